// SPDX-License-Identifier: MIT
#include "Plot.h"

#include "Text.h"

#include <algorithm>
#include <numeric>

namespace tradeoff
{

namespace
{

const double letterWidth = 7.4;  // of the widest usual font at the labels' size
const double textHeight = 14.0;

Box boxAt(const Label& label, int direction, double distance)
{
    const double dx[] = {1, -1, 1, -1, 0, 0, 1, -1};
    const double dy[] = {-1, 1, 1, -1, -1, 1, 0, 0};
    const double width = letterWidth * double(letters(label.text));
    const double x = label.x + dx[direction] * distance;
    const double y = label.y + dy[direction] * distance;
    const double left = dx[direction] > 0 ? x : dx[direction] < 0 ? x - width : x - 0.5 * width;
    const double top = dy[direction] > 0 ? y : dy[direction] < 0 ? y - textHeight : y - 0.5 * textHeight;
    return {left, top, left + width, top + textHeight};
}

}  // namespace

std::vector<std::optional<Box>> placeLabels(const std::vector<Label>& labels, const std::vector<Box>& obstacles,
                                            const Box& inside)
{
    std::vector<Box> taken = obstacles;
    const auto isFree = [&](const Box& b) {
        return inside.contains(b) && std::none_of(taken.begin(), taken.end(), [&](const Box& t) { return t.overlaps(b); });
    };
    const auto find = [&](const Label& label) -> std::optional<Box> {
        for (double distance : {7.0, 13.0, 20.0, 28.0})
            for (int direction = 0; direction < 8; ++direction) {
                const Box box = boxAt(label, direction, distance);
                if (isFree(box)) return box;
            }
        return {};
    };
    std::vector<std::optional<Box>> result;
    for (const Label& label : labels) {
        result.push_back(find(label));
        if (result.back()) taken.push_back(*result.back());
    }
    return result;
}

std::vector<double> spreadOut(const std::vector<double>& places, double gap, double low, double high)
{
    std::vector<size_t> order(places.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return places[a] < places[b]; });
    std::vector<double> result = places;
    double least = low;
    for (size_t i : order) {
        result[i] = std::max(result[i], least);
        least = result[i] + gap;
    }
    double most = high;
    for (auto i = order.rbegin(); i != order.rend(); ++i) {
        result[*i] = std::min(result[*i], most);
        most = result[*i] - gap;
    }
    return result;
}

}  // namespace tradeoff
