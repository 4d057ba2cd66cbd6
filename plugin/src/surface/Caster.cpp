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

namespace
{

void addTo(ChangedPart& part, const Caster& caster)
{
    const osg::BoundingBoxd bound = boundOf(caster);
    if (caster.moves || !bound.valid())
        part.addAll();
    else
        part.add(bound);
}

// Applications change vertices and may not say that their bound is another.
void addTo(ChangedPart& part, const Caster& former, const Caster& now)
{
    addTo(part, former);
    addTo(part, now);
    const bool isDeformed = former.geometry == now.geometry && former.shape != now.shape;
    if (isDeformed && !(former.isMeasured && now.isMeasured)) part.addAll();
}

}  // namespace

bool ShownCasters::take(const CasterList& list, double slack)
{
    const bool isTaken = list.version > 0 && list.version == _version;
    if (isTaken || sameShadows(list.all, _casters, slack)) return false;
    _changed = ChangedPart();
    const size_t kept = std::min(_casters.size(), list.all.size());
    for (size_t i = 0; i < kept; ++i)
        if (!sameShadow(_casters[i], list.all[i], 0.0)) addTo(_changed, _casters[i], list.all[i]);
    for (size_t i = kept; i < _casters.size(); ++i) addTo(_changed, _casters[i]);
    for (size_t i = kept; i < list.all.size(); ++i) addTo(_changed, list.all[i]);
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

namespace
{

template <class Vertices>
bool addVertices(osg::BoundingBox& box, const osg::Array& array)
{
    const auto* vertices = dynamic_cast<const Vertices*>(&array);
    if (!vertices) return false;
    for (const auto& v : *vertices) box.expandBy(osg::Vec3(float(v.x()), float(v.y()), float(v.z())));
    return true;
}

osg::BoundingBoxd inWorld(const osg::BoundingBox& box, const osg::Matrixd& worldFromModel)
{
    osg::BoundingBoxd bound;
    for (unsigned k = 0; box.valid() && k < 8; ++k) {
        const osg::Vec3d p = osg::Vec3d(box.corner(k)) * worldFromModel;
        if (std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) bound.expandBy(p);
    }
    return bound;
}

}  // namespace

void measureBound(Caster& caster)
{
    const osg::Array* array = caster.geometry->getVertexArray();
    osg::BoundingBox box;
    caster.isMeasured = array && (addVertices<osg::Vec3Array>(box, *array) || addVertices<osg::Vec3dArray>(box, *array));
    if (caster.isMeasured) caster.bound = inWorld(box, caster.worldFromModel);
}

osg::BoundingBoxd boundOf(const Caster& caster)
{
    return caster.bound.valid() ? caster.bound : inWorld(caster.geometry->getBoundingBox(), caster.worldFromModel);
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
