// SPDX-License-Identifier: MIT
#include "shadow/ShadowTargets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace MapRegion_test
{

using osgEnvLight::ChangedPart;
using osgEnvLight::MapRegion;
using osgEnvLight::regionOf;

ChangedPart partOf(const osg::Vec3d& low, const osg::Vec3d& high)
{
    ChangedPart part;
    part.add(osg::BoundingBoxd(low, high));
    return part;
}

void expect(const MapRegion& r, int left, int bottom, int right, int top)
{
    EXPECT_EQ(left, r.left);
    EXPECT_EQ(bottom, r.bottom);
    EXPECT_EQ(right, r.right);
    EXPECT_EQ(top, r.top);
}

// Two texels about it.
TEST(MapRegion, IsWhereTheMapShowsThePart)
{
    const osg::Vec3d origin(1e6, 0, 0);
    const osg::Matrixd projection = osg::Matrixd::ortho(-50, 50, -50, 50, 0, 10);
    expect(regionOf(partOf({1e6 - 9.5, 4.5, -3}, {1e6 + 20.5, 6.5, -2}), projection, origin, 100), 38, 52, 73, 59);
    expect(regionOf(partOf({1e6 - 90, -90, -3}, {1e6 - 48.5, -48.5, -2}), projection, origin, 100), 0, 0, 4, 4);
    EXPECT_TRUE(regionOf(partOf({1e6 + 60, 0, 0}, {1e6 + 70, 1, 1}), projection, origin, 100).isEmpty());
    EXPECT_TRUE(regionOf(ChangedPart(), projection, origin, 100).isEmpty());
}

TEST(MapRegion, IsAllOfTheMapWhereThePartIsNotKnown)
{
    const osg::Matrixd projection = osg::Matrixd::perspective(90, 1, 1, 10);
    expect(regionOf(ChangedPart::everything(), projection, {}, 64).within(64), 0, 0, 64, 64);
    // Some of it lies behind the light.
    expect(regionOf(partOf({-1, -1, -5}, {1, 1, 1}), projection, {}, 64).within(64), 0, 0, 64, 64);
    // At distance 4 the map is 8 wide.
    expect(regionOf(partOf({-1, 0, -4}, {1, 2, -4}), projection, {}, 64).within(64), 22, 30, 42, 50);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    ChangedPart two = partOf({-1, 0, -4}, {1, 2, -4});
    two.add(ChangedPart::everything());
    EXPECT_TRUE(two.isWhole());
    EXPECT_FALSE(regionOf(partOf({-1, 0, -4}, {1, 2, -4}), osg::Matrixd::scale(nan, 1, 1) * projection, {}, 64).isEmpty());
}

// What is drawn of the region alone is where it is in the map.
TEST(MapRegion, HasAProjectionThatShowsNoMore)
{
    const osg::Matrixd whole = osg::Matrixd::perspective(90, 1, 1, 10);
    const MapRegion region{8, 16, 24, 48};
    const osg::Matrixd part = region.projection(whole, 64);
    for (const osg::Vec3d& p : {osg::Vec3d(-1.5, 2, -4), osg::Vec3d(0.3, -0.2, -7)}) {
        const osg::Vec3d inMap = p * whole, inRegion = p * part;
        EXPECT_NEAR((inMap.x() * 0.5 + 0.5) * 64, 8 + (inRegion.x() * 0.5 + 0.5) * 16, 1e-9);
        EXPECT_NEAR((inMap.y() * 0.5 + 0.5) * 64, 16 + (inRegion.y() * 0.5 + 0.5) * 32, 1e-9);
        EXPECT_NEAR(inMap.z(), inRegion.z(), 1e-12);
    }
}

}  // namespace MapRegion_test
