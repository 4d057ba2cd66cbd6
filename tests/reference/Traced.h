// SPDX-License-Identifier: MIT
// Scene graphs before the reference, lit by skies written down as functions.
#pragma once

#include <SceneRenderer.h>

#include <reference/Reference>

#include <functional>
#include <memory>

using osgEnvLight::Environment;
using osgEnvLight::Incident;
using osgEnvLight::Layer;
using osgEnvLight::ReferenceOptions;
using osgEnvLight::ReferenceResult;

/** Any radiance, sampled evenly over the sphere. */
class FunctionEnvironment : public Environment
{
  public:
    using Radiance = std::function<double(const glm::dvec3&)>;
    explicit FunctionEnvironment(Radiance radiance) : _radiance(std::move(radiance)) {}
    Incident from(const glm::dvec3& direction, bool withDensity = false) const override;
    Incident sample(const glm::dvec2& u) const override;

  private:
    Radiance _radiance;
};

/** Radiance 1 within an angle of +Z turned about +Y by a zenith angle, sampled evenly in there. */
class ConeEnvironment : public Environment
{
  public:
    ConeEnvironment(double angularRadius, double zenith);
    Incident from(const glm::dvec3& direction, bool withDensity = false) const override;
    Incident sample(const glm::dvec2& u) const override;

  private:
    double _cosine;
    glm::dvec3 _axis;
};

/** A scene with a camera, ready to be rendered. */
class Traced
{
  public:
    /** @param leastLamp  SceneReading's */
    Traced(osg::Node& scene, const osg::Matrixd& view, const osg::Matrixd& projection, int width, int height,
           double leastLamp = HUGE_VAL);

    ReferenceResult render(const Environment& environment, const ReferenceOptions& options,
                           const std::set<Layer>& layers = {}) const;
    const osgEnvLight::TriangleScene& triangles() const { return _triangles; }

  private:
    osgEnvLight::TriangleScene _triangles;
    std::unique_ptr<osgEnvLight::RayScene> _rays;
    std::unique_ptr<osgEnvLight::RayCamera> _camera;
};

/** Seen along a direction by parallel rays that start at the eye, in a square window. */
Traced parallelView(osg::Node& scene, const osg::Vec3d& eye, const osg::Vec3d& direction, double window, int pixels);
/** From an eye to a target. */
Traced perspectiveView(osg::Node& scene, const osg::Vec3d& eye, const osg::Vec3d& target, int pixels, double fovy = 40.0,
                       double leastLamp = HUGE_VAL);

/** A mean over the pixels with geometry, red channel, with its standard error. */
struct Estimate {
    double value = 0.0;
    double error = 0.0;
    int pixels = 0;
};
Estimate estimateOf(const ReferenceResult& result, Layer layer);

/** Samples per pixel in so many independent passes. */
ReferenceOptions makeOptions(ReferenceOptions::Estimator estimator, unsigned pass, unsigned passes, unsigned seed = 0);

extern const ReferenceOptions::Estimator allEstimators[3];
const char* nameOf(ReferenceOptions::Estimator estimator);

osg::ref_ptr<osg::Node> lambert(const osg::ref_ptr<osg::Geode>& geode, double albedo);
/** Radiance of its own; reflects that albedo. */
osg::ref_ptr<osg::Node> emissive(const osg::ref_ptr<osg::Geode>& geode, double radiance, double albedo = 0.0);
osg::ref_ptr<osg::Group> together(const std::vector<osg::ref_ptr<osg::Node>>& nodes);
