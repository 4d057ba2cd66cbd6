// SPDX-License-Identifier: MIT
#include "Pareto.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tradeoff
{

namespace
{

const double logRounding = 1e-9;  // of logarithms

double timeOf(const Point& p)
{
    return p.frame.median;
}

double errorOf(const Point& p)
{
    return p.beauty.error();
}

// The first of those that pass with the smallest key.
template <class Pass, class Key>
Choice smallest(const std::vector<Point>& points, Pass pass, Key key)
{
    Choice best;
    for (size_t i = 0; i < points.size(); ++i)
        if (points[i].measured() && pass(points[i]) && (!best || key(points[i]) < key(points[*best]))) best = i;
    return best;
}

struct Place {
    double x;  // ln time
    double y;  // ln error
};

std::vector<Place> placesOf(const std::vector<Point>& points, const std::vector<size_t>& front)
{
    double least = 1.0;
    for (size_t i : front)  // errors fall along the front: the last that is not 0 is the smallest
        if (errorOf(points[i]) > 0.0) least = errorOf(points[i]);
    std::vector<Place> places;
    for (size_t i : front) {
        const double error = errorOf(points[i]);
        places.push_back({std::log(timeOf(points[i])), std::log(error > 0.0 ? error : 0.1 * least)});
    }
    return places;
}

}  // namespace

double Figures::error() const
{
    return resolved ? tRMSE : noise;
}

bool Point::measured() const
{
    return !failed && frame.median > 0.0 && std::isfinite(frame.median) && std::isfinite(beauty.error());
}

std::vector<size_t> paretoFront(const std::vector<Point>& points)
{
    std::vector<size_t> order;
    for (size_t i = 0; i < points.size(); ++i)
        if (points[i].measured()) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return std::tuple(timeOf(points[a]), errorOf(points[a])) < std::tuple(timeOf(points[b]), errorOf(points[b]));
    });
    std::vector<size_t> front;
    for (size_t i : order)
        if (front.empty() || errorOf(points[i]) < errorOf(points[front.back()])) front.push_back(i);
    return front;
}

bool isDominated(const std::vector<Point>& points, size_t index)
{
    const Point& p = points[index];
    return p.measured() && std::any_of(points.begin(), points.end(), [&](const Point& q) {
               const bool better = timeOf(q) < timeOf(p) || errorOf(q) < errorOf(p);
               return q.measured() && timeOf(q) <= timeOf(p) && errorOf(q) <= errorOf(p) && better;
           });
}

Choice kneeOf(const std::vector<Point>& points)
{
    const std::vector<size_t> front = paretoFront(points);
    if (front.empty()) return {};
    const std::vector<Place> places = placesOf(points, front);
    const Place first = places.front();
    const Place last = places.back();
    Choice knee;
    double farthest = logRounding;
    for (size_t i = 1; i + 1 < places.size(); ++i) {
        const double line = first.y + (last.y - first.y) * (places[i].x - first.x) / (last.x - first.x);
        if (line - places[i].y <= farthest) continue;
        farthest = line - places[i].y;
        knee = front[i];
    }
    if (knee) return knee;
    return last.x + last.y < first.x + first.y - logRounding ? front.back() : front.front();
}

Choice cheapestWithin(const std::vector<Point>& points, double error)
{
    return smallest(
        points, [&](const Point& p) { return errorOf(p) <= error; },
        [](const Point& p) { return std::tuple(timeOf(p), errorOf(p)); });
}

Choice mostExactWithin(const std::vector<Point>& points, double milliseconds)
{
    return smallest(
        points, [&](const Point& p) { return timeOf(p) <= milliseconds; },
        [](const Point& p) { return std::tuple(errorOf(p), timeOf(p)); });
}

Choice answerTo(const Target& target, const std::vector<Point>& points)
{
    return target.kind == Target::ERROR ? cheapestWithin(points, target.value) : mostExactWithin(points, target.value);
}

Choice defaultOf(const std::vector<Point>& points)
{
    for (size_t i = 0; i < points.size(); ++i)
        if (points[i].measured() && points[i].settings.empty()) return i;
    return {};
}

}  // namespace tradeoff
