// SPDX-License-Identifier: MIT
// A viewer that draws on demand draws until the light has settled, and no longer.
#include <OnScreen.h>
#include <SceneRenderer.h>

#include <osg/MatrixTransform>
#include <osgViewer/CompositeViewer>

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace OnDemand_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;
using V = osgViewer::ViewerBase;

namespace
{

const int trailing = 2;  // frames more than are needed

osg::ref_ptr<LitScene> makeScene(osg::Image* map)
{
    osg::ref_ptr<LitScene> lit = new LitScene(map);
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->atlasLights = 16;
    lit->getSettings()->atlasSize = 32;
    lit->getSettings()->sunShadowSize = 64;
    lit->getSettings()->accumulateSize = 32;
    lit->getSettings()->exposureBase = Settings::EXPOSURE_MAP;  // a change of what is shown takes no time
    lit->getSettings()->bounce = Settings::BOUNCE_MEAN;         // frames are counted: of probes a thread says how many
    lit->addChild(makeQuad(osg::Vec3d(-2, -2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    osg::ref_ptr<osg::MatrixTransform> box = new osg::MatrixTransform;
    box->addChild(makeBox(osg::Vec3d(-0.5, -0.5, 0), osg::Vec3d(0.5, 0.5, 1)));
    lit->addChild(box);
    return lit;
}

void move(LitScene& lit, double x)
{
    static_cast<osg::MatrixTransform*>(lit.getChild(1))->setMatrix(osg::Matrixd::translate(x, 0, 0));
}

// One turn of the viewer's own loop: whether it drew.
bool turn(V& viewer)
{
    if (!viewer.checkNeedToDoFrame()) return false;
    viewer.frame();
    return true;
}

// Frames that it draws until none is asked for; then none is, however often it looks.
int framesUntilQuiet(V& viewer)
{
    int frames = 0;
    const int most = 3000;
    while (frames < most && turn(viewer)) ++frames;
    EXPECT_LT(frames, most) << "it draws for ever";
    for (int i = 0; i < 20 && frames < most; ++i) EXPECT_FALSE(turn(viewer));
    return frames;
}

// Waits for some frames, then moves its node and is done.
class MovesOnce : public osg::NodeCallback
{
  public:
    void operator()(osg::Node* node, osg::NodeVisitor*) override
    {
        if (++_frames < 12) return;
        static_cast<osg::MatrixTransform*>(node)->setMatrix(osg::Matrixd::translate(0.3, 0, 0));
        node->setUpdateCallback(nullptr);
    }

  private:
    int _frames = 0;
};

class OnDemand : public testing::TestWithParam<OnScreen::Threading>
{
  protected:
    void SetUp() override
    {
        if (!std::getenv("DISPLAY")) GTEST_SKIP() << "needs a display; tests/run starts one";
    }
    // Shown by a viewer that has come to rest.
    std::unique_ptr<OnScreen> show(LitScene& lit)
    {
        auto screen = std::make_unique<OnScreen>(&lit, GetParam());
        screen->viewer().setRunFrameScheme(V::ON_DEMAND);
        framesUntilQuiet(screen->viewer());
        return screen;
    }
};

INSTANTIATE_TEST_SUITE_P(Threading, OnDemand,
                         testing::Values(V::SingleThreaded, V::CullDrawThreadPerContext, V::DrawThreadPerContext,
                                         V::CullThreadPerCameraDrawThreadPerContext));

}  // namespace

TEST_P(OnDemand, AMovedCasterIsFollowedUntilItsShadowsAre)
{
    osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    const std::unique_ptr<OnScreen> screen = show(*lit);
    EXPECT_FALSE(lit->regenerating());
    // A frame draws maps of all lights, or of four.
    for (const auto& [regeneration, needed] : {std::pair(Settings::IMMEDIATE, 1), std::pair(Settings::BACKGROUND, 4)}) {
        lit->getSettings()->regeneration = regeneration;
        lit->getSettings()->atlasUpdatesPerFrame = 4;
        screen->viewer().requestRedraw();
        framesUntilQuiet(screen->viewer());
        for (int i = 1; i <= 5; ++i) {
            move(*lit, 0.1 * i);
            screen->viewer().requestRedraw();
            const int frames = framesUntilQuiet(screen->viewer());
            EXPECT_GE(frames, needed);
            EXPECT_LE(frames, needed + trailing);
            EXPECT_FALSE(lit->regenerating());
        }
    }
}

// The application's next change may come with what would be the last frame.
TEST_P(OnDemand, ChangesAtAnyFrameAreFollowed)
{
    osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    lit->getSettings()->atlasUpdatesPerFrame = 4;
    const std::unique_ptr<OnScreen> screen = show(*lit);
    for (int after = 1; after < 8; ++after) {
        move(*lit, 0.3);
        screen->viewer().requestRedraw();
        for (int i = 0; i < after; ++i) turn(screen->viewer());
        move(*lit, 0.0);
        screen->viewer().requestRedraw();
        EXPECT_GE(framesUntilQuiet(screen->viewer()), 4) << "after " << after;
        EXPECT_FALSE(lit->regenerating());
    }
}

TEST_P(OnDemand, AChangedMapIsShown)
{
    osg::ref_ptr<osg::Image> map = lopsidedMap();
    osg::ref_ptr<LitScene> lit = makeScene(map.get());
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    const std::unique_ptr<OnScreen> screen = show(*lit);
    osg::ref_ptr<osg::Image> before = new osg::Image(screen->draw(1), osg::CopyOp::DEEP_COPY_ALL);
    framesUntilQuiet(screen->viewer());
    float* texels = reinterpret_cast<float*>(map->data());
    for (unsigned i = 0; i < map->getTotalSizeInBytes() / sizeof(float); ++i) texels[i] *= i % 3 ? 0.5f : 2.0f;
    map->dirty();
    screen->viewer().requestRedraw();
    EXPECT_GT(framesUntilQuiet(screen->viewer()), 1);
    EXPECT_FALSE(lit->regenerating());
    EXPECT_GT(largestByteDifference(*before, screen->draw(1)), 20);
    osg::ref_ptr<LitScene> fresh = makeScene(map.get());
    const std::unique_ptr<OnScreen> other = show(*fresh);
    EXPECT_LE(largestByteDifference(screen->draw(1), other->draw(1)), 3);
}

TEST_P(OnDemand, AStillViewConvergesAndRests)
{
    osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    const std::unique_ptr<OnScreen> screen = show(*lit);
    lit->getSettings()->accumulate = true;
    lit->getSettings()->accumulateFrames = 12;
    screen->viewer().requestRedraw();
    const int frames = framesUntilQuiet(screen->viewer());
    EXPECT_EQ(12u, lit->average().frames);
    EXPECT_GE(frames, 13);
    EXPECT_LE(frames, 13 + trailing);
}

TEST_P(OnDemand, EveryWindowOfOneViewerSettles)
{
    osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    lit->getSettings()->atlasUpdatesPerFrame = 4;
    osg::ref_ptr<osgViewer::CompositeViewer> viewer = new osgViewer::CompositeViewer;
    viewer->setThreadingModel(GetParam());
    viewer->setRunFrameScheme(V::ON_DEMAND);
    for (int i = 0; i < 2; ++i) {
        osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
        OnScreen::place(*view->getCamera(), makeContext(OnScreen::width, OnScreen::height).get(), new FrameReader);
        view->setSceneData(lit.get());
        viewer->addView(view.get());
    }
    viewer->realize();
    framesUntilQuiet(*viewer);
    move(*lit, 0.3);
    viewer->getView(0)->requestRedraw();
    const int frames = framesUntilQuiet(*viewer);
    EXPECT_GE(frames, 4);
    EXPECT_LE(frames, 4 + trailing);
}

TEST_P(OnDemand, ARemovedNodeAsksNoMore)
{
    osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    lit->getSettings()->atlasUpdatesPerFrame = 1;
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(lit);
    OnScreen screen(root.get(), GetParam());
    screen.viewer().setRunFrameScheme(V::ON_DEMAND);
    framesUntilQuiet(screen.viewer());
    for (int after = 1; after < 5; ++after) {
        move(*lit, 0.1 * after);
        screen.viewer().requestRedraw();
        for (int i = 0; i < after; ++i) EXPECT_TRUE(turn(screen.viewer()));
        EXPECT_TRUE(lit->regenerating());
        root->removeChild(lit);
        EXPECT_EQ(0u, root->getNumChildrenRequiringUpdateTraversal());
        EXPECT_EQ(0u, root->getNumChildrenRequiringEventTraversal());
        EXPECT_EQ(0, framesUntilQuiet(screen.viewer()));
        root->addChild(lit);
        screen.viewer().requestRedraw();
        framesUntilQuiet(screen.viewer());
        EXPECT_FALSE(lit->regenerating());
    }
}

// A viewer without events of a window: the frames that are needed, one that finds nothing new, and no more.
TEST(OnDemandEmbedded, DrawsOneFrameMoreThanIsNeeded)
{
    SceneRenderer renderer(64, 48);
    osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    lit->getSettings()->atlasUpdatesPerFrame = 4;
    osgViewer::Viewer& viewer = renderer.viewer();
    viewer.setRunFrameScheme(V::ON_DEMAND);
    viewer.setSceneData(lit.get());
    framesUntilQuiet(viewer);
    EXPECT_EQ(0u, lit->getNumChildrenRequiringUpdateTraversal());
    viewer.requestRedraw();
    EXPECT_EQ(2, framesUntilQuiet(viewer));
    move(*lit, 0.3);
    viewer.requestRedraw();
    EXPECT_EQ(5, framesUntilQuiet(viewer));
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->accumulate = true;
    lit->getSettings()->accumulateFrames = 12;
    viewer.requestRedraw();
    EXPECT_EQ(14, framesUntilQuiet(viewer));  // a normal one, which begins it
}

TEST(OnDemandEmbedded, TwoNodesDontKeepEachOtherAwake)
{
    SceneRenderer renderer(64, 48);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    for (int i = 0; i < 2; ++i) {
        osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
        lit->getSettings()->regeneration = Settings::BACKGROUND;
        lit->getSettings()->atlasUpdatesPerFrame = 4 + i;
        root->addChild(lit);
    }
    osgViewer::Viewer& viewer = renderer.viewer();
    viewer.setRunFrameScheme(V::ON_DEMAND);
    viewer.setSceneData(root.get());
    framesUntilQuiet(viewer);
    for (int i = 0; i < 2; ++i) {
        move(static_cast<LitScene&>(*root->getChild(unsigned(i))), 0.3);
        viewer.requestRedraw();
        EXPECT_EQ(5, framesUntilQuiet(viewer));
    }
    EXPECT_EQ(0u, root->getNumChildrenRequiringUpdateTraversal());
}

TEST(OnDemandEmbedded, AnUpdateCallbacksLastFrameIsFollowed)
{
    SceneRenderer renderer(64, 48);
    osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    lit->getSettings()->atlasUpdatesPerFrame = 4;
    osgViewer::Viewer& viewer = renderer.viewer();
    viewer.setRunFrameScheme(V::ON_DEMAND);
    viewer.setSceneData(lit.get());
    framesUntilQuiet(viewer);
    osg::ref_ptr<MovesOnce> callback = new MovesOnce;
    lit->getChild(1)->setUpdateCallback(callback.get());
    EXPECT_EQ(12 + 4, framesUntilQuiet(viewer));
    EXPECT_FALSE(lit->regenerating());
}

TEST(OnDemandEmbedded, DrawsUntilTheExposureHasFollowed)
{
    SceneRenderer renderer(64, 48);
    osg::ref_ptr<LitScene> lit = makeScene(lopsidedMap().get());
    lit->getSettings()->exposureBase = Settings::EXPOSURE_PICTURE;
    lit->getSettings()->adaptationTime = 0.1f;
    osgViewer::Viewer& viewer = renderer.viewer();
    viewer.setRunFrameScheme(V::ON_DEMAND);
    viewer.setSceneData(lit.get());
    framesUntilQuiet(viewer);
    renderer.lookAt(osg::Vec3d(3, 3, 3), osg::Vec3d());
    viewer.requestRedraw();
    const double start = viewer.getFrameStamp()->getReferenceTime();
    framesUntilQuiet(viewer);
    const double seconds = viewer.getFrameStamp()->getReferenceTime() - start;
    EXPECT_GE(seconds, 3.0 * 0.1);
    EXPECT_LE(seconds, 6.0 * 0.1);  // frames that take .1 s each
    EXPECT_FALSE(lit->regenerating());
}

}  // namespace OnDemand_test
