// SPDX-License-Identifier: MIT
#include "Charts.h"

#include "Plot.h"
#include "Text.h"

#include <algorithm>
#include <cmath>

namespace tradeoff
{

namespace
{

const double markRadius = 5.0;

Box around(double x, double y, double radius)
{
    return {x - radius, y - radius, x + radius, y + radius};
}

std::string classOf(size_t sweep)
{
    return "c" + std::to_string(sweep % 8) + " k" + std::to_string(sweep);
}

// The shapes shift when the colours repeat.
size_t shapeOf(size_t sweep)
{
    return sweep + sweep / 8;
}

std::string at(double x, double y)
{
    return " transform=\"translate(" + coordinate(x) + " " + coordinate(y) + ")\"";
}

class ParetoChart
{
  public:
    ParetoChart(const Report& report, const Summary& summary, bool wide)
        : _report(report), _summary(summary), _wide(wide), _floor(floorOf(report.points)), _plot(plotFor())
    {
    }

    std::string svg()
    {
        for (size_t i = 0; i < _report.points.size(); ++i) addObstacle(i);
        drawNoise();
        drawSweeps();
        drawFront();
        for (size_t i = 0; i < _report.points.size(); ++i)
            if (isDominated(_report.points, i)) drawMark(i, "dominated");
        for (size_t i = 0; i < _report.points.size(); ++i)
            if (_report.points[i].measured() && !isDominated(_report.points, i)) drawMark(i, "front");
        drawRings();
        drawLabels();
        return _plot.svg(_wide ? "chart pareto wide" : "chart pareto narrow",
                         "Time of a frame against error, both logarithmic, of all settings; the table below has the numbers");
    }

  private:
    // Where errors of 0 are drawn.
    static double floorOf(const std::vector<Point>& points)
    {
        double least = 0.0;
        for (const Point& p : points)
            if (p.measured() && p.beauty.error() > 0.0 && (least == 0.0 || p.beauty.error() < least)) least = p.beauty.error();
        return least > 0.0 ? least / 2.0 : 3.0;
    }

    double shown(const Point& p) const { return p.beauty.error() > 0.0 ? p.beauty.error() : _floor; }
    bool isBound(const Point& p) const { return !p.beauty.resolved || !(p.beauty.error() > 0.0); }
    double xOf(const Point& p) const { return _plot.x(p.frame.median); }
    double yOf(const Point& p) const { return _plot.y(shown(p)); }

    Plot plotFor() const
    {
        std::vector<double> times;
        std::vector<double> errors;
        for (const Point& p : _report.points) {
            if (!p.measured()) continue;
            times.push_back(p.frame.median);
            errors.push_back(shown(p));
        }
        Axis x = logAxis(times, _wide ? 14 : 6);
        Axis y = logAxis(errors, _wide ? 12 : 9);
        x.title = "frame [ms]";
        y.title = "error (tone-mapped RMSE)";
        y.unit = "%";
        return Plot(x, y, _wide ? 1000.0 : 380.0, _wide ? 600.0 : 460.0, 12.0);
    }

    // Labels keep off the marks and their rings and arrows.
    void addObstacle(size_t index)
    {
        const Point& p = _report.points[index];
        if (!p.measured()) return;
        const bool ringed = index == _summary.usual || index == _summary.knee;
        _marks.push_back(around(xOf(p), yOf(p), ringed ? 2.0 * markRadius : markRadius));
        if (isBound(p)) _marks.back().bottom += 10.0;
    }

    // Where the reference's own noise is as large as the error.
    void drawNoise()
    {
        const double noise = _report.points[_summary.usual.value_or(_summary.front[0])].beauty.noise;
        const Box& b = _plot.inside();
        const double y = noise > 0.0 ? std::max(_plot.y(noise), b.top) : b.bottom;
        if (y >= b.bottom) return;
        _plot.add("<rect class=\"noise\" x=\"" + coordinate(b.left) + "\" y=\"" + coordinate(y) + "\" width=\"" +
                  coordinate(b.right - b.left) + "\" height=\"" + coordinate(b.bottom - y) + "\"/>");
        const double length = 150.0;
        for (double right = b.right; right >= b.left + length; right -= 10.0) {
            const Box box{right - length, y, right, std::min(y + 16.0, b.bottom)};
            if (std::any_of(_marks.begin(), _marks.end(), [&](const Box& m) { return m.overlaps(box); })) continue;
            _noise = box;
            _plot.text(right - 6.0, y + 13.0, "noise of the reference", "hint end");
            return;
        }
    }

    void drawSweeps()
    {
        for (size_t s = 0; s < _summary.sweeps.size(); ++s) {
            std::vector<const Point*> points;
            for (const Point& p : _report.points)
                if (_summary.sweepOf(p) == s && p.measured() && std::isfinite(p.number)) points.push_back(&p);
            if (points.size() < 2) continue;
            std::stable_sort(points.begin(), points.end(), [](auto* a, auto* b) { return a->number < b->number; });
            std::vector<Plot::Place> places;
            for (const Point* p : points) places.push_back({p->frame.median, shown(*p)});
            _plot.line(places, "sweep " + classOf(s));
        }
    }

