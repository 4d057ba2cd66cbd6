// SPDX-License-Identifier: MIT
// Edges of what a display is sent.
#include "SmoothedCard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace Antialias_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;
using namespace smoothed;

namespace
{

double rmse(const Picture& a, const Picture& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.pixels(); ++i)
        for (size_t k = 0; k < 3; ++k) sum += std::pow(double(a.rgba[4 * i + k]) - double(b.rgba[4 * i + k]), 2.0);
    return std::sqrt(sum / double(3 * a.pixels()));
}

Picture convergedStillView(int antialias)
{
    const osg::ref_ptr<LitScene> lit = card(antialias, true);
    lit->getSettings()->occlusion = true;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->visibility = Settings::VISIBILITY_ATLAS;
    lit->getSettings()->accumulate = true;
    lit->getSettings()->accumulateFrames = 64;
    lit->getSettings()->accumulateSize = 64;
    return draw(lit, osg::Vec4(), size, 70);
}

}  // namespace

// Also where the host, not the map, is behind the edge. Measured .19 of the error without.
TEST(Antialias, EdgesAreNearerToTheirCoverage)
{
    const osg::Vec4 white(1, 1, 1, 1);
    for (const bool background : {true, false}) {
        const Picture truth = shrunk(draw(card(Settings::ANTIALIAS_OFF, background), white, 8 * size), 8);
        const double without = rmse(draw(card(Settings::ANTIALIAS_OFF, background), white), truth);
        const double with = rmse(draw(card(Settings::ANTIALIAS_EDGES, background), white), truth);
        EXPECT_LT(with, 0.2 * without) << background;
    }
}

// Off its edge, the card is what it is without.
TEST(Antialias, WhatIsEvenStays)
{
    const Picture with = draw(card(Settings::ANTIALIAS_EDGES, true), osg::Vec4());
    const Picture without = draw(card(Settings::ANTIALIAS_OFF, true), osg::Vec4());
    for (const int y : {4, size - 4})
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(with.color(20, y)[k], without.color(20, y)[k], 0.5 / 255) << y;
}

// Linear radiance and intermediates are handed on pixel by pixel.
TEST(Antialias, IsOfWhatADisplayShows)
{
    for (const int output : {Settings::DISPLAY, Settings::LINEAR})
        for (const int view : {Settings::BEAUTY, Settings::NORMAL})
            for (const int antialias : {Settings::ANTIALIAS_OFF, Settings::ANTIALIAS_EDGES}) {
                const osg::ref_ptr<LitScene> lit = card(antialias, true);
                lit->getSettings()->output = output;
                lit->getSettings()->view = view;
                SceneRenderer renderer(size, size);
                draw(renderer, lit, osg::Vec4(), 2);
                EXPECT_EQ(output == Settings::DISPLAY && view == Settings::BEAUTY && antialias == Settings::ANTIALIAS_EDGES,
                          lit->plan().runs("display"))
                    << lit->plan().reason("display");
            }
}

// The map alone has no edges.
TEST(Antialias, IsOfSurfaces)
{
    SceneRenderer renderer(size, size);
    const osg::ref_ptr<LitScene> lit = card(Settings::ANTIALIAS_EDGES, true);
    lit->removeChildren(0, lit->getNumChildren());
    const Picture with = draw(renderer, lit, osg::Vec4(), 2);
    EXPECT_FALSE(lit->plan().runs("display"));
    EXPECT_EQ(lit->plan().reason("pixelmarks"), lit->plan().reason("display"));
    lit->getSettings()->antialias = Settings::ANTIALIAS_OFF;
    EXPECT_EQ(0.0, largestDifference(with, draw(renderer, lit, osg::Vec4(), 2)));
}

// The average of a still view has smooth edges of its own.
TEST(Antialias, AStillViewConvergesToWhatItDoesWithout)
{
    const Picture without = convergedStillView(Settings::ANTIALIAS_OFF);
    for (const int antialias : {Settings::ANTIALIAS_EDGES, Settings::ANTIALIAS_TEMPORAL})
        EXPECT_LT(rmse(convergedStillView(antialias), without), 0.002) << antialias;
}

