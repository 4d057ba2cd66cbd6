// SPDX-License-Identifier: MIT
#include "surface/SentLightState.h"

#include "surface/MaterialMaps.h"

#include <osg/TexEnv>

#include <algorithm>
#include <cmath>

#include "glsl.h"
#include "lib/fresnel.glsl"
#include "lib/phong.glsl"
#include "lib/strauss.glsl"
#include "lib/tone.glsl"

namespace osgEnvLight
{

namespace
{

const float mostSent = 0.98f;
const osg::Vec3f whole(1, 1, 1);  // all of the light

osg::Vec3f rgb(const osg::Vec4& c)
{
    return osg::Vec3f(c.r(), c.g(), c.b());
}

template <class F>
osg::Vec3f perChannel(const osg::Vec3f& c, F f)
{
    return osg::Vec3f(float(f(double(c[0]))), float(f(double(c[1]))), float(f(double(c[2]))));
}

osg::Vec3f decoded(const osg::Vec3f& c, bool display)
{
    if (!display) return c;
    return perChannel(c, [](double x) { return glsl::typedDecode(x); });
}

osg::Vec3f mixed(const osg::Vec3f& a, const osg::Vec3f& b, float share)
{
    return a * (1.0f - share) + b * share;
}

template <class T>
void read(const osg::StateSet& s, const char* name, T& value)
{
    if (const osg::Uniform* uniform = s.getUniform(name)) uniform->get(value);
}

// No surface sends on more than it gets; what sends on all of it would light a closed room without end.
void makePossible(SentLight& sent)
{
    for (int k = 0; k < 3; ++k) {
        float &diffuse = sent.diffuse[k], &glossy = sent.glossy[k];
        diffuse = diffuse > 0.0f ? std::min(diffuse, 1.0f) : 0.0f;  // NaN sends nothing
        glossy = glossy > 0.0f ? std::min(glossy, 1.0f) : 0.0f;
        const float scale = mostSent / std::max(diffuse + glossy, mostSent);
        diffuse *= scale;
        glossy *= scale;
    }
}

// What a surface reflects of light from all sides, by what it reflects of light at a cosine: Gauss-Jacobi quadrature of two
// points, exact for cubic polynomials of the cosine.
template <class F>
auto meanByCosine(F reflected)
{
    const double root = std::sqrt(6.0);
    return (0.5 - root / 18.0) * reflected((6.0 - root) / 10.0) + (0.5 + root / 18.0) * reflected((6.0 + root) / 10.0);
}

// The same of Schlick's form.
osg::Vec3f meanFresnel(const osg::Vec3f& f0)
{
    const auto grazing = float(glsl::fresnelGrazing(glsl::vec3(f0[0], f0[1], f0[2])));
    return mixed(f0, osg::Vec3f(grazing, grazing, grazing), 1.0f / 21.0f);
}

// In [0,1], whatever the exponent.
float roughnessOf(double exponent)
{
    return float(glsl::phongRoughness(exponent > 0.0 ? exponent : 0.0));
}

}  // namespace

void SentLightState::merge(const osg::StateSet& s)
{
    SurfaceState::merge(s);
    if (s.getUniformList().empty()) return;
    read(s, "envlightBaseColor", _baseColor);
    read(s, "envlightDiffuse", _diffuse);
    read(s, "envlightSpecular", _specular);
    read(s, "envlightMetalness", _metalness);
    read(s, "envlightSmoothness", _smoothness);
    read(s, "envlightExponent", _exponent);
    read(s, "envlightRoughness", _roughness);
    read(s, MaterialMaps::dielectric, _dielectric);
}

// As combined() of pass/surface.glsl, by means.
osg::Vec3f SentLightState::surfaceColor(const osg::Geometry& geometry, const osg::Vec3f& material, bool displayColors) const
{
    osg::Vec3f color = material;
    if (vertexColored() && geometry.getColorArray())
        color = decoded(
            facts() ? facts()->meanColor(*geometry.getColorArray()) : SurfaceFacts::measureMean(*geometry.getColorArray()),
            displayColors);
    else if (white())
        color = osg::Vec3f(1, 1, 1);
    if (!texture()) return color;
    const osg::Vec3f texel = textureFacts().mean;
    switch (textureMode()) {
        case TEXTURE_REPLACES:
            return texel;
        case TEXTURE_DECAL:
            return mixed(color, texel, textureFacts().opacity);
        case TEXTURE_ADDS:
            return perChannel(color + texel, [](double x) { return std::min(x, 1.0); });
        case TEXTURE_BLENDS: {
            const auto* env = dynamic_cast<const osg::TexEnv*>(textureEnvironment());
            const osg::Vec3f other = decoded(env ? rgb(env->getColor()) : osg::Vec3f(), displayColors);
            return osg::componentMultiply(color, osg::Vec3f(1, 1, 1) - texel) + osg::componentMultiply(other, texel);
        }
        default:
            return osg::componentMultiply(color, texel);
    }
}

float SentLightState::opacity(const osg::Geometry& geometry) const
{
    if (const TextureUnit* unit = mask(&geometry)) return factsOf(*unit->texture.as<osg::Texture>()).mean[0];
    const osg::Material* m = osgMaterial();
    const float material = m && !vertexColored() ? m->getDiffuse(osg::Material::FRONT).a() : 1.0f;
    const float texel = texture() && textureMode() != TEXTURE_DECAL ? textureFacts().opacity : 1.0f;
    return textureMode() == TEXTURE_REPLACES ? texel : material * texel;
}

SentLight SentLightState::hostLight(const osg::Vec3f& color, bool displayColors) const
{
    if (unlit()) return {osg::Vec3f(), osg::Vec3f(), color};
    SentLight sent{color, osg::Vec3f(), emission(displayColors)};
    if (paintedReflection()) {
        std::swap(sent.diffuse, sent.glossy);
        sent.roughness = float(glsl::PAINTED_ROUGHNESS);
        return sent;
    }
    if (!phongMaterial()) return sent;
    sent.roughness = roughnessOf(double(osgMaterial()->getShininess(osg::Material::FRONT)));
    sent.glossy = decoded(rgb(osgMaterial()->getSpecular(osg::Material::FRONT)), displayColors);
    const osg::Vec3f sum = sent.diffuse + sent.glossy;
    const float most = std::max({1.0f, sum[0], sum[1], sum[2]});
    sent.diffuse /= most;
    sent.glossy /= most;
    return sent;
}

SentLight SentLightState::sentLight(const osg::Geometry& geometry, bool displayColors) const
{
    const osg::Material* m = osgMaterial();
    osg::Vec3f material = decoded(m ? rgb(m->getDiffuse(osg::Material::FRONT)) : osg::Vec3f(0.8f, 0.8f, 0.8f), displayColors);
    if (brdf() == Material::LAMBERT || brdf() == Material::PHONG || brdf() == Material::BLINN_PHONG) material = _diffuse;
    if (brdf() >= Material::COOK_TORRANCE && brdf() != Material::BLINN_PHONG) material = _baseColor;
    const osg::Vec3f color = surfaceColor(geometry, material, displayColors);
    SentLight sent = hostLight(color, displayColors);
    if (brdf() >= 0) setLayers(sent, color);
    if (emits()) sent.emission = emission(displayColors);
    makePossible(sent);
    return sent;
}

void SentLightState::setLayers(SentLight& sent, const osg::Vec3f& color) const
{
    switch (brdf()) {
        case Material::PHONG:
        case Material::BLINN_PHONG:
            sent.diffuse = color;
            sent.glossy = _specular;
            sent.roughness = roughnessOf(double(_exponent));
            if (brdf() == Material::PHONG)
                sent.glossy *= float(meanByCosine([&](double c) { return glsl::phongAlbedo(double(_exponent), c); }));
            break;
        case Material::COOK_TORRANCE:
        case Material::BECKMANN: {
            const float glass = float(glsl::DIELECTRIC_F0);
            const osg::Vec3f f0 = mixed(dielectric() ? _dielectric : osg::Vec3f(glass, glass, glass), color, _metalness);
            sent.glossy = meanFresnel(f0);
            sent.roughness = _roughness;
            sent.diffuse = osg::componentMultiply(color * (1.0f - _metalness), whole - sent.glossy);
            break;
        }
        case Material::STRAUSS: {
            const double s = double(_smoothness);
            const glsl::vec2 lobe = meanByCosine(
                [&](double c) { return glsl::straussReflectance(s, c, c) * glsl::phongAlbedo(glsl::straussExponent(s), c); });
            sent.glossy = mixed(whole, color, _metalness) * float(lobe.x) + whole * float(lobe.y);
            sent.diffuse = color * float(glsl::straussDiffuse(s, double(_metalness)));
            sent.roughness = roughnessOf(glsl::straussExponent(s));
            break;
        }
        default:
            sent.diffuse = color;
            sent.glossy = osg::Vec3f();
    }
}

}  // namespace osgEnvLight
