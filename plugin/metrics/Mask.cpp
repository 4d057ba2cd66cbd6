// SPDX-License-Identifier: MIT
#include <metrics/Mask>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace osgEnvLight
{

namespace
{

// NaN bends, too.
bool bends(const Picture& depth, int x0, int y0, int x1, int y1, int x2, int y2, double step)
{
    const double z = double(depth.at(x1, y1)[0]);
    const double bend = z / double(depth.at(x0, y0)[0]) - 2.0 + z / double(depth.at(x2, y2)[0]);
    return !(std::abs(bend) <= step);
}

// Of the lines through a pixel: along x, along y, and the diagonals. At the picture's border, the line through the next
// pixel inside.
bool atDepthStep(const Picture& depth, int x, int y, double step)
{
    const int cx = std::clamp(x, 1, std::max(depth.width - 2, 1));
    const int cy = std::clamp(y, 1, std::max(depth.height - 2, 1));
    const bool across = depth.width > 2;
    const bool along = depth.height > 2;
    return (across && bends(depth, cx - 1, y, cx, y, cx + 1, y, step)) ||
           (along && bends(depth, x, cy - 1, x, cy, x, cy + 1, step)) ||
           (across && along &&
            (bends(depth, cx - 1, cy - 1, cx, cy, cx + 1, cy + 1, step) ||
             bends(depth, cx - 1, cy + 1, cx, cy, cx + 1, cy - 1, step)));
}

bool sameSurface(const Picture& surface, int x, int y, int otherX, int otherY, double angle)
{
    if (surface.alpha(x, y) != surface.alpha(otherX, otherY)) return false;
    const osg::Vec3d a = surface.color(x, y);
    const osg::Vec3d b = surface.color(otherX, otherY);
    return std::atan2((a ^ b).length(), a * b) <= angle;
}

bool atSurfaceEdge(const Picture& surface, int x, int y, double angle)
{
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, surface.height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, surface.width - 1); ++i)
            if (!sameSurface(surface, x, y, i, j, angle)) return true;
    return false;
}

}  // namespace

Mask Mask::geometry(const Picture& picture)
{
    Mask mask(picture.width, picture.height, false);
    for (size_t i = 0; i < picture.pixels(); ++i) mask.counts[i] = picture.rgba[4 * i + 3] > 0.0f;
    return mask;
}

Mask Mask::unmarked(const Picture& marks)
{
    Mask mask(marks.width, marks.height, false);
    for (size_t i = 0; i < marks.pixels(); ++i) mask.counts[i] = !(marks.rgba[4 * i] > 0.0f);
    return mask;
}

size_t Mask::pixels() const
{
    return size_t(std::count(counts.begin(), counts.end(), true));
}

Mask operator&(const Mask& a, const Mask& b)
{
    requireSameSize(a, b);
    Mask both = a;
    for (size_t i = 0; i < both.counts.size(); ++i) both.counts[i] = a.counts[i] && b.counts[i];
    return both;
}

Mask withoutEdges(const Mask& mask, const Picture& surface, const Picture& depth, double depthStep, double angle)
{
    requireSameSize(mask, surface);
    requireSameSize(mask, depth);
    Mask inside = mask;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y) && (atSurfaceEdge(surface, x, y, angle) || atDepthStep(depth, x, y, depthStep)))
                inside.set(x, y, false);
    return inside;
}

void requireSameSize(int width, int height, int otherWidth, int otherHeight)
{
    if (width == otherWidth && height == otherHeight) return;
    throw std::invalid_argument("sizes differ: " + std::to_string(width) + " x " + std::to_string(height) + " and " +
                                std::to_string(otherWidth) + " x " + std::to_string(otherHeight));
}

}  // namespace osgEnvLight
