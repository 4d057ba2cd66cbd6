// SPDX-License-Identifier: MIT
// Still views that converge, against closed forms and the ray-traced reference.
#include <Oracles.h>
#include <SceneRenderer.h>

#include <metrics/Mask>
#include <metrics/Metrics>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osgEnvLight/AreaLight>
#include <osgEnvLight/Material>

#include <gtest/gtest.h>

#include <cmath>

#include "SuiteScenes.h"
#include "TracedView.h"

namespace Accumulation_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

osg::ref_ptr<LitScene> stillScene(osg::Image* map)
{
    osg::ref_ptr<LitScene> lit = makeLit(map);
    Settings& s = *lit->getSettings();
    s.regeneration = Settings::IMMEDIATE;
    s.accumulate = true;
    s.bounce = Settings::BOUNCE_OFF;
    s.reflections = Settings::REFLECTIONS_MAP;
    s.atlasLights = 64;  // of the first frame, which these tests are not about
    s.accumulateLights = 16;
    s.accumulateSize = 512;
    return lit;
}

void addPost(LitScene& lit)
{
    lit.addChild(makeQuad(osg::Vec3d(-2, -2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    lit.addChild(makeBox(osg::Vec3d(-0.3, -0.3, 0), osg::Vec3d(0.3, 0.3, 1.2)));
}

void lookAtPost(SceneRenderer& renderer)
{
    renderer.lookAt(osg::Vec3d(2, -5, 4), osg::Vec3d(0, 0, 0.3));
}

// Of the picture beside exact direct light, without edges: the means over each pixel's square differ there by what the
// rasteriser's pixels are.
double errorOf(const Picture& picture, LitScene& lit, SceneRenderer& renderer, unsigned samples = 256)
{
    using osgEnvLight::Layer;
    const osgEnvLight::ReferenceResult result = tracedView(lit, renderer, samples, {Layer::BEAUTY, Layer::NORMAL, Layer::DEPTH});
    const Picture truth = result.mean(Layer::BEAUTY);
    const osgEnvLight::Mask inside =
        awayFromEdges(osgEnvLight::Mask::geometry(truth) & osgEnvLight::Mask::geometry(picture), result);
    const osgEnvLight::ErrorFigures e = osgEnvLight::compare(picture, truth, result.standardError(Layer::BEAUTY), inside);
    return e.rmse / e.mean;
}

}  // namespace

// The floor beside an upright wall, from 32 frames = 512 lights [occlusion.md 7]: 1 %.
TEST(Accumulation, WallWithinOnePercentAfter512Lights)
{
    SceneRenderer renderer(192, 192);
    osg::ref_ptr<LitScene> lit = stillScene(constantMap(1.0).get());
    lit->getSettings()->accumulateSize = 1024;
    lit->addChild(makeQuad(osg::Vec3d(-8, -4, 0), osg::Vec3d(16, 0, 0), osg::Vec3d(0, 8, 0)));
    lit->addChild(makeBox(osg::Vec3d(-8, 0, 0), osg::Vec3d(8, 2, 1)));
    for (unsigned i = 0; i < 2; ++i)
        osgEnvLight::Material::setLambert(*lit->getChild(i)->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    renderer.lookAt(osg::Vec3d(0, -9, 9), osg::Vec3d(0, 0, 0), osg::Vec3d(0, 0, 1), 30.0);
    Picture p(192, 192);
    while (lit->average().frames < 32) p = renderer.render(lit);
    for (double a : {0.1, 0.5, 1.0}) {
        // Between the rows of pixels about the point, over which the light hardly bends.
        const double y = renderer.pixelOf(osg::Vec3d(0, -a, 0)).y() - 0.5;
        const int row = int(std::floor(y));
        double light = 0.0;
        for (int x = 92; x < 100; ++x)
            light += ((1.0 - y + row) * double(p.color(x, row)[1]) + (y - row) * double(p.color(x, row + 1)[1])) / 8.0;
        const double expected = 1.0 - testmaths::oracle::verticalRectangle(a, 8.0, 1.0);
        EXPECT_NEAR(light / expected, 1.0, 0.01) << "distance " << a;
    }
}

// Lambert and a rough Cook-Torrance metal under a lopsided map. The error falls with the frames and ends, after 128 of them, at
// what texels of 512 leave at contacts and the carrier of D allows.
TEST(Accumulation, ConvergesToExactDirectLight)
{
    SceneRenderer renderer(96, 72);
    osg::ref_ptr<LitScene> lit = stillScene(lopsidedMap(osg::Vec3d(0.3, 0.4, 0.5), osg::Vec3d(6.0, 5.0, 4.0)).get());
    addPost(*lit);
    osg::ref_ptr<osg::Geode> metal = makeBox(osg::Vec3d(0.7, -0.9, 0), osg::Vec3d(1.3, -0.3, 0.5));
    osgEnvLight::Material::setCookTorrance(*metal->getOrCreateStateSet(), osg::Vec3f(0.9f, 0.7f, 0.4f), 1.0f, 0.5f);
    lit->addChild(metal);
    lookAtPost(renderer);
    double errors[3] = {};
    const int frames[] = {1, 33, 129};
    for (int i = 0, drawn = 0; i < 3; drawn = frames[i++]) {
        const Picture p = renderer.render(lit, frames[i] - drawn);
        errors[i] = errorOf(p, *lit, renderer);
    }
    // Measured: .047, .0064, .0031.
    EXPECT_LT(errors[1], errors[0]);
    EXPECT_LT(errors[2], errors[1]);
    EXPECT_LT(errors[1], 0.01);
    EXPECT_LT(errors[2], 0.005);
}

// A room lit through a slot in its roof alone: a point sees a few hundredths of the map, so that lights have to be many and
// spread well. Measured: 1.24, .15.
TEST(Accumulation, ARoomLitThroughASlotConverges)
{
    suite::SuiteScene scene = suite::makeScene("slot");
    ASSERT_TRUE(suite::setMap(*scene.lit, "sky"));
    Settings& s = *scene.lit->getSettings();
    s.accumulate = true;
    s.bounce = Settings::BOUNCE_OFF;
    s.reflections = Settings::REFLECTIONS_MAP;
    SceneRenderer renderer(64, 48);
    renderer.lookAt(scene.eye, scene.target, osg::Vec3d(0, 0, 1), scene.fovy);
    const Picture first = renderer.render(scene.lit);
    const double before = errorOf(first, *scene.lit, renderer, 4096);
    while (scene.lit->average().frames < 47) renderer.render(scene.lit);
    const double after = errorOf(renderer.render(scene.lit), *scene.lit, renderer, 4096);
    EXPECT_GT(before, 0.1) << "too easy";
    EXPECT_LT(after, before / 5.0);
}

TEST(Accumulation, TheFirstFrameIsTheNormalOneAndMotionReturnsToIt)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<LitScene> lit = stillScene(lopsidedMap(osg::Vec3d(0.3, 0.4, 0.5), osg::Vec3d(6.0, 5.0, 4.0)).get());
    addPost(*lit);
    lit->getSettings()->accumulate = false;
    lookAtPost(renderer);
    const Picture normal = renderer.render(lit);
    renderer.lookAt(osg::Vec3d(3, -4, 4), osg::Vec3d(0, 0, 0.3));
    const Picture moved = renderer.render(lit);
    lit->getSettings()->accumulate = true;
    lookAtPost(renderer);
    EXPECT_EQ(0.0, largestDifference(normal, renderer.render(lit)));
    const Picture averaged = renderer.render(lit, 12);
    EXPECT_GT(largestDifference(normal, averaged), 0.0);
    EXPECT_GE(lit->average().frames, 11u);
    renderer.lookAt(osg::Vec3d(3, -4, 4), osg::Vec3d(0, 0, 0.3));
    EXPECT_EQ(0.0, largestDifference(moved, renderer.render(lit)));
    EXPECT_EQ(0u, lit->average().frames);
}

TEST(Accumulation, WhateverChangesBeginsAnew)
{
    SceneRenderer renderer(48, 48);
    osg::ref_ptr<LitScene> lit = stillScene(lopsidedMap(osg::Vec3d(0.3, 0.4, 0.5), osg::Vec3d(6.0, 5.0, 4.0)).get());
    addPost(*lit);
    const osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    const osg::ref_ptr<osg::Material> paint = new osg::Material;
    mover->addChild(makeBox(osg::Vec3d(1, 1, 0), osg::Vec3d(1.3, 1.3, 0.4)));
    mover->getOrCreateStateSet()->setAttributeAndModes(paint);
    lit->addChild(mover);
    lookAtPost(renderer);
    const auto framesAfter = [&](const char* what, auto change) {
        renderer.render(lit, 4);
        EXPECT_GT(lit->average().frames, 0u) << what;
        change();
        renderer.render(lit);
        EXPECT_EQ(0u, lit->average().frames) << what;
    };
    framesAfter("a caster moves", [&] { mover->setMatrix(osg::Matrixd::translate(-0.2, 0, 0)); });
    framesAfter("its colour", [&] { paint->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 0, 0, 1)); });
    framesAfter("the map turns", [&] { lit->getEnvironmentMap()->setRotation(20.0); });
    framesAfter("the intensity", [&] { lit->getEnvironmentMap()->setIntensity(2.0); });
    framesAfter("a setting", [&] { lit->getSettings()->nearRadius = 0.1f; });
    framesAfter("what exposure is added to", [&] { lit->getSettings()->exposureBase = Settings::EXPOSURE_NONE; });
    framesAfter("the scene", [&] { lit->removeChild(mover); });
    framesAfter("its GPU objects are gone", [&] { lit->releaseGLObjects(&renderer.state()); });
}

