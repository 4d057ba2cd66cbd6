// SPDX-License-Identifier: MIT
// What probes know of the scene about them.
#include "indirect/ProbeGrid.h"

#include "base/Limits.h"

#include <TracedShapes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ProbeGrid_test
{

using namespace osgEnvLight;

namespace
{

struct Probed {
    explicit Probed(const TracedScene& of, int most = 4)
        : scene(of),
          bvh(scene),
          points(placeSurfacePoints(scene, 4096)),
          nearest(points, scene, bvh),
          grid(scene, bvh, nearest, most)
    {
    }
    double shareOf(size_t probe, int link) const
    {
        double share = 0.0;
        for (size_t k = 0; k < ProbeGrid::directions().size(); ++k) {
            const ProbeGrid::Links& links = grid.links[probe * ProbeGrid::directions().size() + k];
            share += 0.25 * double(std::count(links.begin(), links.end(), link)) * double(ProbeGrid::directions()[k].share);
        }
        return share;
    }

    TracedScene scene;
    CasterBvh bvh;
    std::vector<SurfacePoint> points;
    NearestPoint nearest;
    ProbeGrid grid;
};

TracedScene makeRoom()
{
    TracedScene room;
    addBox(room, addSurface(room, false), osg::Vec3f(), osg::Vec3f(4, 4, 3), true);
    return room;
}

}  // namespace

TEST(ProbeGrid, DirectionsFillTheSphere)
{
    osg::Vec3d mean;
    double all = 0.0, square = 0.0;
    for (const ProbeGrid::Direction& d : ProbeGrid::directions()) {
        all += double(d.share);
        mean += osg::Vec3d(d.to) * double(d.share);
        square += double(d.to.z() * d.to.z() * d.share);
    }
    EXPECT_NEAR(1.0, all, 1e-6);
    EXPECT_NEAR(0.0, mean.length(), 1e-6);
    EXPECT_NEAR(1.0 / 3.0, square, 2e-3);  // of the middle of texels
}

TEST(ProbeGrid, LinksAreThePointsThatItSees)
{
    const Probed room(makeRoom());
    const auto& directions = ProbeGrid::directions();
    ASSERT_EQ(4u * 4u * 2u, room.grid.probes());
    ASSERT_EQ(room.grid.probes() * directions.size(), room.grid.links.size());
    const float spacing = std::sqrt(2.0f * (16 + 16 + 4 * 12) / 4096.0f);  // both sides of the walls have points
    for (size_t i = 0; i < room.grid.links.size(); ++i) {
        for (const int link : room.grid.links[i]) ASSERT_GE(link, 0) << "a closed room has no sky";
        const ProbeGrid::Place& place = room.grid.places[i / directions.size()];
        EXPECT_TRUE(place.on);
        const osg::Vec3f to = directions[i % directions.size()].to;
        const auto hit = room.bvh.nearest(place.position, to);
        ASSERT_TRUE(hit);
        const SurfacePoint& p = room.points[size_t(room.grid.links[i][0])];
        EXPECT_LT((place.position + to * hit->distance - p.position).length(), 2.0f * spacing);
        EXPECT_LT(p.normal * to, 0.0f) << "the side that faces it";
    }
    EXPECT_EQ(0.0, room.grid.openShare());
}

TEST(ProbeGrid, SeesTheSkyOverAPlane)
{
    TracedScene plane;
    addQuad(plane, addSurface(plane, false), osg::Vec3f(-100, -100, 0), osg::Vec3f(200, 0, 0), osg::Vec3f(0, 200, 0));
    const Probed probed(plane);
    for (size_t i = 0; i < probed.grid.probes(); ++i) {
        EXPECT_NE(0.0f, probed.grid.places[i].position.z()) << "not in it";
        const osg::Vec3f& p = probed.grid.places[i].position;
        if (std::max(std::abs(p.x()), std::abs(p.y())) > 60.0f) continue;
        EXPECT_NEAR(0.5, probed.shareOf(i, ProbeGrid::SKY), 0.1);
    }
    EXPECT_NEAR(0.5, probed.grid.openShare(), 0.1);
}

// A single ray for each texel of directions would meet a body that is smaller in all of the texel or in none.
TEST(ProbeGrid, SeesSmallThingsFarAway)
{
    TracedScene scene;
    addBox(scene, addSurface(scene, false), osg::Vec3f(-10, -10, -10), osg::Vec3f(10, 10, 10), true);
    addSphere(scene, addSurface(scene, true), osg::Vec3f(), 0.8f, 32);
    const Probed probed(scene, 8);
    const auto& directions = ProbeGrid::directions();
    double squares = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < probed.grid.probes(); ++i) {
        const double distance = double(probed.grid.places[i].position.length());
        if (distance < 4.0) continue;
        double seen = 0.0;
        for (size_t k = 0; k < directions.size(); ++k)
            for (const int link : probed.grid.links[i * directions.size() + k])
                if (link >= 0 && probed.points[size_t(link)].surface == 1) seen += 0.25 * double(directions[k].share);
        squares += std::pow(seen / (0.5 * (1.0 - std::sqrt(1.0 - 0.64 / (distance * distance)))) - 1.0, 2.0);
        ++count;
    }
    ASSERT_GT(count, 100u);
    EXPECT_LT(std::sqrt(squares / double(count)), 0.4);  // .34; with a single ray .72
}

