// SPDX-License-Identifier: MIT
#include "Reflection.h"

#include "Directions.h"

#include "base/Limits.h"
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

// Scale and offset of F0, and what edges take, at (roughness, cos) in a block of the model's own table, which is part of its
// definition.
glm::dvec3 albedoInBlock(const osg::Image& table, int number, double roughness, double cosV)
{
    const int n = table.t();
    const auto* texels = reinterpret_cast<const float*>(table.data());
    const glm::dvec2 p = glm::clamp(glm::dvec2(roughness, std::sqrt(cosV)), 0.0, 1.0) * double(n - 1);
    const glm::ivec2 i = glm::min(glm::ivec2(p), n - 2);
    const glm::dvec2 f = p - glm::dvec2(i);
    const int block = n * number;
    auto at = [&](int x, int y) {
        const float* t = texels + 3 * (y * table.s() + block + x);
        return glm::dvec3(double(t[0]), double(t[1]), double(t[2]));
    };
    return (1.0 - f.y) * ((1.0 - f.x) * at(i.x, i.y) + f.x * at(i.x + 1, i.y)) +
           f.y * ((1.0 - f.x) * at(i.x, i.y + 1) + f.x * at(i.x + 1, i.y + 1));
}

glm::dvec3 microfacetAlbedo(int brdf, double roughness, double cosV)
{
    static const osg::ref_ptr<osg::Image> table = albedoTableImage();
    return albedoInBlock(*table, glsl::albedoBlock(brdf), roughness, cosV);
}

glm::dvec3 anisotropicAlbedo(const glm::dvec2& alpha, const glm::dvec3& v)
{
    static const osg::ref_ptr<osg::Image> table = albedoTableImage(true);
    const glm::dvec2 about = glsl::anisotropicRoughness(alpha, v);
    const double block = about.y * (limits::ANISOTROPY_BLOCKS - 1);
    const int below = std::min(int(block), limits::ANISOTROPY_BLOCKS - 2);
    const auto at = [&](int i) { return albedoInBlock(*table, limits::ALBEDO_BLOCKS + i, about.x, v.z); };
    return glm::mix(at(below), at(below + 1), block - below);
}

// The alphas of GGX's normals along the frame's x and y.
template <class Lobe>
glm::dvec2 alphaOf(const Lobe& lobe)
{
    const double alpha = lobe.roughness * lobe.roughness;
    return lobe.anisotropy > 0.0 ? glm::dvec2(glsl::anisotropicAlpha(alpha, lobe.anisotropy)) : glm::dvec2(alpha);
}

template <class Lobe>
glsl::Bsdf bsdfOf(const Lobe& lobe)
{
    glsl::Bsdf b;
    b.brdf = lobe.brdf;
    b.f0 = lobe.f0;
    b.roughness = lobe.roughness;
    b.energy = lobe.energy;
    b.anisotropy = lobe.anisotropy;
    b.edgeLoss = lobe.edgeLoss;
    return b;
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
    _emission = (m.unlit ? base : m.emission) * m.emissionScale;
    if (m.unlit) return;
    _albedo = base;
    _base.brdf = m.brdf;
    _diffuseRoughness = glsl::unpackDiffuseRoughness(glsl::packDiffuseRoughness(m.diffuseRoughness));
    if (_diffuseRoughness > 0.0) setView(ray.direction);
    if (m.brdf != Material::LAMBERT) {
        if (m.anisotropy > 0.0) setBrushing(hit);
        setView(ray.direction);
        setParameters(m, base);
        setLobes(m);
    }
    _diffuse = _albedo * _body / pi;
}

// The frame's x is the direction in which highlights are drawn out.
void Reflection::setBrushing(const SurfaceHit& hit)
{
    const TriangleMesh& mesh = *hit.mesh;
    const SurfaceMaterial& m = mesh.material;
    const auto place = [&](int corner) { return glm::dvec3(mesh.positions[hit.triangle[corner]]); };
    const auto coordinate = [&](int corner) { return glm::dvec2(mesh.texCoords[hit.triangle[corner]]); };
    const glm::dvec3 p1 = place(1) - place(0), p2 = place(2) - place(0);
    const glm::dvec2 c1 = coordinate(1) - coordinate(0), c2 = coordinate(2) - coordinate(0);
    // Positions by coordinates: p = s alongS + t alongT.
    const double area = c1.x * c2.y - c2.x * c1.y;
    const glm::dvec3 alongS = (c2.y * p1 - c1.y * p2) * area, alongT = (c1.x * p2 - c2.x * p1) * area;
    const auto inPlane = [&](const glm::dvec3& d) { return d - glm::dot(d, _normal) * _normal; };
    const bool mapped = area != 0.0 && glm::length(inPlane(alongS)) > 0.0;
    const glm::dvec3 t = mapped ? inPlane(alongS) : glm::cross(m.axis, _normal);
    if (!(glm::length(t) > 0.0)) return;
    const glm::dvec3 tangent = glm::normalize(t);
    glm::dvec3 bitangent = glm::cross(_normal, tangent);
    if (mapped && glm::dot(bitangent, alongT) * m.anisotropyUp < 0.0) bitangent = -bitangent;
    const glm::dvec3 x = m.anisotropyDirection.x * tangent + m.anisotropyDirection.y * bitangent;
    _frame = glm::dmat3(x, glm::cross(_normal, x), _normal);
    _base.anisotropy = m.anisotropy;
}

