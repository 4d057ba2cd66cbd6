// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <osgEnvLight/Material>

#include <osg/ImageSequence>

#include <malloc.h>
#include <algorithm>
#include <thread>

#include "SceneRenderer.h"

namespace Regeneration_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

void fill(osg::Image& map, float radiance)
{
    std::fill_n(reinterpret_cast<float*>(map.data()), map.getTotalSizeInBytes() / sizeof(float), radiance);
    map.dirty();
}

// A white sphere: under a constant map its radiance is the map's, by D alone.
osg::ref_ptr<LitScene> whiteSphere(osg::Image* map)
{
    osg::ref_ptr<LitScene> lit = makeLit(map);
    lit->getSettings()->bounce = Settings::BOUNCE_MEAN;
    lit->getSettings()->atlasLights = 16;  // whose maps are all drawn in the first frame
    lit->addChild(makeSphere(osg::Vec3d(), 1.0));
    osgEnvLight::Material::setLambert(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    return lit;
}

// What is allocated. Not the resident size: the software renderer's threads fragment their arenas, 40 KB a frame.
double liveMegabytes()
{
    const struct mallinfo2 info = mallinfo2();
    return double(info.uordblks + info.hblkhd) / 1048576.0;
}

}  // namespace

TEST(Regeneration, NeverHalfOldAndHalfNewAndSeenOnceReady)
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<osg::Image> map = constantMap(1.0);
    osg::ref_ptr<LitScene> lit = whiteSphere(map.get());
    EXPECT_NEAR(renderer.render(lit, 2).color(16, 16)[0], 1.0, 0.005);
    EXPECT_FALSE(lit->regenerating());
    for (float radiance : {3.0f, 0.5f, 7.0f}) {
        const double old = renderer.render(lit, 1).color(16, 16)[0];
        fill(*map, radiance);
        bool ready = false;
        for (int frame = 0; frame < 2000; ++frame) {
            const Picture p = renderer.render(lit, 1);
            // Object and background of one frame come from one state of the map.
            const double object = p.color(16, 16)[0];
            const double sky = p.color(1, 1)[0];
            EXPECT_NEAR(object, sky, 0.005 * sky);
            const bool isNew = std::abs(sky - double(radiance)) < 0.005 * double(radiance);
            EXPECT_TRUE(isNew || std::abs(sky - old) < 0.005 * old) << sky;
            EXPECT_TRUE(isNew || !ready) << "made before the last frame, and not shown";
            if (isNew) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            ready = !lit->regenerating();
        }
        EXPECT_NEAR(renderer.render(lit, 1).color(16, 16)[0], double(radiance), 0.005 * double(radiance));
    }
}

TEST(Regeneration, NothingOlderThanWhatWasMadeAtOnce)
{
    SceneRenderer renderer(16, 16);
    osg::ref_ptr<osg::Image> map = makeMap(1024, 512, [](const osg::Vec3d&) { return osg::Vec3d(1, 1, 1); });
    osg::ref_ptr<LitScene> lit = whiteSphere(map.get());
    renderer.render(lit, 2);
    fill(*map, 2.0f);
    renderer.render(lit, 1);  // on the thread, which takes a while
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    fill(*map, 3.0f);
    for (int i = 0; i < 100; ++i) {
        EXPECT_NEAR(renderer.render(lit, 1).color(8, 8)[0], 3.0, 0.015) << i;
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
}

TEST(Regeneration, RotationAndIntensityRebuildNothing)
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = whiteSphere(constantMap(1.0).get());
    lit->getSettings()->visibility = Settings::VISIBILITY_SCREEN;  // the shadow maps of a map that turns are drawn again
    renderer.render(lit, 2);
    lit->getEnvironmentMap()->setRotation(33.0);
    lit->getEnvironmentMap()->setIntensity(2.0);
    EXPECT_NEAR(renderer.render(lit, 1).color(16, 16)[0], 2.0, 0.01);
    EXPECT_FALSE(lit->regenerating());
}

// A quarter of the shadow maps stand for all of them in the first frame; the others come map by map, and none of them shows.
TEST(Regeneration, TheFirstFrameIsNearlyTheOneWithAllShadowMaps)
{
    SceneRenderer renderer(96, 96);
    renderer.lookAt(osg::Vec3d(3, -6, 4), osg::Vec3d(0, 0, 0.5));
    const osg::ref_ptr<LitScene> lit = makeLit(lopsidedMap().get());
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    lit->addChild(makeQuad(osg::Vec3d(-3, -3, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 6, 0)));
    for (const double x : {-1.2, 0.0, 1.2}) lit->addChild(makeBox(osg::Vec3d(x, -1, 0), osg::Vec3d(x + 0.5, 1, 1.4)));
    std::vector<Picture> frames;
    do {
        frames.push_back(renderer.render(lit, 1));
    } while (lit->regenerating() && frames.size() < 100);
    EXPECT_EQ(13u, frames.size());  // 64 maps, then 16 a frame
    const Picture settled = renderer.render(lit, 1);
    lit->getSettings()->occlusion = false;
    const double shadows = rootMeanSquare(settled, renderer.render(lit, 1));
    // Of what the shadows are. Measured: .11 in the first, .07 at most from one frame to the next; a white floor has 30 times
    // that.
    EXPECT_LT(rootMeanSquare(settled, frames.front()), 0.13 * shadows);
    for (size_t i = 1; i < frames.size(); ++i) EXPECT_LT(rootMeanSquare(frames[i - 1], frames[i]), 0.09 * shadows) << i;
}

