// SPDX-License-Identifier: MIT
// Rays against triangles: each against all of them, in double precision.
#include "indirect/CasterBvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace CasterBvh_test
{

using osgEnvLight::CasterBvh;
using osgEnvLight::TracedScene;

namespace
{

void add(TracedScene& scene, const osg::Vec3f& a, const osg::Vec3f& b, const osg::Vec3f& c)
{
    const auto first = unsigned(scene.positions.size());
    for (const osg::Vec3f& p : {a, b, c}) scene.positions.push_back(p);
    scene.triangles.push_back({first, first + 1, first + 2});
    scene.surfaceOf.push_back(0);
}

class Random
{
  public:
    osg::Vec3f vector(float size)
    {
        std::uniform_real_distribution<float> u(-size, size);
        const float x = u(_engine), y = u(_engine);
        return osg::Vec3f(x, y, u(_engine));
    }
    osg::Vec3f direction()
    {
        osg::Vec3f d = vector(1.0f);
        d.normalize();
        return d;
    }

  private:
    std::mt19937 _engine{5};
};

TracedScene makeSoup(int triangles, float size)
{
    TracedScene scene;
    Random random;
    for (int i = 0; i < triangles; ++i) {
        const osg::Vec3f at = random.vector(1.0f);
        const osg::Vec3f to = random.vector(size);
        add(scene, at, at + to, at + random.vector(size));
    }
    return scene;
}

// The distance to a triangle by its plane and three edges; infinity where it is missed.
double distanceTo(const TracedScene& scene, size_t triangle, const osg::Vec3d& origin, const osg::Vec3d& direction)
{
    const osg::Vec3d a = scene.corner(triangle, 0), b = scene.corner(triangle, 1), c = scene.corner(triangle, 2);
    const osg::Vec3d n = (b - a) ^ (c - a);
    const double t = (a - origin) * n / (direction * n);
    const osg::Vec3d p = origin + direction * t;
    const bool inside = ((b - a) ^ (p - a)) * n >= 0 && ((c - b) ^ (p - b)) * n >= 0 && ((a - c) ^ (p - c)) * n >= 0;
    return inside && t > 0.0 ? t : std::numeric_limits<double>::infinity();
}

}  // namespace

TEST(CasterBvh, MeetsWhatEachTriangleByItselfSays)
{
    for (const float size : {0.05f, 0.5f}) {
        const TracedScene scene = makeSoup(3000, size);
        const CasterBvh bvh(scene);
        EXPECT_GT(bvh.nodes().size(), 500u);
        Random random;
        int met = 0, differ = 0;
        for (int i = 0; i < 2000; ++i) {
            const osg::Vec3f origin = random.vector(1.5f);
            osg::Vec3f direction = random.direction();
            if (i % 4 == 0) direction = osg::Vec3f(i % 3 == 0, i % 3 == 1, i % 3 == 2);
            double nearest = std::numeric_limits<double>::infinity();
            for (size_t k = 0; k < scene.triangles.size(); ++k)
                nearest = std::min(nearest, distanceTo(scene, k, origin, direction));
            const auto hit = bvh.nearest(origin, direction);
            if (hit) ++met;
            // A ray through an edge may pass on either side of it in single precision.
            if (hit.has_value() != std::isfinite(nearest) || (hit && std::abs(double(hit->distance) - nearest) > 1e-4)) ++differ;
        }
        EXPECT_GT(met, 100);
        EXPECT_LE(differ, 2);
    }
}

TEST(CasterBvh, SaysWhichSideItMeets)
{
    TracedScene scene;
    add(scene, osg::Vec3f(-1, -1, 0), osg::Vec3f(1, -1, 0), osg::Vec3f(0, 1, 0));
    const CasterBvh bvh(scene);
    const auto above = bvh.nearest(osg::Vec3f(0, 0, 2), osg::Vec3f(0, 0, -1));
    const auto below = bvh.nearest(osg::Vec3f(0, 0, -3), osg::Vec3f(0, 0, 1));
    ASSERT_TRUE(above && below);
    EXPECT_FLOAT_EQ(2.0f, above->distance);
    EXPECT_FALSE(above->back);
    EXPECT_FLOAT_EQ(3.0f, below->distance);
    EXPECT_TRUE(below->back);
    EXPECT_FALSE(bvh.nearest(osg::Vec3f(0, 0, 2), osg::Vec3f(0, 0, 1)));
    EXPECT_FALSE(bvh.nearest(osg::Vec3f(5, 0, 2), osg::Vec3f(0, 0, -1)));
}

TEST(CasterBvh, LeavesOutWhatIsNoTriangle)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    TracedScene scene;
    EXPECT_FALSE(CasterBvh(scene).nearest(osg::Vec3f(), osg::Vec3f(0, 0, 1)));
    for (const float bad : {nan, inf}) add(scene, osg::Vec3f(bad, 0, 1), osg::Vec3f(1, 0, 1), osg::Vec3f(0, 1, 1));
    add(scene, osg::Vec3f(0, 0, 1), osg::Vec3f(1, 1, 1), osg::Vec3f(2, 2, 1));
    EXPECT_EQ(0u, CasterBvh(scene).nodes().size());
    add(scene, osg::Vec3f(-1, -1, 2), osg::Vec3f(1, -1, 2), osg::Vec3f(0, 1, 2));
    const CasterBvh bvh(scene);
    const auto hit = bvh.nearest(osg::Vec3f(), osg::Vec3f(0, 0, 1));
    ASSERT_TRUE(hit);
    EXPECT_EQ(3u, hit->triangle);
    EXPECT_FALSE(bvh.nearest(osg::Vec3f(nan, 0, 0), osg::Vec3f(0, 0, 1)));
    EXPECT_FALSE(bvh.nearest(osg::Vec3f(), osg::Vec3f(nan, 0, 1)));
}

// No plane parts them, or only one by one.
TEST(CasterBvh, TakesTrianglesThatCannotBeSplit)
{
    TracedScene same, far;
    for (int i = 0; i < 5000; ++i) {
        add(same, osg::Vec3f(-1, -1, 1), osg::Vec3f(1, -1, 1), osg::Vec3f(0, 1, 1));
        const float x = std::ldexp(1.0f, i % 120 - 60);  // each twice as far as the one before
        add(far, osg::Vec3f(x, -1, 1), osg::Vec3f(x * 1.5f, -1, 1), osg::Vec3f(x, 1, 1));
    }
    const auto hit = CasterBvh(same).nearest(osg::Vec3f(), osg::Vec3f(0, 0, 1));
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(1.0f, hit->distance);
    EXPECT_TRUE(CasterBvh(far).nearest(osg::Vec3f(1.1f, -0.5f, 0), osg::Vec3f(0, 0, 1)));
}

TEST(CasterBvh, GivesUpWhenItIsNoLongerWanted)
{
    const std::atomic<bool> stop{true};
    EXPECT_EQ(0u, CasterBvh(makeSoup(1000, 0.1f), &stop).nodes().size());
}

}  // namespace CasterBvh_test
