// SPDX-License-Identifier: MIT
// Area lights below a LitScene, under a black map: against closed forms, and as guests of the graph.
#include <Halves.h>
#include <Oracles.h>
#include <SceneRenderer.h>

#include <osgEnvLight/AreaLight>
#include <osgEnvLight/Material>

#include <osg/MatrixTransform>
#include <osg/Switch>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "AreaLightScene.h"

namespace AreaLights_test
{

using osgEnvLight::AreaLight;
using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Plan;
using osgEnvLight::Settings;
namespace oracle = testmaths::oracle;

namespace
{

std::string reason(const LitScene& lit, const std::string& pass)
{
    const Plan plan = lit.plan();
    return (plan.runs(pass) ? "" : "off, ") + plan.reason(pass);
}

}  // namespace

class AreaLights : public AreaLightScene
{
};

TEST_F(AreaLights, GiveAPlaneWhatTheClosedFormsSay)
{
    const osg::ref_ptr<AreaLight> light = makeRectangle(1.0);
    light->setRadiance(osg::Vec3f(2, 2, 2));
    lit->addChild(light);
    EXPECT_NEAR(2.0 * oracle::centredRectangle(2.0, 1.0, height), middle()[0], exact);
    light->setDisc(osg::Vec3d(0, 0, height), osg::Vec3d(0, 0, -7), 0.8);
    EXPECT_NEAR(2.0 * oracle::coaxialDisk(0.8, height), middle()[0], exact);
    light->setSphere(osg::Vec3d(0.7, 0, height), 0.5);
    const double distance = std::hypot(0.7, height);
    EXPECT_NEAR(2.0 * oracle::sphere(std::asin(0.5 / distance), std::acos(height / distance)), middle()[0], exact);
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (const osg::Vec3& v :
         {osg::Vec3(-1, 0.5f, 1.5f), osg::Vec3(1, 0.5f, 1.5f), osg::Vec3(1, -0.5f, 1.5f), osg::Vec3(-1, -0.5f, 1.5f)})
        corners->push_back(v);
    light->setPolygon(*corners);
    EXPECT_NEAR(2.0 * oracle::centredRectangle(2.0, 1.0, height), middle()[0], exact);
    EXPECT_EQ("1 area light, each by its closed form", reason(*lit, "arealights"));
    // Nothing of a black map is occluded, and no surface sends light on.
    EXPECT_EQ("off, there is no diffuse term to occlude", reason(*lit, "occlusion"));
    lit->getSettings()->bounce = Settings::BOUNCE_MEAN;
    middle();
    EXPECT_TRUE(lit->plan().runs("occlusion"));
}

// An arrow whose first vertex is the mean of all, and the two triangles that it is made of.
TEST_F(AreaLights, OfAPolygonSendWhatItsPartsSend)
{
    const osg::Vec3 notch(0, 0, 1.5f), left(-1, 1, 1.5f), tip(2, 0, 1.5f), right(-1, -1, 1.5f);
    const auto polygon = [](const std::vector<osg::Vec3>& corners) {
        const osg::ref_ptr<AreaLight> light = new AreaLight;
        light->setPolygon(*osg::ref_ptr<osg::Vec3Array>(new osg::Vec3Array(corners.begin(), corners.end())));
        light->setVisible(false);
        return light;
    };
    const osg::ref_ptr<AreaLight> arrow = polygon({notch, left, tip, right});
    lit->addChild(arrow);
    const double whole = middle()[0];
    EXPECT_GT(whole, 0.1);
    lit->removeChild(arrow);
    lit->addChild(polygon({notch, left, tip}));
    lit->addChild(polygon({notch, tip, right}));
    EXPECT_NEAR(whole, middle()[0], exact);
}

TEST_F(AreaLights, LightTheSideTheyFace)
{
    const osg::ref_ptr<AreaLight> light = makeRectangle();
    lit->addChild(light);
    const osg::Vec3d lit1 = middle();
    EXPECT_NEAR(0.5, lit1[1] / lit1[0], exact);
    light->setRectangle(osg::Vec3d(0, 0, height), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 0.5, 0));
    EXPECT_EQ(osg::Vec3d(), middle());
    light->setTwoSided(true);
    EXPECT_NEAR(lit1[0], middle()[0], exact);
}

