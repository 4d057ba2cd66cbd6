// SPDX-License-Identifier: MIT
// Surfaces that show shadows on the map behind them, and the ground of that kind that a setting puts below a scene.
#include "SunScenes.h"
#include "TracedView.h"

#include <Process.h>

#include <osgEnvLight/Material>
#include <osgEnvLight/SceneDescription>

#include <osg/MatrixTransform>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <limits>

namespace ShadowCatcher_test
{

using osgEnvLight::Layer;
using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::ReferenceOptions;
using osgEnvLight::Settings;

namespace
{

// A sun over a sky, and ground below the horizon.
osg::ref_ptr<LitScene> outdoors()
{
    osg::Vec3d sun(0.5, -0.3, 1.0);
    sun.normalize();
    const osg::ref_ptr<LitScene> lit = makeLit(makeMap(512, 256, [=](const osg::Vec3d& d) {
                                                   if (d * sun > std::cos(1.5 * sunscenes::degree))
                                                       return osg::Vec3d(900, 800, 700);
                                                   return d.z() > 0.0 ? osg::Vec3d(0.6, 0.8, 1.2) : osg::Vec3d(0.5, 0.4, 0.3);
                                               }).get());
    Settings& s = *lit->getSettings();
    s.suns = Settings::SUNS_AUTO;
    s.bounce = Settings::BOUNCE_OFF;
    s.regeneration = Settings::IMMEDIATE;
    return lit;
}

osg::ref_ptr<osg::Geode> floorOf(double halfSide)
{
    return makeQuad(osg::Vec3d(-halfSide, -halfSide, 0), osg::Vec3d(2 * halfSide, 0, 0), osg::Vec3d(0, 2 * halfSide, 0));
}

osg::ref_ptr<osg::Geode> boxOn(double height)
{
    return makeBox(osg::Vec3d(-0.5, -0.5, height), osg::Vec3d(0.5, 0.5, height + 1.0));
}

void lookAtFloor(SceneRenderer& renderer)
{
    renderer.lookAt(osg::Vec3d(0.0, -4.0, 4.0), osg::Vec3d(-0.4, 0.2, 0.0), osg::Vec3d(0, 0, 1), 25.0);
}

// The largest difference in any channel, as a share of the second's.
double largestShare(const Picture& a, const Picture& b, const std::function<bool(int, int)>& counts)
{
    double most = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int k = 0; k < 3 && counts(x, y); ++k)
                most = std::max(most, double(std::abs(a.color(x, y)[k] - b.color(x, y)[k]) / b.color(x, y)[k]));
    return most;
}

Picture without(LitScene& lit, SceneRenderer& renderer)
{
    lit.removeChildren(0, lit.getNumChildren());
    lit.getSettings()->ground = Settings::GROUND_OFF;
    return renderer.render(&lit);
}

}  // namespace

// Its picture over that of the map is the light on a floor over that on the floor of an empty scene: of a frame, and of an
// average.
TEST(ShadowCatcher, DarkensTheMapAsAFloorIsDarkened)
{
    const int side = 48;
    SceneRenderer renderer(side, side);
    lookAtFloor(renderer);
    const osg::ref_ptr<LitScene> lit = outdoors();
    lit->addChild(floorOf(8.0));
    lit->addChild(boxOn(0.1));
    Material::setLambert(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(0.5f, 0.5f, 0.5f));
    Material::setLambert(*lit->getChild(1)->getOrCreateStateSet(), osg::Vec3f());  // its top, too, is level
    renderer.render(lit);                                                          // the camera's near and far
    // Both by the same samples, most of whose noise the quotient is without.
    const auto traced = [&](ReferenceOptions::Paths paths) {
        return tracedView(*lit, renderer, 160, {Layer::BEAUTY, Layer::NORMAL, Layer::DEPTH}, false, paths);
    };
    const osgEnvLight::ReferenceResult open = traced(ReferenceOptions::UNOCCLUDED);
    const Picture alone = open.mean(Layer::BEAUTY), shaded = traced(ReferenceOptions::DIRECT).mean(Layer::BEAUTY);
    Material::setShadowCatcher(*lit->getChild(0)->getOrCreateStateSet());
    std::vector<Picture> shown = {renderer.render(lit)};
    lit->getSettings()->accumulate = true;
    shown.push_back(renderer.render(lit, 24));
    lit->getSettings()->accumulate = false;
    const Picture map = without(*lit, renderer);

    const osgEnvLight::Mask inner = awayFromEdges(osgEnvLight::Mask::geometry(alone), open);
    for (const Picture& picture : shown) {
        double sum = 0.0, of = 0.0;
        int pixels = 0, dark = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                if (!(alone.color(x, y)[1] > 0.0f) || !inner.at(x, y)) continue;
                const double share = double(shaded.color(x, y)[1] / alone.color(x, y)[1]);
                ++pixels;
                dark += share < 0.5;
                sum += share * share;
                of += std::pow(double(picture.color(x, y)[1] / map.color(x, y)[1]) - share, 2.0);
            }
        EXPECT_GT(pixels, side * side / 2);
        EXPECT_GT(dark, pixels / 30) << "the box's shadow is in view";
        EXPECT_LT(std::sqrt(of / sum), 0.02);  // measured: .0152 and .0177, with the truth's noise and the shadow's edge
    }
}

