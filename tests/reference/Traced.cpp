// SPDX-License-Identifier: MIT
#include "Traced.h"

#include <osgEnvLight/Material>

#include <osg/Material>

#include <cmath>

namespace
{

const double pi = std::acos(-1.0);

glm::dvec3 fromPole(double cosine, double turn)
{
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {sine * std::cos(2.0 * pi * turn), sine * std::sin(2.0 * pi * turn), cosine};
}

}  // namespace

const ReferenceOptions::Estimator allEstimators[3] = {ReferenceOptions::COSINE, ReferenceOptions::UNIFORM, ReferenceOptions::MIS};

const char* nameOf(ReferenceOptions::Estimator estimator)
{
    static const char* const names[] = {"cosine", "uniform", "mis"};
    return names[estimator];
}

Incident FunctionEnvironment::from(const glm::dvec3& direction, bool) const
{
    return {direction, glm::dvec3(_radiance(direction)), 1.0 / (4.0 * pi)};
}

Incident FunctionEnvironment::sample(const glm::dvec2& u) const
{
    return from(fromPole(1.0 - 2.0 * u.x, u.y));
}

ConeEnvironment::ConeEnvironment(double angularRadius, double zenith)
    : _cosine(std::cos(angularRadius)), _axis(std::sin(zenith), 0.0, std::cos(zenith))
{
}

Incident ConeEnvironment::from(const glm::dvec3& direction, bool) const
{
    const bool inside = glm::dot(direction, _axis) >= _cosine;
    return {direction, glm::dvec3(inside ? 1.0 : 0.0), inside ? 1.0 / (2.0 * pi * (1.0 - _cosine)) : 0.0};
}

Incident ConeEnvironment::sample(const glm::dvec2& u) const
{
    const glm::dvec3 d = fromPole(1.0 - u.x * (1.0 - _cosine), u.y);
    // Turned about +Y, which takes +Z to the axis.
    const glm::dvec3 direction(_axis.z * d.x + _axis.x * d.z, d.y, -_axis.x * d.x + _axis.z * d.z);
    return {direction, glm::dvec3(1.0), 1.0 / (2.0 * pi * (1.0 - _cosine))};
}

Traced::Traced(osg::Node& scene, const osg::Matrixd& view, const osg::Matrixd& projection, int width, int height,
               double leastLamp)
{
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setViewport(0, 0, width, height);
    camera->setViewMatrix(view);
    camera->setProjectionMatrix(projection);
    _triangles =
        osgEnvLight::flattenScene(scene, *camera, nullptr, {true, 1.0, leastLamp});  // radiances and albedos written as numbers
    _rays = std::make_unique<osgEnvLight::RayScene>(_triangles);
    _camera = std::make_unique<osgEnvLight::RayCamera>(view, projection, width, height, 0.0);
}

ReferenceResult Traced::render(const Environment& environment, const ReferenceOptions& options,
                               const std::set<Layer>& layers) const
{
    return osgEnvLight::Reference(*_rays, *_camera, environment).render(options, layers);
}

Traced parallelView(osg::Node& scene, const osg::Vec3d& eye, const osg::Vec3d& direction, double window, int pixels)
{
    const osg::Vec3d up = std::abs(direction.z()) > 0.9 * direction.length() ? osg::Vec3d(0, 1, 0) : osg::Vec3d(0, 0, 1);
    const double h = 0.5 * window;
    return Traced(scene, osg::Matrixd::lookAt(eye, eye + direction, up), osg::Matrixd::ortho(-h, h, -h, h, 0.0, 1.0), pixels,
                  pixels);
}

Traced perspectiveView(osg::Node& scene, const osg::Vec3d& eye, const osg::Vec3d& target, int pixels, double fovy,
                       double leastLamp)
{
    const osg::Vec3d d = target - eye;
    const osg::Vec3d up = std::abs(d.z()) > 0.99 * d.length() ? osg::Vec3d(0, 1, 0) : osg::Vec3d(0, 0, 1);
    return Traced(scene, osg::Matrixd::lookAt(eye, target, up), osg::Matrixd::perspective(fovy, 1.0, 1.0, 1e4), pixels, pixels,
                  leastLamp);
}

Estimate estimateOf(const ReferenceResult& result, Layer layer)
{
    const Picture mean = result.mean(layer);
    const Picture error = result.standardError(layer);
    Estimate e;
    double variance = 0.0;
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x) {
            if (mean.alpha(x, y) <= 0.0f) continue;
            ++e.pixels;
            e.value += mean.color(x, y).x();
            variance += error.color(x, y).x() * error.color(x, y).x();
        }
    e.value /= std::max(e.pixels, 1);
    e.error = std::sqrt(variance) / std::max(e.pixels, 1);
    return e;
}

ReferenceOptions makeOptions(ReferenceOptions::Estimator estimator, unsigned pass, unsigned passes, unsigned seed)
{
    ReferenceOptions options;
    options.estimator = estimator;
    options.pass = pass;
    options.samples = pass * passes;
    options.seed = seed;
    return options;
}

osg::ref_ptr<osg::Node> lambert(const osg::ref_ptr<osg::Geode>& geode, double albedo)
{
    osgEnvLight::Material::setLambert(*geode->getOrCreateStateSet(), osg::Vec3f(1, 1, 1) * float(albedo));
    return geode;
}

osg::ref_ptr<osg::Node> emissive(const osg::ref_ptr<osg::Geode>& geode, double radiance, double albedo)
{
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    const auto e = float(radiance), a = float(albedo);
    material->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(e, e, e, 1));
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(a, a, a, 1));
    geode->getOrCreateStateSet()->setAttributeAndModes(material);
    return geode;
}

osg::ref_ptr<osg::Group> together(const std::vector<osg::ref_ptr<osg::Node>>& nodes)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (const auto& node : nodes) group->addChild(node);
    return group;
}
