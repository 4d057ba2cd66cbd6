// SPDX-License-Identifier: MIT
// Textures of osgEnvLight::Material beside the base colour.
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>

#include <gtest/gtest.h>

#include <cmath>

#include "Blended.h"

namespace MaterialMaps_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

osg::ref_ptr<osg::Texture2D> evenTexture(const osg::Vec3d& color)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(1, 1, 1, GL_RGB, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGB32F_ARB);
    for (int k = 0; k < 3; ++k) reinterpret_cast<float*>(image->data())[k] = float(color[k]);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
    return texture;
}

// Faces -Y, white metal; its first coordinates run along `s`, `t`, its second ones along t, s.
osg::ref_ptr<osg::Geode> card(const osg::Vec3d& s, const osg::Vec3d& t)
{
    osg::ref_ptr<osg::Geode> geode = makeQuad(osg::Vec3d(-1, 0, -1), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 0, 2));
    osg::Geometry& geometry = *geode->getDrawable(0)->asGeometry();
    const auto& vertices = static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
    osg::ref_ptr<osg::Vec2Array> first = new osg::Vec2Array, second = new osg::Vec2Array;
    for (const osg::Vec3f& v : vertices) {
        first->push_back(osg::Vec2f(float(osg::Vec3d(v) * s), float(osg::Vec3d(v) * t)));
        second->push_back(osg::Vec2f(float(osg::Vec3d(v) * t), float(osg::Vec3d(v) * s)));
    }
    geometry.setTexCoordArray(0, first);
    geometry.setTexCoordArray(1, second);
    Material::setCookTorrance(*geode->getOrCreateStateSet(), osg::Vec3f(1, 1, 1), 1.0f, 1.0f);
    return geode;
}

class MaterialMaps : public testing::Test
{
  protected:
    MaterialMaps() : renderer(32, 32) { renderer.lookAt(osg::Vec3d(0, -4, 0), osg::Vec3d()); }

    osg::Vec3d middle(const osg::ref_ptr<osg::Node>& node, int view)
    {
        osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
        lit->getSettings()->regeneration = Settings::IMMEDIATE;
        lit->getSettings()->view = view;
        lit->addChild(node);
        return renderer.render(lit, 2).color(13, 18);
    }

    // As view = normal shows it.
    osg::Vec3d normalOf(const osg::ref_ptr<osg::Node>& node)
    {
        return middle(node, Settings::NORMAL) * 2.0 - osg::Vec3d(1, 1, 1);
    }

    SceneRenderer renderer;
};

const osg::Vec3d x(1, 0, 0), z(0, 0, 1);

void expectNear(const osg::Vec3d& expected, const osg::Vec3d& actual, const std::string& what)
{
    // Eight bits of the G-buffer's normals, and half floats.
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(expected[k], actual[k], 0.01) << what << ", " << k;
}

}  // namespace

// A texel that leans by 30 degrees to the right, and one that leans up, by coordinates in all directions; and less by its scale.
TEST_F(MaterialMaps, NormalsLeanAlongTheCoordinates)
{
    const double lean = 0.5, rest = std::sqrt(0.75);
    const osg::ref_ptr<osg::Texture2D> right = evenTexture(osg::Vec3d(lean, 0, rest) * 0.5 + osg::Vec3d(0.5, 0.5, 0.5));
    const osg::ref_ptr<osg::Texture2D> up = evenTexture(osg::Vec3d(0, lean, rest) * 0.5 + osg::Vec3d(0.5, 0.5, 0.5));
    const std::pair<osg::Vec3d, osg::Vec3d> axes[] = {{x, z}, {-x, z}, {z, x}, {-z, -x}};
    for (const auto& [s, t] : axes) {
        osg::ref_ptr<osg::Geode> geode = card(s, t);
        Material::setNormalMap(*geode->getStateSet(), right);
        expectNear(s * lean - osg::Vec3d(0, rest, 0), normalOf(geode), "right");
        Material::setNormalMap(*geode->getStateSet(), up);
        expectNear(t * lean - osg::Vec3d(0, rest, 0), normalOf(geode), "up");
        Material::setNormalMap(*geode->getStateSet(), up, 1.0f, true);
        expectNear(t * -lean - osg::Vec3d(0, rest, 0), normalOf(geode), "up, from the top");
        Material::setNormalMap(*geode->getStateSet(), right, 1.0f, false, 1);
        expectNear(t * lean - osg::Vec3d(0, rest, 0), normalOf(geode), "right, by the second coordinates");
        Material::setNormalMap(*geode->getStateSet(), right, 0.0f);
        expectNear(osg::Vec3d(0, -1, 0), normalOf(geode), "without scale");
    }
}

