// SPDX-License-Identifier: MIT
// Shadows of suns in scenes that are large against what the view shows, and of casters of every kind.
#include "SunScenes.h"

#include <osg/AlphaFunc>
#include <osg/Material>
#include <osg/Texture2D>

#include <gtest/gtest.h>

namespace SunLevels_test
{

using namespace sunscenes;
using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

// A floor 400 wide, and along all of it a wall 4 high that throws a shadow 4 wide to its left.
osg::ref_ptr<LitScene> longWall(double sunRadius = 0.7)
{
    osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0, 1), sunRadius);
    lit->addChild(makeBox(osg::Vec3d(-200, -200, -1), osg::Vec3d(200, 200, 0)));
    lit->addChild(makeBox(osg::Vec3d(0, -190, 0), osg::Vec3d(1, 190, 4)));
    return lit;
}

// Where the view ray of a pixel meets the ground.
osg::Vec3d groundAt(SceneRenderer& renderer, const Picture& p, int x, int y)
{
    const osg::Camera& camera = *renderer.viewer().getCamera();
    const osg::Matrixd inverse = osg::Matrixd::inverse(camera.getViewMatrix() * camera.getProjectionMatrix());
    const osg::Vec3d ndc(2.0 * (x + 0.5) / p.width - 1.0, 2.0 * (y + 0.5) / p.height - 1.0, -1.0);
    const osg::Vec3d a = ndc * inverse, b = osg::Vec3d(ndc.x(), ndc.y(), 0.5) * inverse;
    return a + (b - a) * (-a.z() / (b.z() - a.z()));
}

struct Tally {
    int count = 0;
    double mean = 0.0;
};

// Pixels of such places on the ground.
template <class Where>
Tally tallyWhere(SceneRenderer& renderer, const Picture& p, const Where& where)
{
    Tally tally;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            if (!where(groundAt(renderer, p, x, y))) continue;
            tally.mean += double(p.color(x, y)[0]);
            ++tally.count;
        }
    tally.mean /= std::max(tally.count, 1);
    return tally;
}

}  // namespace

// A texel of the whole scene's map is a third of a unit wide: the penumbra of this edge, a seventh of one.
TEST(SunLevels, NearShadowsAreSharp)
{
    SceneRenderer renderer(256, 256);
    osg::ref_ptr<LitScene> lit = longWall();
    const osgEnvLight::DominantLight sun = sunOf(*lit);
    const double elevation = std::asin(sun.direction.z());
    const double edge = 4.0 / std::tan(elevation);
    const double width = 4.0 / std::tan(elevation - 0.687 * sun.radius) - 4.0 / std::tan(elevation + 0.687 * sun.radius);
    lookDown(renderer, osg::Vec3d(-edge, 20, 0), 4.0 * width);
    const Picture p = renderer.render(lit);
    EXPECT_GE(lit->drawnSunMaps(), 2u);
    EXPECT_NEAR(std::abs(crossing(p, 0.9) - crossing(p, 0.1)) / 256.0 * 4.0, 1.0, 0.1);
}

// Down the wall, through all levels: outside of the penumbra everything is lit or dark, no border is seen.
TEST(SunLevels, NoSeamsBetweenLevels)
{
    SceneRenderer renderer(256, 192);
    osg::ref_ptr<LitScene> lit = longWall();
    renderer.lookAt(osg::Vec3d(-6, -185, 3), osg::Vec3d(-4, -170, 0));
    const Picture p = renderer.render(lit);
    EXPECT_GE(lit->drawnSunMaps(), 3u);
    int dark = 0, bright = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const osg::Vec3d g = groundAt(renderer, p, x, y);
            if (!(g.y() > -185.0 && g.y() < 180.0) || !(p.alpha(x, y) > 0.5f)) continue;
            // The penumbra is .15 wide, a texel of the whole scene's map .4.
            const double margin = 0.3 + 0.01 * (g.y() + 185.0);
            if (g.x() > -4.0 + margin && g.x() < -0.05) {
                EXPECT_EQ(0.0, p.color(x, y)[0]) << g.x() << ", " << g.y();
                ++dark;
            } else if (g.x() < -4.0 - margin) {
                EXPECT_EQ(1.0, p.color(x, y)[0]) << g.x() << ", " << g.y();
                ++bright;
            }
        }
    EXPECT_GT(dark, 2000);
    EXPECT_GT(bright, 2000);
}

