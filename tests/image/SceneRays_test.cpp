// SPDX-License-Identifier: MIT
// Mirrors show what is behind the eye, or hidden from it.
#include <SceneRenderer.h>

#include <metrics/Mask>
#include <metrics/Metrics>
#include <osgEnvLight/AreaLight>
#include <osgEnvLight/Material>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "TracedView.h"

namespace SceneRays_test
{

using osgEnvLight::Layer;
using osgEnvLight::LitScene;
using osgEnvLight::Mask;
using osgEnvLight::Material;
using osgEnvLight::ReferenceOptions;
using osgEnvLight::Settings;

namespace
{

osg::ref_ptr<LitScene> makeScene(osg::Image* map)
{
    const osg::ref_ptr<LitScene> lit = makeLit(map);
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->bounce = Settings::BOUNCE_PROBES;
    return lit;
}

osg::StateSet& addWall(LitScene& lit, const osg::Vec3d& corner, const osg::Vec3d& across, const osg::Vec3d& up)
{
    const osg::ref_ptr<osg::Geode> wall = makeQuad(corner, across, up);
    lit.addChild(wall);
    return *wall->getOrCreateStateSet();
}

// Upright, facing -y.
void addMirror(LitScene& lit, float roughness)
{
    osg::StateSet& mirror = addWall(lit, osg::Vec3d(-3, 0, -3), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 0, 6));
    Material::setCookTorrance(mirror, osg::Vec3f(1, 1, 1), 1.0f, roughness);
}

// Behind the eye, facing it: one half each side of x = 0.
void addWallsBehindTheEye(LitScene& lit, bool glow)
{
    for (const bool right : {false, true}) {
        osg::StateSet& wall = addWall(lit, osg::Vec3d(right ? 6 : 0, -8, -5), osg::Vec3d(-6, 0, 0), osg::Vec3d(0, 0, 10));
        const osg::Vec3f color = right ? osg::Vec3f(0.1f, 0.2f, 0.8f) : osg::Vec3f(0.8f, 0.2f, 0.1f);
        Material::setLambert(wall, glow ? osg::Vec3f() : color);
        if (!glow) continue;
        Material::setEmission(wall, color);
        Material::setLight(wall, Material::LIGHT_OFF);
    }
}

void lookIntoMirror(SceneRenderer& renderer)
{
    renderer.lookAt(osg::Vec3d(0, -4, 0.5), osg::Vec3d(0, 0, 0.5), osg::Vec3d(0, 0, 1), 50.0);
}

void addMirrorFloor(LitScene& lit)
{
    osg::StateSet& floor = addWall(lit, osg::Vec3d(-3, -3, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 6, 0));
    Material::setCookTorrance(floor, osg::Vec3f(1, 1, 1), 1.0f, 0.0f);
}

// Behind the picture's upper edge, when one looks onto the floor.
void addDarkPost(LitScene& lit)
{
    const osg::ref_ptr<osg::Geode> post = makeBox(osg::Vec3d(-0.2, 1.0, 0.0), osg::Vec3d(0.2, 1.4, 4.0));
    Material::setLambert(*post->getOrCreateStateSet(), osg::Vec3f(0.05f, 0.05f, 0.05f));
    lit.addChild(post);
}

void lookOntoFloor(SceneRenderer& renderer)
{
    renderer.lookAt(osg::Vec3d(0, -4, 2), osg::Vec3d(0, -1, 0), osg::Vec3d(0, 0, 1), 30.0);
}

double errorOf(LitScene& lit, SceneRenderer& renderer, int reflections, const Picture& truth)
{
    lit.getSettings()->reflections = reflections;
    return osgEnvLight::compare(renderer.render(&lit), truth, Mask::geometry(truth)).tRmse;
}

}  // namespace

