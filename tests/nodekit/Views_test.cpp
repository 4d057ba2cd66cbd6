// SPDX-License-Identifier: MIT
// Several views, viewports, sizes, parents and threading models, on a display.
#include <OnScreen.h>
#include <Halves.h>
#include <SceneRenderer.h>

#include <osgEnvLight/AreaLight>

#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osgViewer/CompositeViewer>

#include <gtest/gtest.h>

#include <cmath>

namespace Views_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

// Reads the back buffer after a frame.
class Grab : public osg::Camera::DrawCallback
{
  public:
    Grab(int x, int y, int w, int h) : _x(x), _y(y), _w(w), _h(h) {}
    void operator()(osg::RenderInfo&) const override
    {
        image = new osg::Image;
        image->readPixels(_x, _y, _w, _h, GL_RGBA, GL_UNSIGNED_BYTE);
    }
    mutable osg::ref_ptr<osg::Image> image;

  private:
    int _x, _y, _w, _h;
};

int byteRange(const osg::Image& a)
{
    const auto [low, high] = std::minmax_element(a.data(), a.data() + a.getTotalSizeInBytes());
    return int(*high) - int(*low);
}

osg::ref_ptr<LitScene> makeScene()
{
    osg::ref_ptr<LitScene> lit = new LitScene(makeMap(64, 32, sixDirectionColor));
    lit->getSettings()->bounceProbes = fewestProbes;
    lit->getSettings()->atlasLights = 64;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;  // or a thread says when probes join
    lit->addChild(makeSphere(osg::Vec3d(), 1.0, 64));
    osg::ref_ptr<osg::ShapeDrawable> dynamic = new osg::ShapeDrawable(new osg::Sphere(osg::Vec3(1.5f, 0, 0), 0.4f));
    dynamic->setDataVariance(osg::Object::DYNAMIC);
    lit->addChild(dynamic);
    return lit;
}

struct View {
    osg::ref_ptr<osgViewer::View> view;
    osg::ref_ptr<Grab> grab;
};

View addView(osgViewer::CompositeViewer& viewer, osg::GraphicsContext* context, osg::Node* scene, int x, int y, int w, int h,
             const osg::Vec3d& eye)
{
    View v{new osgViewer::View, new Grab(x, y, w, h)};
    osg::Camera& camera = *v.view->getCamera();
    v.view->setSceneData(scene);
    camera.setGraphicsContext(context);
    camera.setViewport(x, y, w, h);
    camera.setProjectionMatrixAsPerspective(40, double(w) / h, 1, 10000);
    camera.setViewMatrixAsLookAt(eye, osg::Vec3d(), osg::Vec3d(0, 0, 1));
    camera.setDrawBuffer(GL_BACK);
    camera.setReadBuffer(GL_BACK);
    camera.setFinalDrawCallback(v.grab.get());
    viewer.addView(v.view.get());
    return v;
}

class Views : public testing::Test
{
  protected:
    void SetUp() override
    {
        if (!std::getenv("DISPLAY")) GTEST_SKIP() << "needs a display; tests/run starts one";
    }
};