void Reflection::setView(const glm::dvec3& direction)
{
    _view = local(-direction);
    _view.z = std::max(_view.z, 1e-4);  // as in specular.frag: interpolated normals may lean away from the eye
    _view = glm::normalize(_view);
    _reflected = _frame * glm::dvec3(-_view.x, -_view.y, _view.z);
}

void Reflection::setParameters(const SurfaceMaterial& m, const glm::dvec3& base)
{
    switch (m.brdf) {
        case Material::COOK_TORRANCE:
        case Material::BECKMANN:
            _albedo = base * (1.0 - m.metalness);
            _base.f0 = glm::mix(m.dielectric, base, m.metalness);
            _base.roughness = m.roughness;
            break;
        case Material::STRAUSS:
            _albedo = base * glsl::straussDiffuse(m.smoothness, m.metalness);
            _base.f0 = glm::mix(glm::dvec3(1.0), base, m.metalness);
            _base.roughness = glsl::phongRoughness(glsl::straussExponent(m.smoothness));
            break;
        default:
            _base.f0 = m.specular;
            _base.roughness = glsl::phongRoughness(m.exponent);
    }
    if (!m.limited) return;
    const glm::dvec3 sum = _albedo + _base.f0;
    const double scale = 1.0 / std::max(1.0, std::max(sum.r, std::max(sum.g, sum.b)));
    _albedo *= scale;
    _base.f0 *= scale;
}

void Reflection::setLobes(const SurfaceMaterial& m)
{
    // Of the diffuse layer's share the shader asks at the unclamped cosine; both are the same but at grazing angles.
    const double c = _view.z;
    const glm::dvec3 table =
        _base.brdf == Material::STRAUSS
            ? glm::dvec3(glsl::straussReflectance(glsl::straussSmoothness(glsl::phongExponent(_base.roughness)), c, c), 0.0)
        : _base.anisotropy > 0.0 ? anisotropicAlbedo(alphaOf(_base), _view)
                                 : microfacetAlbedo(_base.brdf, _base.roughness, c);
    glsl::Bsdf b = glsl::makeBsdf(_base.brdf, _base.f0, _base.roughness, glm::dvec2(table));
    if (m.edge != glm::dvec3(1.0)) {
        const glm::dvec3 edge = glsl::unpackEdge(glsl::packEdge(glm::mix(glm::dvec3(1.0), m.edge, m.metalness)));
        _base.edgeLoss = glsl::edgeLoss(_base.f0, edge);
        b = glsl::withEdgeLoss(b, _base.edgeLoss, table.z);
    }
    if (m.coat > 0.0) {
        glsl::Coat coat;
        coat.strength = m.coat;
        coat.roughness = m.coatRoughness;
        const glsl::Bsdf top = glsl::coatBsdf(coat, glm::dvec2(microfacetAlbedo(Material::COOK_TORRANCE, m.coatRoughness, c)));
        b = glsl::belowCoat(b, top.reflected);
        _emission *= 1.0 - m.coat * glsl::fresnelSchlick(top.f0, c);
        _coat.brdf = Material::COOK_TORRANCE;
        _coat.f0 = top.f0;
        _coat.energy = top.energy;
        _coat.roughness = m.coatRoughness;
        _coat.wide = m.coatRoughness * m.coatRoughness >= mirrorAlpha;
        if (!_coat.wide) addMirror(_coat);
    }
    _base.energy = b.energy;
    _body = b.body;
    const bool black = std::max(_base.f0.r, std::max(_base.f0.g, _base.f0.b)) <= 0.0;
    if (black && (glsl::isMirrored(_base.brdf) || _base.brdf == Material::BLINN_PHONG)) return;
    const glm::dvec2 alpha = alphaOf(_base);
    _base.wide = std::sqrt(alpha.x * alpha.y) >= mirrorAlpha;
    if (!_base.wide) addMirror(_base);
}

