// SPDX-License-Identifier: MIT
// The README's table of OpenSceneGraph's features, a test a row: lit, or drawn exactly as without the node and said so once.
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <osg/BlendFunc>
#include <osg/ClipNode>
#include <osg/ClipPlane>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Fog>
#include <osg/FragmentProgram>
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
#include <osg/TexEnv>
#include <osg/TexEnvCombine>
#include <osg/TexGen>
#include <osg/TexMat>
#include <osg/Texture1D>
#include <osg/Texture2D>
#include <osg/Texture3D>
#include <osg/TextureCubeMap>
#include <osg/TextureRectangle>

#include <gtest/gtest.h>

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

const int size = 32;

double decoded(double c)
{
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

osg::ref_ptr<osg::Image> twoHalves(const osg::Vec4ub& left, const osg::Vec4ub& right, int rows = 8, int layers = 1)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, rows, layers, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int z = 0; z < layers; ++z)
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < 8; ++x)
                *reinterpret_cast<osg::Vec4ub*>(image->data(unsigned(x), unsigned(y), unsigned(z))) = x < 4 ? left : right;
    return image;
}

const osg::Vec4ub red(255, 0, 0, 255), blue(0, 0, 255, 255), grey(128, 128, 128, 255);

void sharp(osg::Texture& t)
{
    t.setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    t.setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
}

osg::ref_ptr<osg::Texture2D> texture(osg::Image* image)
{
    osg::ref_ptr<osg::Texture2D> t = new osg::Texture2D(image);
    sharp(*t);
    return t;
}

// Before the camera at (0,-4,0), with coordinates from 0 at the left to 1 at the right; lit from the front without the node, too.
osg::ref_ptr<osg::Geode> card(double half = 3.0, const osg::Vec4& color = osg::Vec4(1, 1, 1, 1))
{
    osg::ref_ptr<osg::Geode> geode =
        makeQuad(osg::Vec3d(-half, 0, -half), osg::Vec3d(2 * half, 0, 0), osg::Vec3d(0, 0, 2 * half));
    osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array;
    for (const osg::Vec2& p : {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)}) st->push_back(p);
    geode->getDrawable(0)->asGeometry()->setTexCoordArray(0, st.get());
    geode->getDrawable(0)->asGeometry()->setTexCoordArray(1, st.get());
    osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT_AND_BACK, color);
    geode->getOrCreateStateSet()->setAttributeAndModes(m.get());
    return geode;
}

osg::ref_ptr<LitScene> furnace(osg::Node* model)
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->occlusion = false;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->addChild(model);
    return lit;
}

}  // namespace

class Features : public testing::Test
{
  protected:
    // Lit by the furnace in which a white surface is 1.
    osg::Vec3d lit(osg::Node* model, int x = size / 2, int y = size / 2)
    {
        const osg::ref_ptr<LitScene> scene = furnace(model);
        const osg::Vec3d c = renderer.render(scene, 2).color(x, y);
        EXPECT_EQ(scene->plan().surfaces.forward, 0u);
        EXPECT_GT(scene->plan().surfaces.deferred, 0u);
        return c;
    }

    void expectAsWithout(osg::Node* model, const std::string& said)
    {
        const Picture plain = renderer.render(model, 2);
        const osg::ref_ptr<LitScene> scene = furnace(model);
        NotifyCatcher notify;
        const Picture found = renderer.render(scene, 3);
        EXPECT_EQ(plain.rgba, found.rgba) << said;
        const size_t first = notify.text().find(said);
        EXPECT_NE(first, std::string::npos) << notify.text();
        EXPECT_EQ(notify.text().find(said, first + 1), std::string::npos) << "once: " << notify.text();
    }

    SceneRenderer renderer{size, size};
    const double small = 0.003;  // as in Surfaces_test.cpp
};

TEST_F(Features, TextureEnvironments)
{
    // Material .5, texel .25 with alpha .5, environment colour (1, 0, 0): as the fixed function combines display values.
    const osg::Vec4ub texel(64, 64, 64, 128);
    const double t = 64.0 / 255.0, a = 128.0 / 255.0;
    const std::pair<osg::TexEnv::Mode, osg::Vec3d> rows[] = {
        {osg::TexEnv::REPLACE, osg::Vec3d(t, t, t)},
        {osg::TexEnv::DECAL, osg::Vec3d(1, 1, 1) * (0.5 * (1 - a) + t * a)},
        {osg::TexEnv::BLEND, osg::Vec3d(0.5 * (1 - t) + t, 0.5 * (1 - t), 0.5 * (1 - t))},
        {osg::TexEnv::ADD, osg::Vec3d(0.5 + t, 0.5 + t, 0.5 + t)}};
    for (const auto& [mode, display] : rows) {
        const osg::ref_ptr<osg::Geode> model = card(3.0, osg::Vec4(0.5f, 0.5f, 0.5f, 1));
        model->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture(twoHalves(texel, texel)).get());
        model->getOrCreateStateSet()->setTextureAttribute(0, new osg::TexEnv(mode));
        static_cast<osg::TexEnv*>(model->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXENV))
            ->setColor(osg::Vec4(1, 0, 0, 1));
        const osg::Vec3d c = lit(model);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(c[k], decoded(display[k]), small) << "mode " << mode;
    }
}

TEST_F(Features, TextureMatrices)
{
    const osg::ref_ptr<osg::Geode> model = card();
    model->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture(twoHalves(red, blue)).get());
    EXPECT_NEAR(lit(model, 4)[0], 1.0, small);
    model->getOrCreateStateSet()->setTextureAttribute(
        0, new osg::TexMat(osg::Matrixd::scale(-1, 1, 1) * osg::Matrixd::translate(1, 0, 0)));
    EXPECT_NEAR(lit(model, 4)[2], 1.0, small);
}

