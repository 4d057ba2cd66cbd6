// SPDX-License-Identifier: MIT
// Light between surfaces by points and probes, after a change: it becomes that of a scene which always was as it is now.
#include "ProbeScenes.h"

#include <osg/LightSource>
#include <osg/MatrixTransform>

#include <chrono>
#include <thread>

namespace ProbeChanges_test
{

using namespace probescenes;

// Points learn of the change in turns. The last ones send their new light on, too, though dark surfaces need few bounces.
TEST(Probes, AChangeOfALampReachesAllPoints)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0.2, -0.5, 0.1), osg::Vec3d(0.1, 1, -0.3), osg::Vec3d(0, 0, 1), 70.0);
    renderer.viewer().getCamera()->setProjectionMatrixAsPerspective(70.0, 1.0, 0.05, 100.0);
    for (const float albedo : {0.1f, 0.5f}) {
        const osg::ref_ptr<LitScene> lit = makeProbed(0.0);
        lit->getSettings()->view = Settings::BOUNCED;
        lit->addChild(makeBowl(24, 0.0));
        setAlbedo(*lit, albedo);
        const osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
        lamp->getLight()->setLightNum(1);
        lamp->getLight()->setPosition(osg::Vec4(0, 0, 0, 1));
        lamp->getLight()->setDiffuse(osg::Vec4(1, 1, 1, 1));
        lit->addChild(lamp);
        lit->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        const double bright = figuresOf(renderer.render(lit, 2)).mean;
        EXPECT_GT(bright, 0.0);
        lit->getSettings()->regeneration = Settings::BACKGROUND;
        lamp->getLight()->setDiffuse(osg::Vec4(0.25f, 0.25f, 0.25f, 1));
        int frames = 0;
        do renderer.render(lit);
        while (++frames < 100 && lit->regenerating());
        const double decoded = std::pow((0.25 + 0.055) / 1.055, 2.4);  // of sRGB
        EXPECT_NEAR(1.0, figuresOf(renderer.render(lit)).mean / (bright * decoded), 0.005) << albedo;
    }
}

// Other counts of lights are another atlas, whose casters are counted from the beginning.
TEST(Probes, FollowAnAtlasThatIsReplaced)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    osg::ref_ptr<LitScene> lit = makeProbed();
    lit->addChild(makeQuad(osg::Vec3d(-3, -4, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 4, 0)));
    setAlbedo(*lit, 0.8f);
    renderer.render(lit);
    lit->getSettings()->atlasLights = 128;
    lit->addChild(makeBox(osg::Vec3d(-1, -1, 0.01), osg::Vec3d(1, 0.2, 2)));
    const Picture replaced = renderer.render(lit);
    osg::ref_ptr<LitScene> fresh = makeProbed();
    fresh->getSettings()->atlasLights = 128;
    for (unsigned i = 0; i < 2; ++i) fresh->addChild(lit->getChild(i));
    setAlbedo(*fresh, 0.8f);
    EXPECT_LT(largestDifference(renderer.render(fresh), replaced), 0.005);
}

// A wall colours the floor, and another colour of it does at once.
TEST(Probes, FollowAColourThatChanges)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.3));
    osg::ref_ptr<LitScene> lit = makeProbed();
    lit->getSettings()->view = Settings::BOUNCED;
    lit->addChild(makeQuad(osg::Vec3d(-2, -4, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-2, 0, -0.1), osg::Vec3d(2, 0.2, 4)));
    setAlbedo(*lit->getChild(0), 0.8f);
    osg::StateSet& wall = *lit->getChild(1)->getOrCreateStateSet();
    Material::setLambert(wall, osg::Vec3f(0.8f, 0, 0));
    const Picture red = renderer.render(lit);
    Material::setLambert(wall, osg::Vec3f(0, 0.8f, 0));
    const Picture green = renderer.render(lit);
    const double sent = figuresOf(red, 0).mean;
    EXPECT_GT(sent, 0.01);
    // The wall receives the floor's light, which is white; measured: .23.
    EXPECT_LT(figuresOf(red, 1).mean, 0.25 * sent);
    EXPECT_NEAR(sent, figuresOf(green, 1).mean, 0.1 * sent);
    EXPECT_LT(figuresOf(green, 0).mean, 0.25 * sent);
}