// A reader left its maps on units of the drawable, where fixed function would multiply them; the material above names the units.
TEST_F(MaterialMaps, AReadersMapsByTheirUnits)
{
    osg::ref_ptr<osg::Geode> geode = card(x, z);
    osg::StateSet& readers = *geode->getDrawable(0)->getOrCreateStateSet();
    readers.setTextureAttributeAndModes(1, evenTexture(osg::Vec3d(0.75, 0.5, 0.5 + 0.5 * std::sqrt(0.75))));
    readers.setTextureAttributeAndModes(3, evenTexture(osg::Vec3d(0.1, 0.5, 0.0)));
    readers.setTextureAttributeAndModes(5, evenTexture(osg::Vec3d(0.2, 0.4, 0.8)));
    expectNear(osg::Vec3d(0, -1, 0), normalOf(geode), "without their names");
    Material::setNormalMap(*geode->getStateSet(), nullptr, 1.0f, false, 0, 1);
    expectNear(x * 0.5 - osg::Vec3d(0, std::sqrt(0.75), 0), normalOf(geode), "normals");
    expectNear(osg::Vec3d(0, 0, 0), middle(geode, Settings::ALBEDO), "metal");
    Material::setMetalRoughMap(*geode->getStateSet(), nullptr, 0, 3);
    expectNear(osg::Vec3d(1, 1, 1), middle(geode, Settings::ALBEDO), "no metal");
    Material::setEmission(*geode->getStateSet(), osg::Vec3f(1, 1, 1));
    Material::setEmissionMap(*geode->getStateSet(), nullptr, 0, 5);
    EXPECT_GT(middle(geode, Settings::EMISSION)[2], middle(geode, Settings::EMISSION)[0]);
}

// Without coordinates there are no tangents: the surface keeps its normal.
TEST_F(MaterialMaps, NormalsStayWhereThereAreNoCoordinates)
{
    osg::ref_ptr<osg::Geode> geode = makeQuad(osg::Vec3d(-1, 0, -1), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 0, 2));
    Material::setLambert(*geode->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    Material::setNormalMap(*geode->getStateSet(), evenTexture(osg::Vec3d(0.9, 0.5, 0.8)));
    expectNear(osg::Vec3d(0, -1, 0), normalOf(geode), "no coordinates");
}