// Frames with everything changing; the picture of the last, which is the same however the threads ran.
osg::ref_ptr<osg::Image> run(osgViewer::ViewerBase::ThreadingModel model, bool twoParents, bool resize, int frames = 40,
                             int antialias = Settings::ANTIALIAS_EDGES)
{
    osg::ref_ptr<LitScene> lit = makeScene();
    lit->getSettings()->bounce = Settings::BOUNCE_MEAN;
    lit->getSettings()->antialias = antialias;
    lit->getSettings()->areaPoints = 16;
    lit->getSettings()->areaMapSize = 32;
    const osg::ref_ptr<osgEnvLight::AreaLight> lamp = new osgEnvLight::AreaLight;
    lamp->setImage(makeHalves());
    lit->addChild(lamp);
    lit->getSettings()->sceneLightMapSize = 32;
    const osg::ref_ptr<osg::LightSource> spot = new osg::LightSource;
    spot->getLight()->setLightNum(1);
    spot->getLight()->setPosition(osg::Vec4(0, 0, 3, 1));
    spot->getLight()->setDirection(osg::Vec3(0, 0, -1));
    spot->getLight()->setSpotCutoff(40.0f);
    const osg::ref_ptr<osg::MatrixTransform> hanging = new osg::MatrixTransform;
    hanging->addChild(spot);
    hanging->addChild(makeBox(osg::Vec3d(0.8, -0.2, 0.8), osg::Vec3d(1.2, 0.2, 1.2)));
    lit->addChild(hanging);
    lit->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    lit->getSettings()->regeneration = Settings::BACKGROUND;  // all maps anew in each of these frames would take hours
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(lit);
    if (twoParents) {
        osg::ref_ptr<osg::MatrixTransform> second = new osg::MatrixTransform(osg::Matrix::translate(0, 3, 0.5));
        second->addChild(lit);
        root->addChild(second);
    }
    osgViewer::CompositeViewer viewer;
    viewer.setUseConfigureAffinity(false);
    osg::ref_ptr<osg::GraphicsContext> context = makeContext(256, 128);
    if (!context) return nullptr;
    View a = addView(viewer, context.get(), root.get(), 0, 0, 128, 128, osg::Vec3d(0, -5, 1));
    View b = addView(viewer, context.get(), root.get(), 128, 0, 128, 128, osg::Vec3d(-4, -3, 2));
    viewer.setThreadingModel(model);
    viewer.realize();
    for (int i = 0; i < frames; ++i) {
        lit->getEnvironmentMap()->setIntensity(0.5 + 0.02 * (i % 40));
        lit->getEnvironmentMap()->setRotation(3.0 * (i % 40));
        lamp->setSphere(osg::Vec3d(std::cos(0.1 * i), std::sin(0.1 * i), 1.5), 0.1 + 0.002 * (i % 40));
        hanging->setMatrix(osg::Matrix::rotate(0.02 * i, osg::Vec3d(1, 0, 0)));
        if (resize && i >= 10 && i < 30) b.view->getCamera()->setViewport(128, 0, 128 - i, 64 + i);
        if (resize && i == 30) b.view->getCamera()->setViewport(128, 0, 128, 128);
        viewer.frame(0.1 * i);
    }
    viewer.stopThreading();
    EXPECT_EQ(twoParents ? 4u : 2u, lit->numViews());
    return b.grab->image;
}

}  // namespace

// What goes wrong once in hundreds of frames.
TEST_F(Views, AThousandFramesInEveryThreadingModel)
{
    using V = osgViewer::ViewerBase;
    const osg::ref_ptr<osg::Image> expected = run(V::SingleThreaded, false, false, 1000);
    ASSERT_TRUE(expected);
    EXPECT_GT(byteRange(*expected), 50);  // not an empty picture
    for (V::ThreadingModel model :
         {V::DrawThreadPerContext, V::CullDrawThreadPerContext, V::CullThreadPerCameraDrawThreadPerContext}) {
        const osg::ref_ptr<osg::Image> image = run(model, false, false, 1000);
        ASSERT_TRUE(image);
        EXPECT_EQ(0, largestByteDifference(*expected, *image)) << "model " << model;
    }
}

TEST_F(Views, EveryThreadingModelDrawsTheSamePicture)
{
    using V = osgViewer::ViewerBase;
    for (bool twoParents : {false, true}) {
        const osg::ref_ptr<osg::Image> expected = run(V::SingleThreaded, twoParents, false);
        ASSERT_TRUE(expected);
        EXPECT_GT(byteRange(*expected), 50);  // not an empty picture
        for (V::ThreadingModel model :
             {V::CullDrawThreadPerContext, V::DrawThreadPerContext, V::CullThreadPerCameraDrawThreadPerContext}) {
            const osg::ref_ptr<osg::Image> found = run(model, twoParents, true);
            ASSERT_TRUE(found);
            EXPECT_EQ(0, largestByteDifference(*expected, *found)) << "model " << model << ", two parents " << twoParents;
        }
    }
}

// Each frame is made of those before, and of where they showed what moves.
TEST_F(Views, EveryThreadingModelAveragesTheSameFrames)
{
    using V = osgViewer::ViewerBase;
    const osg::ref_ptr<osg::Image> expected = run(V::SingleThreaded, false, false, 20, Settings::ANTIALIAS_TEMPORAL);
    ASSERT_TRUE(expected);
    EXPECT_GT(byteRange(*expected), 50);  // not an empty picture
    for (V::ThreadingModel model :
         {V::CullDrawThreadPerContext, V::DrawThreadPerContext, V::CullThreadPerCameraDrawThreadPerContext}) {
        const osg::ref_ptr<osg::Image> found = run(model, false, false, 20, Settings::ANTIALIAS_TEMPORAL);
        ASSERT_TRUE(found);
        EXPECT_EQ(0, largestByteDifference(*expected, *found)) << "model " << model;
    }
}

