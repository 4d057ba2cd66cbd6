// SPDX-License-Identifier: MIT
// Contexts come and go, one after the other and several at once, and the node lights in each of them as a new one would.
#include <OnScreen.h>
#include <Halves.h>
#include <SceneRenderer.h>

#include <osgEnvLight/AreaLight>

#include <osg/GLObjects>
#include <osg/LightSource>
#include <osgViewer/CompositeViewer>

#include <gtest/gtest.h>

namespace Contexts_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

// The built-in sky, whose sun throws a box's shadow on a floor, and a lamp.
osg::ref_ptr<LitScene> makeSunny()
{
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->getSettings()->bounceProbes = fewestProbes;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->atlasLights = 16;
    lit->getSettings()->atlasSize = 64;
    lit->getSettings()->sunShadowSize = 128;
    lit->addChild(makeQuad(osg::Vec3d(-2, -2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-0.5, -0.5, 0), osg::Vec3d(0.5, 0.5, 1)));
    lit->getSettings()->areaPoints = 16;
    lit->getSettings()->areaMapSize = 32;
    const osg::ref_ptr<osgEnvLight::AreaLight> lamp = new osgEnvLight::AreaLight;
    lamp->setImage(makeHalves());
    lamp->setRectangle(osg::Vec3d(-1, -1, 1.5), osg::Vec3d(0.2, 0, 0), osg::Vec3d(0, -0.2, 0));
    lit->addChild(lamp);
    lit->getSettings()->sceneLightMapSize = 32;
    const osg::ref_ptr<osg::LightSource> light = new osg::LightSource;
    light->getLight()->setLightNum(1);
    light->getLight()->setPosition(osg::Vec4(1, -1, 2, 1));
    lit->addChild(light);
    lit->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    return lit;
}

const int settle = 4;  // frames

std::string firstLine(const NotifyCatcher& notify)
{
    return notify.text().substr(0, notify.text().find('\n'));
}

// What a new node shows, with its shadows, in a new viewer.
const osg::Image& expected()
{
    static osg::ref_ptr<osg::Image> image;
    if (!image) {
        osg::ref_ptr<LitScene> lit = makeSunny();
        OnScreen screen(lit.get());
        image = new osg::Image(screen.draw(settle), osg::CopyOp::DEEP_COPY_ALL);
        lit->getSettings()->visibility = Settings::VISIBILITY_NONE;
        EXPECT_GT(largestByteDifference(*image, screen.draw(settle)), 20) << "no shadow to be seen";
    }
    return *image;
}

class Contexts : public testing::Test
{
  protected:
    void SetUp() override
    {
        if (!std::getenv("DISPLAY")) GTEST_SKIP() << "needs a display; tests/run starts one";
        expected();
    }
    // OSG deletes for a few milliseconds a frame.
    static void expectInTheEnd(const GlObjects& objects, OnScreen& screen)
    {
        for (int i = 0; i < 100 && !(screen.objects() == objects); ++i) screen.draw(1);
        EXPECT_EQ(objects, screen.objects());
    }
    static void expectLit(OnScreen& screen) { EXPECT_LE(largestByteDifference(expected(), screen.draw(settle)), 1); }
};

}  // namespace

TEST_F(Contexts, AViewerThatIsMadeAnewShowsTheSame)
{
    using V = osgViewer::ViewerBase;
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeSunny();
    lit->setTimed(true);
    for (auto threading :
         {V::SingleThreaded, V::CullDrawThreadPerContext, V::DrawThreadPerContext, V::CullThreadPerCameraDrawThreadPerContext}) {
        OnScreen screen(lit.get(), threading);
        expectLit(screen);
        EXPECT_EQ(1u, lit->numViews());
    }
    EXPECT_EQ(0u, lit->numViews());  // nothing of a dead viewer is kept
    EXPECT_EQ("", firstLine(notify));
}

TEST_F(Contexts, AWindowThatIsClosedAndOpenedAgainShowsTheSame)
{
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeSunny();
    OnScreen screen(lit.get());
    for (int i = 0; i < 3; ++i) {
        expectLit(screen);
        EXPECT_EQ(1u, lit->numViews());
        screen.reopen();
    }
    EXPECT_EQ("", firstLine(notify));
}

TEST_F(Contexts, ANodeThatIsOutOfTheGraphWhileItsContextClosesStartsAnew)
{
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeSunny(), other = makeSunny();
    {
        OnScreen screen(lit.get());
        expectLit(screen);
        screen.viewer().setSceneData(nullptr);
    }
    OnScreen screen(other.get());  // its objects have the names that the first one's had
    expectLit(screen);
    osg::ref_ptr<osg::Group> both = new osg::Group;
    screen.viewer().setSceneData(lit.get());
    expectLit(screen);
    screen.viewer().setSceneData(other.get());
    expectLit(screen);
    EXPECT_EQ("", firstLine(notify));
}

TEST_F(Contexts, TwoViewersAtOnceShowTheSame)
{
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeSunny();
    OnScreen first(lit.get());
    expectLit(first);
    {
        OnScreen second(lit.get());
        for (int i = 0; i < 3; ++i) {
            expectLit(second);
            expectLit(first);
        }
        EXPECT_EQ(2u, lit->numViews());
    }
    expectLit(first);
    EXPECT_EQ(1u, lit->numViews());
    EXPECT_EQ("", firstLine(notify));
}

