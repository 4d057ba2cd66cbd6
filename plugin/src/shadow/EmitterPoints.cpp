// SPDX-License-Identifier: MIT
#include "shadow/EmitterPoints.h"

#include "base/R2Points.h"
#include "shadow/LitSides.h"
#include "shadow/PointChoice.h"

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// Together they send what the light does.
void evenOut(std::vector<EmitterPoint>::iterator first, std::vector<EmitterPoint>::iterator last)
{
    osg::Vec3d sum, even;
    for (auto p = first; p != last; ++p) {
        sum += p->power;
        even += p->even;
    }
    for (auto p = first; p != last; ++p)
        for (int i = 0; i < 3; ++i) p->power[i] = sum[i] > 0.0 ? p->power[i] * (even[i] / sum[i]) : p->even[i];
}

// How many points each side gets: one, and of the rest by flux, by the largest remainders.
std::vector<unsigned> deal(const std::vector<LitSide>& sides, unsigned count)
{
    double total = 0.0;
    for (const LitSide& side : sides) total += side.flux;
    const auto rest = double(count - sides.size());
    std::vector<unsigned> points;
    std::vector<std::pair<double, size_t>> remainders;
    unsigned dealt = 0;
    for (size_t i = 0; i < sides.size(); ++i) {
        const double share = rest * sides[i].flux / total;
        points.push_back(1 + unsigned(share));
        dealt += points.back();
        remainders.emplace_back(std::floor(share) - share, i);
    }
    std::sort(remainders.begin(), remainders.end());
    for (unsigned k = 0; dealt < count; ++k, ++dealt) ++points[remainders[k % remainders.size()].second];
    return points;
}

std::vector<EmitterPoint> pointsOf(const std::vector<LitSide>& sides, unsigned count, const osg::Vec2d& shift)
{
    const std::vector<unsigned> dealt = deal(sides, count);
    std::vector<EmitterPoint> points;
    for (size_t i = 0; i < sides.size(); ++i) {
        for (unsigned k = 0; k < dealt[i]; ++k) points.push_back(pointOf(sides[i], {k, dealt[i]}, shift));
        if (sides[i].light->picture) evenOut(points.end() - std::ptrdiff_t(dealt[i]), points.end());
    }
    return points;
}

}  // namespace

osg::Vec2d pointShift(unsigned round)
{
    return round == 0 ? osg::Vec2d() : r2Point(round);
}

void placeMaps(std::vector<EmitterPoint>& points, double tangent)
{
    for (size_t i = 0; i < points.size(); ++i) {
        points[i].turn = 2.39996322972865332 * double(i);  // golden angle: neighbours' texels don't fall in step
        points[i].tangent = tangent;
    }
}

std::vector<EmitterPoint> emitterPoints(const std::vector<Emitter>& lights, unsigned count, unsigned round)
{
    const std::vector<LitSide> sides = litSides(lights);
    std::vector<EmitterPoint> points;
    if (sides.size() > count) return chosenPoints(sides, weightsByFlux(sides), count, round);
    if (!sides.empty()) points = pointsOf(sides, count, pointShift(round));
    points.resize(count, darkPoint());
    placeMaps(points, glsl::EMITTER_MAP_TANGENT);
    return points;
}

}  // namespace osgEnvLight
