// SPDX-License-Identifier: MIT
// Slices on the CPU: marks, weights and sectors against their definitions; planes and a wall in computed depth buffers.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "Maths.h"
#include "PlaneView.h"
#include "Projections.h"

namespace slices_test
{

using namespace testmaths;
using glsl::mat4;
using glsl::uint;
using glsl::vec2;
using glsl::vec3;
using glsl::vec4;

namespace
{

const mat4 perspective = frustum(-0.4, 0.4, -0.3, 0.3, 1.0, 100.0);

struct Reach {
    double radius;
    double thickness;
    int slices = 2;
    int taps = 8;
};

glsl::Slices slicesAt(const PlaneView& view, int x, int y, const vec3& n, const Reach& reach)
{
    glsl::SliceView v;
    v.projection = view.projection;
    v.inverseProjection = view.inverse;
    v.size = view.size;
    v.radius = reach.radius;
    v.thickness = reach.thickness;
    v.slices = reach.slices;
    v.taps = reach.taps;
    v.group = glsl::bayer4(x, y);
    return glsl::slicesOf(view.depthMap(), view.normalMap(), v, view.eye(x, y), n, view.bias(x, y), view.footprint(x, y));
}

// A slice about the view direction +Z with the normal at that angle from it.
glsl::Slices oneSlice(double azimuth, double tilt, double phase)
{
    glsl::Slices s;
    s.view = vec3(0, 0, 1);
    s.count = 1;
    s.slice[0].along = vec3(std::cos(azimuth), std::sin(azimuth), 0);
    s.slice[0].tilt = tilt;
    s.slice[0].phase = phase;
    s.slice[0].bits = 0u;
    return s;
}

vec3 tilted(double degrees, double azimuth)
{
    const double t = degrees * pi / 180.0;
    return vec3(std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t));
}

}  // namespace

TEST(slices, MarksAreTheSamplesInTheInterval)
{
    Random random(71);
    for (int i = 0; i < 20000; ++i) {
        const double a = random.uniform(-0.5, 1.5);
        const double b = i % 3 ? random.uniform(-0.5, 1.5) : a + random.uniform(-0.05, 0.05);
        const double phase = (std::floor(random.uniform(0, 16)) + 0.5) / 16.0;
        uint expected = 0u;
        for (int j = 0; j < 32; ++j) {
            const double sample = (j + phase) / 32.0;
            if (sample >= std::min(a, b) && sample <= std::max(a, b)) expected |= 1u << j;
        }
        ASSERT_EQ(glsl::sliceMarks(a, b, phase), expected) << a << " " << b << " " << phase;
    }
    EXPECT_EQ(glsl::sliceMarks(0.0, 1.0, 0.5), 0xffffffffu);
    EXPECT_EQ(glsl::sliceMarks(1.0, 1.0, 0.96875), 0u);
    EXPECT_EQ(glsl::sliceMarks(0.0, 0.0, 0.03125), 0u);
}

TEST(slices, WeightIsTheIntegralOfItsSector)
{
    Random random(72);
    for (int i = 0; i < 200; ++i) {
        const vec3 n = random.upper();
        glsl::Slices s = oneSlice(random.uniform(0, 2 * pi), 0.0, 0.5);
        glsl::Slice& slice = s.slice[0];
        slice.tilt = std::atan2(glsl::dot(n, slice.along), n.z);
        const double a = random.uniform();
        const double b = random.uniform();
        double expected = 0.0;
        const double from = (a - 0.5) * pi + slice.tilt;
        const double to = (b - 0.5) * pi + slice.tilt;
        // On either side of the kink at 0
        const double middle = std::clamp(0.0, std::min(from, to), std::max(from, to));
        for (const auto& [low, high] : {std::pair(from, middle), std::pair(middle, to)}) {
            const Gauss g = gauss(24, low, high);
            for (size_t k = 0; k < g.x.size(); ++k)
                expected += g.w[k] * std::abs(std::sin(g.x[k])) *
                            glsl::dot(n, std::cos(g.x[k]) * s.view + std::sin(g.x[k]) * slice.along);
        }
        EXPECT_NEAR(glsl::sliceWeight(slice, s.view, n, a, b), expected, 1e-12);
    }
}

TEST(slices, WeightsOfAllSlicesAreTheHemisphere)
{
    Random random(73);
    for (int i = 0; i < 20; ++i) {
        const vec3 n = random.upper();
        const int count = 4096;
        double sum = 0.0;
        for (int k = 0; k < count; ++k) {
            glsl::Slices s = oneSlice(pi * (k + 0.5) / count, 0.0, 0.5);
            s.slice[0].tilt = std::atan2(glsl::dot(n, s.slice[0].along), n.z);
            sum += glsl::sliceWeight(s.slice[0], s.view, n, 0.0, 1.0) * pi / count;
        }
        EXPECT_NEAR(sum, pi, 1e-5);
    }
}

