// SPDX-License-Identifier: MIT
// What a view may show of boxes, against points that were drawn at random within it.
#include "surface/CasterCollector.h"
#include "shadow/VisibleBoxes.h"

#include <gtest/gtest.h>

#include <random>

namespace VisibleBoxes_test
{

using osgEnvLight::Caster;
using osgEnvLight::CasterList;
using osgEnvLight::ShadowView;
using osgEnvLight::VisibleBoxes;

namespace
{

Caster box(const osg::Vec3& low, const osg::Vec3& high)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    corners->push_back(low);
    corners->push_back(high);
    geometry->setVertexArray(corners);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, 2));
    return {geometry, osg::Matrixd(), nullptr, 0};
}

ShadowView viewFrom(const osg::Vec3d& eye, const osg::Vec3d& target, const osg::Matrixd& projection)
{
    return {osg::Matrixd::inverse(osg::Matrixd::lookAt(eye, target, osg::Vec3d(0, 0, 1))), projection, 256};
}

const std::array<osg::Vec3d, 3> worldAxes = {osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0), osg::Vec3d(0, 0, 1)};

}  // namespace

// The bounds hold every point of the boxes that the view shows, and are reached by some but for what the draw of points misses.
TEST(VisibleBoxes, BoundsAreThoseOfRandomPoints)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const std::vector<Caster> casters = {box({-3, -2, -1}, {4, 3, 0}), box({-1, 5, 0}, {1, 6, 3})};
    const osg::Matrixd projections[] = {osg::Matrixd::perspective(40.0, 1.5, 0.1, 10.0),
                                        osg::Matrixd::ortho(-2, 1, -1, 3, 0.1, 10.0)};
    const osg::Vec3d eyes[] = {{0, -9, 4}, {-6, 1, 2}, {1, 0, -0.5}};  // before, beside, in the first box
    for (const osg::Matrixd& projection : projections)
        for (const osg::Vec3d& eye : eyes) {
            const ShadowView view = viewFrom(eye, osg::Vec3d(0, 2, 0.3), projection);
            const VisibleBoxes boxes(CasterList(casters), view);
            const osg::Matrixd eyeFromWorld = osg::Matrixd::inverse(view.worldFromEye);
            const double cut = 6.0;
            double nearest = 1e300, farthest = 0.0;
            osg::BoundingBoxd seen;
            for (int i = 0; i < 200000; ++i) {
                const osg::BoundingBox& b = casters[size_t(i % 2)].geometry->getBoundingBox();
                osg::Vec3d p;
                for (int k = 0; k < 3; ++k) p[k] = b._min[k] + uniform(random) * (b._max[k] - b._min[k]);
                const osg::Vec3d inEye = p * eyeFromWorld;
                const osg::Vec3d clip = inEye * projection;
                if (inEye.z() > 0.0 || std::abs(clip.x()) > 1.0 || std::abs(clip.y()) > 1.0) continue;
                nearest = std::min(nearest, -inEye.z());
                farthest = std::max(farthest, -inEye.z());
                if (-inEye.z() <= cut) seen.expandBy(osg::Vec3d(p.x(), p.y(), 0.0));
            }
            ASSERT_FALSE(boxes.empty());
            EXPECT_LE(boxes.nearest(), nearest);
            EXPECT_GE(boxes.farthest(), farthest);
            EXPECT_NEAR(boxes.nearest(), nearest, 0.3);
            EXPECT_NEAR(boxes.farthest(), farthest, 0.3);
            const osg::BoundingBoxd bound = boxes.rectangle(worldAxes, cut);
            ASSERT_EQ(bound.valid(), seen.valid());
            for (int k = 0; seen.valid() && k < 2; ++k) {
                EXPECT_LE(bound._min[k], seen._min[k]);
                EXPECT_GE(bound._max[k], seen._max[k]);
                EXPECT_NEAR(bound._min[k], seen._min[k], 0.3);
                EXPECT_NEAR(bound._max[k], seen._max[k], 0.3);
            }
        }
}

TEST(VisibleBoxes, NothingWhereNothingIs)
{
    const ShadowView view = viewFrom(osg::Vec3d(0, -9, 0), osg::Vec3d(0, 0, 0), osg::Matrixd::perspective(40.0, 1.0, 0.1, 10.0));
    EXPECT_TRUE(VisibleBoxes(CasterList(), view).empty());
    EXPECT_TRUE(VisibleBoxes(CasterList({box({-1, -20, -1}, {1, -18, 1})}), view).empty());  // behind the eye
    EXPECT_TRUE(VisibleBoxes(CasterList({box({50, 0, 0}, {51, 1, 1})}), view).empty());      // beside the view
    EXPECT_FALSE(VisibleBoxes(CasterList({box({-1, 0, -1}, {1, 1, 1})}), view).rectangle(worldAxes, 8.0).valid());  // not so near
    // Too many for each to be cut: all of them together.
    std::vector<Caster> many;
    for (int i = 0; i < 1000; ++i) many.push_back(box({50, 0, 0}, {51, 1, 1}));
    many.push_back(box({-51, 0, 0}, {-50, 1, 1}));
    EXPECT_FALSE(VisibleBoxes(CasterList(many), view).empty());
}

}  // namespace VisibleBoxes_test