// In a street 400 long and 20 wide, a post 60 ahead, four pixels wide there. A level that is to be half as wide as the
// street cannot reach it.
TEST(SunLevels, ReachFarAlongAStreet)
{
    SceneRenderer renderer(512, 384);
    osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0, 1), 0.3);
    lit->addChild(makeBox(osg::Vec3d(-10, -200, -1), osg::Vec3d(10, 200, 0)));
    lit->addChild(makeBox(osg::Vec3d(0, -130.2, 0), osg::Vec3d(0.4, -129.8, 4)));
    renderer.lookAt(osg::Vec3d(-3, -190, 20), osg::Vec3d(-3, -130, 0), osg::Vec3d(0, 0, 1), 30.0);
    const Picture p = renderer.render(lit);
    const Tally shadow = tallyWhere(
        renderer, p, [](const osg::Vec3d& g) { return g.x() > -3.5 && g.x() < -0.3 && std::abs(g.y() + 130.0) < 0.15; });
    ASSERT_GT(shadow.count, 5);
    EXPECT_LT(shadow.mean, 0.02);
}

// Few levels, each half as wide as the last, would have texels half a unit wide before the eye.
TEST(SunLevels, ReachNearInAnEndlessPlain)
{
    SceneRenderer renderer(256, 192);
    osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0, 1), 0.3);
    lit->addChild(makeBox(osg::Vec3d(-2000, -2000, -1), osg::Vec3d(2000, 2000, 0)));
    lit->addChild(makeBox(osg::Vec3d(0, -0.1, 0), osg::Vec3d(0.2, 0.1, 2)));
    renderer.lookAt(osg::Vec3d(-1, -6, 1.7), osg::Vec3d(-1, 0, 0.5));
    const Picture p = renderer.render(lit, 5);  // the fifth knows what the view shows
    const Tally shadow =
        tallyWhere(renderer, p, [](const osg::Vec3d& g) { return g.x() > -1.8 && g.x() < -0.1 && std::abs(g.y()) < 0.07; });
    ASSERT_GT(shadow.count, 5);
    EXPECT_LT(shadow.mean, 0.02);
    const Tally beside = tallyWhere(renderer, p, [](const osg::Vec3d& g) {
        return g.x() > -1.8 && g.x() < -0.1 && std::abs(g.y()) > 0.15 && std::abs(g.y()) < 0.4;
    });
    ASSERT_GT(beside.count, 5);
    EXPECT_GT(beside.mean, 0.98);
}

// A tower stands before a wall, both between the ground and the sun. Where the tower's edge crosses the wall, a map shows one of
// them in a texel, and the other in the next.
TEST(SunLevels, NoLightWhereAShadowsEdgeCrossesAnother)
{
    SceneRenderer renderer(256, 192);
    for (const double radius : {0.3, 0.7, 1.5}) {
        osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0.3, 1), radius);
        lit->addChild(makeBox(osg::Vec3d(-20, -20, -1), osg::Vec3d(20, 20, 0)));
        lit->addChild(makeBox(osg::Vec3d(1, -6, 0), osg::Vec3d(2, 6, 3)));
        lit->addChild(makeBox(osg::Vec3d(4, -1, 0), osg::Vec3d(5, 1, 9)));
        lookDown(renderer, osg::Vec3d(-0.3, -0.5, 0), 3.0);
        const Picture p = renderer.render(lit);
        const Tally shadow =
            tallyWhere(renderer, p, [](const osg::Vec3d& g) { return g.x() > -1.5 && g.x() < 0.9 && std::abs(g.y()) < 3.0; });
        ASSERT_GT(shadow.count, 10000);
        EXPECT_EQ(0.0, shadow.mean) << radius;
    }
}