// What is at (x, y, z) is seen at (x, -y, z): in the mirror that is where the wall's halves have to be, as bright as without it.
TEST(SceneRays, AMirrorShowsWhatGlowsBehindTheEye)
{
    const osg::ref_ptr<LitScene> lit = makeScene(constantMap(0.01).get());
    addMirror(*lit, 0.0f);
    addWallsBehindTheEye(*lit, true);
    SceneRenderer renderer(96, 96);
    lookIntoMirror(renderer);
    std::vector<osg::Vec2d> places;
    for (const double x : {-1.5, -0.2, 0.2, 1.5}) places.push_back(renderer.pixelOf(osg::Vec3d(x, 8, 0.5)));
    const Picture mirrored = renderer.render(lit);
    renderer.lookAt(osg::Vec3d(0, -4, 0.5), osg::Vec3d(0, -8, 0.5), osg::Vec3d(0, 0, 1), 60.0);
    const Picture direct = renderer.render(lit);
    for (size_t i = 0; i < places.size(); ++i) {
        const bool right = i >= 2;
        const osg::Vec2d wall = renderer.pixelOf(osg::Vec3d(right ? 1.0 : -1.0, -8, 0.5));
        for (int c = 0; c < 3; ++c) {
            const double sent = direct.color(int(wall.x()), int(wall.y()))[c];
            EXPECT_NEAR(sent, mirrored.color(int(places[i].x()), int(places[i].y()))[c], 0.02 * sent + 0.002)
                << "place " << i << " channel " << c;
        }
    }
}

// Beside full light transport. tRMSE at these roughnesses, measured: with rays .044, .055, .023, without .198, .109, .043.
TEST(SceneRays, LobesShowLitWallsBehindTheEye)
{
    for (const float roughness : {0.03f, 0.2f, 0.35f}) {
        const osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
        addMirror(*lit, roughness);
        addWallsBehindTheEye(*lit, false);
        SceneRenderer renderer(64, 64);
        lookIntoMirror(renderer);
        const Picture truth = tracedView(*lit, renderer, 128, {Layer::BEAUTY}, false, ReferenceOptions::FULL).mean(Layer::BEAUTY);
        const double without = errorOf(*lit, renderer, Settings::REFLECTIONS_SCREEN, truth),
                     with = errorOf(*lit, renderer, Settings::REFLECTIONS_SCENE, truth);
        EXPECT_LT(with, 0.6 * without) << "roughness " << roughness << ": " << with << " of " << without;
    }
}

// A black floor sends only what it mirrors, little as that is. tRMSE beside full light transport, measured: .070 with rays, .098
// without.
TEST(SceneRays, ABlackPolishedFloorShowsAPostBeyondThePicture)
{
    const osg::ref_ptr<LitScene> lit = makeScene(constantMap(1.0).get());
    Material::setCookTorrance(addWall(*lit, osg::Vec3d(-3, -3, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 6, 0)), osg::Vec3f(), 0.0f,
                              0.15f);
    addDarkPost(*lit);
    SceneRenderer renderer(64, 64);
    lookOntoFloor(renderer);
    const Picture truth = tracedView(*lit, renderer, 256, {Layer::BEAUTY}, false, ReferenceOptions::FULL).mean(Layer::BEAUTY);
    const double without = errorOf(*lit, renderer, Settings::REFLECTIONS_SCREEN, truth),
                 with = errorOf(*lit, renderer, Settings::REFLECTIONS_SCENE, truth);
    EXPECT_LT(with, 0.8 * without) << with << " of " << without;
}

// A mirror floor shows the map up to the outline of a post that the picture does not show: as bright as without the post.
TEST(SceneRays, AMirrorShowsTheMapUpToAnOutline)
{
    const osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    addMirrorFloor(*lit);
    SceneRenderer renderer(96, 96);
    lookOntoFloor(renderer);
    const Picture alone = renderer.render(lit);
    addDarkPost(*lit);
    const Picture beside = renderer.render(lit, 16);  // what is new joins what stands still after some frames
    lit->getSettings()->reflections = Settings::REFLECTIONS_SCREEN;
    const Picture blurred = renderer.render(lit);
    double worst = 0.0, worstBlurred = 0.0;
    for (const double x : {-0.4, -0.3, 0.3, 0.4})
        for (const double z : {1.2, 1.5, 1.8, 2.1}) {
            const osg::Vec2d p = renderer.pixelOf(osg::Vec3d(x, 1.0, -z));
            const double map = alone.color(int(p.x()), int(p.y()))[1];
            ASSERT_GT(map, 0.05);
            worst = std::max(worst, std::abs(beside.color(int(p.x()), int(p.y()))[1] / map - 1.0));
            worstBlurred = std::max(worstBlurred, std::abs(blurred.color(int(p.x()), int(p.y()))[1] / map - 1.0));
        }
    EXPECT_LT(worst, 0.005) << "half floats; measured .0005";
    EXPECT_GT(worstBlurred, 0.1) << "lights about it alone take up to a third";
    const osg::Vec2d p = renderer.pixelOf(osg::Vec3d(0, 1.0, -1.5));
    EXPECT_LT(beside.color(int(p.x()), int(p.y()))[1], 0.2 * alone.color(int(p.x()), int(p.y()))[1]) << "the post is dark";
}

