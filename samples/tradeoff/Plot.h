// SPDX-License-Identifier: MIT
// Plots as SVG inside HTML: logarithmic axes, marks, lines, and labels that don't overlap. Colours are the page's (page.css).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tradeoff
{

/** A logarithmic axis. */
struct Axis {
    std::string title;
    std::string unit;  // behind the tick's number; "%": numbers are times 100
    double low = 1.0;
    double high = 10.0;
    std::vector<double> ticks;

    /** 0 at low, 1 at high. */
    double place(double value) const;
    std::string tickText(double value) const;
};

/** Contains all values that are positive numbers, with a margin; a whole decade if there are none. At most so many ticks: 1, 2, 5
 * of each decade; fewer over many decades, round numbers between them over a part of one.*/
Axis logAxis(const std::vector<double>& values, size_t ticks);

/** Pixels, y down. */
struct Box {
    double left;
    double top;
    double right;
    double bottom;

    bool overlaps(const Box& b) const { return left < b.right && b.left < right && top < b.bottom && b.top < bottom; }
    bool contains(const Box& b) const { return b.left >= left && b.top >= top && b.right <= right && b.bottom <= bottom; }
};

/** A text beside a place. */
struct Label {
    double x;
    double y;
    std::string text;
    std::string style;  // a class of the page
};

/** Where each label goes so that it stays inside and overlaps neither another nor an obstacle, the first choose first; none
 * where there is no room.*/
std::vector<std::optional<Box>> placeLabels(const std::vector<Label>& labels, const std::vector<Box>& obstacles,
                                            const Box& inside);

/** Moves texts of one column apart: the result has the order of the values and gaps of at least this, within low..high if
 * they fit. */
std::vector<double> spreadOut(const std::vector<double>& places, double gap, double low, double high);

/** Outline of a mark about the origin; there are eight, then they repeat. */
std::string markPath(size_t shape, double radius);

class Plot
{
  public:
    /** The margin that the numbers of the vertical axis need. */
    static constexpr double left = 62.0;

    /** Pixels, and the margin on the right. */
    Plot(const Axis& x, const Axis& y, double width, double height, double right);

    double x(double value) const;
    double y(double value) const;
    const Box& inside() const { return _inside; }

    struct Place {
        double x;
        double y;
    };
    /** A line through values. */
    void line(const std::vector<Place>& values, const std::string& style);
    /** A text at pixels. */
    void text(double x, double y, const std::string& text, const std::string& style);
    /** Labels beside pixels, with a thin line to those that are farther away. */
    void labels(const std::vector<Label>& labels, const std::vector<Box>& obstacles);
    /** SVG, in pixels. */
    void add(const std::string& element) { _content += element + "\n"; }

    /** The whole; the name is what a screen reader says. */
    std::string svg(const std::string& style, const std::string& name) const;

  private:
    std::string axes() const;

    Axis _x;
    Axis _y;
    double _width;
    double _height;
    Box _inside;
    std::string _content;
};

}  // namespace tradeoff
