// SPDX-License-Identifier: MIT
// What a drawable sends to other surfaces, as one colour.
#include "surface/SentLightState.h"
#include "surface/StaticCasters.h"

#include <osg/TexEnv>
#include <osg/Texture2D>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace SentLight_test
{

using namespace osgEnvLight;

namespace
{

// sRGB's curve at .5.
const float half = 0.21404114f;

osg::ref_ptr<osg::Texture2D> makeTexture(const std::vector<osg::Vec4ub>& texels)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(texels.size()), 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned i = 0; i < texels.size(); ++i) std::copy_n(texels[i].ptr(), 4, image->data(i, 0));
    return new osg::Texture2D(image);
}

osg::ref_ptr<osg::Material> makeMaterial(const osg::Vec3f& diffuse, const osg::Vec3f& specular = osg::Vec3f())
{
    osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(diffuse, 1));
    m->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(specular, 1));
    return m;
}

SentLight sentBy(const osg::StateSet& stateSet, const osg::Geometry& geometry = *osg::ref_ptr<osg::Geometry>(new osg::Geometry),
                 bool display = true)
{
    SentLightState state;
    state.merge(stateSet);
    return state.sentLight(geometry, display);
}

void expectColor(const osg::Vec3f& expected, const osg::Vec3f& c)
{
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(expected[k], c[k], 2e-3f) << k;
}

osg::Vec3f reflectance(const SentLight& sent)
{
    return sent.diffuse + sent.glossy;
}

}  // namespace

TEST(SentLight, OfMaterialsIsTheirDiffuseAndSpecular)
{
    osg::ref_ptr<osg::StateSet> s = new osg::StateSet;
    s->setAttribute(makeMaterial(osg::Vec3f(0.5f, 1, 0)));
    expectColor(osg::Vec3f(half, 0.98f, 0), reflectance(sentBy(*s)));
    expectColor(osg::Vec3f(0.5f, 0.98f, 0), reflectance(sentBy(*s, *osg::ref_ptr<osg::Geometry>(new osg::Geometry), false)));
    s->setAttribute(makeMaterial(osg::Vec3f(0.5f, 0, 0), osg::Vec3f(0.5f, 0, 0)));
    expectColor(osg::Vec3f(2 * half, 0, 0), reflectance(sentBy(*s)));
    s->setAttribute(makeMaterial(osg::Vec3f(1, 1, 0), osg::Vec3f(1, 1, 1)));
    expectColor(osg::Vec3f(0.98f, 0.98f, 0.5f), reflectance(sentBy(*s)));  // no more than it gets, in its colours
}

TEST(SentLight, OfOurMaterialsIsThatOfBothLayers)
{
    osg::ref_ptr<osg::StateSet> s = new osg::StateSet;
    Material::setLambert(*s, osg::Vec3f(0.1f, 0.2f, 0.3f));
    expectColor(osg::Vec3f(0.1f, 0.2f, 0.3f), reflectance(sentBy(*s)));
    Material::setBlinnPhong(*s, osg::Vec3f(0.1f, 0.2f, 0.3f), osg::Vec3f(0.5f, 0.5f, 0.5f), 10);
    expectColor(osg::Vec3f(0.6f, 0.7f, 0.8f), reflectance(sentBy(*s)));
    Material::setCookTorrance(*s, osg::Vec3f(0.9f, 0.6f, 0.3f), 1.0f, 0.2f);
    expectColor(osg::Vec3f(0.905f, 0.619f, 0.333f), reflectance(sentBy(*s)));
    Material::setCookTorrance(*s, osg::Vec3f(0.5f, 0.5f, 0.5f), 0.0f, 0.2f);
    expectColor(osg::Vec3f(0.543f, 0.543f, 0.543f), reflectance(sentBy(*s)));
    Material::setStrauss(*s, osg::Vec3f(0.5f, 0.5f, 0.5f), 0.0f, 0.0f);
    expectColor(osg::Vec3f(0.5f, 0.5f, 0.5f), sentBy(*s).diffuse);
    Material::setEmission(*s, osg::Vec3f(2, 3, 4));
    expectColor(osg::Vec3f(2, 3, 4), sentBy(*s).emission);
}