// Tangents of the vertices go before those of the coordinates, turn with the geometry, and mirror with it.
TEST_F(MaterialMaps, NormalsLeanAlongTheVerticesTangents)
{
    const double lean = 0.5, rest = std::sqrt(0.75);
    const osg::ref_ptr<osg::Texture2D> right = evenTexture(osg::Vec3d(lean, 0, rest) * 0.5 + osg::Vec3d(0.5, 0.5, 0.5));
    const osg::ref_ptr<osg::Texture2D> up = evenTexture(osg::Vec3d(0, lean, rest) * 0.5 + osg::Vec3d(0.5, 0.5, 0.5));
    const osg::Vec3d front(0, -rest, 0);
    const auto normal = [&](const osg::Vec3d& tangent, double sign, const osg::ref_ptr<osg::Texture2D>& map,
                            const osg::Matrixd& placed = osg::Matrixd()) {
        const osg::ref_ptr<osg::Geode> geode = card(x, z);
        const osg::ref_ptr<osg::Vec4Array> tangents = new osg::Vec4Array(4);
        for (osg::Vec4& t : *tangents) t = osg::Vec4(osg::Vec3f(tangent), float(sign));
        geode->getDrawable(0)->asGeometry()->setVertexAttribArray(Material::tangentAttribute, tangents,
                                                                  osg::Array::BIND_PER_VERTEX);
        Material::setNormalMap(*geode->getStateSet(), map);
        const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(placed);
        transform->addChild(geode);
        return normalOf(transform);
    };
    expectNear(front + z * lean, normal(z, 1.0, right), "right");
    expectNear(front + (osg::Vec3d(0, -1, 0) ^ z) * lean, normal(z, 1.0, up), "up");
    expectNear(front - (osg::Vec3d(0, -1, 0) ^ z) * lean, normal(z, -1.0, up), "up, of the other hand");
    expectNear(front + x * lean, normal(z, 1.0, right, osg::Matrixd::rotate(osg::PI_2, 0, 1, 0)), "turned");
    expectNear(front - x * lean, normal(x, 1.0, right, osg::Matrixd::scale(-1, 1, 1)), "mirrored");
    expectNear(front + z * lean, normal(x, 1.0, up, osg::Matrixd::scale(-1, 1, 1)), "mirrored, up");
    // As many as there are vertices, or they are no tangents.
    const osg::ref_ptr<osg::Geode> geode = card(x, z);
    geode->getDrawable(0)->asGeometry()->setVertexAttribArray(Material::tangentAttribute, new osg::Vec4Array(2),
                                                              osg::Array::BIND_PER_VERTEX);
    Material::setNormalMap(*geode->getStateSet(), right);
    expectNear(front + x * lean, normalOf(geode), "by the coordinates");
}

TEST_F(MaterialMaps, RoughnessAndMetalnessAreMultiplied)
{
    osg::ref_ptr<osg::Geode> geode = card(x, z);
    expectNear(osg::Vec3d(), middle(geode, Settings::ALBEDO), "metal");
    Material::setMetalRoughMap(*geode->getStateSet(), evenTexture(osg::Vec3d(0.3, 0.5, 0.25)));
    expectNear(osg::Vec3d(0.75, 0.75, 0.75), middle(geode, Settings::ALBEDO), "a quarter of it is metal");
    // A map without texels is none.
    Material::setMetalRoughMap(*geode->getStateSet(), new osg::Texture2D(new osg::Image));
    expectNear(osg::Vec3d(), middle(geode, Settings::ALBEDO), "no texels");
}

TEST_F(MaterialMaps, EmissionReplacesThatOfTheHostsMaterial)
{
    osg::ref_ptr<osg::Geode> geode = card(x, z);
    const osg::ref_ptr<osg::Material> host = new osg::Material;
    host->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 1));
    geode->getStateSet()->setAttributeAndModes(host);
    Material::setEmission(*geode->getStateSet(), osg::Vec3f(2.0f, 1.0f, 0.5f));
    expectNear(osg::Vec3d(2.0, 1.0, 0.5), middle(geode, Settings::EMISSION), "without a map");
    Material::setEmission(*geode->getStateSet(), osg::Vec3f(2.0f, 1.0f, 0.5f), evenTexture(osg::Vec3d(1.0, 0.735357, 0.0)));
    expectNear(osg::Vec3d(2.0, 0.5, 0.0), middle(geode, Settings::EMISSION), "half as encoded");
}