// The average is of radiance: another exposure shows the same one, as a view has it that had it from the start.
TEST(Accumulation, GoesOnWhenOnlyWhatIsShownChanges)
{
    const auto picture = [](bool late, bool converged) {
        SceneRenderer renderer(48, 48);
        osg::ref_ptr<LitScene> lit = stillScene(lopsidedMap(osg::Vec3d(0.3, 0.4, 0.5), osg::Vec3d(6.0, 5.0, 4.0)).get());
        lit->getSettings()->output = Settings::DISPLAY;
        lit->getSettings()->accumulateFrames = converged ? 5 : 100;
        addPost(*lit);
        lookAtPost(renderer);
        const auto change = [&] {
            lit->getSettings()->exposure = 1.5f;
            lit->getSettings()->toneCurve = Settings::REINHARD;
            lit->getSettings()->dither = false;
        };
        if (!late) change();
        renderer.render(lit, 12);
        const unsigned frames = lit->average().frames;
        if (late) change();
        const Picture p = renderer.render(lit, 4);
        EXPECT_EQ(converged ? 5u : frames + 4, lit->average().frames);
        return p;
    };
    for (const bool converged : {false, true})
        EXPECT_EQ(picture(false, converged).rgba, picture(true, converged).rgba) << converged;
}

TEST(Accumulation, RestsWhenItHasAllFrames)
{
    SceneRenderer renderer(48, 48);
    osg::ref_ptr<LitScene> lit = stillScene(lopsidedMap(osg::Vec3d(0.3, 0.4, 0.5), osg::Vec3d(6.0, 5.0, 4.0)).get());
    lit->getSettings()->accumulateFrames = 5;
    addPost(*lit);
    lookAtPost(renderer);
    const Picture last = renderer.render(lit, 8);
    EXPECT_EQ(0.0, largestDifference(last, renderer.render(lit, 3)));
    EXPECT_EQ(5u, lit->average().frames);
}

