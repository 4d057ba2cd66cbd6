// SPDX-License-Identifier: MIT
#include "indirect/SurfaceCells.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

constexpr std::array<int, 3> mostAlong = {128, 128, 64};  // so that their table is a texture of any OpenGL
constexpr double widthInPoints = 1.5;  // a cell holds about two points of each surface: light changes evenly from cell to cell

// Of surfaces' sides that points stand for.
double areaOf(const TracedScene& scene)
{
    double sum = 0.0;
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
        const double area = scene.area(i) * (scene.surfaces[scene.surfaceOf[i]].closed ? 1.0 : 2.0);
        if (std::isfinite(area)) sum += area;
    }
    return sum;
}

using Points = std::vector<SurfaceCells::Share>;

void add(Points& points, unsigned point, float weight)
{
    for (SurfaceCells::Share& s : points)
        if (s.point == point) {
            s.weight += weight;
            return;
        }
    points.push_back({point, weight});
}

SurfaceCells::Shares heaviest(Points& points)
{
    std::sort(points.begin(), points.end(), [](const SurfaceCells::Share& a, const SurfaceCells::Share& b) {
        return a.weight != b.weight ? a.weight > b.weight : a.point < b.point;
    });
    SurfaceCells::Shares shares{};
    std::copy_n(points.begin(), std::min(points.size(), shares.size()), shares.begin());
    return shares;
}

}  // namespace

SurfaceCells::SurfaceCells(const TracedScene& scene, const std::vector<SurfacePart>& parts, unsigned partsPerPoint)
{
    osg::BoundingBoxf box;
    for (const SurfacePart& p : parts) box.expandBy(p.position);
    if (!box.valid()) return;
    const double points = double(parts.size()) / partsPerPoint;
    width = float(widthInPoints * std::sqrt(areaOf(scene) / points));
    if (!(width > 0.0f)) width = std::max(box.radius(), 1e-20f);
    while (!layOut(box)) width *= 1.1f;
    std::vector<Points> sums(size_t(count[0] * count[1] * count[2] * facings));
    for (size_t i = 0; i < parts.size(); ++i)
        forEntriesAbout(parts[i], [&](size_t e, float weight) { add(sums[e], unsigned(i) / partsPerPoint, weight); });
    shares.reserve(sums.size());
    for (Points& p : sums) shares.push_back(heaviest(p));
}

// The first and the last cells' centres lie outside the box: each place in it is between eight.
bool SurfaceCells::layOut(const osg::BoundingBoxf& box)
{
    int all = 1;
    for (size_t k = 0; k < 3; ++k) {
        const double along = std::ceil(double(box._max[int(k)] - box._min[int(k)]) / double(width)) + 1.0;
        if (along > mostAlong[k]) return false;
        count[k] = int(along);
        all *= count[k];
        low[int(k)] = 0.5f * (box._min[int(k)] + box._max[int(k)]) - 0.5f * width * float(count[k]);
    }
    return all <= most;
}

void SurfaceCells::forEntriesAbout(const SurfacePart& part, const std::function<void(size_t, float)>& visit) const
{
    const osg::Vec3f at = (part.position - low) / width - osg::Vec3f(0.5f, 0.5f, 0.5f), n = part.normal;
    for (int corner = 0; corner < 8; ++corner) {
        float weight = 1.0f;
        int cell[3];
        for (int k = 0; k < 3; ++k) {
            const float first = std::floor(at[k]);
            const int after = corner >> k & 1;
            weight *= after ? at[k] - first : 1.0f - (at[k] - first);
            cell[k] = std::clamp(int(first) + after, 0, count[size_t(k)] - 1);
        }
        for (int k = 0; k < 3; ++k)
            if (const float w = weight * n[k] * n[k]; w > 0.0f) visit(entry(cell[0], cell[1], cell[2], 2 * k + (n[k] > 0.0f)), w);
    }
}

}  // namespace osgEnvLight
