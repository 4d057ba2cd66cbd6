// SPDX-License-Identifier: MIT
// What glossy surfaces show of the scene.
#include <SceneRenderer.h>

#include <metrics/Mask>
#include <metrics/Metrics>
#include <osgEnvLight/Material>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "TracedView.h"

namespace Reflections_test
{

using osgEnvLight::Layer;
using osgEnvLight::LitScene;
using osgEnvLight::Mask;
using osgEnvLight::Material;
using osgEnvLight::ReferenceOptions;
using osgEnvLight::Settings;

namespace
{

// A metal floor, on which two coloured boxes and a ball of metal stand.
osg::ref_ptr<LitScene> makeScene(float roughness)
{
    osg::ref_ptr<LitScene> lit = makeLit(lopsidedMap().get());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    const osg::ref_ptr<osg::Geode> floor = makeQuad(osg::Vec3d(-3, -3, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 6, 0));
    Material::setCookTorrance(*floor->getOrCreateStateSet(), osg::Vec3f(0.9f, 0.9f, 0.9f), 1.0f, roughness);
    lit->addChild(floor);
    const osg::ref_ptr<osg::Geode> red = makeBox(osg::Vec3d(-1.6, -0.2, 0), osg::Vec3d(-0.6, 0.8, 1.4));
    Material::setLambert(*red->getOrCreateStateSet(), osg::Vec3f(0.8f, 0.1f, 0.1f));
    lit->addChild(red);
    const osg::ref_ptr<osg::Geode> blue = makeBox(osg::Vec3d(-0.2, 0.8, 0), osg::Vec3d(2.4, 1.2, 1.0));
    Material::setLambert(*blue->getOrCreateStateSet(), osg::Vec3f(0.1f, 0.2f, 0.8f));
    lit->addChild(blue);
    const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(0.9, -0.6, 0.6), 0.6, 96);
    Material::setCookTorrance(*ball->getOrCreateStateSet(), osg::Vec3f(0.95f, 0.8f, 0.5f), 1.0f, roughness);
    lit->addChild(ball);
    return lit;
}

void look(SceneRenderer& renderer)
{
    renderer.lookAt(osg::Vec3d(0.5, -6, 2.6), osg::Vec3d(0.2, 0, 0.3));
}

}  // namespace

// Beside full light transport: what is shown in place of black leaves at most .8 of the error [specular.md 9]. Measured below.
TEST(Reflections, ShowTheSceneWhereItHidesTheMap)
{
    for (const float roughness : {0.03f, 0.2f, 0.35f}) {
        SceneRenderer renderer(128, 96);
        look(renderer);
        osg::ref_ptr<LitScene> lit = makeScene(roughness);
        const Picture shown = renderer.render(lit);
        lit->getSettings()->reflections = Settings::REFLECTIONS_MAP;
        const Picture black = renderer.render(lit);
        const Picture truth = tracedView(*lit, renderer, 256, {Layer::BEAUTY}, false, ReferenceOptions::FULL).mean(Layer::BEAUTY);
        const Mask mask = Mask::geometry(truth) & Mask::geometry(shown);
        const double with = osgEnvLight::compare(shown, truth, mask).tRmse,
                     without = osgEnvLight::compare(black, truth, mask).tRmse;
        EXPECT_GT(without, 0.03) << roughness << ": there is something to show";
        EXPECT_LT(with, 0.8 * without) << "roughness " << roughness << ": " << with << " of " << without;
    }
}