TEST_F(Contexts, TwoWindowsOfOneViewerShowTheSame)
{
    using V = osgViewer::ViewerBase;
    for (auto threading :
         {V::SingleThreaded, V::CullDrawThreadPerContext, V::DrawThreadPerContext, V::CullThreadPerCameraDrawThreadPerContext}) {
        NotifyCatcher notify;
        osg::ref_ptr<LitScene> lit = makeSunny();
        osg::ref_ptr<FrameReader> readers[2];
        {
            osgViewer::CompositeViewer viewer;
            viewer.setUseConfigureAffinity(false);
            viewer.setThreadingModel(threading);
            for (auto& reader : readers) {
                osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
                reader = new FrameReader;
                OnScreen::place(*view->getCamera(), makeContext(OnScreen::width, OnScreen::height).get(), reader.get());
                view->setSceneData(lit.get());
                viewer.addView(view.get());
            }
            viewer.realize();
            for (int i = 0; i < settle; ++i) viewer.frame(0.1 * i);
            viewer.stopThreading();
            EXPECT_EQ(2u, lit->numViews());
        }
        for (const auto& reader : readers) EXPECT_LE(largestByteDifference(expected(), *reader->image), 1);
        EXPECT_EQ(0u, lit->numViews());
        EXPECT_EQ("", firstLine(notify));
    }
}

TEST_F(Contexts, ReleasedObjectsComeBack)
{
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeSunny();
    lit->setTimed(true);
    OnScreen screen(lit.get());
    expectLit(screen);
    for (int i = 0; i < 3; ++i) expectLit(screen);  // timers have their queries
    const GlObjects objects = screen.objects();
    for (const bool all : {false, true}) {
        lit->releaseGLObjects(all ? nullptr : &screen.state());
        expectLit(screen);
        lit->resizeGLObjectBuffers(7);
        expectLit(screen);
        expectInTheEnd(objects, screen);
    }
    EXPECT_EQ("", firstLine(notify));
}

TEST_F(Contexts, ReleasedObjectsAreGone)
{
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeSunny();
    lit->setTimed(true);
    osg::ref_ptr<osg::Group> nothing = new osg::Group;
    OnScreen screen(nothing.get());
    screen.draw(settle);
    const GlObjects before = screen.objects();
    screen.viewer().setSceneData(lit.get());
    screen.draw(settle);
    EXPECT_GT(screen.objects().textures, before.textures);
    screen.viewer().setSceneData(nothing.get());
    lit->releaseGLObjects(nullptr);
    screen.draw(settle);
    expectInTheEnd(before, screen);
    EXPECT_EQ("", firstLine(notify));
}

// Only compatibility profiles serve; what another context can't do is no reason not to light in this one.
TEST_F(Contexts, AFailureEndsWithItsContext)
{
    osg::ref_ptr<LitScene> lit = makeSunny();
    OnScreen good(lit.get());
    expectLit(good);
    {
        NotifyCatcher notify;
        OnScreen bad(lit.get(), osgViewer::ViewerBase::SingleThreaded, true);
        bad.draw(settle);
        EXPECT_NE(std::string::npos, notify.text().find("core profile"));
        expectLit(good);
    }
    expectLit(good);
    OnScreen next(lit.get());
    expectLit(next);
}

TEST_F(Contexts, ViewersThatComeAndGoLeaveNothing)
{
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeSunny();
    GlObjects objects;
    ResidentGrowth growth;
    const char* wanted = std::getenv("ENVLIGHT_ROUNDS");
    const int rounds = wanted ? std::atoi(wanted) : 50, warm = 20;
    for (int i = 0; i < rounds; ++i) {
        OnScreen screen(lit.get(), i % 2 ? osgViewer::ViewerBase::SingleThreaded : osgViewer::ViewerBase::DrawThreadPerContext);
        screen.draw(2);
        if (i <= warm) growth.before();
        if (i >= rounds - 20) growth.after();
        if (i == warm) {
            objects = screen.objects();
        } else if (i % 20 == 0 && i > warm) {
            EXPECT_EQ(objects, screen.objects());
        }
    }
    EXPECT_EQ("", firstLine(notify));
    RecordProperty("grownKilobytes", int(growth.kilobytes()));
    EXPECT_LT(growth.kilobytes(), ResidentGrowth::chance + rounds * 50) << "a round's own data is over 1 MB";
}

// The application's own contexts, of which one is current.
TEST(EmbeddedContexts, AContextThatIsMadeAnewShowsTheSame)
{
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeSunny(), other = makeSunny();
    Picture first;
    for (int i = 0; i < 4; ++i) {
        SceneRenderer renderer(64, 48);
        renderer.lookAt(osg::Vec3d(1.5, -6, 4), osg::Vec3d());
        const Picture before = renderer.render(other, settle);
        const Picture picture = renderer.render(lit, settle);
        if (i == 0) first = picture;
        EXPECT_EQ(0.0, largestDifference(before, picture));
        EXPECT_EQ(0.0, largestDifference(first, picture));
        if (i % 2) renderer.render(other, settle);  // the other is out of the graph while the context ends
    }
    EXPECT_EQ(0u, lit->numViews());
    EXPECT_EQ("", firstLine(notify));
}

}  // namespace Contexts_test