TEST_F(AreaLights, OfAFluxSendItWhateverTheirSize)
{
    const osg::ref_ptr<AreaLight> light = makeRectangle();
    lit->addChild(light);
    const double radiance = 2.0;
    light->setFlux(osg::Vec3f(1, 1, 1) * float(osg::PI * 2.0 * radiance));
    EXPECT_NEAR(radiance * oracle::centredRectangle(2.0, 1.0, height), middle()[0], exact);
}

// As a lamp on the parent's side, turned over by a mirror, scaled.
TEST_F(AreaLights, MoveWithTheirParents)
{
    const osg::ref_ptr<AreaLight> light = makeRectangle();
    const osg::ref_ptr<osg::MatrixTransform> parent = new osg::MatrixTransform;
    parent->addChild(light);
    lit->addChild(parent);
    const double there = middle()[0];
    light->setRectangle(osg::Vec3d(0, 0, 0), osg::Vec3d(0.5, 0, 0), osg::Vec3d(0, 0.25, 0));
    parent->setMatrix(osg::Matrixd::scale(2, 2, -2) * osg::Matrixd::translate(0, 0, height));
    EXPECT_NEAR(there, middle()[0], exact);
    parent->setMatrix(osg::Matrixd::scale(2, 2, 2) * osg::Matrixd::rotate(osg::PI, osg::Vec3d(1, 0, 0)) *
                      osg::Matrixd::translate(0, 0, height));
    EXPECT_NEAR(there, middle()[0], exact);
}

TEST_F(AreaLights, AreSwitchedMaskedAndRemovedAsAnyNode)
{
    const Picture without = renderer.render(lit, 2);
    const osg::ref_ptr<osg::Switch> parent = new osg::Switch;
    parent->addChild(makeRectangle(), true);
    lit->addChild(parent);
    EXPECT_GT(middle()[0], 0.1);
    parent->setAllChildrenOff();
    EXPECT_EQ(without.rgba, renderer.render(lit, 2).rgba);
    EXPECT_EQ("off, no area light", reason(*lit, "arealights"));
    EXPECT_EQ("off, no area light", reason(*lit, "areamaps"));
    parent->setAllChildrenOn();
    parent->setNodeMask(0);
    EXPECT_EQ(without.rgba, renderer.render(lit, 2).rgba);
    parent->setNodeMask(~0u);
    EXPECT_GT(middle()[0], 0.1);
    lit->removeChild(parent);
    EXPECT_EQ(without.rgba, renderer.render(lit, 2).rgba);
}

TEST_F(AreaLights, BehindTheEyeStillLight)
{
    lit->addChild(makeRectangle());
    const double above = middle()[0];
    renderer.lookAt(osg::Vec3d(0, -0.5, 0.5), osg::Vec3d(0, 0, 0));
    EXPECT_NEAR(above, middle()[0], 0.02 * above);
}

TEST_F(AreaLights, AreSeenWithTheirRadianceAndBlackFromBehind)
{
    const osg::ref_ptr<AreaLight> light = makeRectangle(4.0);
    light->setVisible(true);
    lit->addChild(light);
    renderer.lookAt(osg::Vec3d(0, -0.5, 0.2), osg::Vec3d(0, 0, height));
    EXPECT_LT((middle() - osg::Vec3d(4, 2, 1)).length(), 1e-2);
    renderer.lookAt(osg::Vec3d(0, -0.5, 3), osg::Vec3d(0, 0, height));
    EXPECT_EQ(osg::Vec3d(), middle());
    // A display's exposure changes what a host's own emission is, but not this.
    lit->getSettings()->output = Settings::LINEAR;
    light->setVisible(false);
    renderer.lookAt(osg::Vec3d(0, -0.5, 0.2), osg::Vec3d(0, 0, height));
    EXPECT_EQ(osg::Vec3d(), middle());
}

