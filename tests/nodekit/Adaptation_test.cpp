// SPDX-License-Identifier: MIT
// The exposure that follows the light on what the picture shows.
#include "passes/Adaptation.h"

#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <gtest/gtest.h>

#include <cmath>

namespace Adaptation_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

const int side = 32;
const double step = 0.006;  // 8 bits of sRGB, as a share of .63

double linear(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

osg::ref_ptr<osg::Geode> card(double x, float albedo)
{
    const osg::ref_ptr<osg::Geode> quad = makeQuad(osg::Vec3d(x - 0.9, -0.9, 0), osg::Vec3d(1.8, 0, 0), osg::Vec3d(0, 1.8, 0));
    Material::setLambert(*quad->getOrCreateStateSet(), osg::Vec3f(albedo, albedo, albedo));
    return quad;
}

// Cards under an even sky, of white at .63 where its intensity is 1.
class Adaptation : public testing::Test
{
  protected:
    Adaptation() : renderer(side, side), lit(new LitScene(constantMap(1.0)))
    {
        Settings& s = *lit->getSettings();
        s.toneCurve = Settings::CLIP;
        s.dither = false;
        s.antialias = Settings::ANTIALIAS_OFF;
        s.occlusion = false;
        s.background = Settings::BACKGROUND_OFF;
        s.adaptationTime = 0.0f;
        renderer.lookAt(osg::Vec3d(0, 0, 8), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    }

    // Of the pixel in the middle of the left card, or of the right one.
    double shown(bool right = false, int frames = 1)
    {
        return linear(renderer.render(lit, frames).color(right ? 5 * side / 8 : 3 * side / 8, side / 2)[1]);
    }
    void setIntensity(double intensity) { lit->getEnvironmentMap()->setIntensity(intensity); }

    SceneRenderer renderer;
    osg::ref_ptr<LitScene> lit;
};

}  // namespace

TEST_F(Adaptation, WhiteIsBroughtBackToWhereItMayBeShown)
{
    lit->addChild(card(-1, 1.0f));
    lit->addChild(card(1, 0.25f));
    lit->getSettings()->exposure = -1.0f;
    for (const double intensity : {2e-5, 1e-3, 0.1, 0.3, 1.0, 1.9, 4.0, 1e3}) {
        setIntensity(intensity);
        const double white = 0.5 * 0.63 * std::clamp(intensity, 0.25, 2.0);
        EXPECT_NEAR(white, shown(), step) << intensity;
        EXPECT_NEAR(0.25 * white, shown(true), step) << intensity;
    }
    lit->getSettings()->exposureBase = Settings::EXPOSURE_MAP;
    setIntensity(0.1);
    EXPECT_NEAR(0.5 * 0.063, shown(), step);
}

TEST_F(Adaptation, ChangesNothingInTheOpen)
{
    lit->addChild(card(-1, 1.0f));
    lit->addChild(card(1, 0.25f));
    const Picture followed = renderer.render(lit);
    lit->getSettings()->exposureBase = Settings::EXPOSURE_MAP;
    EXPECT_EQ(0.0, largestDifference(followed, renderer.render(lit)));
}

TEST_F(Adaptation, WhatReflectsLittleIsNotTakenForShade)
{
    lit->addChild(card(-1, 0.08f));
    lit->addChild(card(1, 0.0f));
    EXPECT_NEAR(0.08 * 0.63, shown(), step);
    EXPECT_NEAR(0.0, shown(true), 1e-6);
}

TEST_F(Adaptation, WhatShinesByItselfIsNotMeteredAndAnUnlitColourIsShownAsTyped)
{
    const osg::ref_ptr<osg::Geode> unlit = card(1, 1.0f);
    unlit->setStateSet(nullptr);
    unlit->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    const osg::ref_ptr<osg::Vec4Array> grey = new osg::Vec4Array(1, new osg::Vec4(0.5f, 0.5f, 0.5f, 1));
    static_cast<osg::Geometry*>(unlit->getDrawable(0))->setColorArray(grey, osg::Array::BIND_OVERALL);
    lit->addChild(unlit);
    for (const double intensity : {1e-4, 1.0, 100.0}) {
        setIntensity(intensity);
        EXPECT_NEAR(linear(0.5), shown(true), step) << intensity;
    }
    lit->addChild(card(-1, 1.0f));
    setIntensity(1e-4);
    EXPECT_NEAR(0.25 * 0.63, shown(), step);
    EXPECT_NEAR(linear(0.5), shown(true), step);
}

TEST_F(Adaptation, SmoothedPicturesShowUnlitColoursAsTyped)
{
    const osg::ref_ptr<osg::Geode> unlit = card(1, 0.5f);
    unlit->setStateSet(nullptr);
    unlit->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    lit->addChild(card(-1, 1.0f));
    lit->addChild(unlit);
    lit->getSettings()->exposureBase = Settings::EXPOSURE_MAP;
    const double typed = shown(true);
    setIntensity(1e-4);
    lit->getSettings()->exposureBase = Settings::EXPOSURE_PICTURE;
    lit->getSettings()->antialias = Settings::ANTIALIAS_EDGES;
    EXPECT_NEAR(typed, shown(true), step);
    EXPECT_NEAR(0.25 * 0.63, shown(), step);
    EXPECT_EQ(1u, lit->plan().surfaces.unlit);
}

TEST_F(Adaptation, TransparentSurfacesAndTheMapBehindHaveTheSameExposure)
{
    lit->addChild(card(-1, 1.0f));
    const osg::ref_ptr<osg::Geode> glass = card(1, 1.0f);
    glass->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    glass->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    lit->addChild(glass);
    lit->getSettings()->background = Settings::BACKGROUND_ON;
    setIntensity(0.01);
    const Picture picture = renderer.render(lit, 2);
    for (const int x : {3 * side / 8, 5 * side / 8}) EXPECT_NEAR(0.25 * 0.63, linear(picture.color(x, side / 2)[1]), step) << x;
    EXPECT_NEAR(0.25 * 0.63, linear(picture.color(side / 2, 1)[1]), step);
}

TEST_F(Adaptation, SmoothedPicturesAndStillViewsHaveIt)
{
    lit->addChild(card(-1, 1.0f));
    setIntensity(0.01);
    for (const int antialias : {Settings::ANTIALIAS_EDGES, Settings::ANTIALIAS_TEMPORAL}) {
        lit->getSettings()->antialias = antialias;
        EXPECT_NEAR(0.25 * 0.63, shown(false, 40), step) << antialias;  // the average forgets what was before
    }
    lit->getSettings()->accumulate = true;
    EXPECT_NEAR(0.25 * 0.63, shown(false, 40), step);
}

TEST_F(Adaptation, FollowsInTime)
{
    lit->addChild(card(-1, 1.0f));
    lit->getSettings()->adaptationTime = 0.5f;
    EXPECT_NEAR(0.63, shown(), step);
    setIntensity(0.0625);  // 4 stops darker, of which 2 are taken back
    for (int frame = 1; frame <= 30; ++frame) {
        const double stops = 2.0 * (1.0 - std::exp(-frame / 30.0 / 0.5));
        EXPECT_NEAR(1.0, shown() / (0.63 * std::exp2(stops - 4.0)), 0.05) << frame;  // 8 bits of a dark grey
    }
}

TEST_F(Adaptation, FirstFrameIsAdapted)
{
    lit->addChild(card(-1, 1.0f));
    lit->getSettings()->adaptationTime = 60.0f;
    setIntensity(1e-3);
    EXPECT_NEAR(0.25 * 0.63, shown(), step);
}

TEST_F(Adaptation, KeepsWhatItHasWhereNothingIsInView)
{
    lit->addChild(card(-1, 1.0f));
    lit->getSettings()->background = Settings::BACKGROUND_ON;
    lit->getSettings()->adaptationTime = 0.1f;
    setIntensity(0.01);
    EXPECT_NEAR(0.25 * 0.63, shown(), step);
    renderer.lookAt(osg::Vec3d(0, 0, 8), osg::Vec3d(0, 0, 16), osg::Vec3d(0, 1, 0));
    EXPECT_NEAR(0.25 * 0.63, shown(false, 20), step);
}

TEST_F(Adaptation, IsDrawnOnlyForADisplayThatFollowsThePicture)
{
    lit->addChild(card(-1, 1.0f));
    Settings& s = *lit->getSettings();
    shown();
    EXPECT_TRUE(lit->plan().runs("meter"));
    EXPECT_TRUE(lit->plan().runs("adaptation"));
    const auto expectNone = [&](const char* why) {
        shown();
        EXPECT_FALSE(lit->plan().runs("meter")) << why;
        EXPECT_FALSE(lit->plan().runs("adaptation")) << why;
    };
    s.exposureBase = Settings::EXPOSURE_NONE;
    expectNone("exposureBase");
    s.exposureBase = Settings::EXPOSURE_PICTURE;
    s.output = Settings::LINEAR;
    expectNone("output");
    s.output = Settings::DISPLAY;
    s.view = Settings::ALBEDO;
    expectNone("view");
    s.view = Settings::BEAUTY;
    shown();
    EXPECT_TRUE(lit->plan().runs("adaptation"));
}

TEST(AdaptationClock, CountsSimulationElseTheClock)
{
    using osgEnvLight::secondsBetween;
    osg::FrameStamp a, b;
    a.setSimulationTime(10.0);
    b.setSimulationTime(10.25);
    a.setReferenceTime(1.0);
    b.setReferenceTime(5.0);
    EXPECT_DOUBLE_EQ(0.25, secondsBetween(&a, &b));
    b.setSimulationTime(10.0);  // paused
    EXPECT_DOUBLE_EQ(4.0, secondsBetween(&a, &b));
    b.setSimulationTime(3.0);  // set back
    EXPECT_DOUBLE_EQ(4.0, secondsBetween(&a, &b));
    b.setReferenceTime(0.0);
    EXPECT_DOUBLE_EQ(1.0 / 60.0, secondsBetween(&a, &b));
    EXPECT_DOUBLE_EQ(1.0 / 60.0, secondsBetween(nullptr, &b));
    EXPECT_DOUBLE_EQ(1.0 / 60.0, secondsBetween(&a, nullptr));
}

}  // namespace Adaptation_test