// What lies within a body stands for nothing: others take its place.
TEST(ProbeGrid, IsOffOrOutsideWhereABodyIs)
{
    TracedScene scene;
    addBox(scene, addSurface(scene, false), osg::Vec3f(-10, -10, -10), osg::Vec3f(10, 10, 10), true);
    const unsigned body = addSurface(scene, true);
    addBox(scene, body, osg::Vec3f(-6, -6, -6), osg::Vec3f(6, 6, 6));
    const Probed probed(scene, 8);
    int off = 0;
    for (size_t i = 0; i < probed.grid.probes(); ++i) {
        const osg::Vec3f& p = probed.grid.places[i].position;
        EXPECT_GT(std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())}), 6.0f);
        EXPECT_EQ(0.0, probed.shareOf(i, ProbeGrid::BACK));
        if (probed.grid.places[i].on) continue;
        ++off;
        const auto same = std::find_if(probed.grid.places.begin(), probed.grid.places.end(),
                                       [&](const ProbeGrid::Place& o) { return o.on && o.position == p; });
        ASSERT_NE(probed.grid.places.end(), same);
        const auto other = same - probed.grid.places.begin();
        const auto links = [&](std::ptrdiff_t probe) {
            const auto count = std::ptrdiff_t(ProbeGrid::directions().size());
            return std::vector<ProbeGrid::Links>(probed.grid.links.begin() + probe * count,
                                                 probed.grid.links.begin() + (probe + 1) * count);
        };
        EXPECT_EQ(links(other), links(std::ptrdiff_t(i)));
        const size_t texels = size_t(limits::PROBE_DEPTH_SIDE * limits::PROBE_DEPTH_SIDE);
        EXPECT_EQ(probed.grid.depths[size_t(other) * texels + 17], probed.grid.depths[i * texels + 17]);
    }
    EXPECT_GT(off, 4);
    EXPECT_LT(off, int(probed.grid.probes()) / 3);
}

// As behind a screen that hangs on a wall.
TEST(ProbeGrid, CountsLittleInANarrowGap)
{
    TracedScene scene = makeRoom();
    addBox(scene, addSurface(scene, true), osg::Vec3f(0.06f, 1, 0.5f), osg::Vec3f(0.12f, 3, 2.5f), false);
    const Probed probed(scene, 12);
    int inGap = 0, open = 0;
    for (const ProbeGrid::Place& place : probed.grid.places) {
        const osg::Vec3f& p = place.position;
        if (p.x() < 0.06f && p.y() > 1.2f && p.y() < 2.8f && p.z() > 0.7f && p.z() < 2.3f) {
            ++inGap;
            EXPECT_LT(place.weight, 0.1f);
        }
        if (p.x() > 1.0f && p.x() < 3.0f && p.y() > 1.0f && p.y() < 3.0f && p.z() > 1.0f && p.z() < 2.0f) {
            ++open;
            EXPECT_EQ(1.0f, place.weight);
        }
    }
    EXPECT_GT(inGap, 0);
    EXPECT_GT(open, 0);
}

TEST(ProbeGrid, HolesLetTheirShareOfRaysPass)
{
    for (const float opacity : {0.2f, 0.7f}) {
        TracedScene scene;
        addSphere(scene, addSurface(scene, false, opacity), osg::Vec3f(), 10.0f, 24);
        const Probed probed(scene, 2);
        double sky = 0.0;
        for (size_t i = 0; i < probed.grid.probes(); ++i) sky += probed.shareOf(i, ProbeGrid::SKY);
        // 4 probes of 384 rays: a standard error of .012 at most.
        EXPECT_NEAR(1.0 - double(opacity), sky / double(probed.grid.probes()), 0.04);
    }
}

TEST(ProbeGrid, DepthsAreTheDistances)
{
    const Probed room(makeRoom(), 2);
    const size_t side = size_t(limits::PROBE_DEPTH_SIDE);
    for (size_t i = 0; i < room.grid.depths.size(); ++i) {
        const auto [mean, square] = room.grid.depths[i];
        ASSERT_GT(mean, 0.0f);
        EXPECT_GE(square, mean * mean * 0.9999f);
    }
    // The middle of an octahedral map looks up.
    const size_t up = side / 2 * side + side / 2;
    for (size_t probe = 0; probe < room.grid.probes(); ++probe)
        EXPECT_NEAR(3.0f - room.grid.places[probe].position.z(), room.grid.depths[probe * side * side + up][0], 0.25f);
}

