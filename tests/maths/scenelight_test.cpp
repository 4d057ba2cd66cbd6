// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace scenelight_test
{

using namespace testmaths;
using glsl::vec3;

namespace
{

const vec3 up(0, 0, 1);
const double roughnesses[] = {0.2, 0.4, 0.7, 1.0};

glsl::Bsdf phongOf(double roughness)
{
    return glsl::makeBsdf(BRDF_PHONG, vec3(1), roughness, glsl::vec2(0));
}

// Without what several bounces between microfacets add.
glsl::Bsdf metalOf(double roughness)
{
    return glsl::makeBsdf(BRDF_COOK_TORRANCE, vec3(1), roughness, glsl::vec2(1, 0));
}

}  // namespace

TEST(scenelight, AttenuationIsOpenGLs)
{
    EXPECT_DOUBLE_EQ(glsl::lightAttenuation(vec3(1, 0, 0), 7.0), 1.0);
    EXPECT_DOUBLE_EQ(glsl::lightAttenuation(vec3(0.5, 0.25, 2), 3.0), 1.0 / (0.5 + 0.75 + 18.0));
    EXPECT_TRUE(std::isfinite(glsl::lightAttenuation(vec3(0, 0, 1), 0.0)));
    EXPECT_TRUE(std::isfinite(glsl::lightAttenuation(vec3(0, 0, 0), 2.0)));
}

TEST(scenelight, AConeEndsAtItsCutoff)
{
    const double cutoff = std::cos(0.5);
    EXPECT_EQ(glsl::lightCone(std::cos(0.501), cutoff, 0.0), 0.0);
    EXPECT_EQ(glsl::lightCone(std::cos(0.499), cutoff, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(glsl::lightCone(std::cos(0.3), cutoff, 4.0), std::pow(std::cos(0.3), 4.0));
    EXPECT_EQ(glsl::lightCone(-0.5, -1.0, 2.0), 0.0);
}

// A sky of such lights, 1 / pi of them in each steradian, is a furnace of radiance 1: what it reflects is the albedo.
TEST(scenelight, ASkyOfLightsIsAFurnace)
{
    for (const double r : roughnesses) {
        const auto phong = [&](const vec3& l) { return glsl::lightLobe(phongOf(r), up, l).x / pi; };
        EXPECT_NEAR(integratePeak(phong, r * r), 1.0, 1e-6) << r;
        const auto brdf = [&](const vec3& l) { return glsl::ggxBrdf(up, l, r * r) * l.z; };
        const auto metal = [&](const vec3& l) { return glsl::lightLobe(metalOf(r), up, l).x / pi; };
        EXPECT_NEAR(integratePeak(metal, r * r), integratePeak(brdf, r * r), 1e-6) << r;
    }
    EXPECT_NEAR(integratePeak([](const vec3& l) { return glsl::lightLambert(vec3(0.7), l).x / pi; }, 1.0), 0.7, 1e-6);
}

TEST(scenelight, NothingComesFromBelowAndASmoothLobeIsBounded)
{
    const vec3 below = glm::normalize(vec3(0.3, 0.1, -0.2));
    const vec3 v = glm::normalize(vec3(0.5, 0.0, 0.4));
    for (const double r : {0.0, 0.05, 0.5}) {
        EXPECT_EQ(glsl::lightLobe(metalOf(r), v, below), vec3(0));
        EXPECT_EQ(glsl::lightLobe(phongOf(r), v, below), vec3(0));
        EXPECT_EQ(glsl::lightLambert(vec3(1), below), vec3(0));
        EXPECT_LT(glsl::lightLobe(metalOf(r), up, up).x, 300.0);
        EXPECT_LT(glsl::lightLobe(phongOf(r), up, up).x, 1200.0);
    }
}

}  // namespace scenelight_test
