// SPDX-License-Identifier: MIT
#include "lights/PenroseTiling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace osgEnvLight
{

ImportanceGrid::ImportanceGrid(int width, int height, const std::vector<double>& values)
{
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    Level base{width, height, {}};
    base.values.reserve(values.size());
    // Never 0 where there is some: single precision ends 1e38 below the mean.
    for (double v : values) base.values.push_back(v > 0.0 ? std::max(float(v / mean), 1e-30f) : 0.0f);
    _levels.push_back(std::move(base));
    while (_levels.back().width > 1 || _levels.back().height > 1) {
        const int w = (_levels.back().width + 1) / 2;
        const int h = (_levels.back().height + 1) / 2;
        _levels.push_back({w, h, std::vector<float>(size_t(w) * size_t(h))});
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) pull(_levels.size() - 1, x, y);
    }
}

size_t ImportanceGrid::cellAt(double x, double y) const
{
    const Level& l = _levels[0];
    const int cx = std::clamp(int(0.5 * x * l.width), 0, l.width - 1);
    const int cy = std::clamp(int(y * l.height), 0, l.height - 1);
    return size_t(cy) * size_t(l.width) + size_t(cx);
}

osg::Vec2d ImportanceGrid::centre(size_t cell) const
{
    const size_t width = size_t(_levels[0].width);
    return osg::Vec2d(2.0 * (double(cell % width) + 0.5) / double(width), (double(cell / width) + 0.5) / _levels[0].height);
}

// The coarsest level that covers the rectangle with at most three by three cells.
double ImportanceGrid::maximum(double x0, double y0, double x1, double y1) const
{
    if (x1 < 0.0 || y1 < 0.0 || x0 >= 2.0 || y0 >= 1.0) return 0.0;
    const Level& base = _levels[0];
    int left = std::clamp(int(0.5 * x0 * base.width), 0, base.width - 1);
    int right = std::clamp(int(0.5 * x1 * base.width), 0, base.width - 1);
    int top = std::clamp(int(y0 * base.height), 0, base.height - 1);
    int bottom = std::clamp(int(y1 * base.height), 0, base.height - 1);
    size_t level = 0;
    for (; right - left > 2 || bottom - top > 2; ++level) {
        left /= 2;
        right /= 2;
        top /= 2;
        bottom /= 2;
    }
    float greatest = 0.0f;
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) greatest = std::max(greatest, _levels[level].at(x, y));
    return double(greatest);
}

void ImportanceGrid::clear(size_t cell)
{
    int x = int(cell) % _levels[0].width;
    int y = int(cell) / _levels[0].width;
    _levels[0].values[cell] = 0.0f;
    for (size_t level = 1; level < _levels.size(); ++level) pull(level, x /= 2, y /= 2);
}

void ImportanceGrid::pull(size_t level, int x, int y)
{
    const Level& below = _levels[level - 1];
    float greatest = 0.0f;
    for (int j = 2 * y; j < std::min(2 * y + 2, below.height); ++j)
        for (int i = 2 * x; i < std::min(2 * x + 2, below.width); ++i) greatest = std::max(greatest, below.at(i, j));
    _levels[level].at(x, y) = greatest;
}

}  // namespace osgEnvLight
