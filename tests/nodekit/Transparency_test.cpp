// SPDX-License-Identifier: MIT
// What is blended, and what has lost its image: in hosts that give images away when they have uploaded them.
#include <SceneRenderer.h>

#include <osgEnvLight/Material>
#include "surface/SurfaceFacts.h"

#include <osg/BlendFunc>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/Texture2D>
#include <osg/Texture3D>

#include <gtest/gtest.h>

#include <set>

namespace Transparency_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

const int size = 32;

osg::ref_ptr<osg::Image> image(const osg::Vec4ub& left, const osg::Vec4ub& right)
{
    osg::ref_ptr<osg::Image> result = new osg::Image;
    result->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            *reinterpret_cast<osg::Vec4ub*>(result->data(unsigned(x), unsigned(y))) = x < 4 ? left : right;
    return result;
}

// A card before the camera at (0,-4,0) that fills its view, textured from left to right.
osg::ref_ptr<osg::Geode> card(double y, const osg::Vec4& color)
{
    osg::ref_ptr<osg::Geode> geode = makeQuad(osg::Vec3d(-3, y, -3), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 0, 6));
    osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array;
    for (const osg::Vec2& p : {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)}) st->push_back(p);
    geode->getDrawable(0)->asGeometry()->setTexCoordArray(0, st.get());
    osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT_AND_BACK, color);
    geode->getOrCreateStateSet()->setAttributeAndModes(m.get());
    return geode;
}

osg::ref_ptr<osg::Texture2D> texture(osg::Image* picture)
{
    osg::ref_ptr<osg::Texture2D> t = new osg::Texture2D(picture);
    t->setUnRefImageDataAfterApply(true);  // as osgUtil::Optimizer has it for all that osgviewer loads
    t->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    t->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    return t;
}

// A red wall behind cards, in a white furnace.
osg::ref_ptr<LitScene> wallBehind(osg::Node* cards)
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->occlusion = false;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->addChild(card(1.0, osg::Vec4(1, 0, 0, 1)));
    lit->addChild(cards);
    return lit;
}

// With one context OSG does so itself as soon as it has uploaded it; other tests may have made more.
void giveAway(osg::Texture2D& t)
{
    if (t.getImage()) t.setImage(nullptr);
}

void blend(osg::Node& node)
{
    node.getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
}

}  // namespace

TEST(Transparency, ACardStaysTransparentWhenItsImageIsGone)
{
    SceneRenderer renderer(size, size);
    const osg::ref_ptr<osg::Geode> green = card(0.0, osg::Vec4(1, 1, 1, 1));
    const osg::ref_ptr<osg::Texture2D> t = texture(image(osg::Vec4ub(0, 255, 0, 0), osg::Vec4ub(0, 255, 0, 255)));
    green->getOrCreateStateSet()->setTextureAttributeAndModes(0, t.get());
    blend(*green);
    const osg::ref_ptr<LitScene> lit = wallBehind(green);
    for (int frame = 1; frame <= 3; ++frame) {
        const Picture p = renderer.render(lit, 1);
        EXPECT_NEAR(p.color(4, 16)[0], 1.0, 0.01) << "frame " << frame;  // the wall through the left half
        EXPECT_NEAR(p.color(4, 16)[1], 0.0, 0.01) << "frame " << frame;
        EXPECT_NEAR(p.color(28, 16)[1], 1.0, 0.01) << "frame " << frame;
        giveAway(*t);
    }
}

TEST(Transparency, ATextureThatWasUploadedBeforeWeSawItIsJudgedByItsFormat)
{
    SceneRenderer renderer(size, size);
    const osg::ref_ptr<osg::Geode> green = card(0.0, osg::Vec4(1, 1, 1, 1));
    const osg::ref_ptr<osg::Texture2D> t = texture(image(osg::Vec4ub(0, 255, 0, 0), osg::Vec4ub(0, 255, 0, 255)));
    green->getOrCreateStateSet()->setTextureAttributeAndModes(0, t.get());
    blend(*green);
    renderer.render(green, 2);  // without us
    giveAway(*t);
    const Picture p = renderer.render(wallBehind(green), 2);
    EXPECT_NEAR(p.color(4, 16)[0], 1.0, 0.01);
    EXPECT_NEAR(p.color(28, 16)[1], 1.0, 0.01);
}

