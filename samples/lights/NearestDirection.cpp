// SPDX-License-Identifier: MIT
#include "NearestDirection.h"

#include <algorithm>
#include <numeric>

NearestDirection::NearestDirection(const osgEnvLight::LightList& lights) : _lights(lights), _order(lights.size())
{
    std::iota(_order.begin(), _order.end(), 0u);
    divide(0, _order.size(), 0);
}

unsigned NearestDirection::find(const osg::Vec3d& direction, unsigned guess) const
{
    Best best{guess, (_lights[guess].direction - direction).length2()};
    search(0, _order.size(), 0, direction, best);
    return best.light;
}

void NearestDirection::divide(size_t first, size_t last, int axis)
{
    if (last - first < 2) return;
    const size_t middle = first + (last - first) / 2;
    const auto at = [this](size_t i) { return _order.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(first), at(middle), at(last),
                     [&](unsigned a, unsigned b) { return _lights[a].direction[axis] < _lights[b].direction[axis]; });
    divide(first, middle, (axis + 1) % 3);
    divide(middle + 1, last, (axis + 1) % 3);
}

void NearestDirection::search(size_t first, size_t last, int axis, const osg::Vec3d& direction, Best& best) const
{
    if (first == last) return;
    const size_t middle = first + (last - first) / 2;
    const osg::Vec3d& d = _lights[_order[middle]].direction;
    const double distance = (d - direction).length2();
    if (distance < best.distance) best = {_order[middle], distance};
    const double across = direction[axis] - d[axis];
    const int next = (axis + 1) % 3;
    across < 0.0 ? search(first, middle, next, direction, best) : search(middle + 1, last, next, direction, best);
    if (across * across >= best.distance) return;
    across < 0.0 ? search(middle + 1, last, next, direction, best) : search(first, middle, next, direction, best);
}
