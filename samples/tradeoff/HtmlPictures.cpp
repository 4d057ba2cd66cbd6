// SPDX-License-Identifier: MIT
#include "Sections.h"

#include "DisplayPng.h"
#include "Text.h"

#include <metrics/Display>

#include <cmath>

namespace tradeoff
{

namespace
{

using osgEnvLight::Picture;

const int smallWidth = 512;  // narrower pictures are shown enlarged, texel by texel

bool isEmpty(const Picture& picture)
{
    return picture.pixels() == 0;
}

std::string image(const Picture& picture, const std::string& uri, const std::string& what)
{
    const std::string style = picture.width < smallWidth ? " class=\"pixelated\"" : "";
    return "<img" + style + " src=\"" + uri + "\" width=\"" + std::to_string(picture.width) + "\" height=\"" +
           std::to_string(picture.height) + "\" alt=\"" + escaped(what) + "\">";
}

std::string exposed(const Report& report, const Picture& picture, const std::string& what)
{
    return image(picture, pngUri(osgEnvLight::displayEncoded(picture, report.exposure)), what);
}

std::string figure(const std::string& picture, const std::string& caption)
{
    return "<figure>" + picture + "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string sharesTable(const TermPictures& term)
{
    std::string rows;
    for (const auto& [name, share] : term.shares) {
        const double length = std::isfinite(share) ? std::fmin(std::fmax(share, 0.0), 1.0) : 0.0;
        rows += "<tr><th scope=\"row\">" + escaped(name) +
                "</th><td class=\"bar\"><span style=\"width:" + coordinate(100.0 * length) + "%\"></span></td><td>" +
                percent(share) + "</td></tr>\n";
    }
    if (rows.empty()) return "";
    return "<table class=\"shares\">\n<caption>Shares of the squared error</caption>\n<tbody>\n" + rows + "</tbody>\n</table>\n";
}

std::string termSection(const Report& report, const TermPictures& term)
{
    std::string html = "<section class=\"term\">\n<h3>" + escaped(term.term) + "</h3>\n";
    if (!term.sentence.empty()) html += "<p>" + escaped(term.sentence) + "</p>\n";
    html += "<div class=\"triple\">\n";
    if (!isEmpty(term.ours)) html += figure(exposed(report, term.ours, "The " + term.term + " term in real time"), "real time");
    if (!isEmpty(term.reference))
        html += figure(exposed(report, term.reference, "The " + term.term + " term of the reference"), "reference");
    if (!isEmpty(term.difference))
        html += figure(
            image(term.difference, pngUri(term.difference), "The difference of the " + term.term + " term in false colours"),
            "difference" + (term.differenceLegend.empty() ? "" : "; " + term.differenceLegend));
    return html + "</div>\n" + sharesTable(term) + "</section>\n";
}

}  // namespace

std::string comparison(const Report& report)
{
    if (isEmpty(report.ours) || isEmpty(report.reference)) return "";
    const int times = std::max(1, 768 / report.ours.width);
    return "<figure id=\"comparison\" style=\"--size:" + std::to_string(times * report.ours.width) +
           "px\">\n<div class=\"views\">\n<div class=\"view\">" +
           exposed(report, report.reference, "The reference, path traced") +
           "<span>reference</span></div>\n<div class=\"view over\">" +
           exposed(report, report.ours, "Real time, with the default settings") +
           "<span>real time</span></div>\n</div>\n<input type=\"range\" min=\"0\" max=\"100\" step=\"0.5\" value=\"50\" "
           "aria-label=\"Border between real time, on the left, and the reference\">\n<figcaption>Real time with the default "
           "settings, and the reference; exposure " +
           roundedNumber(report.exposure, 2) + " stops, sRGB, clipped at white.</figcaption>\n</figure>\n";
}

std::string termSections(const Report& report)
{
    std::string html;
    for (const TermPictures& term : report.pictures) html += termSection(report, term);
    return html;
}

}  // namespace tradeoff