// Levels move by whole texels: a view that comes back by another way sees the shadows that it saw.
TEST(SunLevels, ShadowsDontSwim)
{
    SceneRenderer renderer(128, 96);
    osg::ref_ptr<LitScene> lit = longWall();
    const auto look = [&](double y) { renderer.lookAt(osg::Vec3d(-6, y, 3), osg::Vec3d(-4, y + 10, 0)); };
    look(-100);
    const Picture first = renderer.render(lit);
    look(-99.9);
    renderer.render(lit);
    EXPECT_EQ(0u, lit->drawnSunMaps());  // still within what the levels show
    unsigned drawn = 0;
    for (double y = -98; y < 60; y += 11.3) {
        look(y);
        renderer.render(lit);
        drawn += lit->drawnSunMaps();
    }
    EXPECT_GT(drawn, 2u);
    look(-100);
    // Rows at a texel's border fall to either side of it.
    EXPECT_LT(rootMeanSquare(first, renderer.render(lit)), 0.01);
}

// A leaf whose left half is cut out by its texture's alpha.
TEST(SunLevels, WhatTheAlphaTestLeavesCasts)
{
    SceneRenderer renderer(128, 128);
    osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(0, 0, 1), 0.7);
    lit->addChild(makeBox(osg::Vec3d(-2, -2, -0.2), osg::Vec3d(2, 2, 0)));
    osg::ref_ptr<osg::Geode> leaf = makeQuad(osg::Vec3d(-1, -1, 1), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0));
    osg::Geometry* geometry = leaf->getDrawable(0)->asGeometry();
    osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array;
    const auto& vertices = static_cast<const osg::Vec3Array&>(*geometry->getVertexArray());
    for (const osg::Vec3& v : vertices) coordinates->push_back(osg::Vec2(0.5f + 0.5f * v.x(), 0.5f + 0.5f * v.y()));
    geometry->setTexCoordArray(0, coordinates);
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(64, 64, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            unsigned char* t = image->data(unsigned(x), unsigned(y));
            t[0] = t[1] = t[2] = 255;
            t[3] = x < 32 ? 0 : 255;
        }
    osg::StateSet& state = *leaf->getOrCreateStateSet();
    state.setTextureAttributeAndModes(0, new osg::Texture2D(image));
    state.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    lit->addChild(leaf);
    // From the side, beneath the leaf.
    renderer.lookAt(osg::Vec3d(0, -6, 2), osg::Vec3d(0, 0, 0), osg::Vec3d(0, 0, 1), 30.0);
    const Picture p = renderer.render(lit);
    int dark = 0, bright = 0;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
            const osg::Vec3d g = groundAt(renderer, p, x, y);
            if (std::abs(g.y() + 0.6) > 0.3 || std::abs(g.x()) > 0.9 || std::abs(g.x()) < 0.1) continue;
            ++(g.x() > 0.0 ? dark : bright);
            EXPECT_EQ(g.x() > 0.0 ? 0.0 : 1.0, p.color(x, y)[0]) << g.x() << ", " << g.y();
        }
    EXPECT_GT(dark, 100);
    EXPECT_GT(bright, 100);
}

