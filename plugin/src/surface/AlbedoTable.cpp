// SPDX-License-Identifier: MIT
#include "surface/AlbedoTable.h"

#include "base/Limits.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const int tableSize = 32;
const int microfacets[] = {BRDF_COOK_TORRANCE, BRDF_BECKMANN, BRDF_BLINN_PHONG};
static_assert(std::size(microfacets) == limits::ALBEDO_BLOCKS);

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
glsl::vec3 meanReflection(const glsl::vec3& v, const glsl::vec2& alpha, glsl::uint count, const Weight& weight)
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
    return sum / double(count);
}

// GGX's visible normals bound the weights of all distributions: 1024 points leave less than 1e-3.
glsl::vec3 albedo(int brdf, double roughness, double cosV)
{
    const double alpha = alphaOf(roughness);
    const glsl::vec3 v = viewAt(cosV);
    const glsl::Bsdf b = glsl::makeBsdf(brdf, glsl::vec3(0.0), std::sqrt(alpha), glsl::vec2(1.0, 0.0));
    return meanReflection(v, glsl::vec2(alpha), 1024, [&](const glsl::vec3& h, const glsl::vec3& l) {
        return brdf == BRDF_COOK_TORRANCE ? glsl::ggxG2OverG1(v.z, l.z, alpha)
                                          : glsl::bsdfMicrofacets(b, v, l, h) * l.z / glsl::ggxReflectionPdf(v, h, alpha);
    });
}

// Of GGX's normals with an alpha along the view and another across it; 256 points leave less than .5 %.
glsl::vec3 anisotropicAlbedo(double along, double across, double cosV)
{
    const glsl::vec2 alpha(alphaOf(along), alphaOf(across));
    const glsl::vec3 v = viewAt(cosV);
    const double root = glsl::ggxRoot(v, alpha);
    return meanReflection(v, alpha, 256, [&](const glsl::vec3&, const glsl::vec3& l) {
        return glsl::ggxUnshadowed(v.z, root, l.z, glsl::ggxRoot(l, alpha));
    });
}

osg::ref_ptr<osg::Image> allocate(int blocks)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(blocks * tableSize, tableSize, 1, GL_RGB, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGB32F_ARB);
    return image;
}

// of: its albedo by roughness and cosine
template <class Albedo>
void fill(osg::Image& image, int block, const Albedo& of)
{
    for (int y = 0; y < tableSize; ++y)
        for (int x = 0; x < tableSize; ++x) {
            const double rootMu = double(y) / (tableSize - 1);
            const glsl::vec3 a = of(double(x) / (tableSize - 1), rootMu * rootMu);
            float* out = reinterpret_cast<float*>(image.data(unsigned(block * tableSize + x), unsigned(y)));
            for (int i = 0; i < 3; ++i) out[i] = float(a[i]);
        }
}

osg::ref_ptr<osg::Image> makeTable()
{
    const osg::ref_ptr<osg::Image> image = allocate(limits::ALBEDO_BLOCKS);
    for (const int brdf : microfacets)
        fill(*image, glsl::albedoBlock(brdf), [&](double roughness, double cosV) { return albedo(brdf, roughness, cosV); });
    return image;
}

osg::ref_ptr<osg::Image> makeAnisotropicTable()
{
    const osg::ref_ptr<osg::Image> image = allocate(limits::ALBEDO_BLOCKS + limits::ANISOTROPY_BLOCKS);
    image->copySubImage(0, 0, 0, albedoTableImage().get());
    for (int i = 0; i < limits::ANISOTROPY_BLOCKS; ++i) {
        const double across = double(i) / (limits::ANISOTROPY_BLOCKS - 1);
        fill(*image, limits::ALBEDO_BLOCKS + i,
             [&](double along, double cosV) { return anisotropicAlbedo(along, across, cosV); });
    }
    return image;
}

}  // namespace

osg::ref_ptr<osg::Image> albedoTableImage(bool anisotropic)
{
    if (anisotropic) {
        static const osg::ref_ptr<osg::Image> image = makeAnisotropicTable();
        return image;
    }
    static const osg::ref_ptr<osg::Image> image = makeTable();
    return image;
}

}  // namespace osgEnvLight
