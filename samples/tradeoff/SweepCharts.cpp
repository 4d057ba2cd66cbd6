// SPDX-License-Identifier: MIT
#include "Charts.h"

#include "Fit.h"
#include "Plot.h"
#include "Text.h"

#include <algorithm>
#include <cmath>

namespace tradeoff
{

namespace
{

const double width = 440.0;
const double height = 300.0;
const double right = 96.0;
const size_t mostPasses = 6;
const double leastDeviation = 0.001;  // that is told from none
// A floor that is a hundredth of the smallest error is none; one that is nearly all of the largest leaves nothing to tell a law
// from.
const double noFloor = 0.01;
const double onlyFloor = 0.97;

struct Curve {
    std::string name;
    std::string style;
    std::vector<Plot::Place> known;
    std::vector<Plot::Place> bounds;  // errors that the reference can't tell
    Fit fit;
    size_t points = 0;  // fitted or not
};

// A term and the pass that makes it have one colour.
std::string colorOf(const Summary& summary, const std::string& name)
{
    std::vector<std::string> names = summary.terms;
    for (const std::string& pass : summary.passes)
        if (std::find(names.begin(), names.end(), pass) == names.end()) names.push_back(pass);
    const auto index = std::find(names.begin(), names.end(), name) - names.begin();
    return "c" + std::to_string(index % 8);
}

Curve errorCurve(const std::string& name, const std::string& style, const std::vector<const Point*>& points)
{
    Curve curve{name, style, {}, {}, {}, points.size()};
    std::vector<double> counts;
    std::vector<double> errors;
    for (const Point* p : points) {
        const Figures* figures = name == "all" ? &p->beauty : termOf(*p, name);
        const double error = figures ? figures->error() : unknown;
        const bool known = error > 0.0 && std::isfinite(error) && figures->resolved;
        counts.push_back(p->number);
        errors.push_back(known ? error : 0.0);
        if (known)
            curve.known.push_back({p->number, error});
        else if (figures && error >= 0.0)
            curve.bounds.push_back({p->number, error});
    }
    curve.fit = fitPowerLaw(counts, errors);
    return curve;
}

std::vector<Curve> errorCurves(const Summary& summary, const std::vector<const Point*>& points)
{
    std::vector<Curve> curves = {errorCurve("all", "whole", points)};
    for (const std::string& term : summary.terms) curves.push_back(errorCurve(term, colorOf(summary, term), points));
    return curves;
}

Curve timeCurve(const std::string& name, const std::string& style, const std::vector<const Point*>& points)
{
    Curve curve{name, style, {}, {}, {}, points.size()};
    for (const Point* p : points) {
        const Spread* time = name == "frame" ? &p->frame : passOf(*p, name);
        if (time && time->median > 0.0 && std::isfinite(time->median)) curve.known.push_back({p->number, time->median});
    }
    return curve;
}

double change(const Curve& curve)
{
    if (curve.known.empty()) return 0.0;
    const auto [least, most] =
        std::minmax_element(curve.known.begin(), curve.known.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
    return most->y - least->y;
}

// The frame, and the passes that the setting changes by more than 3 % of it.
std::vector<Curve> timeCurves(const Summary& summary, const std::vector<const Point*>& points)
{
    std::vector<Curve> curves = {timeCurve("frame", "whole", points)};
    double longest = 0.0;
    for (const Plot::Place& p : curves[0].known) longest = std::max(longest, p.y);
    std::vector<Curve> passes;
    for (const std::string& name : summary.passes) {
        const Curve pass = timeCurve(name, colorOf(summary, name), points);
        if (change(pass) > 0.03 * longest) passes.push_back(pass);
    }
    std::stable_sort(passes.begin(), passes.end(), [](const Curve& a, const Curve& b) { return change(a) > change(b); });
    passes.resize(std::min(passes.size(), mostPasses));
    curves.insert(curves.end(), passes.begin(), passes.end());
    return curves;
}

// The values that were measured, but for those whose text would touch the one before.
std::vector<double> measuredTicks(const Axis& axis, std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    std::vector<double> ticks;
    double end = -width;
    for (double v : values) {
        const double half = 4.0 * double(letters(axis.tickText(v)));
        const double centre = axis.place(v) * (width - Plot::left - right);
        if (centre - half < end + 4.0) continue;
        ticks.push_back(v);
        end = centre + half;
    }
    return ticks;
}

// Both axes, and where errors of 0 go.
struct Axes {
    Axis x;
    Axis y;
    double floor;
};

Axes axesFor(const std::vector<Curve>& curves, const std::string& name)
{
    std::vector<double> xs;
    std::vector<double> ys;
    bool zero = false;
    for (const Curve& c : curves)
        for (const auto* list : {&c.known, &c.bounds})
            for (const Plot::Place& p : *list) {
                xs.push_back(p.x);
                if (p.y > 0.0) ys.push_back(p.y);
                zero |= p.y == 0.0;
            }
    const double floor = ys.empty() ? 3.0 : *std::min_element(ys.begin(), ys.end()) / 2.0;
    if (zero) ys.push_back(floor);
    Axes axes{logAxis(xs, 7), logAxis(ys, 8), floor};
    axes.x.title = name;
    axes.x.ticks = measuredTicks(axes.x, xs);
    return axes;
}

void drawFit(Plot& plot, const Curve& curve)
{
    std::vector<double> xs;
    for (const Plot::Place& p : curve.known) xs.push_back(p.x);
    const double low = *std::min_element(xs.begin(), xs.end());
    const double high = *std::max_element(xs.begin(), xs.end());
    std::vector<Plot::Place> places;
    for (int i = 0; i <= 32; ++i) {
        const double n = low * std::pow(high / low, i / 32.0);
        places.push_back({n, curve.fit.at(n)});
    }
    plot.line(places, "fit " + curve.style);
}

void drawMarks(Plot& plot, const Curve& curve, double floor)
{
    const auto mark = [&](double x, double y, const std::string& inner) {
        plot.add("<g class=\"dot " + curve.style + "\">" + inner + "<circle r=\"3.2\" cx=\"" + coordinate(x) + "\" cy=\"" +
                 coordinate(y) + "\"/></g>");
    };
    for (const Plot::Place& p : curve.known) mark(plot.x(p.x), plot.y(p.y), "");
    for (const Plot::Place& p : curve.bounds) {
        const double y = plot.y(p.y > 0.0 ? p.y : floor);
        mark(plot.x(p.x), y, downArrow(plot.x(p.x), y));
    }
}

// Names at the right ends of the curves.
void drawNames(Plot& plot, const std::vector<Curve>& curves, double floor)
{
    std::vector<double> places;
    std::vector<const Curve*> named;
    for (const Curve& c : curves) {
        const Plot::Place* last = nullptr;
        for (const auto* list : {&c.known, &c.bounds})
            for (const Plot::Place& p : *list)
                if (!last || p.x > last->x) last = &p;
        if (!last) continue;
        named.push_back(&c);
        places.push_back(plot.y(last->y > 0.0 ? last->y : floor) + 4.0);
    }
    const Box& b = plot.inside();
    const std::vector<double> spread = spreadOut(places, 14.0, b.top + 4.0, b.bottom + 4.0);
    for (size_t i = 0; i < named.size(); ++i) plot.text(b.right + 8.0, spread[i], named[i]->name, "name " + named[i]->style);
}

std::string errorSvg(const std::vector<Curve>& curves, const std::string& name)
{
    Axes axes = axesFor(curves, name);
    axes.y.unit = "%";
    axes.y.title = "error (tone-mapped RMSE)";
    Plot plot(axes.x, axes.y, width, height, right);
    for (const Curve& c : curves)
        if (c.fit.valid()) drawFit(plot, c);
    for (const Curve& c : curves) drawMarks(plot, c, axes.floor);
    drawNames(plot, curves, axes.floor);
    return plot.svg("chart", "Error against " + name + ", both logarithmic");
}

std::string timeSvg(const std::vector<Curve>& curves, const std::string& name)
{
    Axes axes = axesFor(curves, name);
    axes.y.title = "time [ms]";
    Plot plot(axes.x, axes.y, width, height, right);
    for (const Curve& c : curves)
        if (!c.known.empty()) plot.line(c.known, "fit " + c.style);
    for (const Curve& c : curves) drawMarks(plot, c, axes.floor);
    drawNames(plot, curves, axes.floor);
    return plot.svg("chart", "Time against " + name + ", both logarithmic");
}

std::string cell(const std::string& text)
{
    return "<td>" + text + "</td>";
}

std::string fitRow(const Curve& c)
{
    std::string row = "<tr><th scope=\"row\"><span class=\"key " + c.style + "\"></span>" + escaped(c.name) + "</th>";
    if (!c.fit.valid()) return row + "<td colspan=\"5\">too few errors that the reference can tell</td></tr>\n";
    const auto [least, most] = std::minmax_element(c.known.begin(), c.known.end(), [](auto& a, auto& b) { return a.y < b.y; });
    const bool law = c.fit.b < onlyFloor * most->y;
    row += cell(law ? percent(c.fit.a) + " · N<sup>" + roundedNumber(-c.fit.p, 2) + "</sup>" : "–");
    row += cell(law ? roundedNumber(-c.fit.p, 2) : "0");
    row += cell(c.fit.used.size() == 2 ? "two points can't tell" : c.fit.b < noFloor * least->y ? "none seen" : percent(c.fit.b));
    row += cell(c.fit.deviation < leastDeviation ? "< " + percent(leastDeviation) : "± " + percent(std::expm1(c.fit.deviation)));
    row += cell(std::to_string(c.fit.used.size()) + " of " + std::to_string(c.points));
    return row + "</tr>\n";
}

std::string fitTable(const std::vector<Curve>& curves, const std::string& name)
{
    std::string rows;
    for (const Curve& c : curves) rows += fitRow(c);
    return "<div class=\"scroll\"><table class=\"fits\">\n<caption><span>Error = a N<sup>−p</sup> + b, N = " + escaped(name) +
           "; b is what more of it does not lessen: bias</span></caption>\n<thead><tr><th scope=\"col\">term</th><th "
           "scope=\"col\">a "
           "N<sup>−p</sup></th><th scope=\"col\">slope −p</th><th scope=\"col\">floor b</th><th scope=\"col\">deviation</th>"
           "<th scope=\"col\">points</th></tr></thead>\n<tbody>\n" +
           rows + "</tbody>\n</table></div>\n";
}

std::vector<const Point*> pointsOf(const Report& report, const std::string& sweep)
{
    std::vector<const Point*> points;
    for (const Point& p : report.points)
        if (p.sweep == sweep && p.measured() && p.number > 0.0 && std::isfinite(p.number)) points.push_back(&p);
    std::stable_sort(points.begin(), points.end(), [](auto* a, auto* b) { return a->number < b->number; });
    return points;
}

}  // namespace

std::string sweepFigures(const Report& report, const Summary& summary)
{
    std::string html;
    for (const std::string& name : summary.sweeps) {
        const std::vector<const Point*> points = pointsOf(report, name);
        if (points.size() < 2 || points.front()->number == points.back()->number) continue;
        const std::vector<Curve> errors = errorCurves(summary, points);
        html += "<figure class=\"sweep-figure\">\n<figcaption><h3>" + escaped(name) +
                "</h3></figcaption>\n<div class=\"pair\">\n" + errorSvg(errors, name) +
                timeSvg(timeCurves(summary, points), name) + "</div>\n" + fitTable(errors, name) + "</figure>\n";
    }
    return html;
}

}  // namespace tradeoff
