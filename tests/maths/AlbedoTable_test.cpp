// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "surface/AlbedoTable.h"

#include "Maths.h"

namespace AlbedoTable_test
{

using namespace testmaths;
using glsl::vec2;
using glsl::vec3;

namespace
{

const int distributions[] = {BRDF_COOK_TORRANCE, BRDF_BECKMANN, BRDF_BLINN_PHONG};  // in the table's order

// A F0 + B by quadrature over the directions l: no sampling, no pdf.
vec2 byQuadrature(int brdf, double roughness, double cosV)
{
    const glsl::Bsdf b = glsl::makeBsdf(brdf, vec3(0), roughness, vec2(1, 0));
    const vec3 v(std::sqrt(1.0 - cosV * cosV), 0.0, cosV);
    auto share = [&](bool grazing) {
        return integrateBand(
            [&](const vec3& l) {
                const vec3 h = glsl::normalize(v + l);
                const double x = std::pow(1.0 - glsl::dot(v, h), 5.0);
                return glsl::bsdfMicrofacets(b, v, l, h) * l.z * (grazing ? x : 1.0 - x);
            },
            0.0, 1.0, 400, 400);
    };
    return vec2(share(false), share(true));
}

// Of what edges of metals take.
double edgesByQuadrature(int brdf, double roughness, double cosV)
{
    const glsl::Bsdf b = glsl::makeBsdf(brdf, vec3(0), roughness, vec2(1, 0));
    const vec3 v(std::sqrt(1.0 - cosV * cosV), 0.0, cosV);
    return integrateBand(
        [&](const vec3& l) {
            const vec3 h = glsl::normalize(v + l);
            const double c = glsl::dot(v, h);
            return glsl::bsdfMicrofacets(b, v, l, h) * l.z * c * std::pow(1.0 - c, 6.0);
        },
        0.0, 1.0, 400, 400);
}

float edgeTexel(unsigned x, unsigned y)
{
    return reinterpret_cast<const float*>(osgEnvLight::albedoTableImage()->data(x, y))[2];
}

vec2 texel(unsigned x, unsigned y)
{
    const float* t = reinterpret_cast<const float*>(osgEnvLight::albedoTableImage()->data(x, y));
    return vec2(t[0], t[1]);
}

}  // namespace

TEST(AlbedoTable, Shape)
{
    const osg::ref_ptr<osg::Image> image = osgEnvLight::albedoTableImage();
    EXPECT_EQ(image->s(), 96);
    EXPECT_EQ(image->t(), 32);
    EXPECT_EQ(image->getDataType(), unsigned(GL_FLOAT));
    EXPECT_EQ(osgEnvLight::albedoTableImage(), image);
}

TEST(AlbedoTable, ClosedFormAtFullRoughness)
{
    // F = 1, alpha = 1, from above: 1 - ln 2. The table's 16384 points and its unit leave 7e-6.
    const vec2 e = texel(31, 31);
    EXPECT_NEAR(e.x + e.y, 1.0 - std::log(2.0), 2e-5);
}

TEST(AlbedoTable, AgainstQuadrature)
{
    // Measured: 6e-5; lobes wide enough for 400 x 400 nodes.
    for (unsigned block = 0; block < 3; ++block)
        for (unsigned x : {14u, 20u, 26u, 31u})
            for (unsigned y : {8u, 16u, 24u, 31u}) {
                const double rootMu = y / 31.0;
                const vec2 exact = byQuadrature(distributions[block], x / 31.0, rootMu * rootMu);
                EXPECT_NEAR(texel(32 * block + x, y).x, exact.x, 1e-4) << block << " " << x << " " << y;
                EXPECT_NEAR(texel(32 * block + x, y).y, exact.y, 1e-4) << block << " " << x << " " << y;
                EXPECT_NEAR(edgeTexel(32 * block + x, y), edgesByQuadrature(distributions[block], x / 31.0, rootMu * rootMu),
                            1e-4)
                    << block << " " << x << " " << y;
            }
}

TEST(AlbedoTable, SmoothSurfaceIsSchlick)
{
    // At roughness 0 the lobe is a mirror: A = 1 - (1-mu)^5, B = (1-mu)^5; alpha is held at 1e-4, where the half angle
    // still spreads by 1e-4.
    for (unsigned block = 0; block < 3; ++block)
        for (unsigned y = 4; y < 32; ++y) {
            const double mu = y / 31.0 * (y / 31.0);
            const double f = std::pow(1.0 - mu, 5.0);
            EXPECT_NEAR(texel(32 * block, y).x, 1.0 - f, 1e-3) << block << " " << y;
            EXPECT_NEAR(texel(32 * block, y).y, f, 1e-3) << block << " " << y;
        }
}

TEST(AlbedoTable, BoundedEverywhere)
{
    for (unsigned y = 0; y < 32; ++y)
        for (unsigned x = 0; x < 96; ++x) {
            const vec2 e = texel(x, y);
            EXPECT_GE(e.x, 0.0);
            EXPECT_GE(e.y, 0.0);
            // Units of the table; other distributions than GGX are weighed, and their sums are as exact as the table is
            EXPECT_LE(e.x + e.y, x < 32 ? 1.0 + 2e-5 : 1.001) << x << " " << y;
            EXPECT_GT(e.x + e.y, 0.3) << x << " " << y;
        }
}

}  // namespace AlbedoTable_test