// Far from what casts shadows nothing of the ground is seen, nor where it ends.
TEST(ShadowCatcher, TheGroundItselfIsNotSeen)
{
    SceneRenderer renderer(128, 128);
    renderer.lookAt(osg::Vec3d(0.0, -6.0, 2.0), osg::Vec3d(0, 4, 1.0), osg::Vec3d(0, 0, 1), 60.0);
    for (const bool probes : {false, true}) {
        const osg::ref_ptr<LitScene> lit = outdoors();
        lit->addChild(makeSphere(osg::Vec3d(0, 0, 0.05), 0.05, 16));
        lit->getSettings()->ground = Settings::GROUND_SHADOWS;
        if (probes) lit->getSettings()->bounce = Settings::BOUNCE_PROBES;
        lit->getSettings()->bounceProbes = fewestProbes;
        const osg::Vec2d ball = renderer.pixelOf(osg::Vec3d(0, 0, 0.05));
        const Picture p = renderer.render(lit, probes ? 4 : 1);
        const auto far = [&](int x, int y) { return (osg::Vec2d(x, y) - ball).length() > 24.0; };
        EXPECT_LT(largestShare(p, without(*lit, renderer), far), 1e-3) << probes;
    }
}

// As a veil over what the host has behind it.
TEST(ShadowCatcher, WithoutTheMapShadowsAreAVeil)
{
    SceneRenderer renderer(96, 96);
    lookAtFloor(renderer);
    const osg::ref_ptr<LitScene> lit = outdoors();
    lit->addChild(boxOn(0.0));
    lit->getSettings()->ground = Settings::GROUND_SHADOWS;
    const Picture over = renderer.render(lit);
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    renderer.viewer().getCamera()->setClearColor(osg::Vec4(2.0f, 2.0f, 2.0f, 0.0f));
    const Picture veiled = renderer.render(lit);
    renderer.viewer().getCamera()->setClearColor(osg::Vec4());
    lit->getSettings()->background = Settings::BACKGROUND_ON;
    const Picture map = without(*lit, renderer);
    int dark = 0;
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x) {
            if (over.color(x, y)[1] > map.color(x, y)[1] * 1.01f) continue;  // the box
            const glsl::vec3 share = glsl::vec3(over.color(x, y)[0], over.color(x, y)[1], over.color(x, y)[2]) /
                                     glsl::vec3(map.color(x, y)[0], map.color(x, y)[1], map.color(x, y)[2]);
            dark += share.y < 0.5;
            EXPECT_NEAR(double(veiled.color(x, y)[1]), 2.0 * glsl::luminance(share), 2e-3) << x << ", " << y;
        }
    EXPECT_GT(dark, 200);
}

