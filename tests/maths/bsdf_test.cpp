// SPDX-License-Identifier: MIT
// What all passes take a surface for, against quadrature over the hemisphere.
#include <gtest/gtest.h>

#include "Maths.h"

namespace bsdf_test
{

using namespace testmaths;
using glsl::Bsdf;
using glsl::vec2;
using glsl::vec3;

namespace
{

const vec3 f0(0.9, 0.5, 0.04);

const int microfacets[] = {BRDF_COOK_TORRANCE, BRDF_BECKMANN, BRDF_BLINN_PHONG};

vec2 tableOf(int brdf, const vec3& v, double roughness)
{
    return microfacetAlbedo(brdf, v, roughness, [&](const Integrand& f) { return integratePeak(f, roughness * roughness); });
}

}  // namespace

// With the factor for several bounces the lobe reflects what it says, and the rest reaches the body.
TEST(bsdf, ALobeOfMicrofacetsReflectsWhatItSays)
{
    const vec3 up(0, 0, 1);
    for (const int brdf : microfacets)
        for (const double roughness : {0.4, 0.7, 1.0}) {
            const double alpha = roughness * roughness;
            const Bsdf b = glsl::makeBsdf(brdf, f0, roughness, tableOf(brdf, up, roughness));
            for (int k = 0; k < 3; ++k) {
                const double reflected = integratePeak([&](const vec3& l) { return glsl::bsdfLobe(b, up, l)[k] * l.z; }, alpha);
                EXPECT_NEAR(b.reflected[k], reflected, 1e-6) << brdf << " " << roughness;
                EXPECT_NEAR(brdf == BRDF_BLINN_PHONG ? 1.0 : 1.0 - b.reflected[k], b.body[k], 1e-12);
                EXPECT_LE(b.reflected[k], 1.0);
            }
        }
}

// Light that is the same from everywhere comes back whole from a white lobe: systems.md's furnace, at every roughness and angle.
TEST(bsdf, WhiteLobesOfMicrofacetsLoseNothing)
{
    for (const int brdf : microfacets)
        for (const double roughness : {0.2, 0.5, 0.8, 1.0})
            for (const double degrees : {0.0, 40.0, 70.0, 85.0}) {
                const double t = degrees * pi / 180.0;
                const vec3 v(std::sin(t), 0.0, std::cos(t));
                const auto reflected = [&](const Bsdf& b) {
                    return integrateBand([&](const vec3& l) { return glsl::bsdfLobe(b, v, l).x * l.z; }, 0.0, 1.0, 400, 800);
                };
                const double single = reflected(glsl::makeBsdf(brdf, vec3(1), roughness, vec2(1, 0)));
                EXPECT_LE(single, 1.0 + 1e-3) << brdf << " " << roughness << " " << degrees;
                EXPECT_NEAR(reflected(glsl::makeBsdf(brdf, vec3(1), roughness, vec2(single, 0))), 1.0, 0.005);
            }
}

// The albedo loses what edges lose, by the third number of the table.
TEST(bsdf, EdgesOfMetalsAreInTheAlbedo)
{
    const vec3 f(0.55), edge(0.75, 0.5, 1.0);
    for (const double roughness : {0.4, 0.7})
        for (const double degrees : {0.0, 70.0}) {
            const double alpha = roughness * roughness, t = degrees * pi / 180.0;
            const vec3 v(std::sin(t), 0.0, std::cos(t));
            const auto mean = [&](const Integrand& g) { return integrateBand(g, 0.0, 1.0, 400, 800); };
            const Bsdf plain =
                glsl::makeBsdf(BRDF_COOK_TORRANCE, f, roughness, microfacetAlbedo(BRDF_COOK_TORRANCE, v, roughness, mean));
            const double table = mean([&](const vec3& l) {
                return glsl::ggxBrdf(v, l, alpha) * l.z * glsl::edgeShare(glsl::dot(v, glsl::normalize(v + l)));
            });
            const Bsdf b = glsl::withEdgeLoss(plain, glsl::edgeLoss(f, edge), table);
            for (int k = 0; k < 3; ++k) {
                EXPECT_NEAR(b.reflected[k], mean([&](const vec3& l) { return glsl::bsdfLobe(b, v, l)[k] * l.z; }), 1e-6);
                EXPECT_NEAR(1.0 - b.reflected[k], b.body[k], 1e-12);
            }
            EXPECT_LT(b.reflected.y, b.reflected.x);
            EXPECT_EQ(b.reflected.z, plain.reflected.z);
        }
}

TEST(bsdf, AWhiteMetalLeavesNothingToItsBody)
{
    for (const double roughness : {0.1, 0.5, 1.0}) {
        const Bsdf b = glsl::makeBsdf(BRDF_COOK_TORRANCE, vec3(1), roughness, vec2(0.6, 0.0));
        EXPECT_NEAR(1.0, b.reflected.x, 1e-12);
        EXPECT_NEAR(0.0, b.body.x, 1e-12);
    }
}

TEST(bsdf, APhongLobeLeavesTheBodyAsItIs)
{
    const vec3 up(0, 0, 1);
    const Bsdf b = glsl::makeBsdf(BRDF_PHONG, f0, 0.5, vec2(0));
    EXPECT_EQ(f0, b.reflected);
    EXPECT_EQ(vec3(1), b.body);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(f0[k], integratePeak([&](const vec3& l) { return glsl::bsdfLobe(b, up, l)[k] * l.z; }, 0.25), 1e-6);
}

TEST(bsdf, LambertHasNoLobe)
{
    const Bsdf b = glsl::makeBsdf(BRDF_LAMBERT, f0, 0.5, vec2(1));
    EXPECT_EQ(vec3(0), b.reflected);
    EXPECT_EQ(vec3(1), b.body);
    EXPECT_EQ(vec3(0), glsl::bsdfLobe(b, vec3(0, 0, 1), vec3(0, 0, 1)));
}

// Helmholtz: light goes the other way alike.
TEST(bsdf, LobesAreReciprocal)
{
    Random random(71);
    for (const int brdf : {BRDF_PHONG, BRDF_COOK_TORRANCE, BRDF_BECKMANN, BRDF_BLINN_PHONG}) {
        const Bsdf b = glsl::makeBsdf(brdf, f0, 0.6, vec2(0.7, 0.1));
        for (int i = 0; i < 4000; ++i) {
            const vec3 v = random.upper(), l = random.upper();
            const vec3 there = glsl::bsdfLobe(b, v, l), back = glsl::bsdfLobe(b, l, v);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(there[k], back[k], 1e-12 * (1.0 + there[k]));
        }
    }
}

// Drawn directions are as dense as they say, and weigh in the mean what the lobe reflects; one of them weighs value times cosine
// over density. 1e-4: with 2^16 points of the R2 sequence at the worst 4.5e-5.
TEST(bsdf, SamplesOfLobesReflectWhatTheLobeDoes)
{
    for (const int brdf : {BRDF_PHONG, BRDF_COOK_TORRANCE, BRDF_BECKMANN, BRDF_BLINN_PHONG, BRDF_STRAUSS})
        for (const double roughness : {0.3, 0.6, 0.9})
            for (const double degrees : {0.0, 50.0, 75.0}) {
                const double t = degrees * pi / 180.0;
                const vec3 v(std::sin(t), 0.0, std::cos(t));
                const Bsdf b = glsl::makeBsdf(brdf, f0, roughness, vec2(0.9, 0.05));
                vec3 mean(0.0);
                double cosine = 0.0;
                const int count = 1 << 16;
                for (int i = 0; i < count; ++i) {
                    const vec2 u(std::fmod(0.5 + i * 0.7548776662466927, 1.0), std::fmod(0.5 + i * 0.5698402909980532, 1.0));
                    const glsl::LobeSample s = glsl::sampleLobe(b, v, u);
                    mean += s.weight / double(count);
                    if (s.direction.z <= 0.0) {
                        EXPECT_EQ(vec3(0), s.weight);
                        continue;
                    }
                    cosine += s.direction.z / count;
                    const double exact = glsl::bsdfLobe(b, v, s.direction).y * s.direction.z / s.density;
                    EXPECT_NEAR(exact, s.weight.y, 1e-6 * (1.0 + exact)) << brdf << " " << roughness << " " << degrees;
                }
                const auto integral = [&](auto f) { return integrateBand(f, 0.0, 1.0, 400, 800); };
                EXPECT_NEAR(integral([&](const vec3& l) { return glsl::bsdfLobe(b, v, l).x * l.z; }), mean.x, 1e-4);
                const auto density = [&](const vec3& l) {
                    return brdf == BRDF_PHONG || brdf == BRDF_STRAUSS
                               ? glsl::phongPdf(vec3(-v.x, -v.y, v.z), l, glsl::phongExponent(roughness))
                               : glsl::ggxReflectionPdf(v, glsl::normalize(v + l), roughness * roughness);
                };
                EXPECT_NEAR(integral([&](const vec3& l) { return density(l) * l.z; }), cosine, 1e-4);
            }
}

// A lobe without width is a mirror, at every angle.
TEST(bsdf, SamplesOfASmoothLobeGoTheMirrorsWay)
{
    for (const int brdf : {BRDF_COOK_TORRANCE, BRDF_PHONG})
        for (const double degrees : {0.0, 45.0, 89.9}) {
            const double t = degrees * pi / 180.0;
            const vec3 v(std::sin(t), 0.0, std::cos(t));
            const Bsdf b = glsl::makeBsdf(brdf, f0, 0.001, vec2(1, 0));
            const glsl::LobeSample s = glsl::sampleLobe(b, v, vec2(0.3, 0.7));
            EXPECT_GT(glsl::dot(s.direction, vec3(-v.x, -v.y, v.z)), 1.0 - 1e-4);
            EXPECT_TRUE(std::isfinite(s.weight.x));
        }
}

}  // namespace bsdf_test
