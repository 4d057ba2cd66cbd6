// SPDX-License-Identifier: MIT
#include <osgEnvLight/Material>

#include "surface/MaterialMaps.h"

#include <osg/Uniform>

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// Which BRDF, for the CPU. A uniform and not a define, because OSG's XML files lose their place at a list of defines.
const char* const brdfUniform = "envlightBrdf";

template <class T>
void setUniform(osg::StateSet& stateSet, const char* name, const T& value)
{
    stateSet.addUniform(new osg::Uniform(name, value));
}

void setMap(osg::StateSet& stateSet, const std::string& name, osg::Texture2D* map, int set, unsigned unit)
{
    if (map) stateSet.setTextureAttribute(unit, map);
    setUniform(stateSet, name.c_str(), int(unit));
    setUniform(stateSet, (name + "TexCoord").c_str(), set);
    setUniform(stateSet, (name + "Transform").c_str(), osg::Matrix3(1, 0, 0, 0, 1, 0, 0, 0, 1));
}

}  // namespace

void Material::setLambert(osg::StateSet& stateSet, const osg::Vec3f& diffuse)
{
    setUniform(stateSet, brdfUniform, int(LAMBERT));
    setUniform(stateSet, "envlightDiffuse", diffuse);
}

void Material::setPhong(osg::StateSet& stateSet, const osg::Vec3f& diffuse, const osg::Vec3f& specular, float exponent)
{
    setUniform(stateSet, brdfUniform, int(PHONG));
    setUniform(stateSet, "envlightDiffuse", diffuse);
    setUniform(stateSet, "envlightSpecular", specular);
    setUniform(stateSet, "envlightExponent", exponent);
}

void Material::setBlinnPhong(osg::StateSet& stateSet, const osg::Vec3f& diffuse, const osg::Vec3f& specular, float exponent)
{
    setPhong(stateSet, diffuse, specular, exponent);
    setUniform(stateSet, brdfUniform, int(BLINN_PHONG));
}

void Material::setCookTorrance(osg::StateSet& stateSet, const osg::Vec3f& baseColor, float metalness, float roughness,
                               Distribution normals)
{
    setUniform(stateSet, brdfUniform, int(normals == BECKMANN_NORMALS ? BECKMANN : COOK_TORRANCE));
    setUniform(stateSet, "envlightBaseColor", baseColor);
    setUniform(stateSet, "envlightMetalness", metalness);
    setUniform(stateSet, "envlightRoughness", roughness);
    stateSet.removeUniform(MaterialMaps::edge);
}

void Material::setConductor(osg::StateSet& stateSet, const osg::Vec3f& eta, const osg::Vec3f& kappa, float roughness,
                            Distribution normals)
{
    osg::Vec3f f0, edge;
    for (int i = 0; i < 3; ++i) {
        const double n = double(eta.ptr()[i]), k = double(kappa.ptr()[i]);
        const double facing = glsl::fresnelExact(1.0, n, k);
        const double schlick = glsl::fresnelSchlick(glsl::vec3(facing), glsl::EDGE_COSINE).x;
        f0[i] = float(facing);
        edge[i] = float(std::min(glsl::fresnelExact(glsl::EDGE_COSINE, n, k) / schlick, 1.0));
    }
    setCookTorrance(stateSet, f0, 1.0f, roughness, normals);
    setUniform(stateSet, MaterialMaps::edge, edge);
}

void Material::setStrauss(osg::StateSet& stateSet, const osg::Vec3f& color, float smoothness, float metalness)
{
    setUniform(stateSet, brdfUniform, int(STRAUSS));
    setUniform(stateSet, "envlightBaseColor", color);
    setUniform(stateSet, "envlightMetalness", metalness);
    setUniform(stateSet, "envlightSmoothness", smoothness);
}

void Material::setShadowCatcher(osg::StateSet& stateSet, bool on)
{
    setUniform(stateSet, MaterialMaps::shadowCatcher, on);
}

void Material::setVertexColors(osg::StateSet& stateSet, bool on)
{
    setUniform(stateSet, MaterialMaps::vertexColors, on);
}

