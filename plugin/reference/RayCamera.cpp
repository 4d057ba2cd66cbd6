// SPDX-License-Identifier: MIT
#include <reference/RayCamera>

#include <osg/Vec4d>

namespace osgEnvLight
{

namespace
{

glm::dvec3 toGlm(const osg::Vec3d& v)
{
    return glm::dvec3(v.x(), v.y(), v.z());
}

}  // namespace

RayCamera::RayCamera(const osg::Matrixd& view, const osg::Matrixd& projection, int width, int height, double depth)
    : _view(view),
      _projection(projection),
      _worldFromEye(osg::Matrixd::inverse(view)),
      _eyeFromClip(osg::Matrixd::inverse(projection)),
      _eye(_worldFromEye.getTrans()),
      _width(width),
      _height(height),
      _depth(depth),
      _orthographic(projection(2, 3) == 0.0)
{
}

RayCamera::RayCamera(const osg::Camera& camera, const osg::BoundingSphere& scene)
    : RayCamera(camera.getViewMatrix(), camera.getProjectionMatrix(), int(camera.getViewport()->width()),
                int(camera.getViewport()->height()),
                2.0 * (double(scene.radius()) + (osg::Vec3d(scene.center()) - camera.getInverseViewMatrix().getTrans()).length()))
{
}

Ray RayCamera::ray(double x, double y) const
{
    // Two points of the view ray; which two does not matter, and neither does the matrix's own near and far.
    const double ndcX = 2.0 * x / _width - 1.0;
    const double ndcY = 2.0 * y / _height - 1.0;
    const osg::Vec3d a = osg::Vec3d(ndcX, ndcY, -1.0) * _eyeFromClip;
    if (_orthographic) {
        const osg::Vec3d origin = osg::Vec3d(a.x(), a.y(), _depth) * _worldFromEye;
        return {toGlm(origin), -backward()};
    }
    const osg::Vec3d direction = osg::Matrixd::transform3x3(a, _worldFromEye);
    return {toGlm(_eye), glm::normalize(toGlm(direction))};
}

glm::dvec3 RayCamera::project(const glm::dvec3& world) const
{
    const osg::Vec3d eye = osg::Vec3d(world.x, world.y, world.z) * _view;
    const osg::Vec4d clip = osg::Vec4d(eye, 1.0) * _projection;
    return {(clip.x() / clip.w() * 0.5 + 0.5) * _width, (clip.y() / clip.w() * 0.5 + 0.5) * _height, -eye.z()};
}

glm::dvec3 RayCamera::backward() const
{
    return glm::normalize(toGlm(osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), _worldFromEye)));
}

}  // namespace osgEnvLight