void Reflection::addMirror(const Lobe& lobe)
{
    _mirror = true;
    const double c = _view.z;
    const double n = glsl::phongExponent(lobe.roughness);
    const glsl::Bsdf b = bsdfOf(lobe);
    _mirrorWeight += glsl::isMirrored(lobe.brdf) ? glsl::bsdfMirrored(b, c, c) * ((n + 2.0) / (n + 1.0) * c)
                                                 : lobe.energy * glsl::bsdfFresnel(b, c);
}

glm::dvec3 Reflection::value(const Lobe& lobe, const glm::dvec3& toLight) const
{
    if (!lobe.wide) return glm::dvec3(0.0);
    return glsl::bsdfLobe(bsdfOf(lobe), _view, toLight);
}

glm::dvec3 Reflection::diffuse(const glm::dvec3& l) const
{
    if (_diffuseRoughness <= 0.0) return _diffuse;
    const glm::dvec3 toLight = local(l);
    const glsl::RoughDiffuse layer = glsl::roughDiffuse(_diffuse * pi, _diffuseRoughness);
    return glsl::roughDiffuseBrdf(layer, _view.z, std::max(toLight.z, 0.0), glm::dot(_view, toLight)) / pi;
}

glm::dvec3 Reflection::glossy(const glm::dvec3& l) const
{
    if (!hasLobe()) return glm::dvec3(0.0);
    const glm::dvec3 toLight = local(l);
    return toLight.z <= 0.0 ? glm::dvec3(0.0) : value(_base, toLight) + value(_coat, toLight);
}

glm::dvec3 Reflection::sampleCosine(const glm::dvec2& u) const
{
    return _frame * aboutPole(std::sqrt(1.0 - u.x), u.y);
}

glm::dvec3 Reflection::sampleHemisphere(const glm::dvec2& u) const
{
    return _frame * aboutPole(1.0 - u.x, u.y);
}

glm::dvec3 Reflection::sample(const Lobe& lobe, const glm::dvec2& u) const
{
    if (glsl::isMirrored(lobe.brdf)) {
        // 1 - u^(1/(n+1)) without the difference
        const double height = -std::expm1(std::log1p(-u.x) / (glsl::phongExponent(lobe.roughness) + 1.0));
        return frameAbout(_reflected) * aboutPoleByHeight(height, u.y);
    }
    const glm::dvec2 slope =
        std::sqrt(u.x / (1.0 - u.x)) * alphaOf(lobe) * glm::dvec2(std::cos(2.0 * pi * u.y), std::sin(2.0 * pi * u.y));
    const glm::dvec3 h = glm::normalize(glm::dvec3(slope, 1.0));
    const double c = glm::dot(_view, h);
    return c > 0.0 ? _frame * glm::normalize(2.0 * c * h - _view) : glm::dvec3(0.0);
}

glm::dvec3 Reflection::sampleLobe(const glm::dvec2& u) const
{
    if (!_coat.wide) return sample(_base, u);
    if (!_base.wide) return sample(_coat, u);
    return u.x < 0.5 ? sample(_base, glm::dvec2(2.0 * u.x, u.y)) : sample(_coat, glm::dvec2(2.0 * u.x - 1.0, u.y));
}

double Reflection::cosineDensity(const glm::dvec3& l) const
{
    return cosine(l) / pi;
}

double Reflection::hemisphereDensity(const glm::dvec3& l) const
{
    return glm::dot(_normal, l) > 0.0 ? 0.5 / pi : 0.0;
}

double Reflection::density(const Lobe& lobe, const glm::dvec3& l) const
{
    if (glsl::isMirrored(lobe.brdf)) {
        const double n = glsl::phongExponent(lobe.roughness);
        return (n + 1.0) / (2.0 * pi) * glsl::phongPower(_reflected, l, n);
    }
    const glm::dvec3 h = glm::normalize(_view + local(l));
    if (h.z <= 0.0) return 0.0;
    // D written out a second time, by slopes [Walter 2007, eq. 33; Heitz 2014, eq. 85].
    const double cos2 = h.z * h.z;
    const glm::dvec2 alpha = alphaOf(lobe), slope = glm::dvec2(h) / h.z / alpha;
    const double spread = 1.0 + glm::dot(slope, slope);
    const double d = 1.0 / (pi * alpha.x * alpha.y * cos2 * cos2 * spread * spread);
    return d * h.z / (4.0 * std::max(glm::dot(_view, h), 1e-12));
}

double Reflection::lobeDensity(const glm::dvec3& l) const
{
    if (!_coat.wide) return density(_base, l);
    if (!_base.wide) return density(_coat, l);
    return 0.5 * (density(_base, l) + density(_coat, l));
}

}  // namespace osgEnvLight