TEST(SentLight, IsThatOfEachLayer)
{
    osg::ref_ptr<osg::StateSet> s = new osg::StateSet;
    s->setAttribute(makeMaterial(osg::Vec3f(0.5f, 0, 0), osg::Vec3f(0, 0.5f, 0)));
    expectColor(osg::Vec3f(half, 0, 0), sentBy(*s).diffuse);
    expectColor(osg::Vec3f(0, half, 0), sentBy(*s).glossy);
    // A mirror of Phong's reflects the cosine: two thirds of light from all sides.
    Material::setPhong(*s, osg::Vec3f(0.1f, 0.2f, 0.3f), osg::Vec3f(0.6f, 0.6f, 0.6f), 1000);
    expectColor(osg::Vec3f(0.1f, 0.2f, 0.3f), sentBy(*s).diffuse);
    expectColor(osg::Vec3f(0.4f, 0.4f, 0.4f), sentBy(*s).glossy);
    Material::setLambert(*s, osg::Vec3f(0.1f, 0.2f, 0.3f));
    expectColor(osg::Vec3f(), sentBy(*s).glossy);
    // Light from all sides meets glass at all angles: 1 / 21 of the way from .04 to 1.
    Material::setCookTorrance(*s, osg::Vec3f(0.5f, 0.5f, 0.5f), 0.0f, 0.2f);
    expectColor(osg::Vec3f(0.0857f, 0.0857f, 0.0857f), sentBy(*s).glossy);
    expectColor(osg::Vec3f(0.457f, 0.457f, 0.457f), sentBy(*s).diffuse);
    Material::setCookTorrance(*s, osg::Vec3f(0.5f, 0.5f, 0.5f), 1.0f, 0.2f);
    expectColor(osg::Vec3f(), sentBy(*s).diffuse);
    Material::setStrauss(*s, osg::Vec3f(0.5f, 0.5f, 0.5f), 1.0f, 1.0f);
    expectColor(osg::Vec3f(), sentBy(*s).diffuse);
    EXPECT_NEAR(0.34f, sentBy(*s).glossy[0], 0.01f);  // two thirds of .5, and Fresnel's rise
}

// As the lobes that pixels have: roughness is the root of alpha, and alpha = sqrt(2 / (n + 2)).
TEST(SentLight, KnowsHowRoughTheLobeIs)
{
    osg::ref_ptr<osg::StateSet> s = new osg::StateSet;
    const osg::ref_ptr<osg::Material> material = makeMaterial(osg::Vec3f(0.5f, 0, 0), osg::Vec3f(0, 0.5f, 0));
    material->setShininess(osg::Material::FRONT_AND_BACK, 30);
    s->setAttribute(material);
    EXPECT_FLOAT_EQ(0.5f, sentBy(*s).roughness);
    Material::setCookTorrance(*s, osg::Vec3f(0.9f, 0.6f, 0.3f), 1.0f, 0.3f);
    EXPECT_FLOAT_EQ(0.3f, sentBy(*s).roughness);
    Material::setPhong(*s, osg::Vec3f(), osg::Vec3f(0.6f, 0.6f, 0.6f), 510.0f);
    EXPECT_FLOAT_EQ(0.25f, sentBy(*s).roughness);
    Material::setPhong(*s, osg::Vec3f(), osg::Vec3f(0.6f, 0.6f, 0.6f), std::numeric_limits<float>::quiet_NaN());
    EXPECT_FLOAT_EQ(1.0f, sentBy(*s).roughness);
}

// Ke 9 of an OBJ's lamp is nine times white, not what the display's curve would make of it.
TEST(SentLight, OfAHostsEmissionAboveOneIsLinear)
{
    const osg::ref_ptr<osg::StateSet> s = new osg::StateSet;
    const osg::ref_ptr<osg::Material> material = makeMaterial(osg::Vec3f(0, 0, 0));
    material->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(9, 0.5f, 1, 1));
    s->setAttribute(material);
    expectColor(osg::Vec3f(9, half, 1), sentBy(*s).emission);
}

