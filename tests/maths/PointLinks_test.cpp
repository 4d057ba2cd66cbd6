// SPDX-License-Identifier: MIT
// What surface points see close by.
#include "indirect/PointLinks.h"

#include "base/Limits.h"

#include <TracedShapes.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace PointLinks_test
{

using namespace osgEnvLight;

namespace
{

// Of a scene, links from all points to what is closer than `within`.
struct Linked {
    const TracedScene scene;
    const std::vector<SurfacePoint> points;
    std::vector<int> links;

    Linked(const TracedScene& s, float within, unsigned count = 1024) : scene(s), points(placeSurfacePoints(scene, count))
    {
        const CasterBvh bvh(scene);
        links = linkPoints(scene, bvh, points, NearestPoint(points, scene, bvh), within);
    }
};

}  // namespace

// Two plates whose sides are as long as what lies between them: form factor .19982 [Howell, C-11].
TEST(PointLinks, AreAsManyAsTheFormFactorSays)
{
    TracedScene plates;
    const unsigned surface = addSurface(plates, false);
    addQuad(plates, surface, osg::Vec3f(), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    addQuad(plates, surface, osg::Vec3f(0, 0, 1), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    const Linked linked(plates, 10.0f);
    // 256 points of 16 directions that are spread evenly: far below the .006 of random ones.
    const auto up = [&](size_t i) {
        const SurfacePoint& p = linked.points[i];
        return p.normal.z() > 0.0f && p.position.z() < 0.5f;
    };
    double close = 0.0, all = 0.0;
    for (size_t i = 0; i < linked.links.size(); ++i) {
        if (!up(i / limits::POINT_LINKS)) continue;
        all += 1.0;
        if (linked.links[i] < 0) continue;
        close += 1.0;
        const SurfacePoint& met = linked.points[size_t(linked.links[i])];
        EXPECT_LT(met.normal.z(), 0.0f);
        EXPECT_FLOAT_EQ(1.0f, met.position.z());
    }
    EXPECT_NEAR(0.19982, close / all, 0.006);
}

TEST(PointLinks, EndWhereProbesTakeOver)
{
    TracedScene plates;
    addQuad(plates, addSurface(plates, false), osg::Vec3f(), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    addQuad(plates, addSurface(plates, false), osg::Vec3f(0, 0, 1), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    for (const int link : Linked(plates, 0.99f).links) EXPECT_EQ(int(NOTHING), link);
}

// Probes do not fit between plates, but see them. Their points do not ask these for what is farther away.
TEST(PointLinks, ReachFarFromAHollow)
{
    TracedScene plates;
    addQuad(plates, addSurface(plates, false), osg::Vec3f(), osg::Vec3f(9, 0, 0), osg::Vec3f(0, 9, 0));
    addQuad(plates, addSurface(plates, false), osg::Vec3f(0, 0, 0.5f), osg::Vec3f(9, 0, 0), osg::Vec3f(0, 9, 0));
    // At a distance d the other plate is closer than r in 1 - (d / r)^2 of the directions: three quarters of them.
    const Linked linked(plates, 1.0f);
    int inMiddle = 0;
    for (size_t i = 0; i < linked.points.size(); ++i) {
        const SurfacePoint& p = linked.points[i];
        const bool between = p.normal.z() > 0.0f ? p.position.z() < 0.1f : p.position.z() > 0.4f;
        if (!between || std::max(std::abs(p.position.x() - 4.5f), std::abs(p.position.y() - 4.5f)) > 3.0f) continue;
        ++inMiddle;
        const auto* own = &linked.links[i * limits::POINT_LINKS];
        // The edge is seen below 7 degrees, in a sixtieth of all directions.
        EXPECT_LE(std::count(own, own + limits::POINT_LINKS, int(NOTHING)), 2);
    }
    EXPECT_GT(inMiddle, 200);
}

// Points within a body send nothing to others, and receive nothing.
TEST(PointLinks, KnowTheInsideOfBodies)
{
    TracedScene scene;
    addQuad(scene, addSurface(scene, false), osg::Vec3f(-1, -1, 0), osg::Vec3f(2, 0, 0), osg::Vec3f(0, 2, 0));
    addBox(scene, addSurface(scene, true), osg::Vec3f(-0.5f, -0.5f, -0.2f), osg::Vec3f(0.5f, 0.5f, 0.3f));
    const Linked linked(scene, 10.0f);
    for (size_t i = 0; i < linked.points.size(); ++i) {
        const SurfacePoint& p = linked.points[i];
        const float out = std::max(std::abs(p.position.x()), std::abs(p.position.y()));
        if (p.surface != 0 || p.normal.z() < 0.0f || std::abs(out - 0.5f) < 0.02f)
            continue;  // at the body's sides one may lie in them
        const auto* first = &linked.links[i * limits::POINT_LINKS];
        const auto inside = std::count(first, first + limits::POINT_LINKS, int(INSIDE_OF_BODY));
        EXPECT_EQ(out < 0.5f ? limits::POINT_LINKS : 0, int(inside)) << p.position.x() << " " << p.position.y();
    }
}

TEST(PointLinks, AreNoneWhereNothingIsClose)
{
    TracedScene ball;
    addSphere(ball, addSurface(ball, true), osg::Vec3f(), 1.0f, 32);
    for (const int link : Linked(ball, 10.0f).links) EXPECT_EQ(int(NOTHING), link);
}

}  // namespace PointLinks_test
