// SPDX-License-Identifier: MIT
// The README's table of OpenSceneGraph's features, a test a row: lit, or drawn exactly as without the node and said so once.
// Those of textures: TextureUnits_test.cpp.
#include <osg/BlendFunc>
#include <osg/ClipNode>
#include <osg/ClipPlane>
#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/LightModel>
#include <osg/LineWidth>
#include <osg/LogicOp>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PolygonOffset>
#include <osg/Projection>
#include <osg/Scissor>
#include <osg/Stencil>
#include <osg/TexEnvCombine>
#include <osg/TexGen>
#include <osg/Texture1D>
#include <osg/Texture2D>
#include <osg/Texture3D>
#include <osg/TextureRectangle>
#include <osgSim/LightPointNode>

#include <gtest/gtest.h>

#include <algorithm>

#include "FeatureCards.h"

namespace Features_test
{

using namespace feature_cards;

TEST_F(Features, BackFacesHaveTheirOwnMaterialUnderTwoSidedLighting)
{
    const osg::ref_ptr<osg::Geode> model = card();
    osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT, osg::Vec4(1, 0, 0, 1));
    m->setDiffuse(osg::Material::BACK, osg::Vec4(0, 1, 0, 1));
    model->getOrCreateStateSet()->setAttributeAndModes(m);
    const osg::ref_ptr<osg::MatrixTransform> turned = new osg::MatrixTransform(osg::Matrixd::rotate(osg::PI, 0, 0, 1));
    turned->addChild(model);
    EXPECT_NEAR(lit(turned)[0], 1.0, small);  // one-sided: the front's, as in OpenGL
    const osg::ref_ptr<osg::LightModel> sides = new osg::LightModel;
    sides->setTwoSided(true);
    turned->getOrCreateStateSet()->setAttribute(sides);
    EXPECT_NEAR(lit(turned)[1], 1.0, small);
    EXPECT_NEAR(lit(turned)[0], 0.0, small);
}

TEST_F(Features, PolygonOffset)
{
    const osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(card(3.0, osg::Vec4(1, 0, 0, 1)));
    group->addChild(card(3.0, osg::Vec4(0, 0, 1, 1)));
    group->getChild(0)->getOrCreateStateSet()->setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f));
    EXPECT_NEAR(lit(group)[0], 1.0, small);
}

TEST_F(Features, ClipPlanesBelowAndAbove)
{
    for (bool above : {false, true}) {
        const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
        clip->addClipPlane(new osg::ClipPlane(0, 1.0, 0.0, 0.0, 0.7));  // keeps x > -.7: from pixel 8 on
        const osg::ref_ptr<osg::Group> root = new osg::Group;
        osg::ref_ptr<LitScene> scene;
        if (above) {
            scene = furnace(card());
            clip->addChild(scene);
            root->addChild(clip);
        } else {
            clip->addChild(card());
            scene = furnace(clip);
            root->addChild(scene);
        }
        const Picture p = renderer.render(root, 2);
        EXPECT_EQ(p.alpha(4, 16), 0.0f) << "above " << above;
        EXPECT_NEAR(p.color(12, 16)[0], 1.0, small) << "above " << above;
        EXPECT_NEAR(p.color(28, 16)[0], 1.0, small) << "above " << above;
    }
}