// A mirror with Phong's lobe shows a glowing wall times the cosine to the eye, whether the wall is an area light or not.
TEST(Reflections, PhongsMirrorShowsTheCosineOfAWall)
{
    SceneRenderer renderer(64, 64);
    for (const Material::LightMode mode : {Material::LIGHT_OFF, Material::LIGHT_ON})
        for (const double height : {1.0, 2.0, 5.0}) {
            const osg::ref_ptr<LitScene> lit = makeLit(constantMap(0.01).get());
            lit->getSettings()->regeneration = Settings::IMMEDIATE;
            lit->addChild(makeQuad(osg::Vec3d(-4, -6, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 6, 0)));
            Material::setPhong(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(), osg::Vec3f(0.5f, 0.5f, 0.5f), 1e4f);
            lit->addChild(makeQuad(osg::Vec3d(-4, 0, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 0, 6)));
            osg::StateSet& wall = *lit->getChild(1)->getOrCreateStateSet();
            Material::setLambert(wall, osg::Vec3f());
            Material::setEmission(wall, osg::Vec3f(1, 1, 1));
            Material::setLight(wall, mode);
            renderer.lookAt(osg::Vec3d(0, -6, height), osg::Vec3d(0, -1, 0), osg::Vec3d(0, 0, 1), 30.0);
            const Picture p = renderer.render(lit);
            const osg::Vec2d floor = renderer.pixelOf(osg::Vec3d(0, -1, 0));
            const osg::Vec2d lamp = renderer.pixelOf(osg::Vec3d(0, 0, 0.1));
            const double shown = p.color(int(floor.x()), int(floor.y()))[1], sent = p.color(int(lamp.x()), int(lamp.y()))[1];
            EXPECT_GT(sent, 0.1);
            EXPECT_NEAR(0.5 * height / std::hypot(5.0, height), shown / sent, 0.01) << mode << " " << height;
        }
}

// The scene's indirect light without the rays, for presets that save them. tRMSE, measured: .20 without, .072 with probes,
// .14 with the mean.
TEST(Reflections, IndirectLightAloneStandsForTheScene)
{
    SceneRenderer renderer(128, 96);
    look(renderer);
    osg::ref_ptr<LitScene> lit = makeScene(0.2f);
    const Picture truth = tracedView(*lit, renderer, 256, {Layer::BEAUTY}, false, ReferenceOptions::FULL).mean(Layer::BEAUTY);
    lit->getSettings()->reflections = Settings::REFLECTIONS_MAP;
    const double without = osgEnvLight::compare(renderer.render(lit), truth, Mask::geometry(truth)).tRmse;
    lit->getSettings()->reflections = Settings::REFLECTIONS_INDIRECT;
    for (const int bounce : {Settings::BOUNCE_PROBES, Settings::BOUNCE_MEAN}) {
        lit->getSettings()->bounce = bounce;
        const double with = osgEnvLight::compare(renderer.render(lit), truth, Mask::geometry(truth)).tRmse;
        EXPECT_LT(with, 0.8 * without) << "bounce " << bounce << ": " << with << " of " << without;
        EXPECT_FALSE(lit->plan().runs("reflections"));
    }
}

// A sun's highlight on one metal ball, which rays from the next meet or miss: pixels that are bright beside their neighbours.
TEST(Reflections, ASunInANeighbourLeavesNoSquares)
{
    SceneRenderer renderer(160, 160);
    renderer.lookAt(osg::Vec3d(0, -6, 0), osg::Vec3d());
    const osg::ref_ptr<LitScene> lit = makeLit(nullptr);
    std::string error;
    ASSERT_TRUE(lit->getEnvironmentMap()->load("sky", nullptr, error)) << error;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    for (int x = -1; x <= 1; ++x)
        for (int z = -1; z <= 1; ++z) {
            const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(1.1 * x, 0, 1.1 * z), 0.5, 96);
            Material::setCookTorrance(*ball->getOrCreateStateSet(), osg::Vec3f(0.9f, 0.65f, 0.35f), 1.0f, 0.3f);
            lit->addChild(ball);
        }
    const Picture shown = renderer.render(lit);
    lit->getSettings()->reflections = Settings::REFLECTIONS_MAP;
    const Picture black = renderer.render(lit);
    const auto added = [&](int x, int y) { return shown.color(x, y)[1] - black.color(x, y)[1]; };
    double worst = 0.0;
    for (int y = 4; y < 156; ++y)
        for (int x = 4; x < 156; ++x) {
            std::vector<double> about;
            for (int i = -4; i <= 4; ++i)
                for (int j = -4; j <= 4; ++j)
                    if (shown.alpha(x + i, y + j) > 0.5f) about.push_back(added(x + i, y + j));
            if (about.size() < 81) continue;
            // A square of 4 x 4 is a fifth of 9 x 9. If it is alone, three quarters are darker than it.
            std::nth_element(about.begin(), about.begin() + 60, about.end());
            worst = std::max(worst, added(x, y) - about[60]);
        }
    // Measured: 1.79; without cones and a limit to the brightest ray 3.29.
    EXPECT_LT(worst, 2.2);
}

