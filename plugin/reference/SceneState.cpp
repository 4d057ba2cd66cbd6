// SPDX-License-Identifier: MIT
#include "SceneState.h"

#include "surface/MaterialMaps.h"

#include <osgEnvLight/Material>

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/PolygonMode>
#include <osg/TexEnv>
#include <osg/TexMat>

#include <algorithm>
#include <iterator>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

glm::dvec3 rgb(const osg::Vec4& c)
{
    return glm::dvec3(c.r(), c.g(), c.b());
}

glm::dvec3 rgb(const osg::Vec3f& c)
{
    return glm::dvec3(c.x(), c.y(), c.z());
}

}  // namespace

bool SurfaceMaterial::alphaPasses(double alpha) const
{
    switch (alphaFunction) {
        case GL_NEVER:
            return false;
        case GL_LESS:
            return alpha < alphaReference;
        case GL_EQUAL:
            return alpha == alphaReference;
        case GL_LEQUAL:
            return alpha <= alphaReference;
        case GL_GREATER:
            return alpha > alphaReference;
        case GL_NOTEQUAL:
            return alpha != alphaReference;
        case GL_GEQUAL:
            return alpha >= alphaReference;
        default:
            return true;
    }
}

std::shared_ptr<const TextureImage> TextureCache::get(const osg::Texture& texture, bool linear, std::string& reason)
{
    auto [entry, isNew] = _entries.try_emplace({&texture, linear});
    if (isNew) entry->second.image = TextureImage::create(texture, linear, entry->second.reason);
    reason = entry->second.reason;
    return entry->second.image;
}

void SceneState::merge(const osg::StateSet& s)
{
    SurfaceState::merge(s);
    _alphaTest.merge(s.getMode(GL_ALPHA_TEST));
    _cullFace.merge(s.getMode(GL_CULL_FACE));
    for (GLenum plane = GL_CLIP_PLANE0; plane < GL_CLIP_PLANE0 + 6; ++plane) _clip.merge(s.getMode(plane));
    _alphaFunction.merge(s.getAttributePair(osg::StateAttribute::ALPHAFUNC));
    _cullSide.merge(s.getAttributePair(osg::StateAttribute::CULLFACE));
    _frontFace.merge(s.getAttributePair(osg::StateAttribute::FRONTFACE));
    _blendFunction.merge(s.getAttributePair(osg::StateAttribute::BLENDFUNC));
    _polygonMode.merge(s.getAttributePair(osg::StateAttribute::POLYGONMODE));
    for (const auto& [name, pair] : s.getUniformList()) {
        const auto former = _uniforms.find(name);
        if (former == _uniforms.end() || stateWins(pair.second, former->second.second)) _uniforms[name] = pair;
    }
}

template <class T>
T SceneState::uniform(const char* name, T value) const
{
    const auto found = _uniforms.find(name);
    if (found != _uniforms.end()) found->second.first->get(value);
    return value;
}

void SceneState::setHostMaterial(SurfaceMaterial& m, bool linearColors) const
{
    const osg::Material* material = osgMaterial();
    if (!material) return;
    const osg::Vec4 diffuse = material->getDiffuse(osg::Material::FRONT);
    const auto decoded = [&](const glm::dvec3& c) { return linearColors ? c : glm::dvec3(glsl::typedDecode3(c)); };
    m.color = glm::dvec4(rgb(diffuse), diffuse.a());
    m.emission = decoded(rgb(material->getEmission(osg::Material::FRONT)));
    if (!phongMaterial()) return;
    m.brdf = Material::BLINN_PHONG;
    m.limited = true;
    m.specular = decoded(rgb(material->getSpecular(osg::Material::FRONT)));
    m.exponent = double(material->getShininess(osg::Material::FRONT));
}

void SceneState::setOwnMaterial(SurfaceMaterial& m) const
{
    if (emits()) m.emission = rgb(uniform("envlightEmission", osg::Vec3f()));
    if (isAreaLight()) m.emission = rgb(uniform("envlightLight", osg::Vec3f()));
    const bool metallic = brdf() == Material::COOK_TORRANCE || brdf() == Material::BECKMANN || brdf() == Material::STRAUSS;
    m.color = glm::dvec4(rgb(uniform(metallic ? "envlightBaseColor" : "envlightDiffuse", osg::Vec3f())), m.color.a);
    m.metalness = double(uniform("envlightMetalness", 0.0f));
    m.roughness = double(uniform("envlightRoughness", 0.0f));
    m.smoothness = double(uniform("envlightSmoothness", 0.0f));
    m.specular = rgb(uniform("envlightSpecular", osg::Vec3f()));
    m.exponent = double(uniform("envlightExponent", 0.0f));
    if (coated()) {
        m.coat = double(uniform(MaterialMaps::coat, 0.0f));
        m.coatRoughness = double(uniform(MaterialMaps::coatRoughness, 0.0f));
    }
    if (edged()) m.edge = rgb(uniform(MaterialMaps::edge, osg::Vec3f(1, 1, 1)));
    if (roughDiffuse()) m.diffuseRoughness = double(uniform(MaterialMaps::diffuseRoughness, 0.0f));
    if (anisotropic()) {
        m.anisotropy = double(uniform(MaterialMaps::anisotropy, 0.0f));
        const osg::Vec2f d = uniform(MaterialMaps::anisotropyDirection, osg::Vec2f(1, 0));
        m.anisotropyDirection = glm::dvec2(double(d.x()), double(d.y()));
        m.anisotropyUp = double(uniform(MaterialMaps::anisotropyUp, 1.0f));
    }
    if (!coated() && dielectric()) {
        m.dielectric = rgb(uniform(MaterialMaps::dielectric, osg::Vec3f()));
    }
}