// A post that comes into a scene at run time joins what stands still after some frames. Until rays meet it, lights say what it
// hides.
TEST(SceneRays, NoMirrorShowsTheMapThroughWhatHasJustCome)
{
    const osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    Settings& s = *lit->getSettings();
    addMirrorFloor(*lit);
    SceneRenderer renderer(96, 96);
    lookOntoFloor(renderer);
    const osg::Vec2d p = renderer.pixelOf(osg::Vec3d(0, 1.0, -1.5));
    const double map = renderer.render(lit).color(int(p.x()), int(p.y()))[1];
    s.regeneration = Settings::BACKGROUND;
    s.atlasUpdatesPerFrame = s.atlasLights;
    addDarkPost(*lit);
    renderer.render(lit);
    for (int frame = 1; frame < 24; ++frame)
        EXPECT_LT(renderer.render(lit).color(int(p.x()), int(p.y()))[1], 0.8 * map) << "frame " << frame;
}

// At night, in a room without windows: metals and coats show what lamps light. tRMSE, measured: .02 to
// .07; black mirrors would err by about 1.
TEST(SceneRays, UnderABlackMapMirrorsShowWhatLampsLight)
{
    for (const float roughness : {0.03f, 0.3f})
        for (const bool coated : {false, true}) {
            const osg::ref_ptr<LitScene> lit = makeScene(constantMap(0.0).get());
            addMirror(*lit, roughness);
            if (coated) {
                osg::StateSet& mirror = *lit->getChild(0)->getStateSet();
                Material::setCookTorrance(mirror, osg::Vec3f(0.02f, 0.02f, 0.02f), 0.0f, 0.5f);
                Material::setCoat(mirror, 1.0f, roughness);
            }
            addWallsBehindTheEye(*lit, false);
            const osg::ref_ptr<osgEnvLight::AreaLight> lamp = new osgEnvLight::AreaLight;
            lamp->setSphere(osg::Vec3d(0, -5, 4.5), 0.3);
            lamp->setRadiance(osg::Vec3f(40, 40, 40));
            lit->addChild(lamp);
            SceneRenderer renderer(64, 64);
            lookIntoMirror(renderer);
            const Picture shown = renderer.render(lit);
            const Picture truth =
                tracedView(*lit, renderer, 256, {Layer::BEAUTY}, false, ReferenceOptions::FULL).mean(Layer::BEAUTY);
            EXPECT_LT(osgEnvLight::compare(shown, truth, Mask::geometry(truth)).tRmse, 0.1)
                << "roughness " << roughness << ", coated " << coated;
            for (const char* pass : {"specular", "diffuse"}) EXPECT_EQ(pass == std::string("diffuse"), lit->plan().runs(pass));
        }
}

// A floor that is polished, or painted over, while the program runs.
TEST(SceneRays, FollowAPolishThatChanges)
{
    const osg::ref_ptr<LitScene> lit = makeScene(constantMap(1.0).get());
    addMirror(*lit, 0.0f);
    addWallsBehindTheEye(*lit, false);
    osg::StateSet& mirror = *lit->getChild(0)->getStateSet();
    SceneRenderer renderer(64, 64);
    lookIntoMirror(renderer);
    const Picture polished = renderer.render(lit);
    Material::setLambert(mirror, osg::Vec3f(0.5f, 0.5f, 0.5f));
    const Picture painted = renderer.render(lit, 2);
    EXPECT_GT(largestDifference(polished, painted), 0.1);
    Material::setCookTorrance(mirror, osg::Vec3f(1, 1, 1), 1.0f, 0.0f);
    EXPECT_LT(largestDifference(polished, renderer.render(lit, 2)), 0.01);
    EXPECT_NE(std::string::npos, lit->plan().reason("reflections").find("rays through the scene"))
        << lit->plan().reason("reflections") << "; " << lit->plan().reason("links") << "; " << lit->plan().reason("bounces");
}

}  // namespace SceneRays_test