    // Between two settings nothing was measured: the error stays until the next one is affordable.
    void drawFront()
    {
        std::string d;
        double x = xOf(_report.points[_summary.front[0]]);
        double y = _plot.inside().top;
        const auto step = [&](double nextX, double nextY) {
            d += (d.empty() ? "M" : "L") + coordinate(nextX) + " " + coordinate(y) + "V" + coordinate(nextY);
            _frontline.push_back({x, y - 1.0, nextX, y + 1.0});
            _frontline.push_back({nextX - 1.0, y, nextX + 1.0, nextY});
            x = nextX;
            y = nextY;
        };
        for (size_t i : _summary.front) step(xOf(_report.points[i]), yOf(_report.points[i]));
        step(_plot.inside().right, y);
        _plot.add("<path class=\"frontline\" d=\"" + d + "\"/>");
    }

    std::string describe(const Point& p) const
    {
        return nameOf(p) + "\n" + milliseconds(p.frame.median) + " (" + roundedNumber(p.frame.low) + " to " +
               roundedNumber(p.frame.high) + "), error " + errorText(p.beauty) + "\n" + settingsOf(p);
    }

    void drawMark(size_t index, const std::string& style)
    {
        const Point& p = _report.points[index];
        const size_t sweep = _summary.sweepOf(p);
        std::string mark = "<a class=\"mark " + style + " " + classOf(sweep) + "\" href=\"#p" + std::to_string(index) +
                           "\"><title>" + escaped(describe(p)) + "</title>";
        if (style == "front" && p.frame.high > p.frame.low && p.frame.low > 0.0)
            mark += "<path class=\"spread\" d=\"M" + coordinate(std::max(_plot.x(p.frame.low), _plot.inside().left)) + " " +
                    coordinate(yOf(p)) + "H" + coordinate(std::min(_plot.x(p.frame.high), _plot.inside().right)) + "\"/>";
        if (isBound(p)) mark += downArrow(xOf(p), yOf(p));
        mark += "<path d=\"" + markPath(shapeOf(sweep), style == "front" ? markRadius : 0.8 * markRadius) + "\"" +
                at(xOf(p), yOf(p)) + "/></a>";
        _plot.add(mark);
    }

    void drawRings()
    {
        for (const auto& [choice, style] : {std::pair(_summary.usual, "usual"), std::pair(_summary.knee, "knee")})
            if (choice)
                _plot.add("<circle class=\"ring " + std::string(style) + "\" r=\"" +
                          coordinate(markRadius * (style == std::string("knee") ? 2.4 : 1.8)) + "\"" +
                          at(xOf(_report.points[*choice]), yOf(_report.points[*choice])) + "/>");
    }

    void drawLabels()
    {
        std::vector<Label> labels;
        const auto add = [&](const Choice& choice, const std::string& text, const char* style) {
            if (choice) labels.push_back({xOf(_report.points[*choice]), yOf(_report.points[*choice]), text, style});
        };
        const bool same = _summary.usual && _summary.usual == _summary.knee;
        add(_summary.usual, same ? "default and knee" : "default", "strong");
        if (_summary.knee && !same)
            add(_summary.knee, _wide ? "knee: " + nameOf(_report.points[*_summary.knee]) : "knee", "strong");
        for (size_t i : _summary.front)
            if (i != _summary.usual && i != _summary.knee && (_wide || _report.points[i].sweep == "preset"))
                add(i, nameOf(_report.points[i]), "");
        for (size_t i = 0; i < _report.points.size(); ++i) {
            const Point& p = _report.points[i];
            if (_wide && p.sweep == "preset" && isDominated(_report.points, i) && i != _summary.usual) add(i, p.value, "faint");
        }
        std::vector<Box> obstacles = _marks;
        if (_noise) obstacles.push_back(*_noise);
        obstacles.insert(obstacles.end(), _frontline.begin(), _frontline.end());
        _plot.labels(labels, obstacles);
    }

    const Report& _report;
    const Summary& _summary;
    const bool _wide;
    const double _floor;
    Plot _plot;
    std::vector<Box> _marks;
    std::optional<Box> _noise;    // its text
    std::vector<Box> _frontline;  // its steps
};

std::string legend(const Report& report, const Summary& summary)
{
    std::string items;
    for (size_t s = 0; s < summary.sweeps.size(); ++s) {
        const bool any = std::any_of(report.points.begin(), report.points.end(),
                                     [&](const Point& p) { return p.measured() && summary.sweepOf(p) == s; });
        if (!any) continue;
        items += "<li><button type=\"button\" data-sweep=\"k" + std::to_string(s) + "\" class=\"" + classOf(s) +
                 "\"><svg viewBox=\"-8 -8 16 16\" aria-hidden=\"true\"><path d=\"" + markPath(shapeOf(s), 5.0) + "\"/></svg>" +
                 escaped(summary.sweeps[s]) + "</button></li>\n";
    }
    return items.empty() ? "" : "<ul class=\"legend\">\n" + items + "</ul>\n";
}

}  // namespace

std::string downArrow(double x, double y)
{
    return "<path class=\"arrow\" d=\"M" + coordinate(x) + " " + coordinate(y) + "v14m-3.5 -4l3.5 4l3.5 -4\"/>";
}

std::string paretoFigure(const Report& report, const Summary& summary)
{
    if (summary.front.empty()) return "";
    return "<figure id=\"pareto\">\n" + legend(report, summary) + ParetoChart(report, summary, true).svg() +
           ParetoChart(report, summary, false).svg() +
           "<figcaption>Down and left is better. The step line is the Pareto front: what each time buys at most. Marks in colour "
           "are on it, with bars from the 10th to the 90th percentile of the time; grey ones are dominated, another setting "
           "being "
           "no slower and no less exact. An arrow: the error is no larger than that, and the reference can't tell how much less "
           "it is. A mark leads to its row of the table.</figcaption>\n</figure>\n";
}

}  // namespace tradeoff
