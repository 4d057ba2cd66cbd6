// SPDX-License-Identifier: MIT
// The glTF reader: materials, textures and images, by the units and names of plugin/osgdb_gltf/MaterialNames.h.
#include "GltfFiles.h"

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/Material>
#include <osg/TexMat>
#include <osg/Texture2D>

#include <osgEnvLight/Material>

#include <filesystem>
#include <fstream>

using namespace gltffiles;

namespace
{

// A PNG of 2 x 2 pixels, red and green above blue and white.
const std::vector<unsigned char> kFourColors = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00,
    0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00, 0x00, 0xfd, 0xd4, 0x9a, 0x73, 0x00, 0x00, 0x00, 0x12, 0x49,
    0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0xf8, 0xcf, 0xc0, 0xc0, 0x00, 0xc2, 0x0c, 0xff, 0x81, 0x00, 0x00, 0x1f, 0xee,
    0x05, 0xfb, 0xf1, 0xab, 0xba, 0x77, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

osg::ref_ptr<osg::Node> root;  // keeps the state set of the last file

osg::StateSet* stateSetOf(const json& material, File file = {}, json primitive = {})
{
    if (primitive.is_null()) primitive = file.triangle();
    primitive["material"] = file.add("materials", material);
    file.show(primitive);
    root = readNode(file);
    osg::Geometry* g = geometryOf(root);
    return g ? g->getStateSet() : nullptr;
}

template <class T>
T uniformOf(osg::StateSet* stateSet, const char* name)
{
    T value = {};
    const osg::Uniform* uniform = stateSet->getUniform(name);
    EXPECT_TRUE(uniform && uniform->get(value)) << name;
    return value;
}

osg::Material* osgMaterialOf(osg::StateSet* s)
{
    return static_cast<osg::Material*>(s->getAttribute(osg::StateAttribute::MATERIAL));
}

/** A file with textures 0 to `count` - 1 of one image. */
File textured(int count, const std::string& uri = "data:image/png;base64," + base64(bytesOf(kFourColors)))
{
    File file;
    for (int i = 0; i < count; ++i) {
        file.add("images", {{"uri", uri}});
        file.add("textures", {{"source", i}});
    }
    return file;
}

}  // namespace

// 512 x 512 pixels of a bit each, all alike, in 126 bytes.
TEST(GltfMaterials, AnImageOfOneColorIsSmall)
{
    const std::string flat =
        "iVBORw0KGgoAAAANSUhEUgAAAgAAAAIAAQMAAADOtka5AAAAA1BMVEXIZDLxgAUBAAAANklEQVR42u3BAQEAAACCIP+vbkhAAQAA"
        "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAB8G4IAAAFjdVCkAAAAAElFTkSuQmCC";
    const osg::StateSet* s = stateSetOf({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}},
                                        textured(1, "data:image/png;base64," + flat));
    ASSERT_TRUE(s);
    const auto* texture = dynamic_cast<const osg::Texture2D*>(s->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    ASSERT_TRUE(texture && texture->getImage());
    EXPECT_EQ(512, texture->getImage()->s());
    EXPECT_NEAR(200.0 / 255.0, double(texture->getImage()->getColor(511u, 511u).r()), 1e-6);
}

TEST(GltfMaterials, FactorsAreOursAndOpenSceneGraphs)
{
    osg::StateSet* s = stateSetOf(
        {{"name", "gold"},
         {"pbrMetallicRoughness", {{"baseColorFactor", {1, .5, .25, .5}}, {"metallicFactor", .75}, {"roughnessFactor", .125}}},
         {"emissiveFactor", {.125, .5, 1}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}});
    ASSERT_TRUE(s);
    EXPECT_EQ(osgEnvLight::Material::brdfOf(*s, -1), osgEnvLight::Material::COOK_TORRANCE);
    EXPECT_EQ(uniformOf<osg::Vec3f>(s, "envlightBaseColor"), osg::Vec3f(1, .5f, .25f));
    EXPECT_EQ(uniformOf<float>(s, "envlightMetalness"), .75f);
    EXPECT_EQ(uniformOf<float>(s, "envlightRoughness"), .125f);
    EXPECT_EQ(uniformOf<osg::Vec3f>(s, "envlightEmission"), osg::Vec3f(.5f, 2, 4));
    const osg::Material* m = osgMaterialOf(s);
    EXPECT_EQ(m->getName(), "gold");
    EXPECT_NEAR(m->getDiffuse(osg::Material::FRONT).g(), .7354, 1e-4);
    EXPECT_EQ(m->getDiffuse(osg::Material::FRONT).a(), 1.0f);  // OPAQUE
    EXPECT_NEAR(m->getEmission(osg::Material::FRONT).r(), .7354, 1e-4);
    EXPECT_EQ(m->getEmission(osg::Material::FRONT).g(), 2.0f);  // above 1 as it is
    EXPECT_EQ(s->getMode(GL_CULL_FACE), osg::StateAttribute::ON);
}

