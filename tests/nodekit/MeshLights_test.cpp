// SPDX-License-Identifier: MIT
// What glows in a model is an area light by itself.
#include <Maps.h>

#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Texture2D>

#include "AreaLightScene.h"

namespace MeshLights_test
{

using namespace osgEnvLight;

namespace
{

const osg::Vec3f warm(3.0f, 1.5f, 0.75f);

// The rectangle of the fixture's light, which faces down.
osg::ref_ptr<osg::Geode> makePanel(double height, const osg::Vec3f& emission = warm)
{
    const osg::ref_ptr<osg::Geode> panel = makeQuad(osg::Vec3d(-1, 0.5, height), osg::Vec3d(2, 0, 0), osg::Vec3d(0, -1, 0));
    Material::setLambert(*panel->getOrCreateStateSet(), osg::Vec3f());
    Material::setEmission(*panel->getStateSet(), emission);
    panel->getStateSet()->setAttributeAndModes(new osg::CullFace);
    return panel;
}

}  // namespace

class MeshLights : public AreaLightScene
{
  protected:
    MeshLights() { lit->getSettings()->materialColors = Settings::COLORS_LINEAR; }

    bool isLight(osg::Node* node)
    {
        lit->addChild(node);
        renderer.render(lit, 2);
        const bool runs = lit->plan().runs("arealights");
        lit->removeChild(node);
        return runs;
    }
};

TEST_F(MeshLights, APanelLightsAsAnAreaLightInItsPlace)
{
    renderer.lookAt(osg::Vec3d(0, -6, 1), osg::Vec3d(), osg::Vec3d(0, 0, 1), 30.0);  // from below: an AreaLight's back is drawn
    const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(0.5, 0, 0.4), 0.4);
    const osg::ref_ptr<osg::Geode> panel = makePanel(height);
    const osg::ref_ptr<AreaLight> light = makeRectangle();
    light->setVisible(true);
    const auto difference = [&] {
        lit->addChild(panel);
        const Picture ours = renderer.render(lit, 2);
        lit->replaceChild(panel, light);
        const Picture theirs = renderer.render(lit, 2);
        lit->removeChild(light);
        EXPECT_GT(at(theirs, osg::Vec3d())[0], 0.2);
        return std::pair(largestDifference(ours, theirs), rootMeanSquare(ours, theirs));
    };
    EXPECT_LT(difference().first, 0.005);  // the lamp itself, and what it lights; its points are not at the same places
    lit->addChild(ball);
    EXPECT_LT(difference().second, 0.01);  // its shadow
}

TEST_F(MeshLights, MovesWithItsParents)
{
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
    place->addChild(makePanel(0.0));
    lit->addChild(place);
    std::vector<osg::Vec3d> seen;
    for (const double z : {1.5, 3.0, 1.5}) {
        place->setMatrix(osg::Matrixd::scale(z, z, 1.0) * osg::Matrixd::translate(0, 0, z));
        seen.push_back(middle(1));
    }
    EXPECT_GT(seen[0][0], 0.2);
    EXPECT_NEAR(seen[0][0], seen[1][0], exact * seen[0][0]);  // as large in the sky at twice the distance
    EXPECT_EQ(seen[0], seen[2]);
    place->setMatrix(osg::Matrixd::scale(1, -1, 1) * osg::Matrixd::translate(0, 0, height));  // a mirror keeps its lit side
    EXPECT_GT(middle(1)[0], 0.1);
    place->setNodeMask(0);
    EXPECT_EQ(osg::Vec3d(), middle(1));
}

// What turns is not measured anew, and is where a lamp that was made there is.
TEST_F(MeshLights, TurnsWithItsParents)
{
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
    place->addChild(makePanel(0.0));
    place->addChild(makeSphere(osg::Vec3d(1.2, 0, 0), 0.2, 16));
    Material::setEmission(*place->getChild(1)->getOrCreateStateSet(), warm);
    Material::setLambert(*place->getChild(1)->getStateSet(), osg::Vec3f());
    lit->addChild(place);
    for (int frame = 0; frame < 7; ++frame) {
        place->setMatrix(osg::Matrixd::rotate(0.13 * frame, 0.3, 0.2, 1) * osg::Matrixd::translate(0.1 * frame, 0, height));
        renderer.render(lit, 1);
    }
    const Picture turned = renderer.render(lit, 2);
    const osg::ref_ptr<osg::MatrixTransform> fresh = new osg::MatrixTransform(place->getMatrix());
    fresh->addChild(makePanel(0.0));
    fresh->addChild(makeSphere(osg::Vec3d(1.2, 0, 0), 0.2, 16));
    fresh->getChild(1)->setStateSet(place->getChild(1)->getStateSet());
    lit->replaceChild(place, fresh);
    EXPECT_LT(rootMeanSquare(turned, renderer.render(lit, 2)), 0.01);  // its points lie elsewhere on it
    EXPECT_GT(at(turned, osg::Vec3d())[0], 0.1);
}

