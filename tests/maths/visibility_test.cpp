// SPDX-License-Identifier: MIT
// The ray march on the CPU, over depth buffers of planes.
#include <gtest/gtest.h>

#include "Maths.h"
#include "PlaneView.h"
#include "Projections.h"

namespace visibility_test
{

using namespace testmaths;
using glsl::mat4;
using glsl::vec2;
using glsl::vec3;

namespace
{

// As pass/occlusion.frag sets the march up for a pixel.
glsl::RayMarch marchFrom(const PlaneView& view, int x, int y, const vec3& n, double radius, double thickness, int steps)
{
    glsl::RayMarch m;
    m.projection = view.projection;
    m.inverseProjection = view.inverse;
    m.size = view.size;
    m.radius = radius;
    m.thickness = thickness;
    m.steps = steps;
    return glsl::rayMarchFrom(m, view.eye(x, y), n, view.bias(x, y));
}

const int width = 96;
const int height = 72;

vec3 tilted(double degrees, double azimuth)
{
    const double t = degrees * pi / 180.0;
    return vec3(std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t));
}

void expectPlaneFree(const mat4& projection, double degrees, double azimuth)
{
    const vec3 n = tilted(degrees, azimuth);
    const PlaneView view(projection, width, height, {{vec3(0, 0, -10), n}});
    const glsl::mat3 frame = glsl::frameAround(n);
    Random random(17);
    int rays = 0;
    int blocked = 0;
    for (int i = 0; i < 4000; ++i) {
        const int x = int(random.uniform() * width);
        const int y = int(random.uniform() * height);
        // Half of the rays graze the plane.
        vec3 l = random.upper();
        if (i % 2) l = glsl::normalize(vec3(l.x, l.y, 0.05 * l.z));
        const double phase = random.uniform();
        if (!view.hasSurface(x, y)) continue;
        ++rays;
        blocked += glsl::rayBlocked(view.depthMap(), marchFrom(view, x, y, n, 5.0, 1.0, 16), frame * l, phase) > 0.5;
    }
    EXPECT_GT(rays, 200) << degrees;
    EXPECT_EQ(blocked, 0) << "of " << rays << " rays at " << degrees << " degrees, azimuth " << azimuth;
}

}  // namespace

TEST(visibility, APlaneNeverOccludesItself)
{
    const mat4 perspective = frustum(-0.4, 0.4, -0.3, 0.3, 1.0, 100.0);
    const mat4 parallel = orthographic(-4.0, 4.0, -3.0, 3.0, 1.0, 100.0);
    for (double degrees : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0})
        for (double azimuth : {0.0, 0.5 * pi, 0.7, 4.0}) {
            expectPlaneFree(perspective, degrees, azimuth);
            expectPlaneFree(parallel, degrees, azimuth);
        }
}

TEST(visibility, AWallBlocksWhatRunsIntoIt)
{
    // A floor z = -10 that faces the eye, and beside it a wall x = 1 that reaches up to the eye.
    const mat4 projection = frustum(-0.4, 0.4, -0.3, 0.3, 1.0, 100.0);
    const PlaneView view(projection, 4 * width, 4 * height, {{vec3(0, 0, -10), vec3(0, 0, 1)}, {vec3(1, 0, 0), vec3(-1, 0, 0)}});
    const double radius = 3.0;
    Random random(18);
    int counts[2] = {};
    int wrong[2] = {};
    for (int i = 0; i < 20000; ++i) {
        // Receivers left of the wall, within reach of it
        const int x = int(random.uniform(0.45, 0.6) * 4 * width);
        const int y = int(random.uniform(0.3, 0.7) * 4 * height);
        const vec3 l = random.upper();
        const double phase = random.uniform();
        const glsl::RayMarch m = marchFrom(view, x, y, vec3(0, 0, 1), radius, 2.0, 64);
        // The ends of the ray, one step (.09) of which may lie before the wall, are left out; so are rays that leave the
        // picture before the wall, of which the buffer knows nothing.
        const double distance = l.x > 0.0 ? (1.0 - m.eye.x) / l.x : 1e9;
        const vec3 hit = m.eye + (distance + 0.1) * l;
        if (distance < radius && (distance > radius - 0.1 || std::abs(hit.y) > -0.3 * hit.z)) continue;
        const bool reaches = distance < radius;
        ++counts[reaches];
        wrong[reaches] += reaches != (glsl::rayBlocked(view.depthMap(), m, l, phase) > 0.5);
    }
    EXPECT_GT(counts[0], 5000);
    EXPECT_GT(counts[1], 5000);
    EXPECT_EQ(wrong[0], 0) << "free rays blocked, of " << counts[0];
    EXPECT_EQ(wrong[1], 0) << "blocked rays free, of " << counts[1];
}

TEST(visibility, NothingBlocksAgainstTheBackground)
{
    const mat4 projection = frustum(-0.4, 0.4, -0.3, 0.3, 1.0, 100.0);
    std::vector<float> texels(4 * 4 * 4, 1.0f);
    glsl::RayMarch m;
    m.projection = projection;
    m.inverseProjection = glm::inverse(projection);
    m.size = vec2(4, 4);
    m.radius = 5.0;
    m.thickness = 1e9;
    m.steps = 16;
    m = glsl::rayMarchFrom(m, vec3(0, 0, -10), vec3(0, 0, 1), 1e-3);
    for (const vec3& l : spiral(500)) EXPECT_EQ(glsl::rayBlocked({texels.data(), 4, 4}, m, l, 0.5), 0.0);
}

}  // namespace visibility_test