TEST(ProbeGrid, IsFinerWhereTheSceneIs)
{
    TracedScene scene;
    const unsigned ground = addSurface(scene, false), balls = addSurface(scene, true);
    addQuad(scene, ground, osg::Vec3f(-100, -100, 0), osg::Vec3f(200, 0, 0), osg::Vec3f(0, 200, 0));
    for (int i = 0; i < 4; ++i) addSphere(scene, balls, osg::Vec3f(float(2 * i - 3), 0, 1), 1.0f, 16);
    const Probed probed(scene, 8);
    for (const std::vector<float>& planes : probed.grid.levels[0].planes)
        for (size_t i = 1; i < planes.size(); ++i) EXPECT_LT(planes[i - 1], planes[i]);
    const std::vector<float>& x = probed.grid.levels[0].planes[0];
    EXPECT_GE(std::count_if(x.begin(), x.end(), [](float v) { return std::abs(v) < 15.0f; }), 4);
    EXPECT_GE(std::count_if(x.begin(), x.end(), [](float v) { return std::abs(v) > 20.0f; }), 2);
    EXPECT_EQ(8u, x.size());
    EXPECT_EQ(4u, probed.grid.levels[0].planes[2].size());
}

// Of a scene far larger than what a view shows: two grids of cubes besides, the second a third of the first. Half a cell within
// the scene's bound, on places that do not depend on the centre.
TEST(ProbeGrid, IsFinerAboutTheFocus)
{
    TracedScene plain;
    addBox(plain, addSurface(plain, true), osg::Vec3f(-200, -200, 0), osg::Vec3f(200, 200, 20));
    const CasterBvh bvh(plain);
    const std::vector<SurfacePoint> points = placeSurfacePoints(plain, 256);
    const NearestPoint nearest(points, plain, bvh);
    const auto levelsAbout = [&](const osg::Vec3d& center) {
        const ProbeGrid grid(plain, bvh, nearest, 4, {center, 30.0});
        EXPECT_EQ(3u * 4 * 4 * 2, grid.probes());
        EXPECT_EQ(grid.probes() * ProbeGrid::directions().size(), grid.links.size());
        return grid.levels;
    };
    const auto levels = levelsAbout(osg::Vec3d(47, -40, 2)), moved = levelsAbout(osg::Vec3d(54, -40, 2));
    ASSERT_EQ(3u, levels.size());
    using Vector = std::vector<float>;
    using Ends = std::array<bool, 2>;
    const auto expectNear = [](const Vector& expected, const Vector& planes) {
        ASSERT_EQ(expected.size(), planes.size());
        for (size_t i = 0; i < planes.size(); ++i) EXPECT_NEAR(expected[i], planes[i], 1e-3f) << i;
    };
    expectNear({10, 30, 50, 70}, levels[1].planes[0]);
    expectNear({30, 50, 70, 90}, moved[1].planes[0]);
    expectNear({-70, -50, -30, -10}, levels[1].planes[1]);
    expectNear({-10, 10}, levels[1].planes[2]);  // higher than the scene
    EXPECT_EQ((Ends{true, true}), levels[1].ends[2]);
    const float third = 20.0f / 3.0f;
    const Vector &fine = levels[2].planes[0], &movedFine = moved[2].planes[0];
    expectNear({fine[0], fine[0] + third, fine[0] + 2 * third, fine[0] + 3 * third}, fine);
    EXPECT_NEAR(47.0f, 0.5f * (fine[0] + fine[3]), 0.51f * third);
    expectNear({fine[1], fine[2], fine[3], fine[3] + third}, movedFine);
    expectNear(levels[2].planes[1], moved[2].planes[1]);
    expectNear({0.5f * third, 1.5f * third}, levels[2].planes[2]);
    EXPECT_EQ((Ends{true, false}), levels[2].ends[2]);
    EXPECT_EQ((Ends{false, false}), levels[2].ends[0]);
}

TEST(ProbeGrid, StopsWhenItIsNoLongerWanted)
{
    const TracedScene room = makeRoom();
    const CasterBvh bvh(room);
    const std::vector<SurfacePoint> points = placeSurfacePoints(room, 100);
    const NearestPoint nearest(points, room, bvh);
    const std::atomic<bool> stop{true};
    EXPECT_EQ(0u, ProbeGrid(room, bvh, nearest, 8, {}, &stop).probes());
}

}  // namespace ProbeGrid_test