TEST_F(AreaLights, ThrowShadows)
{
    lit->addChild(makeRectangle());
    const osg::ref_ptr<osg::Geode> box = makeBox(osg::Vec3d(-0.5, -0.5, 0.4), osg::Vec3d(0.5, 0.5, 0.5));
    Material::setLambert(*box->getOrCreateStateSet(), osg::Vec3f());
    renderer.lookAt(osg::Vec3d(0, -3, 1.2), osg::Vec3d(), osg::Vec3d(0, 0, 1), 60.0);
    const osg::Vec3d open = middle();
    lit->addChild(box);
    const Picture p = renderer.render(lit, 2);
    // Below the box all of the light is hidden; from x = 1.25 on nothing is.
    EXPECT_LT(at(p, osg::Vec3d(0, 0, 0))[0], 0.01 * open[0]);
    lit->removeChild(box);
    const Picture before = renderer.render(lit, 2);
    EXPECT_NEAR(at(before, osg::Vec3d(1.5, 0, 0))[0], at(p, osg::Vec3d(1.5, 0, 0))[0], 0.01 * open[0]);
    lit->getSettings()->occlusion = false;
    lit->addChild(box);
    EXPECT_NEAR(open[0], at(renderer.render(lit, 2), osg::Vec3d(0, 0, 0))[0], exact * open[0]);
}

// A wall between the light and the floor's other half, down to the floor: not a ray passes.
// The maps of a sphere's points leave out what grazes them: other points know about it.
TEST_F(AreaLights, DoNotShineThroughTheirShades)
{
    const osg::Vec3d foot(-2, 0, 0);
    const osg::ref_ptr<AreaLight> lamp = new AreaLight;
    lamp->setSphere(foot + osg::Vec3d(0, 0, 0.5), 0.05);
    lamp->setFlux(osg::Vec3f(20, 20, 20));
    lit->addChild(lamp);
    const double open = middle()[0];
    EXPECT_GT(open, 0.01);
    // Four walls around it, open above and below.
    const double inner = 0.15, outer = 0.18, low = 0.2, high = 0.8;
    for (int side = 0; side < 4; ++side) {
        const double sign = side < 2 ? 1.0 : -1.0;
        const osg::Vec3d near = side % 2 ? osg::Vec3d(-outer, sign * inner, low) : osg::Vec3d(sign * inner, -outer, low);
        const osg::Vec3d far = side % 2 ? osg::Vec3d(outer, sign * outer, high) : osg::Vec3d(sign * outer, outer, high);
        osg::BoundingBoxd box;
        box.expandBy(foot + near);
        box.expandBy(foot + far);
        lit->addChild(makeBox(box._min, box._max));
    }
    EXPECT_LT(middle()[0], 0.01 * open);
    // Below it is light.
    const Picture p = renderer.render(lit, 1);
    EXPECT_GT(at(p, foot + osg::Vec3d(0.05, 0, 0))[0], open);
}

TEST_F(AreaLights, DoNotShineThroughWalls)
{
    const osg::ref_ptr<AreaLight> light = makeRectangle();
    light->setRectangle(osg::Vec3d(2, 0, 1), osg::Vec3d(0, 0, 0.4), osg::Vec3d(0, 0.4, 0));  // faces -x
    lit->addChild(light);
    const osg::ref_ptr<osg::Geode> wall = makeBox(osg::Vec3d(0.9, -3.9, 0), osg::Vec3d(1, 3.9, 3));
    Material::setLambert(*wall->getOrCreateStateSet(), osg::Vec3f());
    const double open = middle()[0];
    lit->addChild(wall);
    renderer.lookAt(osg::Vec3d(-3, 0, 3), osg::Vec3d(), osg::Vec3d(0, 0, 1), 30.0);
    EXPECT_GT(open, 0.04);
    EXPECT_LT(middle()[0], 1e-4);
}

