// SPDX-License-Identifier: MIT
#include "surface/MeshLights.h"

#include "surface/CasterMesh.h"
#include "surface/MeshShapes.h"

#include <algorithm>
#include <utility>

namespace osgEnvLight
{

namespace
{

bool mirrors(const osg::Matrixd& m)
{
    const auto row = [&m](int i) { return osg::Vec3d(m(i, 0), m(i, 1), m(i, 2)); };
    return (row(0) ^ row(1)) * row(2) < 0.0;
}

// About the middle of its bound, or large coordinates would cost digits.
std::vector<Emitter> measure(const Caster& caster)
{
    const osg::BoundingBoxd bound = boundOf(caster);
    if (!bound.valid()) return {};
    const osg::Vec3d origin = bound.center();
    CasterMesh mesh = meshOf(caster, origin);
    if (mirrors(caster.worldFromModel))
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    std::vector<Emitter> shapes = shapesOf(mesh, caster.bothSides);
    for (Emitter& shape : shapes) shape.center += origin;
    return shapes;
}

}  // namespace

std::vector<Emitter> MeshLights::of(const std::vector<Caster>& casters, double scale, double slack)
{
    std::multimap<const osg::Geometry*, Lamp> former;
    former.swap(_lamps);
    std::vector<Emitter> lights;
    for (const Caster& caster : casters) {
        if (caster.lamp == osg::Vec3f()) continue;
        const auto [first, last] = former.equal_range(caster.geometry.get());
        const auto known = std::find_if(first, last, [&](const auto& entry) {
            return entry.second.caster.bothSides == caster.bothSides && sameShadow(entry.second.caster, caster, slack);
        });
        const auto lamp = known == last ? _lamps.emplace(caster.geometry.get(), Lamp{caster, measure(caster)})
                                        : _lamps.insert(former.extract(known));
        for (const Emitter& shape : lamp->second.shapes) {
            lights.push_back(shape);
            lights.back().radiance = osg::componentMultiply(shape.radiance, osg::Vec3d(caster.lamp) * scale);
        }
    }
    return lights;
}

}  // namespace osgEnvLight