TEST(GltfMaterials, TheDefaultMaterialIsWhiteMetal)
{
    File file;
    file.show(file.triangle());
    root = readNode(file);
    osg::StateSet* s = geometryOf(root)->getStateSet();
    EXPECT_EQ(uniformOf<osg::Vec3f>(s, "envlightBaseColor"), osg::Vec3f(1, 1, 1));
    EXPECT_EQ(uniformOf<float>(s, "envlightMetalness"), 1.0f);
    EXPECT_EQ(uniformOf<float>(s, "envlightRoughness"), 1.0f);
    EXPECT_FALSE(s->getUniform("envlightEmission"));
}

TEST(GltfMaterials, EveryMapHasItsUnitAndNames)
{
    osg::StateSet* s = stateSetOf(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 2}}}}},
         {"normalTexture", {{"index", 1}, {"scale", .5}}},
         {"occlusionTexture", {{"index", 3}, {"strength", .25}, {"texCoord", 1}}},
         {"emissiveTexture", {{"index", 4}}},
         {"emissiveFactor", {1, 1, 1}},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}},
           {"KHR_materials_clearcoat",
            {{"clearcoatFactor", .5},
             {"clearcoatRoughnessFactor", .25},
             {"clearcoatTexture", {{"index", 5}}},
             {"clearcoatRoughnessTexture", {{"index", 6}}},
             {"clearcoatNormalTexture", {{"index", 7}, {"scale", .75}}}}},
           {"KHR_materials_anisotropy",
            {{"anisotropyStrength", .5}, {"anisotropyRotation", osg::PI_2}, {"anisotropyTexture", {{"index", 8}}}}},
           {"KHR_materials_ior", {{"ior", 1.25}}},
           {"KHR_materials_specular", {{"specularFactor", .5}, {"specularColorFactor", {1, 2, 3}}}}}}},
        textured(9));
    ASSERT_TRUE(s);
    const char* names[] = {"",
                           "envlightNormalMap",
                           "envlightMetalRoughMap",
                           "envlightOcclusionMap",
                           "envlightEmissionMap",
                           "envlightCoatMap",
                           "envlightCoatRoughnessMap",
                           "envlightCoatNormalMap",
                           "envlightAnisotropyMap"};
    for (unsigned unit = 0; unit < 9; ++unit) {
        EXPECT_TRUE(s->getTextureAttribute(unit, osg::StateAttribute::TEXTURE)) << unit;
        EXPECT_EQ(s->getTextureMode(unit, GL_TEXTURE_2D), unit == 0 ? osg::StateAttribute::ON : osg::StateAttribute::INHERIT)
            << unit;
        if (unit == 0) continue;
        EXPECT_EQ(uniformOf<int>(s, names[unit]), int(unit));
        EXPECT_EQ(uniformOf<int>(s, (std::string(names[unit]) + "TexCoord").c_str()), unit == 3 ? 1 : 0);
        const osg::Matrix3 transform = uniformOf<osg::Matrix3>(s, (std::string(names[unit]) + "Transform").c_str());
        for (int i = 0; i < 9; ++i) EXPECT_EQ(transform(i / 3, i % 3), i % 4 == 0 ? 1.0f : 0.0f);
    }
    EXPECT_EQ(uniformOf<float>(s, "envlightNormalScale"), .5f);
    EXPECT_EQ(uniformOf<float>(s, "envlightCoatNormalScale"), .75f);
    EXPECT_EQ(uniformOf<float>(s, "envlightOcclusionStrength"), .25f);
    EXPECT_EQ(uniformOf<osg::Vec3f>(s, "envlightEmission"), osg::Vec3f(3, 3, 3));
    EXPECT_EQ(uniformOf<float>(s, "envlightCoat"), .5f);
    EXPECT_EQ(uniformOf<float>(s, "envlightCoatRoughness"), .25f);
    EXPECT_EQ(uniformOf<float>(s, "envlightAnisotropy"), .5f);
    EXPECT_NEAR(uniformOf<osg::Vec2f>(s, "envlightAnisotropyDirection").y(), 1.0, 1e-6);
    EXPECT_EQ(uniformOf<float>(s, "envlightAnisotropyUp"), -1.0f);
    EXPECT_EQ(uniformOf<int>(s, "envlightAnisotropyTexCoord"), 0);
    // ((n - 1) / (n + 1))^2 of n = 1.25 is 1/81; colour (1, 2, 3) at half the strength
    const osg::Vec3f f0 = uniformOf<osg::Vec3f>(s, "envlightDielectric");
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(f0[i], .5 * (i + 1) / 81, 1e-7);
    // Or all of the surface would glow without the map.
    EXPECT_EQ(osgMaterialOf(s)->getEmission(osg::Material::FRONT), osg::Vec4(0, 0, 0, 1));
}

