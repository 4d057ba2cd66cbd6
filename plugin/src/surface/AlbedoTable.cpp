// SPDX-License-Identifier: MIT
#include "surface/AlbedoTable.h"

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

// By GGX's visible normals, by which the weights of all are bounded: 1024 points leave less than 1e-3.
glsl::vec2 albedo(int brdf, double roughness, double cosV)
{
    const double r = std::max(roughness, 0.01);
    const double alpha = r * r;
    const double mu = std::max(cosV, 1e-4);
    const glsl::vec3 v(std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu);
    const glsl::Bsdf b = glsl::makeBsdf(brdf, glsl::vec3(0.0), r, glsl::vec2(1.0, 0.0));
    const glsl::uint count = 1024;
    glsl::vec2 sum(0.0);
    for (glsl::uint i = 0; i < count; ++i) {
        const glsl::vec3 h = glsl::ggxVisibleNormalSample(v, alpha, glsl::hammersley(i, count));
        const double c = glsl::dot(v, h);
        const glsl::vec3 l = 2.0 * c * h - v;
        if (l.z <= 0.0) continue;
        const double w = brdf == BRDF_COOK_TORRANCE
                             ? glsl::ggxG2OverG1(v.z, l.z, alpha)
                             : glsl::bsdfMicrofacets(b, v, l, h) * l.z / glsl::ggxReflectionPdf(v, h, alpha);
        const double grazing = glsl::fresnelShare(c);
        sum += glsl::vec2(w * (1.0 - grazing), w * grazing);
    }
    return sum / double(count);
}

osg::ref_ptr<osg::Image> makeTable()
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(std::size(microfacets)) * tableSize, tableSize, 1, GL_RG, GL_FLOAT);
    image->setInternalTextureFormat(GL_RG32F);
    for (const int brdf : microfacets)
        for (int y = 0; y < tableSize; ++y)
            for (int x = 0; x < tableSize; ++x) {
                const double rootMu = double(y) / (tableSize - 1);
                const glsl::vec2 a = albedo(brdf, double(x) / (tableSize - 1), rootMu * rootMu);
                float* out =
                    reinterpret_cast<float*>(image->data(unsigned(glsl::albedoBlock(brdf) * tableSize + x), unsigned(y)));
                out[0] = float(a.x);
                out[1] = float(a.y);
            }
    return image;
}

}  // namespace

osg::ref_ptr<osg::Image> albedoTableImage()
{
    static const osg::ref_ptr<osg::Image> image = makeTable();
    return image;
}

}  // namespace osgEnvLight