// Far less than a sector, at every angle and length; along the axes and of nothing at all, too.
TEST(slices, AngleIsThatOfTheVector)
{
    Random random(77);
    for (int i = 0; i < 20000; ++i) {
        const double angle = i < 9 ? (i - 4) * pi / 4.0 : random.uniform(-pi, pi);
        const double length = std::exp(random.uniform(-20, 20));
        const double y = length * std::sin(angle), x = length * std::cos(angle);
        ASSERT_NEAR(glsl::sliceAngle(y, x), std::atan2(y, x), 1.2e-5) << x << " " << y;
    }
    EXPECT_EQ(glsl::sliceAngle(0.0, 1.0), 0.0);
    EXPECT_EQ(glsl::sliceAngle(0.0, 0.0), 0.0);
}

// What reaches on below the receiver's horizon, as slabs do, hides all up to the horizon on its own side, wherever it ends.
TEST(slices, TurnFindsTheAngleOrTheHorizon)
{
    glsl::SlicePlane plane;
    plane.up = vec3(0, 0, 1);
    plane.across = vec3(1, 0, 0);
    Random random(78);
    for (int i = 0; i < 2000; ++i) {
        const double angle = random.uniform(-pi, pi);
        const double length = std::exp(random.uniform(-10, 10));
        const double side = i % 2 ? 1.0 : -1.0;
        const vec3 d(length * std::sin(angle), random.uniform(-1, 1) * length, length * std::cos(angle));
        const double expected = 0.5 + (std::abs(angle) < 0.5 * pi ? angle / pi : 0.5 * side);
        ASSERT_NEAR(glsl::turnPosition(glsl::sliceTurn(plane, d, side)), expected, 1.2e-5 / pi) << angle;
    }
}

TEST(slices, ADirectionFindsItsSector)
{
    Random random(74);
    for (int i = 0; i < 4000; ++i) {
        glsl::Slices s = oneSlice(random.uniform(0, 2 * pi), random.uniform(-1.5, 1.5), random.uniform());
        glsl::Slice& slice = s.slice[0];
        const int j = int(random.uniform(0, 32));
        const double angle = ((j + slice.phase + random.uniform(-0.499, 0.499)) / 32.0 - 0.5) * pi + slice.tilt;
        const vec3 l = std::cos(angle) * s.view + std::sin(angle) * slice.along;
        slice.bits = 1u << j;
        EXPECT_TRUE(glsl::sliceBlocks(s, l)) << j;
        slice.bits = ~slice.bits;
        EXPECT_FALSE(glsl::sliceBlocks(s, l)) << j;
    }
}

TEST(slices, ADirectionTakesTheSliceNearestInAzimuth)
{
    Random random(75);
    for (int count = 1; count <= 4; ++count)
        for (int i = 0; i < 1000; ++i) {
            const double turn = random.uniform(0, pi);
            glsl::Slices s = oneSlice(0, 0, 0.5);
            s.count = count;
            const int marked = int(random.uniform(0, count));
            for (int k = 0; k < count; ++k) {
                s.slice[k] = oneSlice(turn + pi * k / count, 0.0, 0.5).slice[0];
                s.slice[k].bits = k == marked ? 0xffffffffu : 0u;
            }
            const double azimuth = turn + pi * (marked + random.uniform(-0.499, 0.499)) / count + (i % 2 ? pi : 0.0);
            const double sine = random.uniform(0.01, 1.0);
            const vec3 l(sine * std::cos(azimuth), sine * std::sin(azimuth), std::sqrt(1.0 - sine * sine));
            EXPECT_TRUE(glsl::sliceBlocks(s, l)) << count;
        }
}

TEST(slices, APlaneMarksNothing)
{
    const mat4 projections[] = {perspective, frustum(-0.1, 0.7, -0.5, 0.1, 1.0, 100.0), endlessFrustum(-0.4, 0.4, -0.3, 0.3, 1.0),
                                orthographic(-4.0, 4.0, -3.0, 3.0, 1.0, 100.0)};
    for (const mat4& projection : projections)
        for (double degrees : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0})
            for (double azimuth : {0.0, 0.5 * pi, 0.7, 4.0}) {
                const vec3 n = tilted(degrees, azimuth);
                const PlaneView view(projection, 96, 72, {{vec3(0, 0, -10), n}});
                int pixels = 0;
                int marked = 0;
                for (int y = 0; y < 72; y += 3)
                    for (int x = 0; x < 96; x += 3) {
                        // Seen from behind a plane has another normal.
                        if (!view.hasSurface(x, y) || glsl::dot(glsl::viewRay(view.inverse, view.ndc(x, y)), n) > 0.0) continue;
                        ++pixels;
                        const glsl::Slices s = slicesAt(view, x, y, n, {5.0, 1.0, 4, 32});
                        for (const glsl::Slice& slice : s.slice) marked += slice.bits != 0u;
                    }
                EXPECT_GT(pixels, 20) << degrees;
                EXPECT_EQ(marked, 0) << "of " << 4 * pixels << " slices at " << degrees << " degrees, azimuth " << azimuth;
            }
}

