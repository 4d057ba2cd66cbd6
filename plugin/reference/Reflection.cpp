// SPDX-License-Identifier: MIT
#include "Reflection.h"

#include "Directions.h"

#include "surface/AlbedoTable.h"
#include <osgEnvLight/Material>

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// What the shader takes for a mirror is one here.
const double mirrorAlpha = 0.0009;

// Scale and offset of F0 at (roughness, cos): the model's own table, which is part of its definition.
glm::dvec2 lobeAlbedo(double roughness, double cosV)
{
    static const osg::ref_ptr<osg::Image> table = albedoTableImage();
    const int n = table->s();
    const auto* texels = reinterpret_cast<const float*>(table->data());
    const glm::dvec2 p = glm::clamp(glm::dvec2(roughness, std::sqrt(cosV)), 0.0, 1.0) * double(n - 1);
    const glm::ivec2 i = glm::min(glm::ivec2(p), n - 2);
    const glm::dvec2 f = p - glm::dvec2(i);
    auto at = [&](int x, int y) {
        const float* t = texels + 2 * (y * n + x);
        return glm::dvec2(double(t[0]), double(t[1]));
    };
    return (1.0 - f.y) * ((1.0 - f.x) * at(i.x, i.y) + f.x * at(i.x + 1, i.y)) +
           f.y * ((1.0 - f.x) * at(i.x, i.y + 1) + f.x * at(i.x + 1, i.y + 1));
}

// specular.md, 7.
glm::dvec3 multipleScattering(const glm::dvec3& f0, double single)
{
    const double e = std::clamp(single, 0.01, 1.0);
    const double p = 1.0 + 1.1 * (1.0 - e) * (1.0 - e);
    return 1.0 + glm::pow(glm::max(f0, 1e-6), glm::dvec3(p)) * (1.0 / e - 1.0);
}

glm::dvec3 shadingNormal(const SurfaceHit& hit)
{
    if (hit.mesh->normals.empty()) return hit.facet;
    const glm::dvec3 n = hit.interpolate(hit.mesh->normals);
    const double length = glm::length(n);
    if (!(length > 0.0)) return hit.facet;
    return (glm::dot(n, hit.facet) < 0.0 ? -1.0 : 1.0) / length * n;
}

}  // namespace

Reflection::Reflection(const SurfaceHit& hit, const Ray& ray, const glm::dvec4& color)
    : _normal(shadingNormal(hit)), _frame(frameAbout(_normal))
{
    const SurfaceMaterial& m = hit.mesh->material;
    const glm::dvec3 base(color);
    _emission = m.unlit ? base : m.emission;
    if (m.unlit) return;
    _albedo = base;
    if (m.brdf != Material::LAMBERT) setView(ray.direction);
    if (m.brdf == Material::COOK_TORRANCE) setCookTorrance(m, base);
    if (m.brdf == Material::PHONG) setPhong(m);
    if (m.brdf != Material::COOK_TORRANCE) _diffuse = _albedo / pi;
}

void Reflection::setView(const glm::dvec3& direction)
{
    _view = local(-direction);
    _view.z = std::max(_view.z, 1e-4);  // as in specular.frag: interpolated normals may lean away from the eye
    _view = glm::normalize(_view);
    _reflected = _frame * glm::dvec3(-_view.x, -_view.y, _view.z);
}

void Reflection::setCookTorrance(const SurfaceMaterial& m, const glm::dvec3& base)
{
    _albedo = base * (1.0 - m.metalness);
    _f0 = glm::mix(glm::dvec3(0.04), base, m.metalness);
    _alpha = m.roughness * m.roughness;
    // Of the diffuse layer's share the shader asks at the unclamped cosine; both are the same but at grazing angles.
    const glm::dvec2 table = lobeAlbedo(m.roughness, _view.z);
    const double single = table.x + table.y;
    _energy = multipleScattering(_f0, single);
    _diffuse = _albedo * glm::max(1.0 - (_f0 * table.x + table.y) * _energy, 0.0) / pi;
    _mirror = _alpha < mirrorAlpha;
    _lobe = !_mirror;
    _mirrorWeight = glsl::fresnelSchlick(_f0, _view.z);
}

void Reflection::setPhong(const SurfaceMaterial& m)
{
    _phong = true;
    _f0 = m.specular;
    if (m.limited) {
        const glm::dvec3 sum = _albedo + _f0;
        const double scale = 1.0 / std::max(1.0, std::max(sum.r, std::max(sum.g, sum.b)));
        _albedo *= scale;
        _f0 *= scale;
    }
    if (std::max(_f0.r, std::max(_f0.g, _f0.b)) <= 0.0) return;
    const double roughness = glsl::phongRoughness(m.exponent);
    _exponent = glsl::phongExponent(roughness);
    _mirror = roughness * roughness < mirrorAlpha;
    _lobe = !_mirror;
    _mirrorWeight = _f0 * ((_exponent + 2.0) / (_exponent + 1.0) * _view.z);
}

glm::dvec3 Reflection::glossy(const glm::dvec3& l) const
{
    if (!_lobe) return glm::dvec3(0.0);
    const glm::dvec3 toLight = local(l);
    if (toLight.z <= 0.0) return glm::dvec3(0.0);
    if (_phong) return _f0 * glsl::phongBrdf(_reflected, l, _exponent);
    const glm::dvec3 h = glm::normalize(_view + toLight);
    return _energy * glsl::fresnelSchlick(_f0, glm::dot(_view, h)) * glsl::ggxBrdf(_view, toLight, _alpha);
}

glm::dvec3 Reflection::sampleCosine(const glm::dvec2& u) const
{
    return _frame * aboutPole(std::sqrt(1.0 - u.x), u.y);
}

glm::dvec3 Reflection::sampleHemisphere(const glm::dvec2& u) const
{
    return _frame * aboutPole(1.0 - u.x, u.y);
}

glm::dvec3 Reflection::sampleLobe(const glm::dvec2& u) const
{
    if (_phong) {
        // 1 - u^(1/(n+1)) without the difference
        const double height = -std::expm1(std::log1p(-u.x) / (_exponent + 1.0));
        return frameAbout(_reflected) * aboutPoleByHeight(height, u.y);
    }
    const double tan2 = _alpha * _alpha * u.x / (1.0 - u.x);
    const glm::dvec3 h = aboutPole(1.0 / std::sqrt(1.0 + tan2), u.y);
    const double c = glm::dot(_view, h);
    return c > 0.0 ? _frame * glm::normalize(2.0 * c * h - _view) : glm::dvec3(0.0);
}

double Reflection::cosineDensity(const glm::dvec3& l) const
{
    return cosine(l) / pi;
}

double Reflection::hemisphereDensity(const glm::dvec3& l) const
{
    return glm::dot(_normal, l) > 0.0 ? 0.5 / pi : 0.0;
}

double Reflection::lobeDensity(const glm::dvec3& l) const
{
    if (_phong) return (_exponent + 1.0) / (2.0 * pi) * glsl::phongPower(_reflected, l, _exponent);
    const glm::dvec3 h = glm::normalize(_view + local(l));
    if (h.z <= 0.0) return 0.0;
    // D written out a second time, in the tangent form [Walter 2007, eq. 33].
    const double cos2 = h.z * h.z;
    const double tan2 = (h.x * h.x + h.y * h.y) / cos2;
    const double a2 = _alpha * _alpha;
    const double d = a2 / (pi * cos2 * cos2 * (a2 + tan2) * (a2 + tan2));
    return d * h.z / (4.0 * std::max(glm::dot(_view, h), 1e-12));
}

}  // namespace osgEnvLight