TEST_F(AreaLights, ScaleAndPlaceDoNotMatter)
{
    const auto picture = [this](double scale, const osg::Vec3d& place) {
        const osg::ref_ptr<LitScene> scene = makeLit(constantMap(0.0).get());
        scene->getSettings()->regeneration = Settings::IMMEDIATE;
        const osg::ref_ptr<osg::MatrixTransform> parent =
            new osg::MatrixTransform(osg::Matrixd::scale(scale, scale, scale) * osg::Matrixd::translate(place));
        parent->addChild(makeQuad(osg::Vec3d(-4, -4, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0)));
        parent->addChild(makeBox(osg::Vec3d(-0.5, -0.5, 0), osg::Vec3d(0.5, 0.5, 0.5)));
        parent->addChild(makeRectangle());
        scene->addChild(parent);
        renderer.viewer().getCamera()->setProjectionMatrixAsPerspective(40, 1, 0.1 * scale, 100 * scale);
        renderer.viewer().getCamera()->setViewMatrixAsLookAt(osg::Vec3d(1, -5, 4) * scale + place, place, osg::Vec3d(0, 0, 1));
        return renderer.render(scene, 2);
    };
    const Picture expected = picture(1.0, osg::Vec3d());
    EXPECT_GT(ofGeometry(expected).most, 0.1);
    // Some texels of shadow maps fall on the other side of a rounding.
    for (const double scale : {1e-6, 1e-3, 1e3, 1e6})
        EXPECT_LT(rootMeanSquare(expected, picture(scale, osg::Vec3d())), 4e-3) << "scale " << scale;
    for (const double offset : {1e4, 6.4e6})
        EXPECT_LT(rootMeanSquare(expected, picture(1.0, osg::Vec3d(offset, -offset, offset))), 4e-3) << "offset " << offset;
}

TEST_F(AreaLights, ThatCanNotLightAreLeftOutAndNamedOnce)
{
    const osg::ref_ptr<AreaLight> light = makeRectangle();
    lit->addChild(light);
    light->setU(osg::Vec3d());
    NotifyCatcher catcher;
    EXPECT_EQ(osg::Vec3d(), middle(4));
    EXPECT_NE(std::string::npos, catcher.text().find("area light 'lamp' has no area; it is left out"));
    EXPECT_EQ(catcher.text().find("lamp"), catcher.text().rfind("lamp"));
    light->setU(osg::Vec3d(std::nan(""), 0, 0));
    EXPECT_EQ(osg::Vec3d(), middle());
    light->setU(osg::Vec3d(1, 0, 0));
    EXPECT_GT(middle()[0], 0.1);
    light->setShape(AreaLight::DISC);
    light->setImage(makeHalves());
    catcher.clear();
    EXPECT_EQ(osg::Vec3d(), middle());
    EXPECT_NE(std::string::npos, catcher.text().find("area light 'lamp' has an image but is no rectangle; it is left out"));
}

TEST_F(AreaLights, AddedAndRemovedLeaveMemoryAsItWas)
{
    renderer.render(lit, 3);
    const size_t before = lit->textureBytes();
    for (int i = 0; i < 20; ++i) {
        const osg::ref_ptr<AreaLight> light = makeRectangle();
        light->setVisible(i % 2 == 0);
        if (i % 3 == 0) light->setImage(makeHalves());
        lit->addChild(light);
        renderer.render(lit, 1);
        EXPECT_GT(lit->textureBytes(), before);
        lit->removeChild(light);
        renderer.render(lit, 4);
        EXPECT_EQ(before, lit->textureBytes()) << i;
    }
}

TEST_F(AreaLights, AreWrittenAndReadAgain)
{
    const osg::ref_ptr<AreaLight> light = makeRectangle();
    light->setVisible(true);
    lit->addChild(light);
    const osg::ref_ptr<AreaLight> other = new AreaLight;
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (const osg::Vec3& v : {osg::Vec3(-2, 2, 1), osg::Vec3(-1, 2, 1), osg::Vec3(-1, 1, 1)}) corners->push_back(v);
    other->setPolygon(*corners);
    other->setFlux(osg::Vec3f(3, 2, 1));
    other->setTwoSided(true);
    lit->addChild(other);
    const osg::ref_ptr<AreaLight> screen = makeRectangle();
    screen->setImage(makeHalves());
    lit->addChild(screen);
    const Picture before = renderer.render(lit, 2);
    for (const char* extension : {"osgt", "osgb"}) {
        osgDB::ReaderWriter* plugin = osgDB::Registry::instance()->getReaderWriterForExtension(extension);
        ASSERT_TRUE(plugin);
        std::stringstream file;
        ASSERT_TRUE(plugin->writeNode(*lit, file).success());
        const osg::ref_ptr<osg::Node> read = plugin->readNode(file).getNode();
        ASSERT_TRUE(read);
        EXPECT_EQ(before.rgba, renderer.render(read, 2).rgba) << extension;
    }
}

}  // namespace AreaLights_test
