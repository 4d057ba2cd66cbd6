// SPDX-License-Identifier: MIT
// The node as a guest: what the host had before it is what the host has after it.
#include <OnScreen.h>
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <osg/BlendFunc>
#include <osg/Material>
#include <osgGA/TrackballManipulator>
#include <osgUtil/LineSegmentIntersector>
#include <osgUtil/IntersectionVisitor>

#include <gtest/gtest.h>

#include <algorithm>

namespace Host_test
{

using osgEnvLight::LitScene;

namespace
{

osg::ref_ptr<osg::Geode> coloured(osg::ref_ptr<osg::Geode> geode, const osg::Vec4& color)
{
    osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT_AND_BACK, color);
    m->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.3f, 0.3f, 0.3f, 1));
    m->setShininess(osg::Material::FRONT_AND_BACK, 40.0f);
    geode->getOrCreateStateSet()->setAttributeAndModes(m.get());
    if (color.a() < 1.0f) {
        geode->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        geode->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    }
    return geode;
}

// Opaque and transparent, glossy and not.
osg::ref_ptr<osg::Group> makeModel()
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(coloured(makeSphere(osg::Vec3d(-0.7, 0, 0), 0.6), osg::Vec4(0.8f, 0.2f, 0.2f, 1)));
    group->addChild(coloured(makeSphere(osg::Vec3d(0.7, 0, 0), 0.6), osg::Vec4(0.2f, 0.2f, 0.8f, 0.4f)));
    group->addChild(makeQuad(osg::Vec3d(-2, -2, -0.7), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    return group;
}

osg::ref_ptr<osg::Node> makeSibling()
{
    return coloured(makeBox(osg::Vec3d(-0.2, -0.5, -0.7), osg::Vec3d(0.2, 0.5, 0.2)), osg::Vec4(0.2f, 0.8f, 0.2f, 1));
}

}  // namespace

TEST(Host, RemovalRestoresThePictureByteForByte)
{
    SceneRenderer renderer(160, 120);
    renderer.lookAt(osg::Vec3d(0.6, -4, 1.5), osg::Vec3d());
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::Group> model = makeModel();
    root->addChild(model);
    root->addChild(makeSibling());
    const Picture before = renderer.render(root, 3);
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->getSettings()->bounceProbes = fewestProbes;
    lit->addChild(model);
    root->replaceChild(model, lit);
    EXPECT_GT(rootMeanSquare(before, renderer.render(root, 3)), 0.01);  // it did light
    root->replaceChild(lit, model);
    lit = nullptr;
    const Picture after = renderer.render(root, 1);
    EXPECT_EQ(before.rgba, after.rgba);
}

TEST(Host, SiblingsOfAnEmptyNodeAreUntouched)
{
    SceneRenderer renderer(160, 120);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(makeModel());
    const Picture before = renderer.render(root, 2);
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->getSettings()->background = osgEnvLight::Settings::BACKGROUND_OFF;
    root->insertChild(0, lit);
    EXPECT_EQ(before.rgba, renderer.render(root, 2).rgba);
}

TEST(Host, StateSetsOfTheModelAreNotChanged)
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<osg::Group> model = makeModel();
    std::vector<osg::ref_ptr<osg::StateSet>> copies;
    for (unsigned i = 0; i < model->getNumChildren(); ++i)
        copies.push_back(new osg::StateSet(*model->getChild(i)->getStateSet(), osg::CopyOp::DEEP_COPY_ALL));
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->getSettings()->bounceProbes = fewestProbes;
    lit->addChild(model);
    renderer.render(lit, 3);
    for (unsigned i = 0; i < model->getNumChildren(); ++i)
        EXPECT_EQ(0, copies[i]->compare(*model->getChild(i)->getStateSet(), true)) << "child " << i;
    EXPECT_EQ(nullptr, model->getStateSet());
}

TEST(Host, AnImageThatWasNotReadIsOneWarning)
{
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = new LitScene;
    EXPECT_EQ("", notify.text());
    lit = new LitScene(constantMap(1.0));
    EXPECT_EQ("", notify.text());
    lit = new LitScene(osg::ref_ptr<osg::Image>());
    EXPECT_NE(std::string::npos, notify.text().find("built-in sky")) << notify.text();
    EXPECT_EQ(1, std::count(notify.text().begin(), notify.text().end(), '\n')) << notify.text();
    EXPECT_EQ("sky", lit->getEnvironmentMap()->getMap());
}

TEST(Host, AddingAndRemovingAHundredTimesLeaksNothing)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::Group> model = makeModel();
    root->addChild(model);
    osg::ref_ptr<osg::Image> map = constantMap(1.0);
    auto round = [&] {
        osg::ref_ptr<LitScene> lit = new LitScene(map);
        lit->getSettings()->bounceProbes = fewestProbes;
        lit->setTimed(true);
        lit->getSettings()->atlasLights = 16;  // drawn a hundred times
        lit->addChild(model);
        root->replaceChild(model, lit);
        renderer.render(root, 6);  // timers hold queries after four
        EXPECT_EQ(1u, lit->numViews());
        root->replaceChild(lit, model);
        lit = nullptr;
        renderer.render(root, 2);
        osg::flushAllDeletedGLObjects(renderer.state().getContextID());
    };
    ResidentGrowth growth;
    for (int i = 0; i < 20; ++i) {  // pools and caches fill
        round();
        growth.before();
    }
    const GlObjects before = countGlObjects(renderer.state());
    for (int i = 0; i < 100; ++i) {
        round();
        if (i >= 60) growth.after();
    }
    const GlObjects after = countGlObjects(renderer.state());
    EXPECT_EQ(before, after);
    // One round's own data is over 1 MB; the allocators and the driver's caches of shaders may keep some of it.
    EXPECT_LT(growth.kilobytes(), ResidentGrowth::chance);
}

