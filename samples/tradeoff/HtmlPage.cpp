// SPDX-License-Identifier: MIT
#include "Charts.h"
#include "Sections.h"
#include "Text.h"

namespace tradeoff
{

namespace
{

std::string section(const std::string& title, const std::string& content)
{
    return content.empty() ? "" : "<section>\n<h2>" + title + "</h2>\n" + content + "</section>\n";
}

std::string paragraph(const std::string& text)
{
    return text.empty() ? "" : "<p>" + escaped(text) + "</p>\n";
}

std::string head(const Report& report)
{
    const std::string title = report.title + (report.scene.empty() ? "" : ": " + report.scene);
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
           "<meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n<title>" +
           escaped(title) + "</title>\n<style>\n" + pageStyle + "</style>\n</head>\n";
}

// Scene, map, size, date: what there is of them.
std::string subject(const Report& report)
{
    std::string text;
    const auto add = [&](const std::string& part) {
        if (!part.empty()) text += (text.empty() ? "" : " · ") + part;
    };
    add(report.scene);
    add(report.map.empty() ? "" : "under " + report.map);
    add(report.width > 0 ? std::to_string(report.width) + " × " + std::to_string(report.height) : "");
    add(report.date);
    return text;
}

std::string header(const Report& report, const Summary& summary)
{
    std::string html = "<header>\n<p class=\"kicker\">" + escaped(report.title) + "</p>\n<h1>" +
                       escaped(headline(report, summary)) + "</h1>\n<p class=\"subject\">" + escaped(subject(report)) + "</p>\n";
    if (report.interrupted)
        html += "<p class=\"warning\" role=\"note\"><strong>Interrupted.</strong> " + escaped(report.interruption) +
                " What follows is what was measured until then.</p>\n";
    if (report.quick)
        html +=
            "<p class=\"warning quiet\" role=\"note\"><strong>Quick run.</strong> Fewer settings, frames and paths than a full "
            "one: good for a first look.</p>\n";
    return html + "</header>\n";
}

std::string comparedWith(const Point& usual, const Point& p)
{
    std::string text = roundedNumber(p.frame.median / usual.frame.median, 2) + " × the time";
    const bool known = usual.beauty.resolved && p.beauty.resolved && usual.beauty.error() > 0.0;
    if (known) text += ", " + roundedNumber(p.beauty.error() / usual.beauty.error(), 2) + " × the error";
    return "<p class=\"compared\">" + text + " of the defaults</p>\n";
}

std::string card(const Report& report, const Summary& summary, const Answer& answer)
{
    std::string html = "<article><h3>" + escaped(answer.question) + "</h3>\n";
    if (!answer.point) return html + "<p>" + escaped(answer.none) + "</p></article>\n";
    const Point& p = report.points[*answer.point];
    html += "<p class=\"big\">" + milliseconds(p.frame.median) + "<span>" + escaped(errorText(p.beauty)) + " error</span></p>\n";
    if (summary.usual && !p.settings.empty()) html += comparedWith(report.points[*summary.usual], p);
    html += "<p>" + escaped(settingsOf(p)) + "</p>\n";
    if (!p.settings.empty())
        html += "<details><summary>for scene.envlight</summary><pre>" + escaped(settingsJson(p)) + "</pre></details>\n";
    return html + "</article>\n";
}

std::string cards(const Report& report, const Summary& summary)
{
    std::string html;
    for (const Answer& a : answersOf(report, summary)) html += card(report, summary, a);
    return "<section class=\"cards\" aria-label=\"Answers\">\n" + html + "</section>\n";
}

std::string listOf(const Texts& texts)
{
    std::string html;
    for (const auto& [name, text] : texts) html += "<dt>" + escaped(name) + "</dt><dd>" + escaped(text) + "</dd>\n";
    return html.empty() ? "" : "<dl>\n" + html + "</dl>\n";
}

std::string conditions(const Report& report)
{
    std::string html = listOf(report.hardware) + paragraph(report.timeStatement) + paragraph(report.referenceStatement) +
                       paragraph(report.errorStatement);
    if (!report.command.empty()) html += "<p>To repeat it:</p>\n<pre>" + escaped(report.command) + "</pre>\n";
    if (!report.defaults.empty())
        html += "<details><summary>The default settings</summary>\n" + listOf(report.defaults) + "</details>\n";
    return html;
}

std::string limits(const Report& report)
{
    std::string html;
    for (const std::string& note : report.notes) html += "<li>" + escaped(note) + "</li>\n";
    return html.empty() ? "" : "<ul>\n" + html + "</ul>\n";
}

}  // namespace

std::string htmlPage(const Report& report)
{
    const Summary summary(report);
    return head(report) + "<body>\n" + header(report, summary) + "<main>\n" + cards(report, summary) +
           section("Real time and reference", comparison(report)) +
           section("Time against error", paretoFigure(report, summary) + pointsTable(report, summary)) +
           section("Where the error is", termSections(report)) +
           section("What each setting buys", sweepFigures(report, summary)) + section("How it was measured", conditions(report)) +
           section("Limits", limits(report)) +
           "</main>\n<footer><p>Written by envlight-tradeoff of osgEnvLight; the same figures, "
           "unrounded, are in tradeoff.csv and tradeoff.json.</p></footer>\n<script>\n" +
           pageScript + "</script>\n</body>\n</html>\n";
}

}  // namespace tradeoff