TEST(SentLight, OfTexturesIsTheirMean)
{
    osg::ref_ptr<osg::StateSet> s = new osg::StateSet;
    s->setAttribute(makeMaterial(osg::Vec3f(0.5f, 0.5f, 0.5f)));
    s->setTextureAttributeAndModes(0, makeTexture({{255, 0, 0, 255}, {255, 255, 255, 0}}));
    expectColor(osg::Vec3f(half, half / 2, half / 2), reflectance(sentBy(*s)));
    s->setTextureAttribute(0, new osg::TexEnv(osg::TexEnv::REPLACE));
    expectColor(osg::Vec3f(0.98f, 0.5f, 0.5f), reflectance(sentBy(*s)));
    s->setTextureAttribute(0, new osg::TexEnv(osg::TexEnv::DECAL));
    expectColor(osg::Vec3f((half + 1) / 2, (half + 0.5f) / 2, (half + 0.5f) / 2), reflectance(sentBy(*s)));
    s->setTextureAttribute(0, new osg::TexEnv(osg::TexEnv::ADD));
    expectColor(osg::Vec3f(0.98f, half + 0.5f, half + 0.5f), reflectance(sentBy(*s)));
    osg::ref_ptr<osg::TexEnv> blend = new osg::TexEnv(osg::TexEnv::BLEND);
    blend->setColor(osg::Vec4(0, 0, 1, 1));
    s->setTextureAttribute(0, blend);
    expectColor(osg::Vec3f(0, half / 2, half / 2 + 0.5f), reflectance(sentBy(*s)));
}

TEST(SentLight, OfVertexColoursIsTheirMean)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    colors->push_back(osg::Vec4(0, 1, 0.5f, 1));
    colors->push_back(osg::Vec4(0, 0, 0.5f, 1));
    geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    expectColor(osg::Vec3f(0, half, half), reflectance(sentBy(*osg::ref_ptr<osg::StateSet>(new osg::StateSet), *geometry)));
    osg::ref_ptr<osg::StateSet> unlit = new osg::StateSet;
    unlit->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    expectColor(osg::Vec3f(0, half, half), sentBy(*unlit, *geometry).emission);
    expectColor(osg::Vec3f(), reflectance(sentBy(*unlit, *geometry)));
}

TEST(SentLight, OfWhatIsNoColourIsNone)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    osg::ref_ptr<osg::StateSet> s = new osg::StateSet;
    Material::setLambert(*s, osg::Vec3f(nan, -1, 7));
    expectColor(osg::Vec3f(0, 0, 0.98f), reflectance(sentBy(*s)));
}

// Those that stand still: in what each sends on a change is seen without a new scene.
TEST(StaticCasters, KnowsWhatItsPartsSendOn)
{
    std::vector<Caster> casters(3);
    for (Caster& c : casters) {
        const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        for (const osg::Vec3& v : {osg::Vec3(0, 0, 0), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 0)}) vertices->push_back(v);
        geometry->setVertexArray(vertices);
        geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
        c.geometry = geometry;
        c.sent.diffuse = osg::Vec3f(0.5f, 0.5f, 0.5f);
    }
    casters[1].state = new osg::StateSet;  // perforated: drawn apart, but it sends light on
    StaticCasters still;
    still.setPlace(osg::Vec3d(), 0.01);
    EXPECT_EQ(0u, still.generation());
    still.update(CasterList(casters), true, 1e-6);
    const unsigned generation = still.generation(), version = still.sentVersion();
    EXPECT_GT(generation, 0u);
    ASSERT_EQ(3u, still.parts().size());
    EXPECT_EQ(2u, still.drawn().size());
    EXPECT_EQ(2u, still.triangles() - 1);
    still.update(CasterList(casters), false, 1e-6);
    EXPECT_EQ(version, still.sentVersion());
    casters[1].sent.diffuse = osg::Vec3f(1, 0, 0);
    still.update(CasterList(casters), false, 1e-6);
    EXPECT_NE(version, still.sentVersion());
    EXPECT_EQ(generation, still.generation());
    EXPECT_EQ(osg::Vec3f(1, 0, 0), still.parts()[1].sent.diffuse);
    // One moves: it leaves, and comes back when it has stood still.
    casters[2].worldFromModel.makeTranslate(1, 0, 0);
    still.update(CasterList(casters), true, 1e-6);
    EXPECT_EQ(2u, still.parts().size());
    EXPECT_EQ(3u, still.drawn().size());
    for (unsigned i = 0; i < StaticCasters::patience; ++i) still.update(CasterList(casters), false, 1e-6);
    EXPECT_EQ(3u, still.parts().size());
    EXPECT_EQ(2u, still.drawn().size());
    EXPECT_EQ(osg::Vec3f(1, 0, 0), still.drawn()[1].sent.diffuse);
}

}  // namespace SentLight_test
