// SPDX-License-Identifier: MIT
#include "shadow/EmitterMaps.h"

#include <gtest/gtest.h>

namespace EmitterMaps_test
{

using osgEnvLight::Caster;
using osgEnvLight::CasterList;
using osgEnvLight::EmitterMaps;
using osgEnvLight::EmitterPoint;
using osgEnvLight::ShadowRefresh;

// A point that looks along +X, between what stands still at both ends of the scene.
class OneMap : public testing::Test
{
  protected:
    OneMap()
    {
        const osg::Vec3 corners[] = {osg::Vec3(-0.1f, -0.1f, 0), osg::Vec3(0.1f, 0, 0), osg::Vec3(0, 0.1f, 0.1f)};
        const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexArray(new osg::Vec3Array(3, corners));
        geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
        for (const osg::Vec3d& at : {osg::Vec3d(-9, -5, -5), osg::Vec3d(9, 5, 5), osg::Vec3d(5, 0, 0)})
            _casters.push_back({geometry, osg::Matrixd::translate(at), nullptr, 0});
        EmitterPoint point = {};
        point.normal = osg::Vec3d(1, 0, 0);
        point.power = osg::Vec3d(1, 1, 1);
        point.tangent = 1.0;
        _points.assign(1, point);
        EXPECT_EQ(1u, after({5, 0, 0}).size());
    }

    std::vector<ShadowRefresh> after(const osg::Vec3d& place)
    {
        _casters[2].worldFromModel = osg::Matrixd::translate(place);
        _maps->setCasters(CasterList(_casters));
        return _maps->update(_points, 1);
    }

    std::vector<Caster> _casters;
    std::vector<EmitterPoint> _points;
    const osg::ref_ptr<EmitterMaps> _maps = new EmitterMaps(1, 100);
};

// At distance 5 the map is 10 wide, or a little less; texels are .1.
TEST_F(OneMap, IsDrawnWhereItShowsTheChange)
{
    const std::vector<ShadowRefresh> drawn = after({5, 1, 0});
    ASSERT_EQ(1u, drawn.size());
    EXPECT_FALSE(drawn[0].region.isWhole());
    EXPECT_FALSE(drawn[0].region.isEmpty());
    const int wide = drawn[0].region.right - drawn[0].region.left, high = drawn[0].region.top - drawn[0].region.bottom;
    EXPECT_NEAR(std::max(wide, high), 17, 3);
    EXPECT_LT(std::min(wide, high), 9);
    EXPECT_TRUE(after({5, 1, 0}).empty());
}

TEST_F(OneMap, StaysWhereItDoesNotShowTheChange)
{
    after({0.5, 4, 0});                       // from where it was seen to beside the window
    EXPECT_TRUE(after({0.5, 3, 0}).empty());  // and on
    EXPECT_EQ(0u, _maps->waiting());
}

TEST_F(OneMap, IsDrawnAnewForAnotherScene)
{
    const std::vector<ShadowRefresh> drawn = after({20, 0, 0});
    ASSERT_EQ(1u, drawn.size());
    EXPECT_TRUE(drawn[0].region.isWhole());
}

}  // namespace EmitterMaps_test
