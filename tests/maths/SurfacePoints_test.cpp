// SPDX-License-Identifier: MIT
// Points that stand for the surfaces about them.
#include "indirect/SurfacePoints.h"

#include <TracedShapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace SurfacePoints_test
{

using namespace osgEnvLight;

namespace
{

int countOf(const std::vector<SurfacePoint>& points, unsigned surface, const osg::Vec3f& normal)
{
    return int(std::count_if(points.begin(), points.end(),
                             [&](const SurfacePoint& p) { return p.surface == surface && p.normal * normal > 0.99f; }));
}

}  // namespace

TEST(SurfacePoints, AreAsManyAsTheAreaOfEachSide)
{
    TracedScene scene;
    const unsigned sheet = addSurface(scene, false), body = addSurface(scene, true);
    addQuad(scene, sheet, osg::Vec3f(), osg::Vec3f(3, 0, 0), osg::Vec3f(0, 1, 0));  // two sides of 3
    addBox(scene, body, osg::Vec3f(10, 0, 0), osg::Vec3f(11, 1, 1));                // six of 1
    const std::vector<SurfacePoint> points = placeSurfacePoints(scene, 1200);
    ASSERT_EQ(1200u, points.size());
    // Systematic: within a point of the share.
    EXPECT_NEAR(300, countOf(points, sheet, osg::Vec3f(0, 0, 1)), 1);
    EXPECT_NEAR(300, countOf(points, sheet, osg::Vec3f(0, 0, -1)), 1);
    EXPECT_NEAR(100, countOf(points, body, osg::Vec3f(1, 0, 0)), 1);
    EXPECT_NEAR(100, countOf(points, body, osg::Vec3f(0, 0, -1)), 1);
    for (const SurfacePoint& p : points) {
        if (p.surface != body) continue;
        const osg::Vec3f outwards = p.position - osg::Vec3f(10.5f, 0.5f, 0.5f);
        EXPECT_NEAR(0.5f, outwards * p.normal, 1e-5f) << "a body's points face outwards, on it";
    }
}

// Whatever the triangles: two of them are a plain 400 wide.
TEST(SurfacePoints, AreDenserAboutTheFocus)
{
    TracedScene plain;
    addQuad(plain, addSurface(plain, true), osg::Vec3f(-200, -200, 0), osg::Vec3f(400, 0, 0), osg::Vec3f(0, 400, 0));
    const TransportFocus focus{osg::Vec3d(50, 20, 0), 40.0};
    EXPECT_EQ(0.5, focus.density(10.0) / focus.density(0.0));
    const std::vector<SurfacePoint> points = placeSurfacePoints(plain, 4096, focus);
    ASSERT_EQ(4096u, points.size());
    const auto countWithin = [&](double least, double most) {
        return double(std::count_if(points.begin(), points.end(), [&](const SurfacePoint& p) {
            const double d = (osg::Vec3d(p.position) - focus.center).length();
            return d >= least && d < most;
        }));
    };
    // Rings about the centre, by the integral of 1/(1 + (d/10)^2): pi 100 ln(1 + (d/10)^2).
    const auto share = [](double d) { return std::log(1.0 + d * d / 100.0); };
    const double perShare = countWithin(0.0, 150.0) / share(150.0);
    for (const auto& [least, most] : {std::pair(0.0, 10.0), std::pair(10.0, 40.0), std::pair(40.0, 150.0)})
        EXPECT_NEAR(1.0, countWithin(least, most) / (perShare * (share(most) - share(least))), 0.1) << least;
}

TEST(SurfacePoints, AreSpreadEvenlyOverLargeTriangles)
{
    TracedScene scene;
    addQuad(scene, addSurface(scene, true), osg::Vec3f(), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    std::vector<int> counts(64);
    for (const SurfacePoint& p : placeSurfacePoints(scene, 4096))
        ++counts[size_t(std::min(int(p.position.y() * 8), 7) * 8 + std::min(int(p.position.x() * 8), 7))];
    // 64 each; the map of squares onto a triangle is uneven at its tip.
    for (const int count : counts) EXPECT_NEAR(64, count, 16);
}

// A disc has three points' share of the area. The number of points in it measures its area with an error of 25 %, the number of
// their parts with 10 %.
TEST(SurfacePoints, PartsKnowWhatIsSmallerThanAPoint)
{
    TracedScene scene;
    addQuad(scene, addSurface(scene, true), osg::Vec3f(), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    const size_t count = 1024, parts = 16;
    const std::vector<SurfacePoint> points = placeSurfacePoints(scene, count);
    const CasterBvh bvh(scene);
    const NearestPoint nearest(points, scene, bvh);
    const std::vector<osgEnvLight::SurfacePart> all = osgEnvLight::placeSurfaceParts(scene, points, nearest, parts);
    ASSERT_EQ(count * parts, all.size());
    for (size_t i = 0; i < all.size(); i += 7) EXPECT_EQ(i / parts, nearest.find(all[i].position, all[i].normal, 0)) << i;

    const double radius = std::sqrt(3.0 / (double(count) * M_PI));
    const auto error = [&](const auto& places) {
        double sum = 0.0;
        for (int k = 0; k < 100; ++k) {
            const osg::Vec3f middle(0.1f + 0.08f * float(k % 10) + 0.007f * float(k % 7), 0.1f + 0.08f * float(k / 10), 0);
            const auto inside = std::count_if(places.begin(), places.end(),
                                              [&](const auto& p) { return double((p.position - middle).length()) < radius; });
            sum += std::pow(double(inside) / double(places.size()) * double(count) / 3.0 - 1.0, 2);
        }
        return std::sqrt(sum / 100.0);
    };
    EXPECT_LT(error(all), 0.12);
    EXPECT_GT(error(points), 0.2);
}

TEST(SurfacePoints, OfSurfacesWithHolesAreFewer)
{
    TracedScene scene;
    const unsigned solid = addSurface(scene, false), holes = addSurface(scene, false, 0.25f);
    addQuad(scene, solid, osg::Vec3f(), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    addQuad(scene, holes, osg::Vec3f(0, 0, 2), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    const std::vector<SurfacePoint> points = placeSurfacePoints(scene, 1000);
    EXPECT_NEAR(200, countOf(points, holes, osg::Vec3f(0, 0, 1)) + countOf(points, holes, osg::Vec3f(0, 0, -1)), 2);
}

TEST(SurfacePoints, OfNothingAreNone)
{
    TracedScene scene;
    EXPECT_TRUE(placeSurfacePoints(scene, 100).empty());
    const unsigned surface = addSurface(scene, false);
    addTriangle(scene, surface, osg::Vec3f(), osg::Vec3f(1, 1, 1), osg::Vec3f(2, 2, 2));
    addTriangle(scene, surface, osg::Vec3f(NAN, 0, 0), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    EXPECT_TRUE(placeSurfacePoints(scene, 100).empty());
    addTriangle(scene, surface, osg::Vec3f(), osg::Vec3f(1e-6f, 0, 0), osg::Vec3f(0, 1e-6f, 0));
    EXPECT_EQ(100u, placeSurfacePoints(scene, 100).size());
}

TEST(NearestPoint, IsTheNearest)
{
    TracedScene scene;
    addSphere(scene, addSurface(scene, true), osg::Vec3f(1, 2, 3), 2.0f, 24);
    const std::vector<SurfacePoint> points = placeSurfacePoints(scene, 1000);
    const CasterBvh bvh(scene);
    const NearestPoint nearest(points, scene, bvh);
    for (size_t triangle = 0; triangle < scene.triangles.size(); triangle += 7) {
        const osg::Vec3f place = (scene.corner(triangle, 0) + scene.corner(triangle, 1) + scene.corner(triangle, 2)) / 3.0f;
        osg::Vec3f normal = scene.normal(triangle);
        normal.normalize();
        float least = 1e9f;
        for (const SurfacePoint& p : points)
            if (p.normal * normal >= 0.5f) least = std::min(least, (p.position - place).length());
        EXPECT_FLOAT_EQ(least, (points[nearest.find(place, normal, 0)].position - place).length());
    }
}

// A lamp a hand's breadth in front of a wall is not the wall, nor is the wall's other side.
TEST(NearestPoint, KeepsSurfacesApart)
{
    TracedScene scene;
    const unsigned wall = addSurface(scene, false), lamp = addSurface(scene, false);
    addQuad(scene, wall, osg::Vec3f(-2, -2, 0), osg::Vec3f(4, 0, 0), osg::Vec3f(0, 4, 0));
    addQuad(scene, lamp, osg::Vec3f(-0.5f, -0.5f, 0.02f), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    const std::vector<SurfacePoint> points = placeSurfacePoints(scene, 200);
    const CasterBvh bvh(scene);
    const NearestPoint nearest(points, scene, bvh);
    for (float x = -0.4f; x < 0.5f; x += 0.1f)
        for (const float side : {1.0f, -1.0f}) {
            const SurfacePoint& p = points[nearest.find(osg::Vec3f(x, 0.1f, 0), osg::Vec3f(0, 0, side), wall)];
            EXPECT_EQ(wall, p.surface);
            EXPECT_GT(p.normal.z() * side, 0.9f);
        }
    EXPECT_EQ(lamp, points[nearest.find(osg::Vec3f(0, 0, 0.02f), osg::Vec3f(0, 0, 1), lamp)].surface);
    EXPECT_LT(nearest.find(osg::Vec3f(1e6f, -1e6f, 0), osg::Vec3f(0, 0, 1), wall), points.size());
}

// Two rooms that a wall divides have one floor, whose points lie farther apart than the wall is thick.
TEST(NearestPoint, StaysInItsRoom)
{
    TracedScene scene;
    const unsigned floor = addSurface(scene, true), wall = addSurface(scene, true);
    addQuad(scene, floor, osg::Vec3f(-2, -2, 0), osg::Vec3f(4, 0, 0), osg::Vec3f(0, 4, 0));
    addBox(scene, wall, osg::Vec3f(-0.05f, -2, 0), osg::Vec3f(0.05f, 2, 2));
    const std::vector<SurfacePoint> points = placeSurfacePoints(scene, 300);
    const CasterBvh bvh(scene);
    const NearestPoint nearest(points, scene, bvh);
    int across = 0;
    for (float y = -1.9f; y < 1.9f; y += 0.05f)
        for (const float x : {-0.06f, 0.06f}) {
            const osg::Vec3f place(x, y, 0), up(0, 0, 1);
            const SurfacePoint& p = points[nearest.find(place, up, floor)];
            EXPECT_EQ(floor, p.surface);
            EXPECT_GT(p.position.x() * x, 0.0f) << y;
            float least = 1e9f;
            bool other = false;
            for (const SurfacePoint& q : points)
                if (q.surface == floor && (q.position - place).length() < least) {
                    least = (q.position - place).length();
                    other = q.position.x() * x < 0.0f;
                }
            across += other;
        }
    EXPECT_GT(across, 10) << "without the wall these would be of the other room";
}

}  // namespace SurfacePoints_test