MovingErrors panErrors(int antialias, bool bars)
{
    return errorsOfMotion(antialias, [&](LitScene& lit) -> Step {
        for (int i = -8; i <= 8 && bars; ++i) {
            const osg::ref_ptr<osg::Geode> bar =
                makeQuad(osg::Vec3d(0.25 * i, -0.1, -2), osg::Vec3d(0.03, 0, 0), osg::Vec3d(0.6, 0, 4));
            osgEnvLight::Material::setLambert(*bar->getOrCreateStateSet(), osg::Vec3f(0.05f, 0.05f, 0.05f));
            lit.addChild(bar);
        }
        return [](SceneRenderer& renderer, int frame) {
            const double way = 0.013 * frame;  // .29 pixels a frame along both sides
            renderer.lookAt(osg::Vec3d(way, -4, way), osg::Vec3d(way, 0, way), osg::Vec3d(0, 0, 1), 40.0);
        };
    });
}

// Of a lone straight edge and of bars narrower than a pixel. Measured .60 and .75 of the error without, .42 and .56 of its
// change. Smoothed edges err less on these: .26 and .70 of the error, and .19 and .65 of its change. What a pan gains by former
// frames is in bench/motion_study.cpp.
TEST(Antialias, AMovingViewIsNearerToItsCoverageAndSteadierThanWithout)
{
    for (const bool bars : {false, true}) {
        const MovingErrors off = panErrors(Settings::ANTIALIAS_OFF, bars);
        const MovingErrors temporal = panErrors(Settings::ANTIALIAS_TEMPORAL, bars);
        EXPECT_LT(temporal.error, 0.85 * off.error) << bars;
        EXPECT_LT(temporal.change, 0.65 * off.change) << bars;
    }
}

// The first frame has none before it.
TEST(Antialias, AFirstFrameIsAsWithSmoothedEdges)
{
    const auto first = [](int antialias) { return draw(card(antialias, true), osg::Vec4(), size, 1); };
    EXPECT_LE(largestDifference(first(Settings::ANTIALIAS_TEMPORAL), first(Settings::ANTIALIAS_EDGES)), 1.0 / 65535);
}

// Nor has that after another size, or after a frame that was shown without.
TEST(Antialias, AFrameAfterAnotherSizeIsAFirstOne)
{
    const int smaller = size - 17;
    const auto first = [](int width) { return draw(card(Settings::ANTIALIAS_TEMPORAL, true), osg::Vec4(), width, 1); };
    const Picture fresh = first(smaller), large = first(size);
    SceneRenderer renderer(size, size);
    const osg::ref_ptr<LitScene> lit = card(Settings::ANTIALIAS_TEMPORAL, true);
    draw(renderer, lit, osg::Vec4(), 5);
    renderer.viewer().getCamera()->setViewport(0, 0, smaller, smaller);
    EXPECT_LE(largestDifference(fresh, draw(renderer, lit, osg::Vec4(), 1)), 1.0 / 65535);
    renderer.viewer().getCamera()->setViewport(0, 0, size, size);
    draw(renderer, lit, osg::Vec4(), 5);
    lit->getSettings()->view = Settings::NORMAL;
    draw(renderer, lit, osg::Vec4(), 1);
    lit->getSettings()->view = Settings::BEAUTY;
    EXPECT_LE(largestDifference(large, draw(renderer, lit, osg::Vec4(), 1)), 1.0 / 65535);
}

// What was before a card is gone at once.
TEST(Antialias, NothingIsLeftOfWhatIsGone)
{
    SceneRenderer renderer(size, size);
    const osg::ref_ptr<LitScene> lit = card(Settings::ANTIALIAS_TEMPORAL, true);
    lit->addChild(makeBox(osg::Vec3d(-0.2, -1.2, -0.2), osg::Vec3d(0.2, -0.8, 0.2)));
    const Picture there = draw(renderer, lit, osg::Vec4(), 12);
    lit->getChild(1)->setNodeMask(0);
    const Picture gone = draw(renderer, lit, osg::Vec4(), 1);
    const osg::ref_ptr<LitScene> without = card(Settings::ANTIALIAS_TEMPORAL, true);
    const Picture never = draw(renderer, without, osg::Vec4(), 1);
    // Below the edge of the card, where the box was.
    for (int y = size / 2 - 5; y < size / 2 - 2; ++y)
        for (int x = size / 2 - 3; x < size / 2 + 3; ++x)
            for (int k = 0; k < 3; ++k) {
                EXPECT_GT(there.color(x, y)[k], never.color(x, y)[k] + 0.25f);
                EXPECT_NEAR(never.color(x, y)[k], gone.color(x, y)[k], 2.0 / 255) << x << ' ' << y;
            }
}

}  // namespace Antialias_test
