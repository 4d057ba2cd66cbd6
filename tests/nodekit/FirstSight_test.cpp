// SPDX-License-Identifier: MIT
// What a user sees first: colours as they were typed, at an exposure that follows the map.
#include <SceneRenderer.h>

#include "environment/Exposure.h"
#include <osgEnvLight/Material>

#include <osg/Material>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace FirstSight_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

const int size = 48;

osg::ref_ptr<osg::Geode> sphere(const osg::Vec4& diffuse, const osg::Vec4& emission = osg::Vec4(0, 0, 0, 1))
{
    osg::ref_ptr<osg::Geode> geode = makeSphere(osg::Vec3d(), 1.0, 64);
    osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT_AND_BACK, diffuse);
    m->setEmission(osg::Material::FRONT_AND_BACK, emission);
    geode->getOrCreateStateSet()->setAttributeAndModes(m.get());
    return geode;
}

osg::ref_ptr<LitScene> under(const std::string& map, osg::Node* model)
{
    osg::ref_ptr<LitScene> lit = new LitScene;
    std::string error;
    EXPECT_TRUE(lit->getEnvironmentMap()->load(map, nullptr, error)) << error;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->addChild(model);
    return lit;
}

// Of the brightest pixel: hue [degrees], saturation, value, as pickers of colours have them.
struct Hsv {
    double hue, saturation, value;
};
Hsv brightest(const Picture& picture)
{
    osg::Vec3d c;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            if (picture.alpha(x, y) > 0.5f && picture.color(x, y).length2() > c.length2()) c = picture.color(x, y);
    const double most = std::max({c[0], c[1], c[2]}), least = std::min({c[0], c[1], c[2]}), range = most - least;
    double hue = 0.0;
    if (range > 0.0)
        hue = most == c[0] ? (c[1] - c[2]) / range : most == c[1] ? 2.0 + (c[2] - c[0]) / range : 4.0 + (c[0] - c[1]) / range;
    return {60.0 * hue, most > 0.0 ? range / most : 0.0, most};
}

std::vector<std::string> maps()
{
    std::vector<std::string> names = {"sky", "studio"};
    const std::string world = "/usr/share/blender/datafiles/studiolights/world/";
    for (const char* name : {"courtyard", "interior", "night", "sunrise"})
        if (std::filesystem::exists(world + name + ".exr")) names.push_back(world + name + ".exr");
    return names;
}

}  // namespace

TEST(FirstSight, AnAlbedoOfPointEightInFullLightStaysBelowWhiteAndIsNotDark)
{
    SceneRenderer renderer(size, size);
    for (const std::string& map : maps()) {
        const osg::ref_ptr<osg::Geode> model = makeSphere(osg::Vec3d(), 1.0, 64);
        Material::setLambert(*model->getOrCreateStateSet(), osg::Vec3f(0.8f, 0.8f, 0.8f));
        const osg::ref_ptr<LitScene> lit = under(map, model);
        lit->getSettings()->exposureBase = Settings::EXPOSURE_MAP;
        double most = 0.0;
        for (int side = 0; side < 6; ++side) {
            const osg::Vec3d axis(side / 2 == 0, side / 2 == 1, side / 2 == 2);
            renderer.lookAt(axis * (side % 2 ? 4.0 : -4.0), osg::Vec3d(),
                            side / 2 == 2 ? osg::Vec3d(0, 1, 0) : osg::Vec3d(0, 0, 1));
            most = std::max(most, brightest(renderer.render(lit, 2)).value);
        }
        EXPECT_LT(most, 0.97) << map;
        EXPECT_GT(most, 0.70) << map;
    }
}

TEST(FirstSight, HuesAndSaturationsSurvive)
{
    SceneRenderer renderer(size, size);
    // Under the grey studio: a coloured map is to colour what it lights.
    for (const osg::Vec4& typed : {osg::Vec4(0.8f, 0.1f, 0.1f, 1), osg::Vec4(0.2f, 0.5f, 0.3f, 1), osg::Vec4(0.3f, 0.3f, 0.7f, 1),
                                   osg::Vec4(0.5f, 0.4f, 0.2f, 1)}) {
        const Hsv plain = brightest(renderer.render(sphere(typed), 2));
        const Hsv lit = brightest(renderer.render(under("studio", sphere(typed)), 2));
        EXPECT_NEAR(plain.hue, lit.hue, 4.0) << typed.r();
        EXPECT_NEAR(plain.saturation, lit.saturation, 0.08) << typed.r();  // a share of the display's value, not of light
        EXPECT_NEAR(plain.value, lit.value, 0.15) << typed.r();
    }
}

TEST(FirstSight, WhatEmitsIsShownAsTypedUnderEveryMap)
{
    SceneRenderer renderer(size, size);
    for (const std::string& map : maps()) {
        const osg::ref_ptr<LitScene> lit = under(map, sphere(osg::Vec4(0, 0, 0, 1), osg::Vec4(0.6f, 0.3f, 0.1f, 1)));
        const osg::Vec3d c = renderer.render(lit, 2).color(size / 2, size / 2);
        const osg::Vec3d typed(0.6, 0.3, 0.1);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(c[k], typed[k], 0.004) << map;  // an 8-bit dither
        lit->getSettings()->output = Settings::LINEAR;
        EXPECT_NEAR(renderer.render(lit, 1).color(size / 2, size / 2)[0], std::pow((0.6 + 0.055) / 1.055, 2.4), 1e-3) << map;
    }
}

TEST(FirstSight, ExposureFollowsTheMapAndNotItsIntensityOrThePicture)
{
    SceneRenderer renderer(size, size);
    const auto shown = [&](double radiance, double intensity, float exposure, int base) {
        const osg::ref_ptr<LitScene> lit = new LitScene(constantMap(radiance));
        lit->getEnvironmentMap()->setIntensity(intensity);
        lit->getSettings()->toneCurve = Settings::CLIP;
        lit->getSettings()->dither = false;
        lit->getSettings()->exposure = exposure;
        lit->getSettings()->exposureBase = base;
        lit->addChild(sphere(osg::Vec4(1, 1, 1, 1)));
        const double c = renderer.render(lit, 2).color(size / 2, size / 2)[0];
        return std::pow((c + 0.055) / 1.055, 2.4);
    };
    const double small = 0.005;
    for (double radiance : {1e-4, 0.3, 1.0, 500.0}) EXPECT_NEAR(shown(radiance, 1.0, 0.0f, Settings::EXPOSURE_MAP), 0.63, small);
    EXPECT_NEAR(shown(1.0, 0.5, 0.0f, Settings::EXPOSURE_MAP), 0.315, small);
    EXPECT_NEAR(shown(1.0, 1.0, -1.0f, Settings::EXPOSURE_MAP), 0.315, small);
    EXPECT_NEAR(shown(0.5, 1.0, 0.0f, Settings::EXPOSURE_NONE), 0.5, small);
}

}  // namespace FirstSight_test