TEST_F(MeshLights, OneOutOfViewLightsToo)
{
    renderer.lookAt(osg::Vec3d(0, -2, 1), osg::Vec3d(), osg::Vec3d(0, 0, 1), 10.0);
    lit->addChild(makePanel(height));
    const osg::Vec3d hidden = middle();
    renderer.lookAt(osg::Vec3d(0, -6, 6), osg::Vec3d(), osg::Vec3d(0, 0, 1), 30.0);
    const osg::Vec3d shown = middle();
    EXPECT_GT(hidden[0], 0.2);
    EXPECT_NEAR(shown[0], hidden[0], exact * shown[0]);
}

TEST_F(MeshLights, WhatIsNoLampByItself)
{
    EXPECT_TRUE(isLight(makePanel(height)));
    lit->getSettings()->emissiveMeshes = false;
    EXPECT_FALSE(isLight(makePanel(height)));
    lit->getSettings()->emissiveMeshes = true;

    const osg::ref_ptr<osg::Geode> off = makePanel(height);
    Material::setLight(*off->getStateSet(), Material::LIGHT_OFF);
    EXPECT_FALSE(isLight(off));

    const osg::ref_ptr<osg::Geode> glass = makePanel(height);
    Material::setLambert(*glass->getStateSet(), osg::Vec3f());
    glass->getStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    Material::setVertexColors(*glass->getStateSet());
    const osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    colors->assign(4, osg::Vec4(0, 0, 0, 0.5f));
    glass->getDrawable(0)->asGeometry()->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    EXPECT_FALSE(isLight(glass));

    const osg::ref_ptr<osg::Geode> unlit = makeQuad(osg::Vec3d(-1, 0.5, height), osg::Vec3d(2, 0, 0), osg::Vec3d(0, -1, 0));
    unlit->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    EXPECT_FALSE(isLight(unlit));
}

TEST_F(MeshLights, NumbersThatAreNoneLightNothing)
{
    for (const float wrong : {std::nanf(""), HUGE_VALF, -1.0f}) {
        EXPECT_FALSE(isLight(makePanel(height, osg::Vec3f(wrong, wrong, wrong)))) << wrong;
        const osg::ref_ptr<osg::Geode> panel = makePanel(height, osg::Vec3f(wrong, 1, 1));
        lit->addChild(panel);
        const osg::Vec3d c = middle();
        EXPECT_EQ(0.0, c[0]);
        EXPECT_GT(c[1], 0.05) << wrong;
        lit->removeChild(panel);
    }
}

// An environment that outshines it: models whose materials glow a little to be seen in OpenGL's own light are no lamps.
TEST_F(MeshLights, IsBrighterThanTheMap)
{
    lit->getEnvironmentMap()->setImage(constantMap(1.0));
    EXPECT_TRUE(isLight(makePanel(height, osg::Vec3f(0.1f, 1.2f, 0.1f))));
    const osg::ref_ptr<osg::Geode> dim = makePanel(height, osg::Vec3f(0.9f, 0.9f, 0.9f));
    EXPECT_FALSE(isLight(dim));
    Material::setLight(*dim->getStateSet(), Material::LIGHT_ON);
    EXPECT_TRUE(isLight(dim));
}

// With an emission map it is one where it is asked for, as bright as the map's mean.
TEST_F(MeshLights, OneWithAnEmissionMapSendsItsMean)
{
    osg::ref_ptr<osg::Image> halves = new osg::Image;
    halves->allocateImage(2, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
    const unsigned char texels[] = {255, 255, 255, 0, 0, 0};
    std::copy(texels, texels + 6, halves->data());
    const osg::ref_ptr<osg::Geode> panel = makePanel(height);
    Material::setEmissionMap(*panel->getStateSet(), new osg::Texture2D(halves), 0, 4);
    panel->getDrawable(0)->asGeometry()->setTexCoordArray(0, new osg::Vec2Array(4));
    EXPECT_FALSE(isLight(panel));
    Material::setLight(*panel->getStateSet(), Material::LIGHT_ON);
    lit->addChild(panel);
    const osg::Vec3d half = middle();
    lit->removeChild(panel);
    lit->addChild(makePanel(height));
    const osg::Vec3d all = middle();
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(0.5 * all[k], half[k], exact * all[k]) << k;
}

// The emission of an osg::Material, typed as a display value.
TEST_F(MeshLights, AnOsgMaterialIsOne)
{
    const osg::ref_ptr<osg::Geode> panel = makePanel(height);
    lit->addChild(panel);
    const osg::Vec3d own = middle();
    lit->removeChild(panel);
    const osg::ref_ptr<osg::Geode> host = makeQuad(osg::Vec3d(-1, 0.5, height), osg::Vec3d(2, 0, 0), osg::Vec3d(0, -1, 0));
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, 1));
    material->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(warm, 1));
    host->getOrCreateStateSet()->setAttributeAndModes(material);
    host->getStateSet()->setAttributeAndModes(new osg::CullFace);
    lit->addChild(host);
    const osg::Vec3d hosts = middle();
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(own[k], hosts[k], exact * own[k]) << k;
}

}  // namespace MeshLights_test
