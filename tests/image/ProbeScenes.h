// SPDX-License-Identifier: MIT
// Scenes whose surfaces light each other by probes, and what pictures of them say.
#pragma once

#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace probescenes
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

inline osg::ref_ptr<LitScene> makeProbed(double radiance = 1.0)
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(radiance).get());
    Settings& s = *lit->getSettings();
    s.regeneration = Settings::IMMEDIATE;
    s.background = Settings::BACKGROUND_OFF;
    s.bounce = Settings::BOUNCE_PROBES;
    return lit;
}

inline void setAlbedo(osg::Node& node, float albedo)
{
    Material::setLambert(*node.getOrCreateStateSet(), osg::Vec3f(albedo, albedo, albedo));
}

struct Figures {
    double mean = 0.0;
    double deviation = 0.0;
};

inline Figures figuresOf(const Picture& p, int channel = 1)
{
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            if (!(p.alpha(x, y) > 0.5f)) continue;
            const double v = double(p.color(x, y)[channel]);
            sum += v;
            squares += v * v;
            ++count;
        }
    EXPECT_GT(count, p.width * p.height / 8);
    const double mean = sum / std::max(count, 1);
    return {mean, std::sqrt(std::max(squares / std::max(count, 1) - mean * mean, 0.0))};
}

// The inside of a sphere, open above down to the polar angle.
inline osg::ref_ptr<osg::Geode> makeBowl(int rings, double opening = M_PI_2)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
    const int sides = 4 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j <= sides; ++j) {
            const double polar = opening + (M_PI - opening) * i / rings, azimuth = 2.0 * M_PI * j / sides;
            const osg::Vec3 p(float(std::sin(polar) * std::cos(azimuth)), float(std::sin(polar) * std::sin(azimuth)),
                              float(std::cos(polar)));
            vertices->push_back(p);
            normals->push_back(-p);
        }
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sides; ++j) {
            const auto a = unsigned(i * (sides + 1) + j), b = a + unsigned(sides) + 1;
            for (unsigned v : {a, a + 1, b, b, a + 1, b + 1}) indices->push_back(v);
        }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(indices);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

}  // namespace probescenes
