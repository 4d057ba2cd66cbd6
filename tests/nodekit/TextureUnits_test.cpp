// SPDX-License-Identifier: MIT
// The rows of the README's table of OpenSceneGraph's features that are of textures.
#include <osgEnvLight/Material>

#include <osg/TexEnv>
#include <osg/TexEnvCombine>
#include <osg/TexGen>
#include <osg/TexGenNode>
#include <osg/TexMat>
#include <osg/TextureCubeMap>

#include <gtest/gtest.h>

#include "FeatureCards.h"

namespace TextureUnits_test
{

using namespace feature_cards;

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

// Material .5, in the second unit a texel of .25 with alpha .5, environment colour (1, 0, 0): as the fixed function combines
// display values.
TEST_F(Features, TextureUnitsAfterTheFirst)
{
    using Combine = osg::TexEnvCombine;
    const auto combine = [](GLint how, float scale) {
        const osg::ref_ptr<Combine> c = new Combine;
        c->setCombine_RGB(how);
        c->setSource0_RGB(Combine::PREVIOUS);
        c->setSource1_RGB(Combine::TEXTURE);
        c->setScale_RGB(scale);
        return osg::ref_ptr<osg::StateAttribute>(c);
    };
    const auto environment = [](osg::TexEnv::Mode mode) {
        const osg::ref_ptr<osg::TexEnv> env = new osg::TexEnv(mode);
        env->setColor(osg::Vec4(1, 0, 0, 1));
        return osg::ref_ptr<osg::StateAttribute>(env);
    };
    const osg::ref_ptr<Combine> byAlpha = new Combine;
    byAlpha->setCombine_RGB(Combine::INTERPOLATE);
    byAlpha->setSource0_RGB(Combine::TEXTURE);
    byAlpha->setSource1_RGB(Combine::PREVIOUS);
    byAlpha->setSource2_RGB(Combine::TEXTURE);
    byAlpha->setOperand2_RGB(Combine::SRC_ALPHA);
    const osg::Vec4ub texel(64, 64, 64, 128);
    const double t = 64.0 / 255.0, a = 128.0 / 255.0;
    const osg::Vec3d white(1, 1, 1);
    const std::pair<osg::ref_ptr<osg::StateAttribute>, osg::Vec3d> rows[] = {
        {nullptr, white * (0.5 * t)},
        {environment(osg::TexEnv::REPLACE), white * t},
        {environment(osg::TexEnv::DECAL), white * (0.5 * (1 - a) + t * a)},
        {environment(osg::TexEnv::BLEND), osg::Vec3d(0.5 * (1 - t) + t, 0.5 * (1 - t), 0.5 * (1 - t))},
        {environment(osg::TexEnv::ADD), white * (0.5 + t)},
        {combine(Combine::MODULATE, 2.0f), white * t},
        {combine(Combine::ADD_SIGNED, 1.0f), white * t},
        {combine(Combine::ADD, 4.0f), white},
        {byAlpha, white * (0.5 * (1 - a) + t * a)}};
    for (const bool first : {false, true})
        for (const unsigned unit : {1u, 3u})
            for (const auto& [env, display] : rows) {
                // Of the first unit's texture or of the material.
                const float below = first ? 1.0f : 0.5f;
                const osg::ref_ptr<osg::Geode> model = card(3.0, osg::Vec4(below, below, below, 1));
                model->getDrawable(0)->asGeometry()->setTexCoordArray(3,
                                                                      model->getDrawable(0)->asGeometry()->getTexCoordArray(0));
                osg::StateSet& s = *model->getStateSet();
                const osg::Vec4ub half(128, 128, 128, 255);
                if (first) s.setTextureAttributeAndModes(0, texture(twoHalves(half, half)).get());
                s.setTextureAttributeAndModes(unit, texture(twoHalves(texel, texel)).get());
                if (env) s.setTextureAttribute(unit, env);
                const osg::Vec3d c = lit(model);
                // 128 is not quite a half
                for (int k = 0; k < 3; ++k)
                    EXPECT_NEAR(c[k], decoded(display[k]), first ? 2.5 * small : small) << "row " << &display - &rows[0].second;
            }
}

// A product of a texture with the direction to a light, in whatever unit, is a normal map; the colours are that direction.
TEST_F(Features, NormalMapsOfFixedFunction)
{
    const osg::ref_ptr<osg::TexEnvCombine> dot3 = new osg::TexEnvCombine;
    dot3->setCombine_RGB(osg::TexEnvCombine::DOT3_RGB);
    dot3->setSource0_RGB(osg::TexEnvCombine::TEXTURE);
    dot3->setSource1_RGB(osg::TexEnvCombine::PRIMARY_COLOR);
    const osg::Vec4ub leaning(191, 128, 238, 255);  // by 30 degrees to the right
    for (const unsigned unit : {0u, 1u}) {
        const osg::ref_ptr<osg::Geode> model = card();
        osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(osg::Array::BIND_OVERALL, 1);
        (*colors)[0] = osg::Vec4(0.1f, 0.9f, 0.2f, 1.0f);
        model->getDrawable(0)->asGeometry()->setColorArray(colors);
        osg::StateSet& s = *model->getStateSet();
        s.removeAttribute(osg::StateAttribute::MATERIAL);
        s.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        s.setTextureAttributeAndModes(unit, texture(twoHalves(leaning, leaning)).get());
        s.setTextureAttribute(unit, dot3);
        s.setTextureAttributeAndModes(1 - unit, texture(twoHalves(red, red)).get());
        const osg::Vec3d c = lit(model);
        EXPECT_NEAR(c[0], 1.0, small) << "red in white light, unit " << unit;
        EXPECT_NEAR(c[1], 0.0, small);
        const osg::ref_ptr<LitScene> scene = furnace(model);
        scene->getSettings()->view = Settings::NORMAL;
        const osg::Vec3d n = renderer.render(scene, 2).color(size / 2, size / 2) * 2.0 - osg::Vec3d(1, 1, 1);
        EXPECT_NEAR(n[0], 0.5, 0.01);
        EXPECT_NEAR(n[1], -0.866, 0.01);
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
            expectAsWithout(model, "generated otherwise than by planes, or in part");
        }
}

// Planes in the space of the model, of the eye, and of a TexGenNode, which turns and projects them: a slide projector's.
TEST_F(Features, GeneratedCoordinatesAfterTheFirstUnit)
{
    for (const unsigned unit : {1u, 3u})
        for (const int kind : {0, 1, 2}) {
            const osg::ref_ptr<osg::Group> model = new osg::Group;
            model->addChild(card());
            osg::StateSet& s = *model->getOrCreateStateSet();
            const osg::ref_ptr<osg::Texture2D> halves = texture(twoHalves(red, blue));
            halves->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
            s.setTextureAttributeAndModes(unit, halves);
            const osg::ref_ptr<osg::TexGen> gen = new osg::TexGen;
            gen->setMode(kind == 0 ? osg::TexGen::OBJECT_LINEAR : osg::TexGen::EYE_LINEAR);
            gen->setPlane(osg::TexGen::S, osg::Plane(kind == 2 ? -1.0 / 3.0 : 1.0 / 6.0, 0, 0, kind == 2 ? 1.0 : 0.5));
            gen->setPlane(osg::TexGen::T, osg::Plane(0, 0, 0, 0.5));
            gen->setPlane(osg::TexGen::Q, osg::Plane(0, 0, 0, 2));
            for (const GLenum mode : {GLenum(GL_TEXTURE_GEN_S), GLenum(GL_TEXTURE_GEN_T)})
                s.setTextureMode(unit, mode, osg::StateAttribute::ON);
            if (kind == 2) {
                s.setTextureMode(unit, GL_TEXTURE_GEN_Q, osg::StateAttribute::ON);
                const osg::ref_ptr<osg::TexGenNode> node = new osg::TexGenNode(gen);
                node->setTextureUnit(unit);
                model->addChild(node);
            } else {
                s.setTextureAttribute(unit, gen);
            }
            EXPECT_NEAR(1.0, lit(model, 4)[kind == 2 ? 2 : 0], small) << "unit " << unit << " kind " << kind;
            EXPECT_NEAR(1.0, lit(model, size - 5)[kind == 2 ? 0 : 2], small) << "unit " << unit << " kind " << kind;
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

}  // namespace TextureUnits_test