TEST_F(Views, ANodeMayDieWhileItsLastFrameIsDrawn)
{
    using V = osgViewer::ViewerBase;
    for (V::ThreadingModel model : {V::DrawThreadPerContext, V::CullThreadPerCameraDrawThreadPerContext}) {
        osg::ref_ptr<osg::Group> root = new osg::Group;
        osgViewer::CompositeViewer viewer;
        viewer.setUseConfigureAffinity(false);
        osg::ref_ptr<osg::GraphicsContext> context = makeContext(256, 128);
        ASSERT_TRUE(context);
        View a = addView(viewer, context.get(), root.get(), 0, 0, 256, 128, osg::Vec3d(0, -5, 1));
        viewer.setThreadingModel(model);
        viewer.realize();
        for (int i = 0; i < 40; ++i) {
            root->removeChildren(0, root->getNumChildren());  // a draw thread may still be at the former one's stages
            root->addChild(makeScene());
            static_cast<LitScene&>(*root->getChild(0)).getSettings()->regeneration =
                Settings::BACKGROUND;  // and so may its thread
            viewer.frame(0.1 * i);
        }
        viewer.stopThreading();
        ASSERT_TRUE(a.grab->image);
        EXPECT_GT(byteRange(*a.grab->image), 50);
    }
}

TEST_F(Views, AnOffsetViewportShowsTheSamePicture)
{
    osg::ref_ptr<osg::Image> pictures[2];
    for (int i = 0; i < 2; ++i) {
        osg::ref_ptr<LitScene> lit = makeScene();
        osgViewer::CompositeViewer viewer;
        viewer.setUseConfigureAffinity(false);
        viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
        osg::ref_ptr<osg::GraphicsContext> context = makeContext(256, 256);
        ASSERT_TRUE(context);
        View v = addView(viewer, context.get(), lit.get(), i * 100, i * 60, 120, 90, osg::Vec3d(0, -5, 1));
        viewer.realize();
        viewer.frame();
        viewer.frame();
        pictures[i] = v.grab->image;
    }
    EXPECT_LE(largestByteDifference(*pictures[0], *pictures[1]), 1);  // the rasteriser's own rounding at another offset
}

TEST_F(Views, DataIsFreedWithTheView)
{
    osg::ref_ptr<LitScene> lit = makeScene();
    osgViewer::CompositeViewer viewer;
    viewer.setUseConfigureAffinity(false);
    viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    osg::ref_ptr<osg::GraphicsContext> context = makeContext(256, 128);
    ASSERT_TRUE(context);
    View a = addView(viewer, context.get(), lit.get(), 0, 0, 128, 128, osg::Vec3d(0, -5, 1));
    View b = addView(viewer, context.get(), lit.get(), 128, 0, 128, 128, osg::Vec3d(0, 5, 1));
    viewer.realize();
    viewer.frame();
    EXPECT_EQ(2u, lit->numViews());
    viewer.removeView(b.view.get());
    b = View();
    viewer.frame();
    viewer.frame();
    EXPECT_EQ(1u, lit->numViews());
}

TEST(Sizes, AViewportOfNothingAndOfOnePixelAndBack)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<LitScene> lit = makeScene();
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    plain->addChild(makeSphere(osg::Vec3d(), 1.0));
    const Picture before = renderer.render(lit, 2);
    for (const auto& [w, h] : {std::pair(0, 0), std::pair(1, 1), std::pair(7, 5), std::pair(64, 1), std::pair(3, 64)}) {
        renderer.viewer().getCamera()->setViewport(0, 0, w, h);
        NotifyCatcher notify;
        renderer.render(plain, 2);  // OSG itself gives an empty frame buffer a GL error; it is not for us to add another
        const std::string withoutUs = notify.text();
        notify.clear();
        const Picture p = renderer.render(lit, 2);
        EXPECT_TRUE(p.finite()) << w << "x" << h;
        EXPECT_LE(notify.text().size(), withoutUs.size()) << w << "x" << h << ": " << notify.text();
    }
    renderer.viewer().getCamera()->setViewport(0, 0, 64, 64);
    EXPECT_EQ(before.rgba, renderer.render(lit, 2).rgba);
}

}  // namespace Views_test
