// SPDX-License-Identifier: MIT
#include "Sections.h"

#include "Text.h"

#include <cmath>

namespace tradeoff
{

namespace
{

// The key is what the column is sorted by; rows without one stay last.
std::string cell(const std::string& text, double key, const std::string& style = "")
{
    return "<td" + (style.empty() ? "" : " class=\"" + style + "\"") + " data-key=\"" + exactNumber(key) + "\">" + text + "</td>";
}

std::string heading(const std::string& text, const std::string& meaning, const std::string& style = "")
{
    return "<th scope=\"col\"" + (style.empty() ? "" : " class=\"" + style + "\"") + " title=\"" + escaped(meaning) + "\">" +
           escaped(text) + "</th>";
}

std::string number(double value, int digits = 2)
{
    return cell(roundedNumber(value, digits), value);
}

std::string errorCell(const Figures* figures)
{
    return figures && std::isfinite(figures->error()) ? cell(errorText(*figures), figures->error()) : cell("–", unknown);
}

std::string range(const Spread& s)
{
    return std::isfinite(s.low) && std::isfinite(s.high) ? roundedNumber(s.low) + "–" + roundedNumber(s.high) : "–";
}

std::string badges(const Summary& summary, size_t index)
{
    std::string text;
    if (index == summary.usual) text += " <span class=\"badge\">default</span>";
    if (index == summary.knee) text += " <span class=\"badge\">knee</span>";
    return text;
}

std::string headings(const Summary& summary)
{
    std::string html = heading("settings", "What differs from the defaults; sorted by the order of measuring") +
                       heading("frame, ms", "Median of the frame's time, until the GPU is done") +
                       heading("10–90 %", "Percentiles of the frame's time [ms]") +
                       heading("error", "RMSE of v / (v + mean of the reference)");
    for (const std::string& term : summary.terms) html += heading(term, "The same of the term " + term + " alone");
    html += heading("bias", "Mean of ours - reference [radiance]") + heading("RMSE", "[radiance]") +
            heading("p99", "99th percentile of the absolute error [radiance]") +
            heading("SSIM", "Structural similarity; 1: alike") +
            heading("FLIP", "Difference that is seen when flipping between the pictures; 0: none");
    for (const std::string& pass : summary.passes) html += heading(pass + ", ms", "Median of the pass's time", "pass");
    return html;
}

std::string failedCells(const Summary& summary)
{
    const size_t others = 8 + summary.terms.size();
    std::string html = cell("failed", unknown);
    for (size_t i = 1; i < others; ++i) html += cell("–", unknown);
    for (size_t i = 0; i < summary.passes.size(); ++i) html += cell("–", unknown, "pass");
    return html;
}

std::string figureCells(const Summary& summary, const Point& p)
{
    const Figures& f = p.beauty;
    std::string html = number(p.frame.median, 3) + cell(range(p.frame), p.frame.low, "range") + errorCell(&f);
    for (const std::string& term : summary.terms) html += errorCell(termOf(p, term));
    html += number(f.bias) + number(f.rmse) + number(f.p99) + number(f.ssim, 3) + number(f.flip);
    for (const std::string& pass : summary.passes) {
        const Spread* time = passOf(p, pass);
        const double median = time ? time->median : unknown;
        html += cell(roundedNumber(median), median, "pass");
    }
    return html;
}

std::string row(const Report& report, const Summary& summary, size_t index)
{
    const Point& p = report.points[index];
    const std::string style = p.failed ? "failed" : isDominated(report.points, index) ? "dominated" : "front";
    std::string name = escaped(nameOf(p));
    const std::string settings = settingsOf(p);
    // A sweep's only setting is its name already.
    if (p.settings.size() > 1 || p.sweep == "preset") name += " <small>" + escaped(settings) + "</small>";
    if (p.failed && !p.failure.empty()) name += " <small>" + escaped(p.failure) + "</small>";
    return "<tr id=\"p" + std::to_string(index) + "\" class=\"" + style + "\"><th scope=\"row\" data-key=\"" +
           std::to_string(index) + "\">" + name + badges(summary, index) + "</th>" +
           (p.failed ? failedCells(summary) : figureCells(summary, p)) + "</tr>\n";
}

}  // namespace

std::string pointsTable(const Report& report, const Summary& summary)
{
    std::string rows;
    for (size_t i = 0; i < report.points.size(); ++i) rows += row(report, summary, i);
    if (rows.empty()) return "";
    const std::string passes =
        summary.passes.empty()
            ? ""
            : "<p><label class=\"switch\"><input type=\"checkbox\" id=\"passes\"> times of the passes</label></p>\n";
    return "<div class=\"points\">\n" + passes + "<div class=\"scroll\"><table>\n<caption><span>All " +
           std::to_string(report.points.size()) +
           " settings; dominated ones are grey. A heading sorts.</span></caption>\n<thead><tr>" + headings(summary) +
           "</tr></thead>\n<tbody>\n" + rows + "</tbody>\n</table></div>\n</div>\n";
}

}  // namespace tradeoff