// A floor is polished, and made matt again.
TEST(Probes, FollowAPolishThatChanges)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    const osg::ref_ptr<LitScene> lit = makeProbed();
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    lit->getSettings()->view = Settings::BOUNCED;
    lit->addChild(makeQuad(osg::Vec3d(-3, -4, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-2, 0, -0.1), osg::Vec3d(2, 0.2, 3)));
    setAlbedo(*lit->getChild(1), 0.8f);
    osg::StateSet& floor = *lit->getChild(0)->getOrCreateStateSet();
    const auto settled = [&] {
        for (int i = 0; i < 500 && (renderer.render(lit, 4), lit->regenerating()); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return renderer.render(lit);
    };
    setAlbedo(*lit->getChild(0), 0.8f);
    const Picture matt = settled();
    const size_t mattBytes = lit->textureBytes();
    Material::setPhong(floor, osg::Vec3f(), osg::Vec3f(0.8f, 0.8f, 0.8f), 1000);
    const Picture polished = settled();
    const size_t polishedBytes = lit->textureBytes();
    EXPECT_GT(polishedBytes, mattBytes);
    EXPECT_GT(largestDifference(matt, polished), 0.02);
    const osg::ref_ptr<LitScene> fresh = makeProbed();
    fresh->getSettings()->view = Settings::BOUNCED;
    for (unsigned i = 0; i < 2; ++i) fresh->addChild(lit->getChild(i));
    EXPECT_LT(largestDifference(renderer.render(fresh), polished), 0.005);
    setAlbedo(*lit->getChild(0), 0.8f);
    EXPECT_LT(largestDifference(matt, settled()), 0.005);
    EXPECT_LT(lit->textureBytes(), polishedBytes);
}

// The map is turned, a body moved: after some frames the picture is that of a scene that never was another.
TEST(Probes, ForgetWhatWas)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    const auto make = [](double x) {
        osg::ref_ptr<LitScene> lit = makeProbed();
        lit->addChild(makeQuad(osg::Vec3d(-3, -4, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 4, 0)));
        const osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrix::translate(x, 0, 0));
        moved->addChild(makeBox(osg::Vec3d(-1, -1, 0.01), osg::Vec3d(1, 0.2, 2)));
        lit->addChild(moved);
        setAlbedo(*lit, 0.8f);
        return lit;
    };
    const Picture expected = renderer.render(make(1.0));
    osg::ref_ptr<LitScene> lit = make(-1.0);
    renderer.render(lit);
    static_cast<osg::MatrixTransform*>(lit->getChild(1))->setMatrix(osg::Matrix::translate(1, 0, 0));
    const Picture after = renderer.render(lit, 40);
    EXPECT_LT(largestDifference(expected, after), 0.02);
}

// Without waiting for them the picture begins with the mean, and ends with what it would have been at once.
TEST(Probes, ComeWhenTheyAreMade)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    const auto make = [](int regeneration) {
        osg::ref_ptr<LitScene> lit = makeProbed();
        lit->getSettings()->regeneration = regeneration;
        lit->addChild(makeQuad(osg::Vec3d(-3, -4, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 4, 0)));
        lit->addChild(makeBox(osg::Vec3d(-1, -1, 0.01), osg::Vec3d(1, 0.2, 2)));
        setAlbedo(*lit, 0.8f);
        return lit;
    };
    const Picture expected = renderer.render(make(Settings::IMMEDIATE));
    osg::ref_ptr<LitScene> lit = make(Settings::BACKGROUND);
    renderer.render(lit);
    for (int i = 0; i < 500 && lit->regenerating(); ++i) {
        renderer.render(lit);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_FALSE(lit->regenerating());
    EXPECT_LT(largestDifference(expected, renderer.render(lit)), 0.005);
    const Picture still = renderer.render(lit);
    EXPECT_EQ(0.0, largestDifference(still, renderer.render(lit))) << "then nothing changes";
}

}  // namespace ProbeChanges_test
