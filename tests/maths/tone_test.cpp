// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace tone_test
{

using namespace testmaths;
using glsl::vec3;

TEST(tone, ReinhardOnLuminance)
{
    const vec3 weights(0.2126, 0.7152, 0.0722);
    Random random(13);
    for (int i = 0; i < 1000; ++i) {
        const vec3 c(random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 20));
        const vec3 t = glsl::toneReinhard(c);
        const double l = glsl::dot(c, weights);
        EXPECT_NEAR(glsl::dot(t, weights), l / (1.0 + l), 1e-14);
        EXPECT_NEAR(t.x * c.y, t.y * c.x, 1e-12);  // the hue is kept
    }
    EXPECT_EQ(glsl::toneReinhard(vec3(0.0)), vec3(0.0));
}

TEST(tone, NeutralPassesBaseColours)
{
    // The specification: greys from .08 lose .04, below that 6.25 x^2 is all that stays.
    for (double x : {0.08, 0.1, 0.5, 0.79}) EXPECT_NEAR(glsl::toneNeutral(vec3(x)).y, x - 0.04, 1e-15);
    for (double x : {0.0, 0.01, 0.04, 0.079}) EXPECT_NEAR(glsl::toneNeutral(vec3(x)).y, 6.25 * x * x, 1e-15);
    const vec3 c = glsl::toneNeutral(vec3(0.7, 0.3, 0.1));
    EXPECT_NEAR(c.x, 0.66, 1e-15);
    EXPECT_NEAR(c.z, 0.06, 1e-15);
}

TEST(tone, ShoulderPassesColoursBelowItsStartAndStaysBelowWhite)
{
    Random random(17);
    for (int i = 0; i < 1000; ++i) {
        const vec3 c(random.uniform(0, 0.76), random.uniform(0, 0.76), random.uniform(0, 0.76));
        EXPECT_EQ(glsl::toneShoulder(c), c);
        const double bright = random.uniform(0.76, 100.0);
        // Khronos PBR Neutral's own compression, written out.
        EXPECT_NEAR(glsl::toneShoulder(vec3(bright)).x, 1.0 - 0.24 * 0.24 / (bright - 0.52), 1e-12);
        EXPECT_LT(glsl::toneShoulder(vec3(bright)).x, 1.0);
    }
}

TEST(tone, NeutralIsContinuousMonotoneAndBounded)
{
    double before = -1.0;
    for (int i = 0; i <= 20000; ++i) {
        const double x = std::exp(-7.0 + 21.0 * i / 20000.0);
        const double y = glsl::toneNeutral(vec3(x)).x;
        EXPECT_GT(y, before);
        EXPECT_LT(y, 1.0);
        // Its slope is at most 1; steps are .00105 x
        EXPECT_LT(y - std::max(before, 0.0), 0.0011 * x + 1e-4);
        before = y;
    }
    // 1 - .24^2 / (x - .04 + .24 - .76): 5.8e-8 below 1 at a million
    EXPECT_NEAR(before, 1.0 - 0.0576 / (std::exp(14.0) - 0.56), 1e-12);
    const vec3 red = glsl::toneNeutral(vec3(1e6, 0.0, 0.0));
    EXPECT_GT(red.y, 0.99);  // a highlight bends to white
}

TEST(tone, SrgbKnownValues)
{
    // IEC 61966-2-1
    EXPECT_EQ(glsl::srgbEncode(0.0), 0.0);
    EXPECT_NEAR(glsl::srgbEncode(1.0), 1.0, 1e-15);
    EXPECT_NEAR(glsl::srgbEncode(0.5), 0.7353569830524495, 1e-14);
    EXPECT_NEAR(glsl::srgbDecode(0.5), 0.21404114048223255, 1e-14);
    EXPECT_NEAR(glsl::srgbEncode(0.001), 0.01292, 1e-15);
    // The standard's own thresholds do not quite meet: 3e-8.
    EXPECT_NEAR(glsl::srgbEncode(0.0031308), glsl::srgbEncode(0.0031308 + 1e-12), 3e-8);
}

TEST(tone, SrgbRoundTrip)
{
    for (int i = 0; i <= 255; ++i) EXPECT_NEAR(glsl::srgbEncode(glsl::srgbDecode(i / 255.0)), i / 255.0, 1e-14);
    const vec3 c(0.2, 0.02, 0.9);
    const vec3 back = glsl::srgbDecode3(glsl::srgbEncode3(c));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], c[i], 1e-14);
}

TEST(tone, TypedColorsAreLightAboveOne)
{
    EXPECT_EQ(glsl::typedDecode(9.0), 9.0);
    EXPECT_EQ(glsl::typedEncode(9.0), 9.0);
    EXPECT_EQ(glsl::typedDecode(-1.0), 0.0);
    EXPECT_NEAR(glsl::typedDecode(1.0), 1.0, 1e-15);
    EXPECT_NEAR(glsl::typedDecode(0.5), glsl::srgbDecode(0.5), 1e-15);
    for (const double x : {0.0, 0.001, 0.3, 1.0, 1.5, 1e6})
        EXPECT_NEAR(glsl::typedDecode(glsl::typedEncode(x)), x, 1e-14 * (1.0 + x));
    EXPECT_EQ(glsl::typedDecode3(vec3(9.0, 0.0, -2.0)).x, 9.0);
}

}  // namespace tone_test