TEST(ShadowCatcher, IsAMaterialOfSceneDescriptions)
{
    const TemporaryFolder folder;
    const osg::ref_ptr<osg::Geode> floor = floorOf(3.0);
    floor->setName("floor");
    ASSERT_TRUE(osgDB::writeNodeFile(*floor, folder.file("floor.osgb")));
    const std::string file =
        folder.write("scene.envlight", R"({"model": "floor.osgb", "environment": {"map": "sky"}, "settings": {"bounce": "off"},
                                           "materials": {"fl*": {"brdf": "shadow-catcher"}}})");
    osgEnvLight::SceneDescription description;
    std::string error;
    ASSERT_TRUE(description.readFile(file, nullptr, error)) << error;
    const osg::ref_ptr<LitScene> lit = description.build(nullptr, error);
    ASSERT_TRUE(lit) << error;
    SceneRenderer renderer(32, 32);
    lookAtFloor(renderer);
    renderer.render(lit);
    EXPECT_EQ(1u, lit->plan().surfaces.catchers);
}

// A catcher between a lamp of the map and a body takes nothing from it.
TEST(ShadowCatcher, CastsNoShadow)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, 0, 0.2), osg::Vec3d(0, 0, -1), osg::Vec3d(0, 1, 0));
    const osg::ref_ptr<LitScene> lit = outdoors();
    lit->addChild(makeBox(osg::Vec3d(-1, -1, -2), osg::Vec3d(1, 1, -1)));
    const Picture open = renderer.render(lit);
    const osg::ref_ptr<osg::MatrixTransform> above = new osg::MatrixTransform(osg::Matrixd::translate(0, 0, 0.5));
    above->addChild(floorOf(3.0));
    lit->addChild(above);
    EXPECT_GT(largestDifference(renderer.render(lit), open), 0.1) << "a floor does, above the eye";
    Material::setShadowCatcher(*above->getOrCreateStateSet());
    EXPECT_LE(largestDifference(renderer.render(lit), open), 1e-6);
}

// It lies at the lowest vertex, not at the corner of a turned box of bounds; a body that rises leaves it behind.
TEST(ShadowCatcher, TheGroundIsAsLowAsTheSceneHasBeen)
{
    SceneRenderer renderer(96, 96);
    const osg::ref_ptr<LitScene> lit = outdoors();
    const osg::ref_ptr<osg::MatrixTransform> turned = new osg::MatrixTransform(osg::Matrixd::rotate(0.7, osg::Vec3d(1, 1, 0)));
    turned->addChild(makeSphere(osg::Vec3d(), 1.0, 64));
    lit->addChild(turned);
    lit->getSettings()->ground = Settings::GROUND_SHADOWS;
    lit->getSettings()->view = Settings::NORMAL;
    // Level, from just above and just below the ball's lowest point.
    const auto showsGround = [&](double height) {
        renderer.lookAt(osg::Vec3d(0, -6, height + 0.02), osg::Vec3d(0, -3, height));
        const Picture p = renderer.render(lit);
        return p.color(6, 6)[2] > 0.9f || p.color(6, 89)[2] > 0.9f;  // beside the ball
    };
    EXPECT_TRUE(showsGround(-0.99));
    EXPECT_FALSE(showsGround(-1.05));
    const osg::BoundingSphere bound = lit->getBound();
    EXPECT_NEAR(double(bound.radius()), 1.0, 0.8) << "the home view does not go by the ground";
    turned->postMult(osg::Matrixd::translate(0, 0, 0.5));
    EXPECT_TRUE(showsGround(-0.99));
    turned->postMult(osg::Matrixd::translate(0, 0, -1.0));
    EXPECT_TRUE(showsGround(-1.49)) << "it falls with the ball";
    EXPECT_FALSE(showsGround(-1.55));
}