// Under light from one line of directions a card is bright where its highlights are drawn out along that line.
TEST_F(MaterialMaps, OfAnisotropy)
{
    osg::Light& headlight = *renderer.viewer().getLight();
    headlight.setDiffuse(osg::Vec4(0, 0, 0, 1));
    headlight.setSpecular(osg::Vec4(0, 0, 0, 1));
    const osg::Vec3d line = (x + z) / std::sqrt(2.0);
    const osg::ref_ptr<osg::Image> map =
        makeMap(128, 64, [&](const osg::Vec3d& d) { return osg::Vec3d(1, 1, 1) * (std::abs(d * line) > 0.6 ? 1.0 : 0.0); });
    const auto seen = [&](bool forward, float strength, float rotation, const osg::ref_ptr<osg::Texture2D>& texture,
                          bool topIsZero = false, int set = 0) {
        osg::ref_ptr<osg::Geode> geode = card(x, z);
        osg::StateSet& s = *geode->getStateSet();
        Material::setCookTorrance(s, osg::Vec3f(1, 1, 1), 1.0f, 0.2f);
        Material::setAnisotropy(s, strength, rotation, topIsZero, set);
        if (texture) Material::setAnisotropyMap(s, texture);
        if (forward) blend(s);
        osg::ref_ptr<LitScene> lit = makeLit(map.get());
        // A light that only the lobe sees: forward surfaces look up the map by one width for all directions.
        const osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
        const osg::Vec3d direction = line * 0.9 - osg::Vec3d(0, 1, 0);
        lamp->getLight()->setLightNum(1);
        lamp->getLight()->setPosition(osg::Vec4(osg::Vec3f(direction), 0.0f));
        lamp->getLight()->setDiffuse(osg::Vec4(1, 1, 1, 1));
        lit->getSettings()->sceneLights = forward ? Settings::SCENE_LIGHTS_ON : Settings::SCENE_LIGHTS_OFF;
        lit->getSettings()->specular = true;
        lit->addChild(lamp);
        lit->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        lit->addChild(geode);
        return renderer.render(lit, 2).color(13, 18)[1];
    };
    for (const bool forward : {false, true}) {
        const double even = seen(forward, 0.0f, 0.0f, nullptr);
        const double along = seen(forward, 1.0f, 45.0f, nullptr), across = seen(forward, 1.0f, -45.0f, nullptr);
        EXPECT_GT(along, 2.0 * across) << forward;
        EXPECT_GT(along, 1.5 * even) << forward;
        const double same = 0.02 * along;
        EXPECT_NEAR(across, seen(forward, 1.0f, 45.0f, nullptr, true), same) << "to the bottom";
        EXPECT_NEAR(along, seen(forward, 1.0f, 45.0f, nullptr, false, 1), same) << "the other coordinates, mirrored";
        EXPECT_NEAR(along, seen(forward, 1.0f, -45.0f, evenTexture(osg::Vec3d(0.5, 1, 1))), same) << "turned by the map";
        EXPECT_NEAR(even, seen(forward, 1.0f, 45.0f, evenTexture(osg::Vec3d(1, 0.5, 0))), same) << "no strength in the map";
    }
}

// Red times the strength and green times the roughness of a coat; its normals are its own.
TEST_F(MaterialMaps, OfACoat)
{
    osg::ref_ptr<osg::Geode> geode = card(x, z);
    osg::StateSet& s = *geode->getStateSet();
    Material::setCookTorrance(s, osg::Vec3f(), 1.0f, 1.0f);
    Material::setCoat(s, 1.0f, 1.0f);
    const double rough = middle(geode, Settings::SPECULAR)[1];
    Material::setCoatRoughnessMap(s, evenTexture(osg::Vec3d(1, 0.2, 1)));
    const double smooth = middle(geode, Settings::SPECULAR)[1];
    EXPECT_NEAR(0.04, smooth, 0.001);
    EXPECT_GT(std::abs(rough - smooth), 0.002);
    Material::setCoatMap(s, evenTexture(osg::Vec3d(0, 1, 1)));
    EXPECT_EQ(0.0, middle(geode, Settings::SPECULAR)[1]);
    // Schlick at the pixel's cosines, seen from the side, flat and leaning away by 5 degrees. What a coat mirrors that leans
    // further is behind the card.
    renderer.lookAt(osg::Vec3d(-4, -2, 0), osg::Vec3d());
    Material::setCoatMap(s, evenTexture(osg::Vec3d(1, 1, 1)));
    Material::setCoatRoughnessMap(s, evenTexture(osg::Vec3d(1, 0.02, 1)));
    EXPECT_NEAR(0.04 + 0.96 * std::pow(1 - 0.496, 5), middle(geode, Settings::SPECULAR)[1], 0.001);
    Material::setCoatNormalMap(s, evenTexture(osg::Vec3d(0.087, 0, 0.996) * 0.5 + osg::Vec3d(0.5, 0.5, 0.5)));
    EXPECT_NEAR(0.04 + 0.96 * std::pow(1 - 0.419, 5), middle(geode, Settings::SPECULAR)[1], 0.001);
    expectNear(osg::Vec3d(0, -1, 0), normalOf(geode), "below the coat");
}

}  // namespace MaterialMaps_test