TEST(Regeneration, AnotherImageAndBack)
{
    // The address of a freed image may come back with the same modified count: still another image.
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = whiteSphere(constantMap(1.0).get());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    renderer.render(lit, 1);
    for (int i = 0; i < 20; ++i) {
        lit->getEnvironmentMap()->setImage(constantMap(1.0 + i).get());
        EXPECT_NEAR(renderer.render(lit, 1).color(16, 16)[0], 1.0 + i, 0.01 * (1.0 + i));
    }
}

TEST(Regeneration, AMapThatCannotServeIsSaidAndTheNextOneIsSeen)
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = whiteSphere(constantMap(1.0).get());
    renderer.render(lit, 2);
    NotifyCatcher notify;
    osg::ref_ptr<osg::Image> wrong = new osg::Image;
    wrong->allocateImage(30, 7, 1, GL_RGB, GL_FLOAT);
    lit->getEnvironmentMap()->setImage(wrong.get());
    for (int i = 0; i < 1000 && (i < 2 || lit->regenerating()); ++i) renderer.render(lit, 1);
    renderer.render(lit, 1);
    EXPECT_NE(notify.text().find("30x7"), std::string::npos) << notify.text();
    lit->getEnvironmentMap()->setImage(constantMap(4.0).get());
    EXPECT_NEAR(renderer.render(lit, 2).color(16, 16)[0], 4.0, 0.02);  // there is no older light to show meanwhile
}

TEST(Regeneration, AThousandMapsLeaveNoMemoryBehind)
{
    SceneRenderer renderer(16, 16);
    osg::ref_ptr<osg::Image> map = constantMap(1.0);
    osg::ref_ptr<LitScene> lit = whiteSphere(map.get());
    double before = 0.0;
    for (int i = 0; i < 1000; ++i) {
        if (i % 50 == 0) lit->getEnvironmentMap()->setImage((map = constantMap(1.0)).get());
        fill(*map, 1.0f + float(i % 7));
        renderer.render(lit, 1);
        if (i == 300) before = liveMegabytes();  // pools are filled by then
    }
    for (int i = 0; i < 1000 && lit->regenerating(); ++i) renderer.render(lit, 1);
    // A map of this size takes .6 MB with all that is made of it: 700 left behind would be 400 MB. What is being
    // made or waits to be deleted by the draw thread varies by some MB.
    EXPECT_LT(liveMegabytes() - before, 16.0);
    EXPECT_NEAR(renderer.render(lit, 1).color(8, 8)[0], 1.0 + 999 % 7, 0.01 * (1.0 + 999 % 7));
    EXPECT_EQ(lit->numViews(), 1u);
}

TEST(Regeneration, GoneWhileItIsMade)
{
    SceneRenderer renderer(16, 16);
    for (int i = 0; i < 20; ++i) {
        osg::ref_ptr<osg::Image> map = constantMap(1.0);
        osg::ref_ptr<LitScene> lit = whiteSphere(map.get());
        lit->getSettings()->atlasLights = 16;  // what is gone is the map's, not its shadows
        renderer.render(lit, 1);
        fill(*map, 2.0f);
        renderer.render(lit, 1);
        renderer.viewer().setSceneData(nullptr);
    }
}

TEST(Regeneration, ASequenceOfImagesPlays)
{
    SceneRenderer renderer(16, 16);
    osg::ref_ptr<osg::ImageSequence> sequence = new osg::ImageSequence;
    for (int i = 0; i < 4; ++i) sequence->addImage(constantMap(1.0 + i).get());
    sequence->setLength(4.0);
    sequence->play();
    osg::ref_ptr<LitScene> lit = whiteSphere(sequence.get());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    double lowest = 1e9;
    double highest = 0.0;
    for (int i = 0; i < 300; ++i) {
        const double l = renderer.render(lit, 1).color(8, 8)[0];
        lowest = std::min(lowest, l);
        highest = std::max(highest, l);
    }
    EXPECT_LT(lowest, 2.5);
    EXPECT_GT(highest, lowest + 0.9);
}

TEST(Regeneration, UpdatesAreAskedForOnlyWhileASequencePlays)
{
    SceneRenderer renderer(16, 16);
    osg::ref_ptr<LitScene> lit = whiteSphere(constantMap(1.0).get());
    const auto renderUntilQuiet = [&] {
        for (int frame = 0; frame < 2000 && lit->getNumChildrenRequiringUpdateTraversal() > 0; ++frame) {
            renderer.render(lit, 1);  // until it has been made into light
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    };
    renderer.render(lit, 2);
    renderUntilQuiet();
    EXPECT_EQ(lit->getNumChildrenRequiringUpdateTraversal(), 0u);  // a viewer on demand would draw for ever
    osg::ref_ptr<osg::ImageSequence> sequence = new osg::ImageSequence;
    sequence->addImage(constantMap(1.0).get());
    sequence->addImage(constantMap(2.0).get());
    sequence->play();
    lit->getEnvironmentMap()->setImage(sequence.get());
    renderer.render(lit, 2);
    EXPECT_EQ(lit->getNumChildrenRequiringUpdateTraversal(), 1u);
    lit->getEnvironmentMap()->setImage(constantMap(1.0).get());
    renderUntilQuiet();
    EXPECT_EQ(lit->getNumChildrenRequiringUpdateTraversal(), 0u);
}

}  // namespace Regeneration_test
