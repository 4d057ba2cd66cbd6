// SPDX-License-Identifier: MIT
#include <reference/RayCamera>

#include "Directions.h"

#include <osg/Vec4d>

namespace osgEnvLight
{

RayCamera::RayCamera(const osg::Matrixd& view, const osg::Matrixd& projection, int width, int height, double depth)
    : _view(view),
      _projection(projection),
      _worldFromEye(osg::Matrixd::inverse(view)),
      _eyeFromClip(osg::Matrixd::inverse(projection)),
      _eye(toGlm(_worldFromEye.getTrans())),
      _backward(glm::normalize(toGlm(osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), _worldFromEye)))),
      _width(width),
      _height(height),
      _depth(depth),
      _orthographic(projection(2, 3) == 0.0)
{
    // A point of the view ray of each pixel; which one does not matter, and neither does the matrix's own near and far. With its
    // weight left in, it is linear in the pixel.
    auto direction = [&](double x, double y, double one) {
        const osg::Vec4d eye = osg::Vec4d(x, y, -one, one) * _eyeFromClip;
        return toGlm(osg::Matrixd::transform3x3(osg::Vec3d(eye.x(), eye.y(), eye.z()), _worldFromEye));
    };
    const double sign = (osg::Vec4d(0, 0, -1, 1) * _eyeFromClip).w() < 0.0 ? -1.0 : 1.0;
    _corner = sign * direction(-1.0, -1.0, 1.0);
    _right = sign * direction(2.0 / width, 0.0, 0.0);
    _up = sign * direction(0.0, 2.0 / height, 0.0);
}

RayCamera::RayCamera(const osg::Camera& camera, const osg::BoundingSphere& scene)
    : RayCamera(camera.getViewMatrix(), camera.getProjectionMatrix(), int(camera.getViewport()->width()),
                int(camera.getViewport()->height()),
                2.0 * (double(scene.radius()) + (osg::Vec3d(scene.center()) - camera.getInverseViewMatrix().getTrans()).length()))
{
}

Ray RayCamera::parallelRay(double x, double y) const
{
    const osg::Vec3d eye = osg::Vec3d(2.0 * x / _width - 1.0, 2.0 * y / _height - 1.0, -1.0) * _eyeFromClip;
    return {toGlm(osg::Vec3d(eye.x(), eye.y(), _depth) * _worldFromEye), -_backward};
}

glm::dvec3 RayCamera::project(const glm::dvec3& world) const
{
    const osg::Vec3d eye = osg::Vec3d(world.x, world.y, world.z) * _view;
    const osg::Vec4d clip = osg::Vec4d(eye, 1.0) * _projection;
    return {(clip.x() / clip.w() * 0.5 + 0.5) * _width, (clip.y() / clip.w() * 0.5 + 0.5) * _height, -eye.z()};
}

}  // namespace osgEnvLight