void Material::setNormalMap(osg::StateSet& stateSet, osg::Texture2D* map, float scale, bool topIsZero, int set, unsigned unit)
{
    setMap(stateSet, MaterialMaps::normal, map, set, unit);
    setUniform(stateSet, MaterialMaps::normalScale, scale);
    setUniform(stateSet, MaterialMaps::normalUp, topIsZero ? -1.0f : 1.0f);
}

void Material::setMetalRoughMap(osg::StateSet& stateSet, osg::Texture2D* map, int set, unsigned unit)
{
    setMap(stateSet, MaterialMaps::metalRough, map, set, unit);
}

void Material::setEmission(osg::StateSet& stateSet, const osg::Vec3f& emission, osg::Texture2D* map, int set, unsigned unit)
{
    setUniform(stateSet, MaterialMaps::emission, emission);
    if (map) setEmissionMap(stateSet, map, set, unit);
}

void Material::setEmissionMap(osg::StateSet& stateSet, osg::Texture2D* map, int set, unsigned unit)
{
    setMap(stateSet, MaterialMaps::emissionMap, map, set, unit);
}

void Material::setLight(osg::StateSet& stateSet, LightMode mode)
{
    setUniform(stateSet, MaterialMaps::lightMode, int(mode));
}

void Material::setDielectric(osg::StateSet& stateSet, float ior, float strength, const osg::Vec3f& color)
{
    const float r = (ior - 1.0f) / (ior + 1.0f);
    osg::Vec3f f0 = color * (r * r);
    for (int i = 0; i < 3; ++i) f0[i] = std::min(f0[i], 1.0f) * strength;
    setUniform(stateSet, MaterialMaps::dielectric, f0);
}

void Material::setDiffuseRoughness(osg::StateSet& stateSet, float roughness)
{
    setUniform(stateSet, MaterialMaps::diffuseRoughness, roughness);
}

void Material::setCoat(osg::StateSet& stateSet, float strength, float roughness)
{
    setUniform(stateSet, MaterialMaps::coat, strength);
    setUniform(stateSet, MaterialMaps::coatRoughness, roughness);
}

void Material::setAnisotropy(osg::StateSet& stateSet, float strength, float rotation, bool topIsZero, int set)
{
    const double angle = osg::DegreesToRadians(double(rotation));
    setUniform(stateSet, MaterialMaps::anisotropy, strength);
    setUniform(stateSet, MaterialMaps::anisotropyDirection, osg::Vec2f(float(std::cos(angle)), float(std::sin(angle))));
    setUniform(stateSet, MaterialMaps::anisotropyTexCoord, set);
    setUniform(stateSet, MaterialMaps::anisotropyUp, topIsZero ? -1.0f : 1.0f);
}

void Material::setAnisotropyMap(osg::StateSet& stateSet, osg::Texture2D* map, int set, unsigned unit)
{
    setMap(stateSet, MaterialMaps::anisotropyMap, map, set, unit);
}

void Material::setCoatMap(osg::StateSet& stateSet, osg::Texture2D* map, int set, unsigned unit)
{
    setMap(stateSet, MaterialMaps::coatMap, map, set, unit);
}

void Material::setCoatRoughnessMap(osg::StateSet& stateSet, osg::Texture2D* map, int set, unsigned unit)
{
    setMap(stateSet, MaterialMaps::coatRoughnessMap, map, set, unit);
}

void Material::setCoatNormalMap(osg::StateSet& stateSet, osg::Texture2D* map, float scale, bool topIsZero, int set, unsigned unit)
{
    setMap(stateSet, MaterialMaps::coatNormalMap, map, set, unit);
    setUniform(stateSet, MaterialMaps::coatNormalScale, scale);
    setUniform(stateSet, MaterialMaps::coatNormalUp, topIsZero ? -1.0f : 1.0f);
}

int Material::brdfOf(const osg::StateSet& stateSet, int inherited)
{
    const osg::Uniform* uniform = stateSet.getUniform(brdfUniform);
    int brdf = inherited;
    return uniform && uniform->get(brdf) && brdf >= LAMBERT && brdf <= STRAUSS ? brdf : inherited;
}

}  // namespace osgEnvLight
