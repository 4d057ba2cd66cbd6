// SPDX-License-Identifier: MIT
#include "Plot.h"

#include "Text.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tradeoff
{

namespace
{

const double topMargin = 30.0;
const double bottomMargin = 44.0;
const double pi = 3.14159265358979323846;

using Corners = std::vector<std::pair<double, double>>;

std::string path(const Corners& corners, double scale)
{
    std::string d;
    for (const auto& [x, y] : corners) d += (d.empty() ? "M" : "L") + coordinate(scale * x) + " " + coordinate(scale * y);
    return d + "Z";
}

Corners star(int points, double inner)
{
    Corners corners;
    for (int i = 0; i < 2 * points; ++i) {
        const double r = i % 2 == 0 ? 1.35 : inner;
        corners.emplace_back(r * std::sin(pi * i / points), -r * std::cos(pi * i / points));
    }
    return corners;
}

Corners cross(bool tilted)
{
    const double a = 0.42;
    const double b = 1.15;
    Corners corners = {{-a, -b}, {a, -b}, {a, -a}, {b, -a}, {b, a},   {a, a},
                       {a, b},   {-a, b}, {-a, a}, {-b, a}, {-b, -a}, {-a, -a}};
    const double c = std::sqrt(0.5);
    if (tilted)
        for (auto& [x, y] : corners) std::tie(x, y) = std::pair(c * (x - y), c * (x + y));
    return corners;
}

std::string number(const char* name, double value)
{
    return std::string(" ") + name + "=\"" + coordinate(value) + "\"";
}

std::string rule(double x1, double y1, double x2, double y2, const std::string& style)
{
    return "<line class=\"" + style + "\"" + number("x1", x1) + number("y1", y1) + number("x2", x2) + number("y2", y2) + "/>\n";
}

std::string textAt(double x, double y, const std::string& text, const std::string& style)
{
    return "<text class=\"" + style + "\"" + number("x", x) + number("y", y) + ">" + escaped(text) + "</text>\n";
}

}  // namespace

std::string markPath(size_t shape, double radius)
{
    const double r = radius;
    switch (shape % 8) {
        case 0: {
            const std::string arc = "a" + coordinate(r) + " " + coordinate(r) + " 0 1 0 ";
            return "M" + coordinate(-r) + " 0" + arc + coordinate(2 * r) + " 0" + arc + coordinate(-2 * r) + " 0Z";
        }
        case 1:
            return path({{-0.88, -0.88}, {0.88, -0.88}, {0.88, 0.88}, {-0.88, 0.88}}, r);
        case 2:
            return path({{0, -1.2}, {1.1, 0.8}, {-1.1, 0.8}}, r);
        case 3:
            return path({{0, -1.25}, {1.25, 0}, {0, 1.25}, {-1.25, 0}}, r);
        case 4:
            return path({{0, 1.2}, {1.1, -0.8}, {-1.1, -0.8}}, r);
        case 5:
            return path(cross(false), r);
        case 6:
            return path(star(5, 0.6), r);
        default:
            return path(cross(true), r);
    }
}

Plot::Plot(const Axis& x, const Axis& y, double width, double height, double right)
    : _x(x), _y(y), _width(width), _height(height), _inside{left, topMargin, width - right, height - bottomMargin}
{
}

double Plot::x(double value) const
{
    return _inside.left + _x.place(value) * (_inside.right - _inside.left);
}

double Plot::y(double value) const
{
    return _inside.bottom - _y.place(value) * (_inside.bottom - _inside.top);
}

void Plot::line(const std::vector<Place>& values, const std::string& style)
{
    std::string points;
    for (const Place& v : values) points += (points.empty() ? "" : " ") + coordinate(x(v.x)) + "," + coordinate(y(v.y));
    add("<polyline class=\"" + style + "\" points=\"" + points + "\"/>");
}

void Plot::text(double x, double y, const std::string& text, const std::string& style)
{
    _content += textAt(x, y, text, style);
}

void Plot::labels(const std::vector<Label>& labels, const std::vector<Box>& obstacles)
{
    const std::vector<std::optional<Box>> boxes = placeLabels(labels, obstacles, _inside);
    for (size_t i = 0; i < labels.size(); ++i) {
        if (!boxes[i]) continue;
        const Label& label = labels[i];
        const Box& box = *boxes[i];
        const double nearX = std::clamp(label.x, box.left, box.right);
        const double nearY = std::clamp(label.y, box.top, box.bottom);
        if (std::hypot(nearX - label.x, nearY - label.y) > 15.0) _content += rule(label.x, label.y, nearX, nearY, "leader");
        const bool before = box.right <= label.x;
        const bool behind = box.left >= label.x;
        _content += textAt(behind   ? box.left
                           : before ? box.right
                                    : label.x,
                           box.bottom - 3.5, label.text,
                           "label " +
                               std::string(behind   ? ""
                                           : before ? "end "
                                                    : "middle ") +
                               label.style);
    }
}

std::string Plot::axes() const
{
    std::string result;
    for (double tick : _x.ticks) {
        result += rule(x(tick), _inside.top, x(tick), _inside.bottom, "grid");
        result += textAt(x(tick), _inside.bottom + 17.0, _x.tickText(tick), "tick middle");
    }
    for (double tick : _y.ticks) {
        result += rule(_inside.left, y(tick), _inside.right, y(tick), "grid");
        result += textAt(_inside.left - 7.0, y(tick) + 4.0, _y.tickText(tick), "tick end");
    }
    result += textAt(_inside.right, _height - 8.0, _x.title, "axis end");
    result += textAt(4.0, 14.0, _y.title, "axis");
    return result;
}

std::string Plot::svg(const std::string& style, const std::string& name) const
{
    return "<svg class=\"" + style + "\" viewBox=\"0 0 " + coordinate(_width) + " " + coordinate(_height) +
           "\" role=\"group\" aria-label=\"" + escaped(name) + "\">\n" + axes() + _content + "</svg>\n";
}

}  // namespace tradeoff
