// SPDX-License-Identifier: MIT
#include "Materials.h"

#include "Extensions.h"

#include <osgEnvLight/Material>

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/TexMat>

#include <cmath>

#include "glsl.h"

namespace osgEnvLight::gltf
{

namespace
{

osg::Vec3f toVec3f(const std::vector<double>& v)
{
    return osg::Vec3f(float(v[0]), float(v[1]), float(v[2]));
}

template <class T>
void setUniform(osg::StateSet& stateSet, const std::string& name, const T& value)
{
    stateSet.addUniform(new osg::Uniform(name.c_str(), value));
}

osg::Texture::FilterMode filterMode(int code, osg::Texture::FilterMode otherwise)
{
    return code < 0 ? otherwise : static_cast<osg::Texture::FilterMode>(code);
}

bool blends(const tinygltf::Material& m)
{
    return m.alphaMode == "BLEND" || extension(m.extensions, "KHR_materials_transmission");
}

/** Of OPAQUE surfaces that of their textures and vertices counts for nothing. */
double alphaOf(const tinygltf::Material& m)
{
    const tinygltf::Value* transmission = extension(m.extensions, "KHR_materials_transmission");
    const double passed = transmission ? numberOf(*transmission, "transmissionFactor", 0.0) : 0.0;
    return (m.alphaMode == "OPAQUE" ? 1.0 : m.pbrMetallicRoughness.baseColorFactor[3]) * (1.0 - passed);
}

/** The geometry's array of TEXCOORD_n: that of unit 0 and the first are exchanged. */
int arrayOf(unsigned texCoord, unsigned baseTexCoord)
{
    return int(texCoord == baseTexCoord ? 0 : texCoord == 0 ? baseTexCoord : texCoord);
}

}  // namespace

osg::Vec4 displayColor(const osg::Vec4d& linear)
{
    osg::Vec4 color;
    for (int i = 0; i < 3; ++i) color.ptr()[i] = float(glsl::typedEncode(linear.ptr()[i]));
    color[3] = float(linear[3]);
    return color;
}

const tinygltf::Material& Materials::material(int index) const
{
    return index < 0 ? _default : _asset.model.materials[std::size_t(index)];
}

bool Materials::isUnlit(int index) const
{
    return extension(material(index).extensions, "KHR_materials_unlit") != nullptr;
}

osg::Vec4d Materials::baseColor(int index) const
{
    const std::vector<double>& c = material(index).pbrMetallicRoughness.baseColorFactor;
    return osg::Vec4d(c[0], c[1], c[2], alphaOf(material(index)));
}

unsigned Materials::baseTexCoord(int index) const
{
    return use(material(index).pbrMetallicRoughness.baseColorTexture).texCoord;
}

template <class TextureInfo>
Materials::Use Materials::use(const TextureInfo& info) const
{
    Use use;
    use.texture = info.index;
    use.texCoord = unsigned(info.texCoord);
    if (const tinygltf::Value* transform = extension(info.extensions, "KHR_texture_transform")) readTransform(*transform, use);
    return use;
}

void Materials::readTransform(const tinygltf::Value& transform, Use& use)
{
    use.hasTransform = true;
    use.texCoord = unsigned(numberOf(transform, "texCoord", use.texCoord));
    use.rotation = numberOf(transform, "rotation", 0.0);
    for (int i = 0; i < 2; ++i) {
        use.offset[i] = numberAt(transform, "offset", i, 0.0);
        use.scale[i] = numberAt(transform, "scale", i, 1.0);
    }
}

Materials::Use Materials::use(int index, const char* extensionName, const char* name) const
{
    Use use;
    const tinygltf::Value* values = extension(material(index).extensions, extensionName);
    if (!values || !values->Has(name)) return use;
    const tinygltf::Value& info = values->Get(name);
    use.texture = int(numberOf(info, "index", -1));
    use.texCoord = unsigned(numberOf(info, "texCoord", 0));
    if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
        readTransform(info.Get("extensions").Get("KHR_texture_transform"), use);
    return use;
}

osg::Texture2D* Materials::texture(int index)
{
    osg::ref_ptr<osg::Texture2D>& result = _textures[std::size_t(index)];
    const tinygltf::Texture& t = _asset.model.textures[std::size_t(index)];
    if (result || t.source < 0) return result.get();  // an image of an extension that we do not read
    const tinygltf::Sampler sampler = t.sampler < 0 ? tinygltf::Sampler() : _asset.model.samplers[std::size_t(t.sampler)];
    result = new osg::Texture2D(_images.image(t.source));
    result->setName(t.name);
    result->setResizeNonPowerOfTwoHint(false);
    result->setWrap(osg::Texture::WRAP_S, static_cast<osg::Texture::WrapMode>(sampler.wrapS));
    result->setWrap(osg::Texture::WRAP_T, static_cast<osg::Texture::WrapMode>(sampler.wrapT));
    result->setFilter(osg::Texture::MAG_FILTER, filterMode(sampler.magFilter, osg::Texture::LINEAR));
    result->setFilter(osg::Texture::MIN_FILTER, filterMode(sampler.minFilter, osg::Texture::LINEAR_MIPMAP_LINEAR));
    return result.get();
}

void Materials::addBaseColor(osg::StateSet& stateSet, const Use& use)
{
    osg::Texture2D* t = use.texture < 0 ? nullptr : texture(use.texture);
    if (!t) return;
    stateSet.setTextureAttributeAndModes(MaterialNames::BASE_COLOR, t);
    if (!use.hasTransform) return;
    const double c = std::cos(use.rotation), s = std::sin(use.rotation);
    osg::Matrix matrix;
    matrix(0, 0) = use.scale[0] * c;
    matrix(0, 1) = -use.scale[0] * s;
    matrix(1, 0) = use.scale[1] * s;
    matrix(1, 1) = use.scale[1] * c;
    matrix(3, 0) = use.offset[0];
    matrix(3, 1) = use.offset[1];
    stateSet.setTextureAttributeAndModes(MaterialNames::BASE_COLOR, new osg::TexMat(matrix));
}

void Materials::addMap(osg::StateSet& stateSet, int unit, const Use& use, unsigned baseTexCoord)
{
    osg::Texture2D* t = use.texture < 0 ? nullptr : texture(use.texture);
    if (!t) return;
    stateSet.setTextureAttribute(unsigned(unit), t);
    const std::string name = MaterialNames::sampler[unit];
    setUniform(stateSet, name, unit);
    setUniform(stateSet, name + MaterialNames::texCoordSuffix, arrayOf(use.texCoord, baseTexCoord));
    const float c = float(std::cos(use.rotation)), s = float(std::sin(use.rotation));
    const float x = float(use.scale[0]), y = float(use.scale[1]);
    // Columns, as GLSL has them.
    setUniform(stateSet, name + MaterialNames::transformSuffix,
               osg::Matrix3(x * c, -x * s, 0, y * s, y * c, 0, float(use.offset[0]), float(use.offset[1]), 1));
}

void Materials::addTextures(osg::StateSet& stateSet, int index)
{
    const tinygltf::Material& m = material(index);
    const Use base = use(m.pbrMetallicRoughness.baseColorTexture);
    addBaseColor(stateSet, base);
    const auto add = [&](int unit, const Use& use) { addMap(stateSet, unit, use, base.texCoord); };
    add(MaterialNames::NORMAL, use(m.normalTexture));
    add(MaterialNames::METAL_ROUGH, use(m.pbrMetallicRoughness.metallicRoughnessTexture));
    add(MaterialNames::OCCLUSION, use(m.occlusionTexture));
    add(MaterialNames::EMISSION, use(m.emissiveTexture));
    const char* const coating = "KHR_materials_clearcoat";
    add(MaterialNames::COAT, use(index, coating, "clearcoatTexture"));
    add(MaterialNames::COAT_ROUGHNESS, use(index, coating, "clearcoatRoughnessTexture"));
    add(MaterialNames::COAT_NORMAL, use(index, coating, "clearcoatNormalTexture"));
    add(MaterialNames::ANISOTROPY, use(index, "KHR_materials_anisotropy", "anisotropyTexture"));
    if (m.normalTexture.index >= 0) {
        setUniform(stateSet, MaterialNames::normalScale, float(m.normalTexture.scale));
        setUniform(stateSet, MaterialNames::normalUp, -1.0f);
    }
    const tinygltf::Value* coat = extension(m.extensions, coating);
    if (coat && coat->Has("clearcoatNormalTexture")) {
        const float scale = float(numberOf(coat->Get("clearcoatNormalTexture"), "scale", 1.0));
        setUniform(stateSet, MaterialNames::coatNormalScale, scale);
        setUniform(stateSet, MaterialNames::coatNormalUp, -1.0f);
    }
    if (m.occlusionTexture.index >= 0) setUniform(stateSet, MaterialNames::occlusionStrength, float(m.occlusionTexture.strength));
}

void Materials::addSurface(osg::StateSet& stateSet, const tinygltf::Material& m, Form form)
{
    const std::vector<double>& c = m.pbrMetallicRoughness.baseColorFactor;
    const osg::Vec3f emissive = m.emissiveFactor.empty() ? osg::Vec3f() : toVec3f(m.emissiveFactor);
    const tinygltf::Value* strength = extension(m.extensions, "KHR_materials_emissive_strength");
    const osg::Vec3f emission = emissive * float(strength ? numberOf(*strength, "emissiveStrength", 1.0) : 1.0);

    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setName(m.name);
    const osg::Vec4 color = displayColor(osg::Vec4d(c[0], c[1], c[2], alphaOf(m)));
    material->setDiffuse(osg::Material::FRONT_AND_BACK, color);
    material->setAmbient(osg::Material::FRONT_AND_BACK, color);
    material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, 1));
    if (m.emissiveTexture.index < 0)
        material->setEmission(osg::Material::FRONT_AND_BACK, displayColor(osg::Vec4d(osg::Vec3d(emission), 1.0)));
    if (form.vertexColors) material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    stateSet.setAttributeAndModes(material);
    if (form.unlit) return stateSet.setMode(GL_LIGHTING, osg::StateAttribute::OFF);

    osgEnvLight::Material::setCookTorrance(stateSet, toVec3f(c), float(m.pbrMetallicRoughness.metallicFactor),
                                           float(m.pbrMetallicRoughness.roughnessFactor));
    if (form.vertexColors) osgEnvLight::Material::setVertexColors(stateSet);
    if (emission.length2() > 0.0f) setUniform(stateSet, MaterialNames::emission, emission);
    addExtensions(stateSet, m);
}

