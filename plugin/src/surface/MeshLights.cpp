// SPDX-License-Identifier: MIT
#include "surface/MeshLights.h"

#include "surface/Axes.h"
#include "surface/CasterMesh.h"
#include "surface/MeshShapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osgEnvLight
{

namespace
{

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

// From one place to another, if that neither scales nor mirrors.
bool isRigid(const osg::Matrixd& m)
{
    const double slack = 1e-6;
    for (int i = 0; i < 3; ++i)
        for (int k = i; k < 3; ++k)
            if (!(std::abs(axisOf(m, i) * axisOf(m, k) - (i == k ? 1.0 : 0.0)) < slack)) return false;
    return !mirrors(m);
}

// The same shapes, measured where the caster was first.
bool follows(const Caster& caster, const Caster& first)
{
    return caster.shape == first.shape && caster.bothSides == first.bothSides &&
           isRigid(osg::Matrixd::inverse(first.worldFromModel) * caster.worldFromModel);
}

}  // namespace

void MeshLights::place(Lamp& lamp, const Caster& caster)
{
    const osg::Matrixd motion = osg::Matrixd::inverse(lamp.first.worldFromModel) * caster.worldFromModel;
    lamp.now = caster;
    lamp.placed = lamp.shapes;
    if (caster.worldFromModel != lamp.first.worldFromModel)
        for (Emitter& shape : lamp.placed) shape = shape.moved(motion);
}

std::vector<Emitter> MeshLights::of(const std::vector<Caster>& casters, double scale, double slack)
{
    std::multimap<const osg::Geometry*, Lamp> former;
    former.swap(_lamps);
    std::vector<Emitter> lights;
    for (const Caster& caster : casters) {
        if (caster.lamp == osg::Vec3f()) continue;
        const auto [first, last] = former.equal_range(caster.geometry.get());
        auto known = std::find_if(first, last, [&](const auto& entry) {
            return entry.second.now.bothSides == caster.bothSides && sameShadow(entry.second.now, caster, slack);
        });
        const bool stands = known != last;
        if (!stands) known = std::find_if(first, last, [&](const auto& entry) { return follows(caster, entry.second.first); });
        const auto lamp = known == last ? _lamps.emplace(caster.geometry.get(), Lamp{caster, measure(caster), caster, {}})
                                        : _lamps.insert(former.extract(known));
        lamp->second.first.state = nullptr;  // nothing is drawn of it: the user's textures are not kept
        if (!stands) place(lamp->second, caster);
        for (const Emitter& shape : lamp->second.placed) {
            lights.push_back(shape);
            lights.back().radiance = osg::componentMultiply(shape.radiance, osg::Vec3d(caster.lamp) * scale);
        }
    }
    return lights;
}

}  // namespace osgEnvLight
