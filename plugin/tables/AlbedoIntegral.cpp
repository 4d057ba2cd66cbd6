// SPDX-License-Identifier: MIT
#include "AlbedoIntegral.h"

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace
{

glsl::vec3 viewAt(double cosV)
{
    const double mu = std::max(cosV, 1e-4);
    return glsl::vec3(std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu);
}

double alphaOf(double roughness)
{
    return std::pow(std::max(roughness, 0.01), 2.0);
}

// Mean of GGX's visible normals' reflections, each weighed by what it returns, as scale and offset of F0, and of edgeShare().
template <class Weight>
std::array<double, 3> meanReflection(const glsl::vec3& v, const glsl::vec2& alpha, glsl::uint count, const Weight& weight)
{
    glsl::vec3 sum(0.0);
    for (glsl::uint i = 0; i < count; ++i) {
        const glsl::vec3 h = glsl::ggxVisibleNormalSample(v, alpha, glsl::hammersley(i, count));
        const double c = glsl::dot(v, h);
        const glsl::vec3 l = 2.0 * c * h - v;
        if (l.z <= 0.0) continue;
        const double grazing = glsl::fresnelShare(c);
        sum += weight(h, l) * glsl::vec3(1.0 - grazing, grazing, glsl::edgeShare(c));
    }
    sum /= double(count);
    return {sum.x, sum.y, sum.z};
}

}  // namespace

std::array<double, 3> lobeAlbedo(int brdf, double roughness, double cosV, unsigned points)
{
    const double alpha = alphaOf(roughness);
    const glsl::vec3 v = viewAt(cosV);
    const glsl::Bsdf b = glsl::makeBsdf(brdf, glsl::vec3(0.0), std::sqrt(alpha), glsl::vec2(1.0, 0.0));
    return meanReflection(v, glsl::vec2(alpha), points, [&](const glsl::vec3& h, const glsl::vec3& l) {
        return brdf == BRDF_COOK_TORRANCE ? glsl::ggxG2OverG1(v.z, l.z, alpha)
                                          : glsl::bsdfMicrofacets(b, v, l, h) * l.z / glsl::ggxReflectionPdf(v, h, alpha);
    });
}

std::array<double, 3> brushedAlbedo(double along, double across, double cosV, unsigned points)
{
    const glsl::vec2 alpha(alphaOf(along), alphaOf(across));
    const glsl::vec3 v = viewAt(cosV);
    const double root = glsl::ggxRoot(v, alpha);
    return meanReflection(v, alpha, points, [&](const glsl::vec3&, const glsl::vec3& l) {
        return glsl::ggxUnshadowed(v.z, root, l.z, glsl::ggxRoot(l, alpha));
    });
}
