// SPDX-License-Identifier: MIT
"use strict";
document.documentElement.classList.add("js");

// The border between the two pictures
const comparison = document.getElementById("comparison");
if (comparison) {
    const range = comparison.querySelector("input");
    const views = comparison.querySelector(".views");
    const show = () => comparison.style.setProperty("--border", range.value + "%");
    const drag = (event) => {
        const box = views.getBoundingClientRect();
        range.value = 100 * (event.clientX - box.left) / box.width;
        show();
    };
    range.addEventListener("input", show);
    views.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        event.preventDefault();
        views.setPointerCapture(event.pointerId);
        drag(event);
    });
    views.addEventListener("pointermove", (event) => {
        if (views.hasPointerCapture(event.pointerId)) drag(event);
    });
    show();
}

// Headings sort; rows without a number stay last.
for (const heading of document.querySelectorAll(".points thead th")) {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener("click", () => {
        const order = heading.getAttribute("aria-sort") === "ascending" ? "descending" : "ascending";
        for (const other of heading.parentNode.children) other.removeAttribute("aria-sort");
        heading.setAttribute("aria-sort", order);
        const body = heading.closest("table").tBodies[0];
        const key = (row) => {
            const text = row.cells[heading.cellIndex].dataset.key;
            return text === "" ? NaN : Number(text);
        };
        const sign = order === "ascending" ? 1 : -1;
        const compare = (a, b) => isNaN(a) || isNaN(b) ? isNaN(a) - isNaN(b) : sign * (a - b);
        body.append(...[...body.rows].sort((a, b) => compare(key(a), key(b))));
    });
}

// The legend brings out one sweep; a second click brings back the others.
const pareto = document.getElementById("pareto");
const legend = [...document.querySelectorAll(".legend button")];
const bringOut = (sweep) => {
    for (const item of pareto.querySelectorAll(".mark, .sweep")) {
        item.classList.toggle("chosen", item.classList.contains(sweep));
        item.classList.toggle("faded", sweep !== "" && !item.classList.contains(sweep));
    }
};
const pressed = () => legend.find((button) => button.getAttribute("aria-pressed") === "true")?.dataset.sweep ?? "";
for (const button of legend) {
    button.setAttribute("aria-pressed", "false");
    button.addEventListener("click", () => {
        const on = button.getAttribute("aria-pressed") !== "true";
        for (const other of legend) other.setAttribute("aria-pressed", String(on && other === button));
        bringOut(pressed());
    });
    button.addEventListener("pointerenter", () => bringOut(button.dataset.sweep));
    button.addEventListener("pointerleave", () => bringOut(pressed()));
}
