// SPDX-License-Identifier: MIT
#include "surface/CasterMotion.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace osgEnvLight
{

namespace
{

// Of a hundredth of a pixel, at about a thousand pixels a picture.
const double visibleMotion = 1e-5;
// Of the coordinates: what rounding leaves where an eye that moves was multiplied in and out again.
const double rounding = 1e-12;

// No vertex moves by more than this much.
double motionBound(const osg::Matrixd& a, const osg::Matrixd& b, double reach)
{
    double turn = 0.0, way = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) turn += std::abs(a(i, k) - b(i, k));
    for (int k = 0; k < 3; ++k) way += std::abs(a(3, k) - b(3, k));
    return turn * reach + way;
}

bool hasMoved(const Caster& caster, const osg::Matrixd& former, const osg::Vec3d& eye)
{
    const osg::Matrixd& m = caster.worldFromModel;
    if (m == former) return false;
    const osg::BoundingBox& box = caster.geometry->getBoundingBox();
    if (!box.valid()) return false;
    const double reach = double(box.center().length()) + double(box.radius());
    const osg::BoundingBoxd bound = boundOf(caster);
    const double distance = (bound.center() - eye).length() - bound.radius();
    const double size = bound.center().length() + bound.radius() + eye.length();
    return motionBound(m, former, reach) > std::max(visibleMotion * distance, rounding * size);
}

}  // namespace

std::vector<MovedCaster> CasterMotion::update(const std::vector<Caster>& casters, const osg::Vec3d& eye)
{
    std::vector<Former> former;
    former.swap(_former);
    _former.reserve(casters.size());
    for (const Caster& c : casters) _former.push_back({c.geometry.get(), c.shape, c.worldFromModel});

    const auto sameGeometry = [](const Former& a, const Former& b) { return a.geometry == b.geometry; };
    const bool sameList = std::equal(former.begin(), former.end(), _former.begin(), _former.end(), sameGeometry);
    std::unordered_map<const osg::Geometry*, std::vector<size_t>> places;  // the first is the last
    for (size_t i = former.size(); !sameList && i-- > 0;) places[former[i].geometry].push_back(i);
    const auto find = [&](size_t i) -> const Former* {
        if (sameList) return &former[i];
        const auto found = places.find(_former[i].geometry);
        if (found == places.end() || found->second.empty()) return nullptr;
        const size_t place = found->second.back();
        found->second.pop_back();
        return &former[place];
    };

    std::vector<MovedCaster> moved;
    for (size_t i = 0; i < casters.size(); ++i) {
        const Former* f = find(i);
        if (!f) continue;
        const bool isChanged = f->shape != casters[i].shape;
        if (isChanged || hasMoved(casters[i], f->worldFromModel, eye))
            moved.push_back({casters[i], f->worldFromModel, isChanged});
    }
    return moved;
}

}  // namespace osgEnvLight