TEST(GltfMaterials, UnitZeroReadsItsCoordinatesFromArrayZero)
{
    File file = textured(2);
    json primitive = file.triangle();
    primitive["attributes"]["TEXCOORD_0"] = file.vec2({0, 0, 0, 0, 0, 0});
    primitive["attributes"]["TEXCOORD_1"] = file.vec2({1, 1, 1, 1, 1, 1});
    osg::StateSet* s = stateSetOf(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}, {"normalTexture", {{"index", 1}}}},
        file, primitive);
    EXPECT_EQ(uniformOf<int>(s, "envlightNormalMapTexCoord"), 1);
    osg::Geometry* g = geometryOf(root);
    EXPECT_EQ(arrayOf<osg::Vec2Array>(g->getTexCoordArray(0))[0], osg::Vec2(1, 1));
    EXPECT_EQ(arrayOf<osg::Vec2Array>(g->getTexCoordArray(1))[0], osg::Vec2(0, 0));
}

TEST(GltfMaterials, TextureTransforms)
{
    const json transform = {
        {"KHR_texture_transform", {{"offset", {.5, .25}}, {"rotation", osg::PI_2}, {"scale", {2, 3}}, {"texCoord", 0}}}};
    osg::StateSet* s =
        stateSetOf({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}, {"extensions", transform}}}}},
                    {"normalTexture", {{"index", 1}, {"extensions", transform}}}},
                   textured(2));
    const auto* matrix = dynamic_cast<osg::TexMat*>(s->getTextureAttribute(0, osg::StateAttribute::TEXMAT));
    ASSERT_TRUE(matrix);
    // Counter-clockwise, where the second coordinate points down: (1, 0) goes to (0, -1).
    EXPECT_NEAR((osg::Vec3d(1, 0, 0) * matrix->getMatrix() - osg::Vec3d(.5, .25 - 2, 0)).length(), 0.0, 1e-6);
    EXPECT_NEAR((osg::Vec3d(0, 1, 0) * matrix->getMatrix() - osg::Vec3d(.5 + 3, .25, 0)).length(), 0.0, 1e-6);
    const osg::Matrix3 columns = uniformOf<osg::Matrix3>(s, "envlightNormalMapTransform");
    EXPECT_NEAR(columns(0, 1), -2.0, 1e-6);
    EXPECT_NEAR(columns(1, 0), 3.0, 1e-6);
    EXPECT_NEAR(columns(2, 0), .5, 1e-6);
    EXPECT_EQ(uniformOf<int>(s, "envlightNormalMapTexCoord"), 0);
}

