// SPDX-License-Identifier: MIT
#include "Sections.h"
#include "Text.h"

#include <algorithm>

namespace tradeoff
{

namespace
{

// RFC 4180
std::string quoted(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + "\"";
}

using Row = std::vector<std::string>;

std::string lineOf(const Row& row)
{
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) line += (i > 0 ? "," : "") + quoted(row[i]);
    return line + "\n";
}

void addFigureNames(Row& row, const std::string& prefix)
{
    for (const FigureColumn& column : figureColumns) row.push_back(prefix + column.name);
    row.push_back(prefix + "resolved");
}

void addFigures(Row& row, const Figures* figures)
{
    for (const FigureColumn& column : figureColumns) row.push_back(figures ? exactNumber(figures->*column.value) : "");
    row.push_back(!figures ? "" : figures->resolved ? "1" : "0");
}

Row header(const Summary& summary)
{
    Row row = {"sweep", "value", "default", "front", "dominated", "knee", "failure", "frames", "ms", "ms 10 %", "ms 90 %"};
    addFigureNames(row, "");
    for (const std::string& term : summary.terms) addFigureNames(row, term + " ");
    for (const std::string& pass : summary.passes) row.push_back(pass + " ms");
    row.insert(row.end(), summary.varied.begin(), summary.varied.end());
    return row;
}

std::string valueIn(const Texts& texts, const std::string& name)
{
    const auto found = std::find_if(texts.begin(), texts.end(), [&](const auto& text) { return text.first == name; });
    return found == texts.end() ? "" : found->second;
}

Row rowOf(const Report& report, const Summary& summary, size_t index)
{
    const Point& p = report.points[index];
    const auto flag = [](bool set) { return std::string(set ? "1" : "0"); };
    const bool front = std::find(summary.front.begin(), summary.front.end(), index) != summary.front.end();
    Row row = {p.sweep,
               p.value,
               flag(p.settings.empty()),
               flag(front),
               flag(isDominated(report.points, index)),
               flag(index == summary.knee),
               p.failed && p.failure.empty() ? "failed" : p.failure,
               std::to_string(p.frame.frames)};
    for (double ms : {p.frame.median, p.frame.low, p.frame.high}) row.push_back(exactNumber(ms));
    addFigures(row, &p.beauty);
    for (const std::string& term : summary.terms) addFigures(row, termOf(p, term));
    for (const std::string& pass : summary.passes) {
        const Spread* time = passOf(p, pass);
        row.push_back(time ? exactNumber(time->median) : "");
    }
    for (const std::string& name : summary.varied) {
        const std::string own = valueIn(p.settings, name);
        row.push_back(own.empty() ? valueIn(report.defaults, name) : own);
    }
    return row;
}

}  // namespace

std::string csvText(const Report& report)
{
    const Summary summary(report);
    std::string text = lineOf(header(summary));
    for (size_t i = 0; i < report.points.size(); ++i) text += lineOf(rowOf(report, summary, i));
    return text;
}

}  // namespace tradeoff
