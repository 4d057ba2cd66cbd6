// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"
#include "Projections.h"

namespace depth_test
{

using namespace testmaths;
using glsl::mat4;
using glsl::vec2;
using glsl::vec3;
using glsl::vec4;

namespace
{

struct View {
    const char* name;
    mat4 projection;
    bool parallel;
};

const View views[] = {{"perspective", frustum(-0.4, 0.4, -0.3, 0.3, 1.0, 100.0), false},
                      {"off-axis", frustum(-0.1, 0.7, -0.5, 0.1, 1.0, 100.0), false},
                      {"deep", frustum(-0.04, 0.04, -0.03, 0.03, 0.1, 1e5), false},
                      {"orthographic", orthographic(-4.0, 4.0, -3.0, 3.0, 1.0, 100.0), true},
                      {"orthographic behind the eye", orthographic(-4.0, 1.0, -3.0, 3.0, -50.0, 50.0), true}};

}  // namespace

TEST(depth, InvertsTheProjection)
{
    Random random(14);
    for (const View& view : views) {
        const mat4 inverse = glm::inverse(view.projection);
        for (int i = 0; i < 1000; ++i) {
            const vec3 p(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-90, -1.5));
            const vec4 clip = view.projection * vec4(p, 1.0);
            const vec3 ndc = vec3(clip) / clip.w;
            const vec3 q = glsl::eyeFromDepth(inverse, vec2(ndc), 0.5 * ndc.z + 0.5);
            // Depth's rounding, 1e-16, is stretched by z^2/near: 1e5 for the deep view at most
            EXPECT_LT(glsl::length(q - p), 1e-10 * glsl::length(p)) << view.name;
        }
    }
}

TEST(depth, ViewRay)
{
    Random random(15);
    for (const View& view : views) {
        const mat4 inverse = glm::inverse(view.projection);
        for (int i = 0; i < 1000; ++i) {
            const vec2 ndc = 2.0 * random.square() - 1.0;
            const vec3 ray = glsl::viewRay(inverse, ndc);
            EXPECT_NEAR(glsl::length(ray), 1.0, 1e-14);
            const vec3 p = glsl::eyeFromDepth(inverse, ndc, 0.3);
            const vec3 exact = view.parallel ? vec3(0, 0, -1) : glsl::normalize(p);
            EXPECT_LT(glsl::length(ray - exact), 1e-9) << view.name;
            EXPECT_LT(glsl::length(glsl::viewRayAt(inverse, p) - exact), 1e-12) << view.name;
        }
    }
}

TEST(depth, FootprintOfAPixel)
{
    const vec2 size(640, 480);
    Random random(16);
    for (const View& view : views) {
        const mat4 inverse = glm::inverse(view.projection);
        for (int i = 0; i < 100; ++i) {
            const vec2 ndc = 2.0 * random.square() - 1.0;
            const double depth = random.uniform(0.0, 0.9);
            // The height of the view, 2 / P[1][1] at unit distance, over the rows.
            const double z = view.parallel ? 1.0 : -glsl::eyeFromDepth(inverse, ndc, depth).z;
            EXPECT_NEAR(glsl::pixelFootprint(inverse, ndc, depth, size) / (2.0 / view.projection[1][1] * z / size.y), 1.0, 1e-9)
                << view.name;
        }
    }
}

TEST(depth, SlopeIsThatOfTheSideThatGoesOnEvenly)
{
    const auto expect = [](const vec2& slope, double exact, double bend) {
        EXPECT_NEAR(slope.x, exact, 1e-12);
        EXPECT_NEAR(slope.y, bend, 1e-12);
    };
    for (double rise : {-0.02, 0.0, 0.03}) {
        const double d = 0.5;
        expect(glsl::depthSlope(d - 2 * rise, d - rise, d, d + rise, d + 2 * rise), rise, 0.0);
        // Another surface, or nothing, on either side
        for (double other : {0.1, 0.9, 2.0}) {
            expect(glsl::depthSlope(other, other, d, d + rise, d + 2 * rise), rise, 0.0);
            expect(glsl::depthSlope(other, d - rise, d, d + rise, d + 2 * rise), rise, 0.0);
            expect(glsl::depthSlope(d - 2 * rise, d - rise, d, d + rise, other), rise, 0.0);
            expect(glsl::depthSlope(d - 2 * rise, d - rise, d, other, other), rise, 0.0);
        }
        // A pixel of its own has none.
        EXPECT_GT(glsl::depthSlope(0.1, 0.1 + rise, d, 0.1 + 3 * rise, 0.1 + 4 * rise).y, 0.3);
    }
}

}  // namespace depth_test