TEST(GltfMaterials, AlphaModes)
{
    osg::StateSet* s = stateSetOf({{"alphaMode", "MASK"}, {"alphaCutoff", .25}, {"doubleSided", true}});
    const auto* test = dynamic_cast<osg::AlphaFunc*>(s->getAttribute(osg::StateAttribute::ALPHAFUNC));
    ASSERT_TRUE(test);
    EXPECT_EQ(test->getFunction(), osg::AlphaFunc::GEQUAL);
    EXPECT_EQ(test->getReferenceValue(), .25f);
    EXPECT_EQ(s->getMode(GL_ALPHA_TEST), osg::StateAttribute::ON);
    EXPECT_EQ(s->getMode(GL_CULL_FACE), osg::StateAttribute::OFF);

    s = stateSetOf({{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, .5}}}}});
    EXPECT_EQ(s->getMode(GL_BLEND), osg::StateAttribute::ON);
    EXPECT_EQ(s->getRenderingHint(), osg::StateSet::TRANSPARENT_BIN);
    EXPECT_EQ(osgMaterialOf(s)->getDiffuse(osg::Material::FRONT).a(), .5f);

    s = stateSetOf({{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", .75}}}}}});
    EXPECT_EQ(s->getMode(GL_BLEND), osg::StateAttribute::ON);
    EXPECT_EQ(osgMaterialOf(s)->getDiffuse(osg::Material::FRONT).a(), .25f);
}

TEST(GltfMaterials, UnlitSurfacesShowTheirColors)
{
    osg::StateSet* s = stateSetOf({{"pbrMetallicRoughness", {{"baseColorFactor", {.5, .5, .5, 1}}}},
                                   {"extensions", {{"KHR_materials_unlit", json::object()}}}});
    EXPECT_EQ(s->getMode(GL_LIGHTING), osg::StateAttribute::OFF);
    EXPECT_EQ(osgEnvLight::Material::brdfOf(*s, -1), -1);
    EXPECT_NEAR(arrayOf<osg::Vec4Array>(geometryOf(root)->getColorArray())[0].r(), .7354, 1e-4);
}

TEST(GltfMaterials, SamplersAndTheirDefaults)
{
    File file = textured(2);
    file.add("samplers", {{"magFilter", 9728}, {"minFilter", 9985}, {"wrapS", 33071}, {"wrapT", 33648}});
    file.document["textures"][0]["sampler"] = 0;
    osg::StateSet* s =
        stateSetOf({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}, {"normalTexture", {{"index", 1}}}}, file);
    const auto* given = static_cast<osg::Texture2D*>(s->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    const auto* standard = static_cast<osg::Texture2D*>(s->getTextureAttribute(1, osg::StateAttribute::TEXTURE));
    EXPECT_EQ(given->getFilter(osg::Texture::MAG_FILTER), osg::Texture::NEAREST);
    EXPECT_EQ(given->getFilter(osg::Texture::MIN_FILTER), osg::Texture::LINEAR_MIPMAP_NEAREST);
    EXPECT_EQ(given->getWrap(osg::Texture::WRAP_S), osg::Texture::CLAMP_TO_EDGE);
    EXPECT_EQ(given->getWrap(osg::Texture::WRAP_T), osg::Texture::MIRROR);
    EXPECT_EQ(standard->getFilter(osg::Texture::MIN_FILTER), osg::Texture::LINEAR_MIPMAP_LINEAR);
    EXPECT_EQ(standard->getWrap(osg::Texture::WRAP_S), osg::Texture::REPEAT);
}

TEST(GltfMaterials, ImagesFromDataViewsAndFiles)
{
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(::testing::TempDir()) / "gltf images";
    fs::create_directories(folder / "ä b");
    const json material = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
    const auto checkImage = [](osg::Node* node) {
        osg::Geometry* g = geometryOf(node);
        const auto* t =
            g ? static_cast<osg::Texture2D*>(g->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE)) : nullptr;
        ASSERT_TRUE(t && t->getImage());
        EXPECT_EQ(t->getImage()->s(), 2);
        EXPECT_EQ(t->getImage()->getPixelFormat(), GLenum(GL_RGB));
        // The first row is the top of the picture.
        EXPECT_EQ(t->getImage()->getColor(0, 0), osg::Vec4(1, 0, 0, 1));
        EXPECT_EQ(t->getImage()->getColor(0, 1), osg::Vec4(0, 0, 1, 1));
    };
    stateSetOf(material, textured(1));
    checkImage(root);

    File viewed;
    viewed.add("images", {{"bufferView", viewed.view(bytesOf(kFourColors))}, {"mimeType", "image/png"}});
    viewed.add("textures", {{"source", 0}});
    stateSetOf(material, viewed);
    checkImage(root);

    std::ofstream(folder / "ä b" / "four+colors.png", std::ios::binary) << bytesOf(kFourColors);
    File file = textured(1, "%C3%A4%20b/four+colors.png");
    json primitive = file.triangle();
    primitive["material"] = file.add("materials", material);
    file.show(primitive);
    std::ofstream(folder / "model.gltf") << file.text();
    ReadResult result = osgDB::Registry::instance()->readNode((folder / "model.gltf").string(), nullptr);
    ASSERT_TRUE(result.validNode()) << result.message();
    checkImage(result.getNode());
    fs::remove_all(folder);
}