TEST(Host, NoGlErrorAndNoWarning)
{
    SceneRenderer renderer(64, 64);
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->getSettings()->bounceProbes = fewestProbes;
    lit->addChild(makeModel());
    lit->setTimed(true);
    for (int view = 0; view < osgEnvLight::Settings::NUM_VIEWS; ++view) {
        lit->getSettings()->view = view;
        lit->getSettings()->background = view % 3;
        const Picture p = renderer.render(lit, 3);
        EXPECT_TRUE(p.finite() && !p.rgba.empty());
    }
    EXPECT_EQ("", notify.text());  // State checks for errors after every attribute, and reports them here
}

TEST(Host, PickingThroughTheNodeIsPickingDirectly)
{
    osg::ref_ptr<osg::Group> model = makeModel();
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->getSettings()->bounceProbes = fewestProbes;
    lit->addChild(model);
    auto pick = [](osg::Node* node) {
        osg::ref_ptr<osgUtil::LineSegmentIntersector> line =
            new osgUtil::LineSegmentIntersector(osg::Vec3d(-0.7, -5, 0.1), osg::Vec3d(-0.7, 5, 0.1));
        osgUtil::IntersectionVisitor visitor(line.get());
        node->accept(visitor);
        return line->containsIntersections() ? line->getFirstIntersection().getWorldIntersectPoint() : osg::Vec3d();
    };
    EXPECT_EQ(pick(model), pick(lit));
    EXPECT_EQ(model->getBound().radius(), lit->getBound().radius());
}

TEST(Host, BadSettingsAreReportedOnceAndTheLastValidOnesStay)
{
    SceneRenderer renderer(48, 48);
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->regeneration = osgEnvLight::Settings::IMMEDIATE;
    lit->addChild(makeModel());
    const Picture before = renderer.render(lit, 2);
    NotifyCatcher notify;
    lit->getSettings()->occlusionLights = -3;
    EXPECT_EQ(before.rgba, renderer.render(lit, 3).rgba);
    EXPECT_NE(std::string::npos, notify.text().find("occlusionLights"));
    EXPECT_NE(std::string::npos, notify.text().find("16..65536"));
    EXPECT_EQ(notify.text().find("occlusionLights"), notify.text().rfind("occlusionLights"));
}

TEST(Host, AMapThatChangesIsSeenAtTheNextFrame)
{
    SceneRenderer renderer(48, 48);
    osg::ref_ptr<osg::Image> map = constantMap(1.0);
    osg::ref_ptr<LitScene> lit = makeLit(map.get());
    lit->getSettings()->regeneration = osgEnvLight::Settings::IMMEDIATE;
    lit->addChild(makeSphere(osg::Vec3d(), 1.0));
    osgEnvLight::Material::setLambert(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    EXPECT_NEAR(renderer.render(lit, 2).color(24, 24)[0], 1.0, 0.005);
    std::fill_n(reinterpret_cast<float*>(map->data()), map->getTotalSizeInBytes() / sizeof(float), 3.0f);
    EXPECT_NEAR(renderer.render(lit, 1).color(24, 24)[0], 1.0, 0.005);  // not told yet: nothing is rebuilt
    map->dirty();
    EXPECT_NEAR(renderer.render(lit, 1).color(24, 24)[0], 3.0, 0.015);
}

TEST(Host, AKeyCyclesTheIntermediatesAndIsHandledOnlyByUs)
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->addChild(makeSphere(osg::Vec3d(), 1.0));
    renderer.render(lit, 1);
    for (int i = 1; i <= osgEnvLight::Settings::NUM_VIEWS; ++i) {
        renderer.viewer().getEventQueue()->keyPress('V');
        renderer.viewer().getEventQueue()->keyPress('x');  // nobody's
        renderer.render(lit, 1);
        EXPECT_EQ(i % osgEnvLight::Settings::NUM_VIEWS, lit->getSettings()->view);
    }
}

TEST(Host, ASceneDescriptionsCameraIsTheManipulatorsHomeOnce)
{
    SceneRenderer renderer(64, 32);
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->addChild(makeSphere(osg::Vec3d(), 1.0));
    osgEnvLight::HomeView view;
    view.eye = osg::Vec3d(3, -4, 5);
    view.fovy = 50.0;
    lit->setHomeView(view);
    renderer.viewer().setCameraManipulator(new osgGA::TrackballManipulator);
    renderer.render(lit, 3);
    osg::Vec3d eye, target, up;
    renderer.viewer().getCamera()->getViewMatrixAsLookAt(eye, target, up);
    EXPECT_NEAR(0.0, (eye - view.eye).length(), 1e-4);
    double fovy, aspect, near, far;
    renderer.viewer().getCamera()->getProjectionMatrixAsPerspective(fovy, aspect, near, far);
    EXPECT_NEAR(50.0, fovy, 1e-6);
    EXPECT_NEAR(2.0, aspect, 1e-6);
}

}  // namespace Host_test