// Whatever stands between the view and the sun casts, out of the picture too; a sheet from either side.
TEST(SunLevels, CastersOutOfTheViewCast)
{
    SceneRenderer renderer(64, 64);
    for (bool turned : {false, true}) {
        osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0, 1), 0.7);
        lit->addChild(makeBox(osg::Vec3d(-30, -2, -0.2), osg::Vec3d(30, 2, 0)));
        renderer.lookAt(osg::Vec3d(-20, -1, 2), osg::Vec3d(-20, 0, 0), osg::Vec3d(0, 0, 1), 20.0);
        EXPECT_EQ(1.0, ofGeometry(renderer.render(lit)).least);
        const osg::Vec3d a(4, 0, 0), b(0, 4, 0);
        lit->addChild(makeQuad(osg::Vec3d(-2, -2, 20), turned ? b : a, turned ? a : b));
        EXPECT_EQ(0.0, ofGeometry(renderer.render(lit)).most) << turned;
    }
}

// What D asks about its lights is no business of the suns, nor of what the scene itself emits.
TEST(SunLevels, TheSunsDontChangeWithWhatDAsks)
{
    SceneRenderer renderer(96, 96);
    osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0.3, 1));
    lit->getSettings()->view = Settings::BEAUTY;  // under a black sky: the suns' and the lamp's light alone
    lit->getSettings()->emissiveMeshes = false;   // an area light has shadows, too
    lit->addChild(makeBox(osg::Vec3d(-2, -2, -0.2), osg::Vec3d(2, 2, 0)));
    lit->addChild(makeSphere(osg::Vec3d(0, 0, 0.7), 0.7));
    osg::ref_ptr<osg::Geode> lamp = makeBox(osg::Vec3d(0.9, -0.2, 0), osg::Vec3d(1.1, 0, 0.5));
    osg::ref_ptr<osg::Material> glow = new osg::Material;
    glow->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(0.5, 0.25, 0.125, 1));
    lamp->getOrCreateStateSet()->setAttributeAndModes(glow);
    lit->addChild(lamp);
    renderer.lookAt(osg::Vec3d(-2, -5, 3), osg::Vec3d(0, 0, 0.4));
    const auto picture = [&](Settings::Visibility v, Settings::View view) {
        lit->getSettings()->visibility = v;
        lit->getSettings()->view = view;
        return renderer.render(lit).rgba;
    };
    const std::vector<float> beauty = picture(Settings::VISIBILITY_AUTO, Settings::BEAUTY);
    for (Settings::Visibility v : {Settings::VISIBILITY_SCREEN, Settings::VISIBILITY_ATLAS, Settings::VISIBILITY_BOTH})
        EXPECT_TRUE(beauty == picture(v, Settings::BEAUTY)) << v;
    EXPECT_FALSE(beauty == picture(Settings::VISIBILITY_NONE, Settings::BEAUTY));
    EXPECT_TRUE(picture(Settings::VISIBILITY_AUTO, Settings::EMISSION) == picture(Settings::VISIBILITY_NONE, Settings::EMISSION));
}

// A still view goes over from a normal frame, shadows of suns included, to its average.
TEST(SunLevels, AStillViewBeginsWithTheirShadows)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<LitScene> lit = makeLit(sunMap(osg::Vec3d(1, 0, 1), 1.5, 0.05).get());
    Settings& s = *lit->getSettings();
    s.regeneration = Settings::IMMEDIATE;
    s.suns = Settings::SUNS_AUTO;
    s.atlasLights = 16;
    s.accumulateSize = 256;
    lit->addChild(makeBox(osg::Vec3d(-3, -3, -0.5), osg::Vec3d(3, 3, 0)));
    lit->addChild(makeBox(osg::Vec3d(0, -2, 0), osg::Vec3d(0.5, 2, 1.5)));
    lookDown(renderer, osg::Vec3d(-0.5, 0, 0), 4.0);
    const Picture normal = renderer.render(lit, 3);
    s.accumulate = true;
    Picture still(64, 64);
    for (int i = 0; i < 16 && lit->average().frames < 1; ++i) still = renderer.render(lit);
    EXPECT_EQ(1u, lit->average().frames);
    // A 32nd of it is the average already.
    EXPECT_LT(rootMeanSquare(normal, still), 0.01 * ofGeometry(normal).most);
}

}  // namespace SunLevels_test