void Materials::addExtensions(osg::StateSet& stateSet, const tinygltf::Material& m)
{
    if (const tinygltf::Value* coat = extension(m.extensions, "KHR_materials_clearcoat")) {
        osgEnvLight::Material::setCoat(stateSet, float(numberOf(*coat, "clearcoatFactor", 0.0)),
                                       float(numberOf(*coat, "clearcoatRoughnessFactor", 0.0)));
    }
    if (const tinygltf::Value* brushed = extension(m.extensions, "KHR_materials_anisotropy")) {
        // By the tangents of the normal map; without one, of the first coordinates.
        const unsigned set = m.normalTexture.index >= 0 ? use(m.normalTexture).texCoord : 0;
        const double rotation = osg::RadiansToDegrees(numberOf(*brushed, "anisotropyRotation", 0.0));
        osgEnvLight::Material::setAnisotropy(stateSet, float(numberOf(*brushed, "anisotropyStrength", 0.0)), float(rotation),
                                             true, arrayOf(set, use(m.pbrMetallicRoughness.baseColorTexture).texCoord));
    }
    const tinygltf::Value* ior = extension(m.extensions, "KHR_materials_ior");
    const tinygltf::Value* specular = extension(m.extensions, "KHR_materials_specular");
    if (!ior && !specular) return;
    osgEnvLight::Material::setDielectric(stateSet, float(ior ? numberOf(*ior, "ior", 1.5) : 1.5),
                                         float(specular ? numberOf(*specular, "specularFactor", 1.0) : 1.0),
                                         specular ? colorOf(*specular, "specularColorFactor", 1.0f) : osg::Vec3f(1, 1, 1));
}

void Materials::addBlending(osg::StateSet& stateSet, const tinygltf::Material& m)
{
    if (blends(m)) {
        stateSet.setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
        stateSet.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    } else if (m.alphaMode == "MASK") {
        stateSet.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GEQUAL, float(m.alphaCutoff)));
    }
    if (m.doubleSided) {
        osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
        model->setTwoSided(true);
        stateSet.setAttribute(model);
        stateSet.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    } else {
        stateSet.setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
    }
}

osg::StateSet* Materials::stateSet(int index, Form form)
{
    form.unlit = form.unlit || isUnlit(index);
    osg::ref_ptr<osg::StateSet>& result = _stateSets[{index, form.vertexColors, form.unlit}];
    if (result) return result.get();
    const tinygltf::Material& m = material(index);
    result = new osg::StateSet;
    result->setName(m.name);
    addSurface(*result, m, form);
    addTextures(*result, index);
    addBlending(*result, m);
    return result.get();
}

}  // namespace osgEnvLight::gltf