// Each place of the ground shows what the map's camera saw there, wherever the eye is. Further off the map is infinitely far. The
// end of the ground is not seen.
TEST(ShadowCatcher, TheMapMayLieOnTheGround)
{
    SceneRenderer renderer(160, 160);
    const auto radiance = [](const osg::Vec3d& d) { return osg::Vec3d(1.0 + 0.5 * d.x(), 1.0 + 0.5 * d.y(), 1.0); };
    const osg::ref_ptr<LitScene> lit = makeLit(makeMap(512, 256, radiance).get());
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    lit->addChild(makeSphere(osg::Vec3d(0, 0, 0.05), 0.05, 16));
    lit->getSettings()->ground = Settings::GROUND_SHADOWS;
    lit->getSettings()->groundMapHeight = 0.2f;
    const osg::Vec3d camera(0, 0, 0.2);
    for (const osg::Vec3d& eye : {osg::Vec3d(0.1, -1.0, 0.6), osg::Vec3d(0.8, 0.5, 0.4), osg::Vec3d(-0.1, 0.2, 1.5)})
        for (const bool averages : {false, true}) {
            renderer.lookAt(eye, osg::Vec3d(0, 0, 0.0), osg::Vec3d(0, 1, 0.1), 60.0);
            lit->getSettings()->accumulate = averages;
            const Picture p = renderer.render(lit, averages ? 6 : 1);
            for (const osg::Vec3d& place : {osg::Vec3d(0.25, 0.1, 0), osg::Vec3d(-0.1, 0.22, 0), osg::Vec3d(-0.2, -0.2, 0)}) {
                osg::Vec3d seen = place - camera;
                seen.normalize();
                const osg::Vec2d pixel = renderer.pixelOf(place);
                for (int k = 0; k < 3; ++k)
                    EXPECT_NEAR(double(p.color(int(pixel.x()), int(pixel.y()))[k]) / radiance(seen)[k], 1.0, 0.02)
                        << place.x() << k;
            }
        }
    lit->getSettings()->accumulate = false;
    renderer.lookAt(osg::Vec3d(0, -0.3, 0.1), osg::Vec3d(0, 4, 0.0), osg::Vec3d(0, 0, 1), 60.0);
    const Picture p = renderer.render(lit);
    const int horizon = int(renderer.pixelOf(osg::Vec3d(0, 1e4, 0.0)).y());
    for (int y = std::min(horizon, 80) - 12; y < horizon + 12; ++y)
        for (int x = 4; x < 30; ++x)
            for (int k = 0; k < 2; ++k) EXPECT_NEAR(p.color(x, y)[k], p.color(x, y + 1)[k], 0.02f) << x << ", " << y;
}

// What is averaged over frames is looked up where the picture before showed the map, not where it showed the ground.
TEST(ShadowCatcher, TheFarMapIsAveragedAsWithoutAGround)
{
    SceneRenderer renderer(96, 96);
    const auto stripes = [](const osg::Vec3d& d) {
        const double level = 0.5 + 0.4 * std::sin(60.0 * std::atan2(d.y(), d.x())) * std::sin(60.0 * d.z());
        return osg::Vec3d(level, level, level);
    };
    const auto lastOfWalk = [&](int ground) {
        const osg::ref_ptr<LitScene> lit = makeLit(makeMap(1024, 512, stripes).get());
        lit->addChild(makeSphere(osg::Vec3d(0, 0, 0.05), 0.05, 16));
        Settings& s = *lit->getSettings();
        s.ground = ground;
        s.bounce = Settings::BOUNCE_OFF;
        s.output = Settings::DISPLAY;
        s.exposureBase = Settings::EXPOSURE_NONE;
        s.antialias = Settings::ANTIALIAS_TEMPORAL;
        Picture p;
        for (int frame = 0; frame < 6; ++frame) {
            renderer.lookAt(osg::Vec3d(0.06 * frame, -2.0, 0.8 + 0.02 * frame), osg::Vec3d(0.03 * frame, 0, 0.1));
            p = renderer.render(lit);
        }
        return p;
    };
    const Picture with = lastOfWalk(Settings::GROUND_SHADOWS), without = lastOfWalk(Settings::GROUND_OFF);
    const osg::Vec2d ball = renderer.pixelOf(osg::Vec3d(0, 0, 0.05));
    double most = 0.0;
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            if ((osg::Vec2d(x, y) - ball).length() > 20.0)
                most = std::max(most, std::abs(double(with.color(x, y)[1] - without.color(x, y)[1])));
    EXPECT_LT(most, 2.5 / 255.0);  // measured: 2, the ball's shadow; 44 where the ground was
}