// Estimated from the spread of the frames.
TEST(Accumulation, TheStandardErrorFallsAsTheRootOfTheFrames)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<LitScene> lit = stillScene(lopsidedMap(osg::Vec3d(0.3, 0.4, 0.5), osg::Vec3d(6.0, 5.0, 4.0)).get());
    addPost(*lit);
    lookAtPost(renderer);
    EXPECT_LT(lit->average().standardError, 0.0);
    renderer.render(lit, 17);
    const double early = lit->average().standardError;
    renderer.render(lit, 48);
    const double late = lit->average().standardError;
    EXPECT_GT(early, 0.0);
    EXPECT_GT(late, 0.0);
    EXPECT_NEAR(late / early, 0.5, 0.2);  // a quarter of the variance
}

TEST(Accumulation, WithoutItNothingIsKept)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<LitScene> lit = stillScene(lopsidedMap(osg::Vec3d(0.3, 0.4, 0.5), osg::Vec3d(6.0, 5.0, 4.0)).get());
    addPost(*lit);
    lookAtPost(renderer);
    lit->getSettings()->accumulate = false;
    renderer.render(lit, 2);
    const size_t without = lit->textureBytes();
    lit->getSettings()->accumulate = true;
    renderer.render(lit, 3);
    EXPECT_GT(lit->textureBytes(), without);
    lit->getSettings()->accumulate = false;
    renderer.render(lit, 2);
    EXPECT_EQ(without, lit->textureBytes());
}

// Each frame has other points on the area lights. tRMSE, measured: 1.14 % in the first frame, .40 % after 48. With 96 x 72 pixels
// .78 % are left: the average keeps the blur of the filter, which is 2 pixels wide.
TEST(Accumulation, ShadowsOfAreaLightsConverge)
{
    const osg::ref_ptr<LitScene> lit = stillScene(constantMap(0.02).get());
    addPost(*lit);
    lit->getSettings()->areaPoints = 16;
    for (const double x : {-1.5, 1.5}) {
        const osg::ref_ptr<osgEnvLight::AreaLight> light = new osgEnvLight::AreaLight;
        light->setRectangle(osg::Vec3d(x, 0, 2), osg::Vec3d(0.5, 0, 0), osg::Vec3d(0, -0.5, 0));
        light->setRadiance(osg::Vec3f(3, 3, 3));
        light->setVisible(false);
        lit->addChild(light);
    }
    SceneRenderer renderer(192, 144);
    lookAtPost(renderer);
    const double first = errorOf(renderer.render(lit, 1), *lit, renderer);
    const Picture after = renderer.render(lit, 48);
    EXPECT_GE(lit->average().frames, 40u);
    const double last = errorOf(after, *lit, renderer);
    EXPECT_LT(last, 0.45 * first);
    lit->getSettings()->areaPoints = 32;  // whatever changes begins anew
    renderer.render(lit, 2);
    EXPECT_LT(lit->average().frames, 4u);
}

}  // namespace Accumulation_test
