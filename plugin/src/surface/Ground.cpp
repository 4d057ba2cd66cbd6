// SPDX-License-Identifier: MIT
#include "surface/Ground.h"

#include <osgEnvLight/Material>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgEnvLight
{

namespace
{

const double infinity = std::numeric_limits<double>::infinity();

// Of the scene's radius. A sun 5 degrees high throws the top's shadow 23 radii away.
const double sideOverRadius = 24.0;
// A floor of the scene's own at its lowest height is above it.
const double gapOverRadius = 2e-4;

// Height in the world; those that are not finite don't count.
template <class Vertices>
double lowestVertex(const osg::Array& array, const osg::Matrixd& worldFromModel)
{
    double lowest = infinity;
    for (const auto& v : static_cast<const Vertices&>(array)) {
        const double height = (osg::Vec3d(v) * worldFromModel).z();
        if (height < lowest && std::isfinite(height)) lowest = height;
    }
    return lowest;
}

// The corners of a turned box may lie far below what is in it.
double lowestOf(const Caster& caster)
{
    const osg::Array* vertices = caster.moves ? nullptr : caster.geometry->getVertexArray();
    const osg::Array::Type type = vertices ? vertices->getType() : osg::Array::ArrayType;
    if (type == osg::Array::Vec3ArrayType) return lowestVertex<osg::Vec3Array>(*vertices, caster.worldFromModel);
    if (type == osg::Array::Vec3dArrayType) return lowestVertex<osg::Vec3dArray>(*vertices, caster.worldFromModel);
    return caster.bound.zMin();
}

// As low as these, if they are lower than what is known.
double lowestOf(const std::vector<Caster>& casters, double lowest)
{
    for (const Caster& caster : casters)
        if (caster.bound.valid() && caster.bound.zMin() < lowest) lowest = std::min(lowest, lowestOf(caster));
    return lowest;
}

// Its bounds are not for the host: neither its home view nor its near plane nor its culling goes by them.
struct NoBounds : osg::Drawable::ComputeBoundingBoxCallback {
    osg::BoundingBox computeBound(const osg::Drawable&) const override { return osg::BoundingBox(); }
};

osg::ref_ptr<osg::Geometry> makeRectangle(double halfSide)
{
    const float s = float(halfSide);
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::Vec3 corners[] = {{-s, -s, 0}, {s, -s, 0}, {-s, s, 0}, {s, s, 0}};
    const osg::Vec3 up(0, 0, 1);
    geometry->setName("ground of osgEnvLight");
    geometry->setVertexArray(new osg::Vec3Array(unsigned(std::size(corners)), corners));
    geometry->setNormalArray(new osg::Vec3Array(1u, &up), osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4));
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(false);  // it leaves nothing in a context
    geometry->setComputeBoundingBoxCallback(new NoBounds);
    geometry->setCullingActive(false);
    osg::StateSet& state = *geometry->getOrCreateStateSet();
    Material::setShadowCatcher(state);
    state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED);
    return geometry;
}

// Depths in front of the eye at which the corners of the view, and so all of it, meet a level plane [eye space].
struct Depths {
    double nearest = infinity;
    double farthest = 0.0;
    bool endless = false;  // the horizon is in view
};

Depths depthsOf(const osg::Matrixd& projection, const osg::Matrixd& worldFromEye, double height)
{
    Depths depths;
    const osg::Matrixd eyeFromClip = osg::Matrixd::inverse(projection);
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0}) {
            const osg::Vec3d a = osg::Vec3d(x, y, -1) * eyeFromClip, b = osg::Vec3d(x, y, 1) * eyeFromClip;
            const double above = (a * worldFromEye).z() - height, slope = (b * worldFromEye).z() - height - above;
            const double depth = -(a + (b - a) * (-above / slope)).z();
            if (!(slope < 0.0) || !(depth > 0.0)) {
                depths.endless = true;
                continue;
            }
            depths.nearest = std::min(depths.nearest, depth);
            depths.farthest = std::max(depths.farthest, depth);
        }
    return depths;
}

}  // namespace

void Ground::update(const CasterList& casters)
{
    if (casters.version == _version && _version > 0) return;
    _version = casters.version;
    _lowest = lowestOf(casters.all, _lowest);
    const double radius = 0.5 * diagonal(casters.bound);
    if (!casters.bound.valid() || !std::isfinite(_lowest) || !(radius > 0.0)) return;
    _radius = std::max(_radius, radius);
    const osg::Vec3d center = casters.bound.center();
    const bool away = (osg::Vec2d(center.x(), center.y()) - osg::Vec2d(_origin.x(), _origin.y())).length() > _radius;
    if (!_geometry || away) _origin = center;
    _origin.z() = _lowest - gapOverRadius * _radius;
    if (sideOverRadius * _radius <= _halfSide) return;
    _halfSide = 1.25 * sideOverRadius * _radius;  // what grows does not make another one in every frame
    _geometry = makeRectangle(_halfSide);
}

void Ground::cull(osgUtil::CullVisitor& cv, const osg::Matrixd& worldFromEye) const
{
    if (!_geometry) return;
    const Depths depths = depthsOf(*cv.getProjectionMatrix(), worldFromEye, _origin.z());
    if (!(depths.farthest > 0.0)) return;
    const osg::Matrixd eyeFromWorld = osg::Matrixd::inverse(worldFromEye);
    const double reach = (_origin * eyeFromWorld).length() + 1.5 * _halfSide;
    const double farthest = depths.endless ? reach : std::min(depths.farthest, reach);
    cv.setCalculatedNearPlane(std::min(cv.getCalculatedNearPlane(), depths.nearest));
    cv.setCalculatedFarPlane(std::max(cv.getCalculatedFarPlane(), farthest));
    cv.pushModelViewMatrix(new osg::RefMatrix(osg::Matrixd::translate(_origin) * eyeFromWorld), osg::Transform::ABSOLUTE_RF);
    _geometry->accept(cv);
    cv.popModelViewMatrix();
}

}  // namespace osgEnvLight