// Its bounds reach behind the eye. A near plane that went by them would leave the depth buffer few steps for the scene.
TEST(ShadowCatcher, TheGroundLeavesTheNearPlaneToTheScene)
{
    SceneRenderer renderer(64, 64);
    const osg::ref_ptr<LitScene> lit = outdoors();
    lit->addChild(makeSphere(osg::Vec3d(), 1.0, 32));
    lit->getSettings()->ground = Settings::GROUND_SHADOWS;
    renderer.lookAt(osg::Vec3d(0, -10, 3), osg::Vec3d(), osg::Vec3d(0, 0, 1), 20.0);
    renderer.render(lit);
    double left, right, bottom, top, near, far;
    renderer.viewer().getCamera()->getProjectionMatrixAsFrustum(left, right, bottom, top, near, far);
    // The view's lowest ray falls by 26.7 degrees and meets the ground, 4 below the eye, 8.9 away: 8.8 deep.
    EXPECT_GT(near, 8.0);
    EXPECT_LT(near, 9.0);
    EXPECT_GT(far, 11.0);
}

// Pixels that a box's shadow darkens, of a scene of that size at that place, whose ground lies by the setting.
int shadedPixels(SceneRenderer& renderer, double scale, const osg::Vec3d& place, bool parallel)
{
    const osg::ref_ptr<LitScene> lit = outdoors();
    const osg::ref_ptr<osg::MatrixTransform> at =
        new osg::MatrixTransform(osg::Matrixd::scale(scale, scale, scale) * osg::Matrixd::translate(place));
    at->addChild(boxOn(0.0));
    lit->addChild(at);
    lit->getSettings()->ground = Settings::GROUND_SHADOWS;
    renderer.lookAt(osg::Vec3d(0, -4, 4) * scale + place, osg::Vec3d(0, 0.3, 0) * scale + place);
    if (parallel)
        renderer.viewer().getCamera()->setProjectionMatrixAsOrtho(-2 * scale, 2 * scale, -2 * scale, 2 * scale, 0, 9 * scale);
    const Picture p = renderer.render(lit);
    const Picture map = without(*lit, renderer);
    int shaded = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            EXPECT_TRUE(std::isfinite(p.color(x, y)[0]) && p.color(x, y)[0] >= 0.0f) << x << ", " << y;
            shaded += p.color(x, y)[1] < 0.6f * map.color(x, y)[1];
        }
    return shaded;
}

TEST(ShadowCatcher, TheGroundIsTheSameAtAnySizeAndPlace)
{
    SceneRenderer renderer(64, 64);
    for (const bool parallel : {false, true}) {
        const int expected = shadedPixels(renderer, 1.0, osg::Vec3d(), parallel);
        EXPECT_GT(expected, 60);
        const std::pair<double, osg::Vec3d> others[] = {
            {1e-5, osg::Vec3d()}, {1e5, osg::Vec3d()}, {10.0, osg::Vec3d(3e6, -4e6, 4e6)}, {1.0, osg::Vec3d(0, 0, -1e4)}};
        for (const auto& [scale, place] : others)
            EXPECT_NEAR(shadedPixels(renderer, scale, place, parallel), expected, 0.05 * expected + 2) << scale << parallel;
    }
}

TEST(ShadowCatcher, AGroundBelowNothingIsNotThere)
{
    SceneRenderer renderer(16, 16);
    lookAtFloor(renderer);
    const auto expectNoGround = [&](osg::Node* node) {
        const osg::ref_ptr<LitScene> lit = outdoors();
        if (node) lit->addChild(node);
        lit->getSettings()->ground = Settings::GROUND_SHADOWS;
        const Picture p = renderer.render(lit, 2);
        EXPECT_LT(largestShare(p, without(*lit, renderer), [](int, int) { return true; }), 1e-6);
    };
    expectNoGround(nullptr);
    expectNoGround(new osg::Group);
    const osg::ref_ptr<osg::Geode> none = boxOn(0.0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (auto& v : static_cast<osg::Vec3Array&>(*none->getDrawable(0)->asGeometry()->getVertexArray())) v.set(0, 0, float(nan));
    none->getDrawable(0)->dirtyBound();
    expectNoGround(none);
    const osg::ref_ptr<osg::Geode> point = boxOn(0.0);
    for (auto& v : static_cast<osg::Vec3Array&>(*point->getDrawable(0)->asGeometry()->getVertexArray())) v.set(0, 0, 0);
    point->getDrawable(0)->dirtyBound();
    expectNoGround(point);
}

}  // namespace ShadowCatcher_test