TEST_F(Features, FixedFunctionThatNoPassDrawsIsDrawnAsWithoutUs)
{
    using Change = std::function<void(osg::StateSet&)>;
    const auto mode = [](osg::StateAttribute* a) {
        return [a = osg::ref_ptr(a)](osg::StateSet& s) { s.setAttributeAndModes(a); };
    };
    const auto unit = [](unsigned n, osg::Texture* t) {
        return [n, t = osg::ref_ptr(t)](osg::StateSet& s) { s.setTextureAttributeAndModes(n, t); };
    };
    const osg::ref_ptr<osg::Stencil> stencil = new osg::Stencil;
    stencil->setFunction(osg::Stencil::ALWAYS, 1, ~0u);
    const osg::ref_ptr<osg::Texture1D> line = new osg::Texture1D(twoHalves(red, blue, 1));
    sharp(*line);
    const osg::ref_ptr<osg::Texture3D> volume = new osg::Texture3D(twoHalves(red, blue, 8, 2));
    sharp(*volume);
    const osg::ref_ptr<osg::Image> decimals = new osg::Image;
    decimals->allocateImage(1, 1, 1, GL_RGBA, GL_FLOAT);
    decimals->setInternalTextureFormat(GL_RGBA32F_ARB);
    std::fill_n(reinterpret_cast<float*>(decimals->data()), 4, 0.5f);
    const osg::ref_ptr<osg::Texture2D> floats = texture(decimals);
    const osg::ref_ptr<osg::TextureRectangle> rectangle = new osg::TextureRectangle(twoHalves(red, blue));
    const osg::ref_ptr<osg::Texture2D> shadowMap = texture(twoHalves(red, blue));  // osgShadow's in the fixed function
    shadowMap->setShadowComparison(true);
    const std::pair<Change, const char*> rows[] = {
        {mode(stencil), "the stencil test"},
        {mode(new osg::Scissor(0, 0, 20, 20)), "the scissor test"},
        {mode(new osg::ColorMask(true, false, true, true)), "colour masks"},
        {mode(new osg::LogicOp(osg::LogicOp::COPY)), "logic operations"},
        {mode(new osg::BlendFunc(GL_ONE, GL_ONE)), "blending other than by alpha"},
        {mode(new osg::Depth(osg::Depth::ALWAYS)), "depth tests for other than the nearest"},
        {mode(new osg::Depth(osg::Depth::LESS, 0.0, 0.5)), "depth tests for other than the nearest"},
        {unit(4, texture(twoHalves(red, blue))), "texture units beyond the fourth"},
        {unit(1, volume), "texture units beyond the first that are not Texture2D or combine"},
        {unit(1, shadowMap), "texture units beyond the first that are not Texture2D or combine"},
        {unit(1, floats), "texture units beyond the first of floats or without colours"},
        {[](osg::StateSet& s) {
             s.setTextureAttributeAndModes(1, texture(twoHalves(red, blue)).get());
             const osg::ref_ptr<osg::TexGen> sphere = new osg::TexGen;
             sphere->setMode(osg::TexGen::SPHERE_MAP);
             s.setTextureAttributeAndModes(1, sphere);
         },
         "generated otherwise than by planes"},
        {unit(0, line), "textures other than Texture2D"},
        {unit(0, volume), "textures other than Texture2D"},
        {unit(0, rectangle), "textures other than Texture2D"},
        {[](osg::StateSet& s) {
             s.setTextureAttributeAndModes(0, texture(twoHalves(red, blue)).get());
             const osg::ref_ptr<osg::TexEnvCombine> less = new osg::TexEnvCombine;
             less->setCombine_RGB(osg::TexEnvCombine::SUBTRACT);
             s.setTextureAttribute(0, less);
         },
         "texture environments that combine"}};
    for (const auto& [change, said] : rows) {
        const osg::ref_ptr<osg::Geode> model = card();
        osg::Geometry& geometry = *model->getDrawable(0)->asGeometry();
        geometry.setTexCoordArray(4, geometry.getTexCoordArray(0));
        change(*model->getOrCreateStateSet());
        expectAsWithout(model, said);
    }
}

TEST_F(Features, PointsAndLinesAreDrawnAsWithoutUs)
{
    for (GLenum primitive : {GLenum(GL_POINTS), GLenum(GL_LINE_STRIP)}) {
        const osg::ref_ptr<osg::Geode> model = card(1.0);
        osg::Geometry& geometry = *model->getDrawable(0)->asGeometry();
        geometry.setPrimitiveSet(0, new osg::DrawArrays(primitive, 0, 4));
        model->getOrCreateStateSet()->setAttribute(new osg::LineWidth(3.0f));
        expectAsWithout(model, "points and lines");
    }
}

// osgSim makes their drawable anew for each view.
TEST_F(Features, LightPointsAreDrawnAsWithoutUs)
{
    const osg::ref_ptr<osgSim::LightPointNode> points = new osgSim::LightPointNode;
    points->setMinPixelSize(4.0f);
    points->addLightPoint(osgSim::LightPoint(osg::Vec3(0, 0, 0), osg::Vec4(1, 0.5f, 0, 1)));
    expectAsWithout(points, "points and lines");
    EXPECT_GT(renderer.render(furnace(points), 3).color(size / 2, size / 2)[0], 0.9f);
}

TEST_F(Features, AProjectionOfItsOwnIsDrawnAsWithoutUs)
{
    const osg::ref_ptr<osg::Projection> overlay = new osg::Projection(osg::Matrixd::ortho2D(-1, 1, -1, 1));
    const osg::ref_ptr<osg::MatrixTransform> placed = new osg::MatrixTransform(osg::Matrixd::rotate(-osg::PI_2, 1, 0, 0));
    placed->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    placed->addChild(card(0.5, osg::Vec4(0.2f, 0.7f, 0.3f, 1)));
    overlay->addChild(placed);
    const Picture plain = renderer.render(overlay, 2);
    EXPECT_GT(plain.alpha(16, 16), 0.5f);
    EXPECT_EQ(plain.rgba, renderer.render(furnace(overlay), 2).rgba);
}

}  // namespace Features_test
