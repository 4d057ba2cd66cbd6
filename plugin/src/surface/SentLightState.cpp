// SPDX-License-Identifier: MIT
#include "surface/SentLightState.h"

#include "surface/MaterialMaps.h"

#include <osg/TexEnv>

#include <algorithm>

#include "glsl.h"
#include "lib/fresnel.glsl"
#include "lib/strauss.glsl"
#include "lib/tone.glsl"

namespace osgEnvLight
{

namespace
{

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
osg::Vec3f possible(const osg::Vec3f& reflectance)
{
    return perChannel(reflectance, [](double x) { return x > 0.0 ? std::min(x, 0.98) : 0.0; });  // NaN sends nothing
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

float SentLightState::opacity() const
{
    const osg::Material* m = osgMaterial();
    const float material = m && !vertexColored() ? m->getDiffuse(osg::Material::FRONT).a() : 1.0f;
    const float texel = texture() && textureMode() != TEXTURE_DECAL ? textureFacts().opacity : 1.0f;
    return textureMode() == TEXTURE_REPLACES ? texel : material * texel;
}

SentLight SentLightState::hostLight(const osg::Vec3f& color, bool displayColors) const
{
    if (unlit()) return {osg::Vec3f(), color};
    const osg::Material* m = osgMaterial();
    SentLight sent{color, emission(displayColors)};
    if (paintedReflection()) return sent;
    if (phongMaterial()) sent.reflectance += decoded(rgb(m->getSpecular(osg::Material::FRONT)), displayColors);
    const float most = std::max({1.0f, sent.reflectance[0], sent.reflectance[1], sent.reflectance[2]});
    sent.reflectance /= most;
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
    switch (brdf()) {
        case Material::LAMBERT:
            sent.reflectance = color;
            break;
        case Material::PHONG:
        case Material::BLINN_PHONG:
            sent.reflectance = color + _specular;
            break;
        case Material::COOK_TORRANCE:
        case Material::BECKMANN: {
            const float glass = float(glsl::DIELECTRIC_F0);
            sent.reflectance = mixed(color + (dielectric() ? _dielectric : osg::Vec3f(glass, glass, glass)), color, _metalness);
            break;
        }
        case Material::STRAUSS: {
            const auto diffuse = float(glsl::straussDiffuse(double(_smoothness), double(_metalness)));
            sent.reflectance = mixed(color * diffuse, color, _metalness);
            break;
        }
        default:
            break;
    }
    if (emits()) sent.emission = emission(displayColors);
    sent.reflectance = possible(sent.reflectance);
    return sent;
}

}  // namespace osgEnvLight
