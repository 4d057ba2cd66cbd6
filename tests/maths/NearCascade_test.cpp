// SPDX-License-Identifier: MIT
// What of a large scene a view's shadow maps are fitted to.
#include "shadow/NearCascade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace NearCascade_test
{

using osgEnvLight::NearCascade;
using osgEnvLight::ProbedPoints;

namespace
{

const double scene = 1000.0;

// Points between two distances from the eye, within that angle of a direction.
ProbedPoints cone(const osg::Vec3d& eye, const osg::Vec3d& direction, double halfAngle, double nearest, double farthest)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    ProbedPoints seen;
    seen.eye = eye;
    while (seen.points.size() < 256) {
        osg::Vec3d d(unit(random), unit(random), unit(random));
        d.normalize();
        if (d * direction < std::cos(halfAngle)) continue;
        seen.points.push_back(eye + d * (nearest + (farthest - nearest) * 0.5 * (1.0 + unit(random))));
    }
    return seen;
}

}  // namespace

TEST(NearCascade, IsAboutTheEyeThatStandsAmidWhatItSees)
{
    const osg::Vec3d eye(100, 20, 2);
    NearCascade n;
    n.follow(cone(eye, osg::Vec3d(1, 0, 0), 0.6, 2.0, 10.0), scene);
    ASSERT_TRUE(n.sphere().valid());
    EXPECT_EQ(eye, n.sphere().center());
    EXPECT_GT(n.sphere().radius(), 10.0);
    EXPECT_LT(n.sphere().radius(), 10.0 * 1.5 * std::sqrt(2.0) + 1e-9);
    // Turning, and steps, don't move it.
    const osg::BoundingSphered before = n.sphere();
    n.follow(cone(eye, osg::Vec3d(0, -1, 0), 0.6, 2.0, 10.0), scene);
    n.follow(cone(eye + osg::Vec3d(2, 1, 0), osg::Vec3d(-1, 0, 0), 0.6, 2.0, 10.0), scene);
    EXPECT_EQ(before.center(), n.sphere().center());
    EXPECT_EQ(before.radius(), n.sphere().radius());
    n.follow(cone(eye + osg::Vec3d(20, 0, 0), osg::Vec3d(-1, 0, 0), 0.6, 2.0, 10.0), scene);
    EXPECT_EQ(eye + osg::Vec3d(20, 0, 0), n.sphere().center());
}

TEST(NearCascade, IsAboutWhatIsSeenFromAfar)
{
    NearCascade n;
    n.follow(cone(osg::Vec3d(0, 0, 300), osg::Vec3d(0, 0, -1), 0.1, 290.0, 300.0), scene);
    ASSERT_TRUE(n.sphere().valid());
    EXPECT_NEAR(0.0, n.sphere().center().z(), 10.0);
    EXPECT_LT(n.sphere().radius(), 30.0 * 1.5 * std::sqrt(2.0) + 1.0);
}

TEST(NearCascade, LeavesWhatIsFarToTheWholeScene)
{
    ProbedPoints seen = cone(osg::Vec3d(), osg::Vec3d(0, 1, 0), 0.6, 4.0, 6.0);
    for (int i = 0; i < 100; ++i) seen.points.push_back(osg::Vec3d(i, 900, 0));
    NearCascade n;
    n.follow(seen, scene);
    ASSERT_TRUE(n.sphere().valid());
    EXPECT_LT(n.sphere().radius(), 24.0 * 1.5 * std::sqrt(2.0));
}

TEST(NearCascade, IsNoneWhereTheViewShowsTheScene)
{
    NearCascade n;
    n.follow(cone(osg::Vec3d(), osg::Vec3d(0, 1, 0), 0.6, 100.0, 900.0), scene);
    EXPECT_FALSE(n.sphere().valid());
    n.follow(cone(osg::Vec3d(), osg::Vec3d(0, 1, 0), 0.6, 5.0, 9.0), scene);
    EXPECT_TRUE(n.sphere().valid());
    n.follow(ProbedPoints(), scene);  // the sky
    EXPECT_TRUE(n.sphere().valid());
    n.follow(cone(osg::Vec3d(), osg::Vec3d(0, 1, 0), 0.6, 100.0, 900.0), scene);
    EXPECT_FALSE(n.sphere().valid());
}

// Zooming in makes it smaller, but not at once.
TEST(NearCascade, ShrinksByMuchOrNotAtAll)
{
    NearCascade n;
    n.follow(cone(osg::Vec3d(), osg::Vec3d(0, 1, 0), 0.6, 10.0, 40.0), scene);
    const double radius = n.sphere().radius();
    n.follow(cone(osg::Vec3d(), osg::Vec3d(0, 1, 0), 0.6, 10.0, 30.0), scene);
    EXPECT_EQ(radius, n.sphere().radius());
    n.follow(cone(osg::Vec3d(), osg::Vec3d(0, 1, 0), 0.6, 1.0, 4.0), scene);
    EXPECT_LT(n.sphere().radius(), 0.25 * radius);
}

TEST(NearCascade, PointsThatAreNoneOrOne)
{
    for (double far : {1e-30, 1.0, 1e30}) {
        NearCascade n;
        ProbedPoints seen;
        seen.eye = osg::Vec3d();
        n.follow(seen, scene);
        EXPECT_FALSE(n.sphere().valid());
        seen.points = {osg::Vec3d(0, far, 0)};
        n.follow(seen, scene);
        seen.eye.reset();
        n.follow(seen, scene);  // no extent
        EXPECT_FALSE(n.sphere().valid()) << far;
    }
}

}  // namespace NearCascade_test