// A black floor with a coat: what it mirrors is all that there is to see of it.
TEST(Reflections, ACoatShowsTheScene)
{
    for (const float roughness : {0.0f, 0.2f}) {
        SceneRenderer renderer(128, 96);
        look(renderer);
        const osg::ref_ptr<LitScene> lit = makeScene(0.5f);
        osg::StateSet& floor = *lit->getChild(0)->getStateSet();
        Material::setCookTorrance(floor, osg::Vec3f(), 0.0f, 1.0f);
        Material::setDielectric(floor, 1.0f);
        Material::setCoat(floor, 1.0f, roughness);
        lit->removeChild(3);
        const Picture shown = renderer.render(lit);
        lit->getSettings()->reflections = Settings::REFLECTIONS_MAP;
        const Picture black = renderer.render(lit);
        const Picture truth = tracedView(*lit, renderer, 256, {Layer::BEAUTY}, false, ReferenceOptions::FULL).mean(Layer::BEAUTY);
        // The floor before the boxes, where it mirrors them.
        double with = 0.0, without = 0.0, sum = 0.0;
        for (int y = 20; y < 40; ++y)
            for (int x = 20; x < 110; ++x) {
                with += std::abs(shown.color(x, y)[2] - truth.color(x, y)[2]);
                without += std::abs(black.color(x, y)[2] - truth.color(x, y)[2]);
                sum += truth.color(x, y)[2];
            }
        EXPECT_GT(without, 0.05 * sum) << roughness << ": there is something to show";
        EXPECT_LT(with, 0.5 * without) << "roughness " << roughness << ": " << with / sum << " of " << without / sum;
    }
}

TEST(Reflections, NothingTrailsBehindACut)
{
    SceneRenderer renderer(64, 48);
    look(renderer);
    const Picture fresh = renderer.render(makeScene(0.2f));
    const osg::ref_ptr<LitScene> lit = makeScene(0.2f);
    renderer.lookAt(osg::Vec3d(-5, -3, 2), osg::Vec3d());
    renderer.render(lit, 3);
    look(renderer);
    EXPECT_EQ(0.0, largestDifference(fresh, renderer.render(lit)));
}

TEST(Reflections, OffHidesNothingAndTracesNothing)
{
    SceneRenderer renderer(64, 48);
    look(renderer);
    const osg::ref_ptr<LitScene> lit = makeScene(0.2f);
    lit->getSettings()->view = Settings::SPECULAR;
    lit->getSettings()->reflections = Settings::REFLECTIONS_OFF;
    const Picture off = renderer.render(lit);
    EXPECT_FALSE(lit->plan().runs("reflections"));
    lit->getSettings()->reflections = Settings::REFLECTIONS_MAP;
    const Picture map = renderer.render(lit);
    lit->getSettings()->visibility = Settings::VISIBILITY_NONE;
    EXPECT_EQ(0.0, largestDifference(off, renderer.render(lit)));
    EXPECT_GT(largestDifference(off, map), 0.1);
}

TEST(Reflections, AreNotTracedWhereNothingIsGlossy)
{
    SceneRenderer renderer(32, 32);
    renderer.lookAt(osg::Vec3d(0, -6, 2), osg::Vec3d());
    osg::ref_ptr<LitScene> lit = makeLit(lopsidedMap().get());
    lit->addChild(makeSphere(osg::Vec3d(), 1.0, 32));
    renderer.render(lit, 2);
    for (const char* pass : {"specular", "loberows", "lobes", "reflections", "reflectionfilter"}) {
        EXPECT_FALSE(lit->plan().runs(pass));
        EXPECT_EQ("no glossy surface in view", lit->plan().reason(pass)) << pass;
    }
}

}  // namespace Reflections_test
