// SPDX-License-Identifier: MIT
#include "surface/Caster.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osgEnvLight
{

CasterList::CasterList(std::vector<Caster> casters) : all(std::move(casters)), bound(boundOf(all)) {}

void CasterList::clear()
{
    if (all.empty()) return;
    all.clear();
    bound.init();
    lamps = 0;
    ++version;
}

bool ShownCasters::take(const CasterList& list, double slack)
{
    const bool isTaken = list.version > 0 && list.version == _version;
    if (isTaken || sameShadows(list.all, _casters, slack)) return false;
    _casters.resize(list.all.size());
    for (size_t i = 0; i < _casters.size(); ++i)
        if (!(_casters[i] == list.all[i])) _casters[i] = list.all[i];
    _version = list.version;
    return true;
}

bool sameShadow(const Caster& a, const Caster& b, double slack)
{
    if (a.geometry != b.geometry || a.state != b.state || a.shape != b.shape) return false;
    if (a.worldFromModel == b.worldFromModel) return true;
    const osg::BoundingBox& box = a.geometry->getBoundingBox();
    for (unsigned k = 0; box.valid() && k < 8; ++k) {
        const osg::Vec3d corner = box.corner(k);
        if ((corner * a.worldFromModel - corner * b.worldFromModel).length() > slack) return false;
    }
    return true;
}

bool sameShadows(const std::vector<Caster>& a, const std::vector<Caster>& b, double slack)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](const Caster& x, const Caster& y) { return sameShadow(x, y, slack); });
}

osg::BoundingBoxd boundOf(const Caster& caster)
{
    if (caster.bound.valid()) return caster.bound;
    osg::BoundingBoxd bound;
    const osg::BoundingBox& box = caster.geometry->getBoundingBox();
    for (unsigned k = 0; box.valid() && k < 8; ++k) {
        const osg::Vec3d p = osg::Vec3d(box.corner(k)) * caster.worldFromModel;
        if (std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) bound.expandBy(p);
    }
    return bound;
}

osg::BoundingBoxd boundOf(const std::vector<Caster>& casters)
{
    osg::BoundingBoxd bound;
    for (const Caster& caster : casters) bound.expandBy(boundOf(caster));
    return bound;
}

size_t trianglesOf(const std::vector<Caster>& casters)
{
    size_t sum = 0;
    for (const Caster& caster : casters)
        for (unsigned i = 0; i < caster.geometry->getNumPrimitiveSets(); ++i) {
            const osg::PrimitiveSet& set = *caster.geometry->getPrimitiveSet(i);
            sum += set.getMode() == GL_TRIANGLES ? set.getNumIndices() / 3 : set.getNumIndices();
        }
    return sum;
}

bool mapShows(const osg::Matrixd& projection, const osg::BoundingBoxd& bound)
{
    bool outside[5] = {true, true, true, true, true};
    for (unsigned i = 0; i < 8; ++i) {
        const osg::Vec4d p = osg::Vec4d(bound.corner(i), 1.0) * projection;
        const double reach = p[3] + 1e-3 * std::abs(p[3]);
        const double beyond[5] = {p[0] - reach, -p[0] - reach, p[1] - reach, -p[1] - reach, p[2] - reach};
        for (int k = 0; k < 5; ++k) outside[k] = outside[k] && beyond[k] > 0.0;
    }
    return std::find(outside, outside + 5, true) == outside + 5;
}

}  // namespace osgEnvLight
