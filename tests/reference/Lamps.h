// SPDX-License-Identifier: MIT
// Area lights over the origin, and what is expected of their light.
#pragma once

#include <osgEnvLight/AreaLight>
#include <osgEnvLight/Material>

#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <gtest/gtest.h>

#include "Traced.h"

using osgEnvLight::AreaLight;

inline const FunctionEnvironment day([](const glm::dvec3&) { return 1.0; });
inline const FunctionEnvironment night([](const glm::dvec3&) { return 0.0; });

inline const std::set<Layer> allTerms = {Layer::DIFFUSE, Layer::OCCLUSION, Layer::SPECULAR, Layer::SPECULAR_VISIBLE,
                                         Layer::EMISSION};

inline osg::ref_ptr<AreaLight> lamp(double radiance)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setRadiance(osg::Vec3f(1, 1, 1) * float(radiance));
    return light;
}

// Facing down.
inline osg::ref_ptr<AreaLight> rectangle(const osg::Vec3d& center, double a, double b, double radiance = 1.0)
{
    osg::ref_ptr<AreaLight> light = lamp(radiance);
    light->setRectangle(center, osg::Vec3d(0.5 * a, 0, 0), osg::Vec3d(0, -0.5 * b, 0));
    return light;
}

inline osg::ref_ptr<AreaLight> disc(const osg::Vec3d& center, double radius, double radiance = 1.0)
{
    osg::ref_ptr<AreaLight> light = lamp(radiance);
    light->setDisc(center, osg::Vec3d(0, 0, -1), radius);
    return light;
}

inline osg::ref_ptr<AreaLight> sphere(const osg::Vec3d& center, double radius, double radiance = 1.0)
{
    osg::ref_ptr<AreaLight> light = lamp(radiance);
    light->setSphere(center, radius);
    return light;
}

inline osg::ref_ptr<AreaLight> polygon(const std::vector<osg::Vec3>& vertices, double radiance = 1.0)
{
    osg::ref_ptr<AreaLight> light = lamp(radiance);
    light->setPolygon(*osg::ref_ptr<osg::Vec3Array>(new osg::Vec3Array(vertices.begin(), vertices.end())));
    return light;
}

inline osg::ref_ptr<AreaLight> invisible(osg::ref_ptr<AreaLight> light)
{
    light->setVisible(false);
    return light;
}

inline osg::ref_ptr<osg::Geode> floorOf(double half)
{
    return makeQuad(osg::Vec3d(-half, -half, 0), osg::Vec3d(2 * half, 0, 0), osg::Vec3d(0, 2 * half, 0));
}

inline osg::ref_ptr<osg::Node> whiteFloor(double half = 0.01)
{
    return lambert(floorOf(half), 1.0);
}

// As good as the origin alone, seen from just above it.
inline Traced originOf(osg::Node& scene)
{
    return parallelView(scene, osg::Vec3d(0, 0, 1e-3), osg::Vec3d(0, 0, -1), 1e-4, 8);
}

inline ReferenceOptions options(ReferenceOptions::Estimator estimator, ReferenceOptions::Paths paths = ReferenceOptions::DIRECT,
                                unsigned pass = 64)
{
    ReferenceOptions o = makeOptions(estimator, pass, 8);
    o.paths = paths;
    return o;
}

// The numbers are the same at every run: 3.5 standard errors are passed by one comparison in 2000. The slack is for a direction
// in 10^5 that was not taken: of a lamp so small that its light is a sampled point's.
inline void expectNear(const Estimate& e, double truth, const std::string& what, double slack = 2e-5)
{
    EXPECT_LE(std::abs(e.value - truth), 3.5 * e.error + slack * std::abs(truth))
        << what << ": " << e.value << " +- " << e.error << " for " << truth;
}

inline void expectSame(const Estimate& a, const Estimate& b, const std::string& what)
{
    EXPECT_LE(std::abs(a.value - b.value), 3.5 * std::hypot(a.error, b.error) + 1e-6 * std::abs(a.value))
        << what << ": " << a.value << " +- " << a.error << ", " << b.value << " +- " << b.error;
}

inline osg::ref_ptr<osg::MatrixTransform> moved(const osg::Matrixd& matrix, osg::Node* node)
{
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
    transform->addChild(node);
    return transform;
}
