// SPDX-License-Identifier: MIT
// Rays through the picture, on the CPU, over depth buffers of planes.
#include <gtest/gtest.h>

#include "Maths.h"
#include "PlaneView.h"
#include "Projections.h"

namespace march_test
{

using namespace testmaths;
using glsl::mat4;
using glsl::vec2;
using glsl::vec3;
using glsl::vec4;

namespace
{

const int width = 192;
const int height = 144;

glsl::ScreenRay rayFrom(const PlaneView& view, const vec3& origin, const vec3& direction, double most, double tolerance)
{
    return glsl::screenRay(view.projection, view.inverse, view.size, origin, glsl::normalize(direction), most, tolerance);
}

glsl::ScreenHit meets(const PlaneView& view, const glsl::ScreenRay& ray, int steps, double phase)
{
    return glsl::screenRayHit(view.depthMap(), view.normalMap(), ray, steps, phase);
}

const mat4 perspective = frustum(-0.4, 0.4, -0.3, 0.3, 1.0, 100.0);
const mat4 parallel = orthographic(-4.0, 4.0, -3.0, 3.0, 1.0, 100.0);

}  // namespace

// A floor that slants away from the eye, and a wall at its far end that faces the eye.
TEST(march, FindsTheWallThatAMirrorShows)
{
    for (const mat4& projection : {perspective, parallel}) {
        const vec3 floorNormal = glsl::normalize(vec3(0, 1, 0.2));
        const vec3 wall(0, 0, -12);
        const PlaneView view(projection, width, height, {{vec3(0, -1.5, -8), floorNormal}, {wall, vec3(0, 0, 1)}});
        int asked = 0, right = 0;
        for (int y = 0; y < height; y += 3)
            for (int x = 0; x < width; x += 5) {
                const vec3 p = view.eye(x, y);
                if (std::abs(glsl::dot(p - vec3(0, -1.5, -8), floorNormal)) > 1e-3 || !view.hasSurface(x, y)) continue;
                const vec3 d = glm::reflect(glsl::viewRay(view.inverse, view.ndc(x, y)), floorNormal);
                if (d.z >= 0.0) continue;
                const vec3 hit = p + (wall.z - p.z) / d.z * d;
                const vec4 clip = projection * vec4(hit, 1.0);
                const vec2 ndc = vec2(clip) / clip.w;
                if (std::max(std::abs(ndc.x), std::abs(ndc.y)) > 0.98) continue;
                ++asked;
                const auto found = meets(view, rayFrom(view, p + view.footprint(x, y) * floorNormal, d, 40.0, 0.5), 16, 1.0);
                const vec2 pixel = (0.5 * ndc + 0.5) * view.size;
                right += found.found && glsl::length(vec2(found.pixel) + 0.5 - pixel) < 3.0;
            }
        EXPECT_GT(asked, 100);
        EXPECT_GE(right, asked * 95 / 100) << "of " << asked;  // measured: all but those whose wall begins between two points
    }
}

TEST(march, APlaneMeetsNothing)
{
    for (const mat4& projection : {perspective, parallel})
        for (const double degrees : {0.0, 30.0, 60.0, 80.0, 88.0}) {
            const double t = degrees * pi / 180.0;
            const vec3 n(std::sin(t), 0.0, std::cos(t));
            const PlaneView view(projection, width, height, {{vec3(0, 0, -10), n}});
            const glsl::mat3 frame = glsl::frameAround(n);
            Random random(3);
            for (int i = 0; i < 2000; ++i) {
                const int x = int(random.uniform() * width), y = int(random.uniform() * height);
                vec3 l = random.upper();
                l = glsl::normalize(vec3(l.x, l.y, std::max(l.z, 0.1)));
                if (!view.hasSurface(x, y)) continue;
                const vec3 origin = view.eye(x, y) + view.footprint(x, y) * n;
                EXPECT_FALSE(meets(view, rayFrom(view, origin, frame * l, 20.0, 0.5), 16, random.uniform()).found)
                    << degrees << " at " << x << ", " << y;
            }
        }
}

TEST(march, EndsWhereTheViewEnds)
{
    const PlaneView view(perspective, 8, 8, {});
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const vec3 origin(random.uniform() - 0.5, random.uniform() - 0.5, -5.0 - random.uniform());
        const auto ray = rayFrom(view, origin, random.upper() * (i % 2 ? 1.0 : -1.0), 30.0, 1.0);
        const double end = glsl::screenRayEnd(ray);
        ASSERT_GE(end, 0.0);
        ASSERT_LE(end, 30.0);
        const auto outside = [&](double t) {
            const vec4 c = perspective * vec4(ray.origin + t * ray.direction, 1.0);
            return std::max({std::abs(c.x), std::abs(c.y), -c.z}) - c.w;
        };
        EXPECT_LE(outside(0.999 * end), 1e-9);
        if (end < 30.0) {
            EXPECT_NEAR(outside(end), 0.0, 1e-9);
        }
        EXPECT_FALSE(meets(view, ray, 16, 0.5).found);  // nothing is there
    }
}

// What comes out behind a surface where that ends does not meet it, however thick it may be.
TEST(march, PassesBehindWhatIsThin)
{
    const PlaneView view(perspective, width, height,
                         {{vec3(0, 0, -5), vec3(0, 0, 1), [](const vec3& p) { return std::abs(p.x) < 0.3; }}});
    const vec3 origin(-3, 0, -10);
    for (const double away : {0.0, 0.2, -0.2})
        EXPECT_FALSE(meets(view, rayFrom(view, origin, vec3(1, 0, away), 6.0, 0.5), 64, 1.0).found) << away;
}

// A card in front of the ray, and a slanting wall at its end.
TEST(march, MeetsAWallBeyondWhatItPassesBehind)
{
    const vec3 end(2, 0, -10);
    const vec3 slant = glsl::normalize(vec3(-1, 0, 0.5));
    const PlaneView view(perspective, width, height,
                         {{vec3(0, 0, -5), vec3(0, 0, 1), [](const vec3& p) { return std::abs(p.x) < 0.3; }}, {end, slant}});
    const auto hit = meets(view, rayFrom(view, vec3(-3, 0, -10), vec3(1, 0, 0), 12.0, 0.02), 64, 1.0);
    ASSERT_TRUE(hit.found);
    const vec4 clip = perspective * vec4(end, 1.0);
    EXPECT_NEAR(hit.pixel.x + 0.5, (0.5 * clip.x / clip.w + 0.5) * width, 1.0);
}

}  // namespace march_test
