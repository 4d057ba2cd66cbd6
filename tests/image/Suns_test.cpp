// SPDX-License-Identifier: MIT
// Suns cut from the map and shaded as discs give the picture that the whole map gives.
#include <gtest/gtest.h>

#include <osgEnvLight/Material>

#include <SceneRenderer.h>

#include "Brdfs.h"

namespace Suns_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

// A blue sky and a disc of 1.5 degrees radius with about half of the flux, at 35 degrees of elevation.
osg::ref_ptr<osg::Image> sunnySky()
{
    osg::Vec3d sun(0.6, -0.55, 0.58);
    sun.normalize();
    return makeMap(1024, 512, [sun](const osg::Vec3d& d) {
        const osg::Vec3d sky = osg::Vec3d(0.5, 0.7, 1.0) * (d.z() > 0.0 ? 1.0 - 0.5 * d.z() : 0.2);
        return d * sun > std::cos(osg::DegreesToRadians(1.5)) ? osg::Vec3d(3000, 2700, 2400) : sky;
    });
}

osg::ref_ptr<LitScene> sphere(osg::Image* map)
{
    osg::ref_ptr<LitScene> lit = makeLit(map);
    lit->addChild(makeSphere(osg::Vec3d(), 1.0));
    lit->getSettings()->occlusion = false;  // a convex body has none
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    return lit;
}

}  // namespace

TEST(Suns, DiffuseAgreesWithTheWholeMap)
{
    SceneRenderer renderer(96, 96);
    osg::ref_ptr<LitScene> lit = sphere(sunnySky().get());
    Material::setLambert(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(0.8f, 0.8f, 0.8f));
    lit->getSettings()->diffuseCarrier = Settings::LIGHTS;
    lit->getSettings()->diffuseLights = 2048;
    const Picture whole = renderer.render(lit, 2);
    lit->getSettings()->suns = Settings::SUNS_AUTO;
    const Picture split = renderer.render(lit, 1);
    EXPECT_EQ(lit->plan().suns, 1u) << lit->plan().explain();
    double level = 0.0;
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x) level = std::max(level, whole.color(x, y)[1]);
    // U of 2048 lights is 3e-5; half floats in two targets 5e-4 each.
    EXPECT_LT(rootMeanSquare(whole, split), 1e-3 * level);
    EXPECT_LT(largestDifference(whole, split), 4e-3 * level);  // at the horizon of the disc, where lights are points
}

TEST(Suns, ACoarseRoundBodyDoesNotShadeItsOwnTerminator)
{
    // A round body hides nothing from itself; its facets, between which the normals are interpolated, do.
    // Measured: .0011, .00015; from the facets themselves .0048, .0020.
    for (const auto& [segments, most] : {std::pair(24, 0.002), std::pair(48, 0.0005)}) {
        SceneRenderer renderer(96, 96);
        renderer.lookAt(osg::Vec3d(2.6, 2.84, 0), osg::Vec3d());  // across the sun's direction
        const osg::ref_ptr<LitScene> lit = makeLit(sunnySky().get());
        lit->getSettings()->background = Settings::BACKGROUND_OFF;
        lit->addChild(makeSphere(osg::Vec3d(), 1.0, segments));
        const Picture shaded = renderer.render(lit, 3);
        EXPECT_TRUE(lit->plan().runs("sunshadow"));
        lit->getSettings()->occlusion = false;
        const Picture open = renderer.render(lit, 2);
        EXPECT_LT(rootMeanSquare(open, shaded) / ofGeometry(open).mean, most) << segments;
    }
}

TEST(Suns, GlossyAgreesWithTheWholeMap)
{
    for (const Material::Brdf brdf : lobedBrdfs) {
        SceneRenderer renderer(96, 96);
        osg::ref_ptr<LitScene> lit = sphere(sunnySky().get());
        setLobe(*lit->getChild(0)->getOrCreateStateSet(), brdf, osg::Vec3f(0.9f, 0.9f, 0.9f), 0.45f);
        lit->getSettings()->specularSamples = 1024;
        const Picture whole = renderer.render(lit, 2);
        lit->getSettings()->suns = Settings::SUNS_AUTO;
        const Picture split = renderer.render(lit, 1);
        ASSERT_EQ(lit->plan().suns, 1u);
        double level = 0.0;
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 96; ++x) level = std::max(level, whole.color(x, y)[1]);
        ASSERT_GT(level, 1.0);  // the sun's highlight
        // 1024 samples a pixel of a lobe 20 times as wide as the sun, each as wide as its share of it.
        EXPECT_LT(rootMeanSquare(whole, split), 0.01 * level) << brdf;
        EXPECT_LT(largestDifference(whole, split), 0.06 * level) << brdf;
    }
}

TEST(Suns, NoneWithoutASun)
{
    SceneRenderer renderer(48, 48);
    osg::ref_ptr<LitScene> lit = sphere(constantMap(1.0).get());
    const Picture off = renderer.render(lit, 2);
    lit->getSettings()->suns = Settings::SUNS_AUTO;
    EXPECT_EQ(off.rgba, renderer.render(lit, 1).rgba);
    EXPECT_EQ(lit->plan().suns, 0u);
    EXPECT_NE(lit->plan().explain().find("suns: off, the map has none"), std::string::npos) << lit->plan().explain();
}

}  // namespace Suns_test