TEST_F(Features, GeneratedCoordinates)
{
    for (bool eye : {false, true})
        for (double sense : {1.0, -1.0}) {
            const osg::ref_ptr<osg::Geode> model = card();
            model->getDrawable(0)->asGeometry()->setTexCoordArray(0, nullptr);
            osg::StateSet& s = *model->getOrCreateStateSet();
            s.setTextureAttributeAndModes(0, texture(twoHalves(red, blue)).get());
            const osg::ref_ptr<osg::TexGen> gen = new osg::TexGen;
            gen->setMode(eye ? osg::TexGen::EYE_LINEAR : osg::TexGen::OBJECT_LINEAR);
            gen->setPlane(osg::TexGen::S, osg::Plane(sense / 6.0, 0, 0, 0.5));
            gen->setPlane(osg::TexGen::T, osg::Plane(0, 0, 1.0 / 6.0, 0.5));
            s.setTextureAttribute(0, gen);
            s.setTextureMode(0, GL_TEXTURE_GEN_S, osg::StateAttribute::ON);
            s.setTextureMode(0, GL_TEXTURE_GEN_T, osg::StateAttribute::ON);
            EXPECT_NEAR(lit(model, 4)[sense > 0 ? 0 : 2], 1.0, small) << "eye " << eye;
            s.setTextureMode(0, GL_TEXTURE_GEN_T, osg::StateAttribute::OFF);
            expectAsWithout(model, "texture coordinates that are generated in part");
        }
}

TEST_F(Features, PaintedReflectionsAreMetal)
{
    for (bool cube : {false, true}) {
        const osg::ref_ptr<osg::Geode> model = makeSphere(osg::Vec3d(), 1.0, 64);
        osg::StateSet& s = *model->getOrCreateStateSet();
        s.setAttributeAndModes(card()->getStateSet()->getAttribute(osg::StateAttribute::MATERIAL));
        const osg::ref_ptr<osg::TexGen> gen = new osg::TexGen;
        gen->setMode(cube ? osg::TexGen::REFLECTION_MAP : osg::TexGen::SPHERE_MAP);
        if (cube) {
            const osg::ref_ptr<osg::TextureCubeMap> faces = new osg::TextureCubeMap;
            for (unsigned i = 0; i < 6; ++i) faces->setImage(i, twoHalves(red, blue));
            s.setTextureAttributeAndModes(0, faces);
        } else {
            s.setTextureAttributeAndModes(0, texture(twoHalves(red, blue)).get());
        }
        s.setTextureAttributeAndModes(0, gen);
        const osg::Vec3d c = lit(model);
        EXPECT_NEAR(c[0], 0.9, 0.01) << "its reflectance in a white furnace, whatever is painted on; cube " << cube;
        EXPECT_NEAR(c[2], 0.9, 0.01);
        s.setTextureAttribute(0, new osg::TexEnv(osg::TexEnv::ADD));
        EXPECT_NEAR(lit(model)[0], 1.0, 0.01) << "a highlight on white: all of what it gets, reflected or scattered";
        osgEnvLight::Material::setLambert(s, osg::Vec3f(0.5f, 0.5f, 0.5f));
        EXPECT_NEAR(lit(model)[0], 0.5, 0.01) << "a material of ours says more than a painted reflection";
    }
}

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
    const osg::ref_ptr<osg::TextureRectangle> rectangle = new osg::TextureRectangle(twoHalves(red, blue));
    const std::pair<Change, const char*> rows[] = {
        {mode(stencil), "the stencil test"},
        {mode(new osg::Scissor(0, 0, 20, 20)), "the scissor test"},
        {mode(new osg::ColorMask(true, false, true, true)), "colour masks"},
        {mode(new osg::LogicOp(osg::LogicOp::COPY)), "logic operations"},
        {mode(new osg::BlendFunc(GL_ONE, GL_ONE)), "blending other than by alpha"},
        {mode(new osg::Depth(osg::Depth::ALWAYS)), "depth tests for other than the nearest"},
        {mode(new osg::Depth(osg::Depth::LESS, 0.0, 0.5)), "depth tests for other than the nearest"},
        {unit(1, texture(twoHalves(red, blue))), "texture units beyond the first"},
        {unit(0, line), "textures other than Texture2D"},
        {unit(0, volume), "textures other than Texture2D"},
        {unit(0, rectangle), "textures other than Texture2D"},
        {[](osg::StateSet& s) {
             s.setTextureAttributeAndModes(0, texture(twoHalves(red, blue)).get());
             s.setTextureAttribute(0, new osg::TexEnvCombine);
         },
         "texture environments that combine"}};
    for (const auto& [change, said] : rows) {
        const osg::ref_ptr<osg::Geode> model = card();
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

TEST_F(Features, FogIsNotDrawnAndSaidSoOnce)
{
    const osg::ref_ptr<osg::Geode> model = card();
    const osg::ref_ptr<osg::Fog> fog = new osg::Fog;
    fog->setColor(osg::Vec4(0, 0, 1, 1));
    model->getOrCreateStateSet()->setAttributeAndModes(fog);
    NotifyCatcher notify;
    EXPECT_NEAR(lit(model)[0], 1.0, small);
    const size_t first = notify.text().find("fog: not drawn");
    EXPECT_NE(first, std::string::npos);
    EXPECT_EQ(notify.text().find("fog", first + 4), std::string::npos);
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