TEST(Transparency, VertexAndMaterialAlphaWithoutATransparentBin)
{
    SceneRenderer renderer(size, size);
    for (bool vertices : {false, true}) {
        const osg::ref_ptr<osg::Geode> green = card(0.0, osg::Vec4(0, 1, 0, vertices ? 1.0f : 0.25f));
        if (vertices) {
            osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
            colors->push_back(osg::Vec4(0, 1, 0, 0.25f));
            green->getDrawable(0)->asGeometry()->setColorArray(colors.get(), osg::Array::BIND_OVERALL);
            osg::ref_ptr<osg::Material> m = new osg::Material;
            m->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
            green->getOrCreateStateSet()->setAttributeAndModes(m.get());
        }
        blend(*green);
        const osg::Vec3d c = renderer.render(wallBehind(green), 2).color(16, 16);
        EXPECT_NEAR(c[0], 0.75, 0.01) << "vertices " << vertices;
        EXPECT_NEAR(c[1], 0.25, 0.01) << "vertices " << vertices;
    }
}

TEST(Transparency, ATransparentBinWithoutBlendingIsOpaqueAndLitLikeTheRest)
{
    SceneRenderer renderer(size, size);
    const osg::ref_ptr<osg::Geode> green = card(0.0, osg::Vec4(0, 1, 0, 0.25f));
    green->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    const osg::ref_ptr<LitScene> lit = wallBehind(green);
    const osg::Vec3d c = renderer.render(lit, 2).color(16, 16);
    EXPECT_NEAR(c[0], 0.0, 0.01);
    EXPECT_NEAR(c[1], 1.0, 0.01);
    EXPECT_EQ(lit->plan().surfaces.forward, 0u);
}

namespace
{

// A grey card that is glossy or not, opaque or as good as that but drawn after the composite.
osg::ref_ptr<LitScene> glossyCard(bool glossy, bool transparent)
{
    const osg::ref_ptr<LitScene> lit = makeLit(lopsidedMap().get());
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    const osg::ref_ptr<osg::Geode> grey = card(0.0, osg::Vec4(1, 1, 1, transparent ? 0.9999f : 1.0f));
    osg::StateSet& s = *grey->getOrCreateStateSet();
    if (glossy)
        osgEnvLight::Material::setCookTorrance(s, osg::Vec3f(0.5f, 0.5f, 0.5f), 0.0f, 0.8f);
    else
        osgEnvLight::Material::setLambert(s, osg::Vec3f(0.5f, 0.5f, 0.5f));
    if (transparent) blend(*grey);
    lit->addChild(grey);
    return lit;
}

}  // namespace

// Terms that are switched off, whatever carries D, and lists of the application's own.
TEST(Transparency, TermsAreThoseOfOpaqueSurfaces)
{
    SceneRenderer renderer(size, size);
    const auto list = std::make_shared<osgEnvLight::LightList>();
    list->push_back({osg::Vec3d(0.6, -0.8, 0), osg::Vec3d(3, 2, 1)});
    std::set<double> seen;
    const auto expectEqual = [&](const char* what, bool glossy, bool given,
                                 const std::vector<std::pair<std::string, std::string>>& set) {
        osg::Vec3d color[2];
        for (const bool transparent : {false, true}) {
            const osg::ref_ptr<LitScene> lit = glossyCard(glossy, transparent);
            if (given) lit->getEnvironmentMap()->setLights(list);
            std::string error;
            for (const auto& [name, value] : set) ASSERT_TRUE(lit->getSettings()->set(name, value, error)) << error;
            color[transparent] = renderer.render(lit, 2).color(16, 16);
            EXPECT_EQ(lit->plan().surfaces.litForward, transparent ? 1u : 0u) << what;
        }
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(color[1][k], color[0][k], 2e-3 * color[0][k]) << what << ", channel " << k;
        seen.insert(color[0][0]);
    };
    expectEqual("by harmonics", false, false, {{"diffuseCarrier", "sh"}});
    expectEqual("by 16 lights", false, false, {{"diffuseCarrier", "lights"}, {"diffuseLights", "16"}, {"lightWeights", "off"}});
    expectEqual("by a list", false, true, {});
    expectEqual("without D", false, false, {{"diffuse", "off"}});
    expectEqual("without S", true, false, {{"specular", "off"}});
    expectEqual("without either", true, false, {{"specular", "off"}, {"diffuse", "off"}});
    EXPECT_EQ(seen.size(), 5u);  // two are black
}