namespace
{

// The ground z = 0 before a wall of height 1 and infinite length, seen from (0, -9, 9).
class Wall
{
  public:
    Wall(const mat4& projection, double thickness)
        : _eyeFromWorld(glm::lookAt(vec3(0, -9, 9), vec3(0, 0, 0), vec3(0, 0, 1))),
          _worldFromEye(glm::inverse(_eyeFromWorld)),
          view(projection, size, size,
               {plane(vec3(0), vec3(0, 0, 1), [=](const vec3& p) { return p.y < 0.0 || p.y > thickness; }),
                plane(vec3(0), vec3(0, -1, 0), [](const vec3& p) { return p.z > 0.0 && p.z < 1.0; }),
                plane(vec3(0, 0, 1), vec3(0, 0, 1), [=](const vec3& p) { return p.y > 0.0 && p.y < thickness; })})
    {
    }

    // Measured over exact occlusion [systems.md 1.7] of sixteen pixels by four at that distance from the wall.
    double ratio(double distance, const Reach& reach) const
    {
        const vec4 clip = view.projection * _eyeFromWorld * vec4(0, -distance, 0, 1);
        const vec2 pixel = (0.5 * vec2(clip) / clip.w + 0.5) * view.size;
        double measured = 0.0;
        double exact = 0.0;
        for (int y = int(pixel.y) - 2; y < int(pixel.y) + 2; ++y)
            for (int x = int(pixel.x) - 8; x < int(pixel.x) + 8; ++x) {
                const double a = -(_worldFromEye * vec4(view.eye(x, y), 1.0)).y;
                exact += 0.5 * (1.0 - a / std::sqrt(a * a + 1.0));
                measured += occlusion(x, y, reach);
            }
        return measured / exact;
    }

  private:
    static const int size = 512;

    // Under a uniform sky.
    double occlusion(int x, int y, const Reach& reach) const
    {
        const vec3 n(_eyeFromWorld * vec4(0, 0, 1, 0));
        const glsl::Slices s = slicesAt(view, x, y, n, reach);
        double blocked = 0.0;
        double all = 0.0;
        for (int i = 0; i < s.count; ++i)
            for (int j = 0; j < 32; ++j) {
                const double w = glsl::sliceWeight(s.slice[i], s.view, n, j / 32.0, (j + 1) / 32.0);
                all += w;
                blocked += s.slice[i].bits >> j & 1u ? w : 0.0;
            }
        return blocked / all;
    }

    Plane plane(const vec3& point, const vec3& normal, const std::function<bool(const vec3&)>& inside) const
    {
        return {vec3(_eyeFromWorld * vec4(point, 1)), vec3(_eyeFromWorld * vec4(normal, 0)),
                [inside, m = _worldFromEye](const vec3& p) { return inside(vec3(m * vec4(p, 1))); }};
    }

    const mat4 _eyeFromWorld;
    const mat4 _worldFromEye;

  public:
    const PlaneView view;
};

}  // namespace

TEST(slices, AWallOccludesAsItShould)
{
    // From above, where the wall's top hangs over its face if patches are not cut at the edge between them.
    const double t = std::tan(20.0 * pi / 180.0);
    const mat4 projections[] = {frustum(-t, t, -t, t, 1.0, 40.0), endlessFrustum(-t, t, -t, t, 1.0),
                                frustum(-1.3 * t, 0.7 * t, -0.8 * t, 1.2 * t, 1.0, 40.0),
                                orthographic(-4.6, 4.6, -4.6, 4.6, 1.0, 40.0)};
    for (const mat4& projection : projections) {
        const Wall wall(projection, 4.0);
        for (double a : {0.1, 0.5, 1.0}) {
            EXPECT_NEAR(wall.ratio(a, {4.0, 4.0, 2, 8}), 1.0, 0.05) << a;
            EXPECT_NEAR(wall.ratio(a, {4.0, 4.0, 4, 32}), 1.0, 0.03) << a;  // at 1, 1.2 % lie beyond the radius
        }
    }
}

TEST(slices, AThinWallLetsLightPassBehind)
{
    const double t = std::tan(20.0 * pi / 180.0);
    const Wall wall(frustum(-t, t, -t, t, 1.0, 40.0), 0.2);
    for (double a : {0.1, 0.5, 1.0}) EXPECT_NEAR(wall.ratio(a, {4.0, 0.2, 2, 8}), 1.0, 0.08) << a;
}

}  // namespace slices_test