void SceneState::setTexture(SurfaceMaterial& m, TextureCache& textures, std::set<std::string>& leftOut) const
{
    const osg::Texture* t = texture();
    if (!t) return;
    std::string reason;
    m.texture = textures.get(*t, textureFacts().linear, reason);
    if (!m.texture) leftOut.insert("textures, " + reason);
    if (m.texture) m.textureMode = textureMode();
    if (m.textureMode == TEXTURE_BLENDS) m.textureColor = rgb(static_cast<const osg::TexEnv*>(textureEnvironment())->getColor());
    if (coordinates() != FROM_VERTICES) leftOut.insert("generated texture coordinates: the vertices' own are taken");
}

SurfaceMaterial SceneState::material(const osg::Geometry& geometry, bool linearColors, TextureCache& textures,
                                     std::set<std::string>& leftOut) const
{
    SurfaceMaterial m;
    m.brdf = std::max(brdf(), 0);
    m.encoded = (brdf() < 0 || vertexColored()) && !linearColors;
    m.unlit = unlit();
    m.vertexColored = vertexColored();
    setHostMaterial(m, linearColors);
    if (brdf() >= 0) setOwnMaterial(m);
    setTexture(m, textures, leftOut);
    if (const char* what = unsupported(&geometry)) leftOut.insert(std::string(what) + ": lit as if they were not there");
    for (unsigned map = 0; map < std::size(MaterialMaps::samplers); ++map)
        if (mapped(map))
            leftOut.insert("normal, roughness, emission, anisotropy and coat maps: their surfaces have the material without");
    if (anisotropic() && (firstMatrix() || uniform(MaterialMaps::anisotropyTexCoord, 0) != 0))
        leftOut.insert("anisotropy by other texture coordinates than the first as they are: it is by those of the base colour");
    if (anisotropic() && geometry.getVertexAttribArray(Material::tangentAttribute))
        leftOut.insert("anisotropy by the vertices' tangents: it is by those of the texture coordinates");
    for (const TextureStage& stage : stages(&geometry))
        if (stage.kind != limits::STAGE_NONE)
            leftOut.insert("texture units beyond the first, and normal maps: their surfaces have the first alone");
    if (paintedReflection()) leftOut.insert("painted reflections: their surfaces have the material without");
    if (_alphaTest.on && _alphaFunction.attribute) {
        const auto& f = static_cast<const osg::AlphaFunc&>(*_alphaFunction.attribute);
        m.alphaTest = f.getFunction() != osg::AlphaFunc::ALWAYS;
        m.alphaFunction = GLenum(f.getFunction());
        m.alphaReference = double(f.getReferenceValue());
    }
    m.blended = blended(&geometry);
    if (m.blended && _blendFunction.attribute) {
        const auto& f = static_cast<const osg::BlendFunc&>(*_blendFunction.attribute);
        if (f.getSource() != osg::BlendFunc::SRC_ALPHA || f.getDestination() != osg::BlendFunc::ONE_MINUS_SRC_ALPHA)
            leftOut.insert("blend functions other than alpha over: taken as that");
    }
    const auto* front = static_cast<const osg::FrontFace*>(_frontFace.attribute);
    m.clockwiseFront = front && front->getMode() == osg::FrontFace::CLOCKWISE;
    if (_cullFace.on) {
        const auto* side = static_cast<const osg::CullFace*>(_cullSide.attribute);
        const auto mode = side ? side->getMode() : osg::CullFace::BACK;
        m.sides = mode == osg::CullFace::FRONT ? SurfaceMaterial::SHOW_BACK : SurfaceMaterial::SHOW_FRONT;
    }
    if (ownProgram()) leftOut.insert("shader programs of the scene's own: their surfaces have their materials instead");
    if (_clip.on) leftOut.insert("clip planes: what they cut off is there");
    const auto* polygon = static_cast<const osg::PolygonMode*>(_polygonMode.attribute);
    if (polygon && polygon->getMode(osg::PolygonMode::FRONT) != osg::PolygonMode::FILL)
        leftOut.insert("polygons drawn as lines or points: they are filled");
    return m;
}

osg::Matrixd SceneState::textureMatrix() const
{
    const auto* matrix = static_cast<const osg::TexMat*>(firstMatrix());
    return matrix ? osg::Matrixd(matrix->getMatrix()) : osg::Matrixd();
}

}  // namespace osgEnvLight