TEST(Transparency, ACardsShadowKeepsItsHolesWhenItsImageIsGone)
{
    // Light from +Z alone onto a floor; above it a card whose left half is not there.
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -6, 3), osg::Vec3d());
    const auto map = makeMap(64, 32, [](const osg::Vec3d& d) { return d.z() > 0.97 ? osg::Vec3d(9, 9, 9) : osg::Vec3d(); });
    const osg::ref_ptr<LitScene> lit = makeLit(map.get());
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->addChild(makeQuad(osg::Vec3d(-2, -2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    const osg::ref_ptr<osg::Geode> above = makeQuad(osg::Vec3d(-1, -1, 1), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0));
    osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array;
    for (const osg::Vec2& p : {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)}) st->push_back(p);
    above->getDrawable(0)->asGeometry()->setTexCoordArray(0, st.get());
    above->getOrCreateStateSet()->setTextureAttributeAndModes(
        0, texture(image(osg::Vec4ub(255, 255, 255, 0), osg::Vec4ub(255, 255, 255, 255))).get());
    blend(*above);
    lit->addChild(above);
    const Picture p = renderer.render(lit, 4);
    const auto at = [&](double x) {
        const osg::Vec2d pixel = renderer.pixelOf(osg::Vec3d(x, -0.5, 0));
        return p.color(int(pixel.x()), int(pixel.y()))[0];
    };
    EXPECT_GT(at(-0.5), 0.8 * at(-1.8));
    EXPECT_LT(at(0.5), 0.2 * at(1.8));
}

TEST(Transparency, ATextureWithoutAnImageShowsTheMaterial)
{
    SceneRenderer renderer(size, size);
    osg::ref_ptr<osg::Image> hollow = new osg::Image;
    hollow->setFileName("not/there.png");
    for (osg::Image* missing : {static_cast<osg::Image*>(nullptr), hollow.get()}) {
        const osg::ref_ptr<osg::Geode> white = card(0.0, osg::Vec4(1, 1, 1, 1));
        white->getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D(missing));
        EXPECT_NEAR(renderer.render(wallBehind(white), 2).color(16, 16)[1], 1.0, 0.01);
        blend(*white);
        EXPECT_NEAR(renderer.render(wallBehind(white), 2).color(16, 16)[1], 1.0, 0.01) << "blended";
    }
}

TEST(Transparency, AnAlphaTextureHasTheMaterialsColour)
{
    SceneRenderer renderer(size, size);
    const osg::ref_ptr<osg::Geode> white = card(0.0, osg::Vec4(0, 1, 0, 1));
    osg::ref_ptr<osg::Image> alpha = new osg::Image;
    alpha->allocateImage(8, 8, 1, GL_ALPHA, GL_UNSIGNED_BYTE);
    std::fill_n(alpha->data(), 64, static_cast<unsigned char>(64));
    white->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture(alpha).get());
    EXPECT_NEAR(renderer.render(wallBehind(white), 2).color(16, 16)[1], 1.0, 0.01) << "opaque";
    blend(*white);
    EXPECT_NEAR(renderer.render(wallBehind(white), 2).color(16, 16)[1], 64.0 / 255.0, 0.01) << "blended";
}

TEST(Transparency, TexelsAreReadOnceAndForgottenWithTheirTexture)
{
    const osg::ref_ptr<osgEnvLight::SurfaceFacts> facts = new osgEnvLight::SurfaceFacts;
    osg::ref_ptr<osg::Image> picture = image(osg::Vec4ub(1, 1, 1, 255), osg::Vec4ub(1, 1, 1, 255));
    osg::ref_ptr<osg::Texture2D> t = new osg::Texture2D(picture);
    EXPECT_FALSE(facts->of(*t).translucent);
    picture->data()[3] = 0;
    EXPECT_FALSE(facts->of(*t).translucent) << "not told yet: nothing is read";
    picture->dirty();
    EXPECT_TRUE(facts->of(*t).translucent);
    picture->data()[3] = 255;
    picture->dirty();
    EXPECT_TRUE(facts->of(*t).translucent) << "what keeps changing is judged by its format";
    t->setImage(nullptr);
    EXPECT_TRUE(facts->of(*t).translucent) << "remembered";
    EXPECT_EQ(facts->size(), 1u);
    for (int i = 0; i < 2000; ++i) facts->of(*osg::ref_ptr<osg::Texture2D>(new osg::Texture2D(picture)));
    EXPECT_LE(facts->size(), 512u);
}

}  // namespace Transparency_test
