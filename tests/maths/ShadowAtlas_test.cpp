// SPDX-License-Identifier: MIT
#include "shadow/ShadowAtlas.h"

#include <osg/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using osgEnvLight::Caster;
using osgEnvLight::CasterList;
using osgEnvLight::LightList;
using osgEnvLight::ShadowAtlas;
using osgEnvLight::ShadowRefresh;

namespace ShadowAtlas_test
{

namespace
{

const unsigned count = 256;

// A spherical Fibonacci lattice, dealt to the groups in its order.
LightList evenLights()
{
    LightList list(count);
    for (unsigned i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count, turn = 2.39996322972865332 * i;
        const double r = std::sqrt(1.0 - z * z);
        list[i] = {osg::Vec3d(r * std::cos(turn), r * std::sin(turn), z), osg::Vec3d(1.0, 2.0, 3.0) * (1.0 + i % 3)};
    }
    return list;
}

std::vector<Caster> triangle()
{
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::Vec3 corners[] = {osg::Vec3(0, 0, 0), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 1)};
    geometry->setVertexArray(new osg::Vec3Array(3, corners));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    return {{geometry, osg::Matrixd(), nullptr}};
}

// Row `row` of a light.
osg::Vec4d rowOf(const osg::Image& image, unsigned light, unsigned row)
{
    const float* v = reinterpret_cast<const float*>(image.data(light / 16, 4 * (light % 16) + row));
    return osg::Vec4d(v[0], v[1], v[2], v[3]);
}

struct Rows {
    osg::Vec4d flux;  // with the solid angle
    unsigned withMaps = 0;
    double without = 0.0;  // flux of lights without maps
    unsigned ofGroup[16] = {};
};

Rows rowsOf(const ShadowAtlas& atlas)
{
    const osg::ref_ptr<osg::Image> image = atlas.lightImage(1.0, nullptr);
    Rows rows;
    for (unsigned i = 0; i < count; ++i) {
        const osg::Vec4d v = rowOf(*image, i, 3);
        rows.flux += osg::Vec4d(v[0], v[1], v[2], std::abs(v[3]));
        if (v[3] < 0.0) {
            rows.without += v[0] + v[1] + v[2];
        } else {
            ++rows.withMaps;
            ++rows.ofGroup[i % 16];
        }
    }
    return rows;
}

}  // namespace

class FirstMaps : public testing::Test
{
  protected:
    FirstMaps() { atlas->setCasters(CasterList(triangle())); }

    const LightList list = evenLights();
    const osg::ref_ptr<ShadowAtlas> atlas = new ShadowAtlas(count, 8);
};

TEST_F(FirstMaps, TakeTheFluxAndTheSolidAngleOfTheOthers)
{
    osg::Vec4d all(0, 0, 0, 4.0 * osg::PI);
    for (const auto& light : list) all += osg::Vec4d(light.flux, 0.0);
    for (unsigned drawn = 0; drawn < count; drawn += 32) {
        EXPECT_EQ(drawn == 0 ? 0u : 32u, atlas->update(list, drawn == 0 ? 0 : 32).size());
        const Rows rows = rowsOf(*atlas);
        EXPECT_EQ(drawn, rows.withMaps);
        for (unsigned k = 0; k < 4; ++k)
            EXPECT_NEAR(all[k], rows.flux[k], 3e-4 * all[k]) << drawn;  // 256 angles of at least 1e-6
        EXPECT_NEAR(drawn == 0 ? all[0] + all[1] + all[2] : 0.0, rows.without, 1e-4) << drawn;
        EXPECT_FALSE(atlas->complete());
    }
    atlas->update(list, 32);
    EXPECT_TRUE(atlas->complete());
}

// Each sixteenth of the maps holds one of each group, and a quarter leaves no gap of more than twice what a lattice leaves.
TEST_F(FirstMaps, LieSpreadOverTheSphereAndTheGroups)
{
    for (const unsigned budget : {16u, 64u}) {
        const osg::ref_ptr<ShadowAtlas> maps = new ShadowAtlas(count, 8);
        maps->setCasters(CasterList(triangle()));
        std::vector<osg::Vec3d> drawn;
        for (const auto& refresh : maps->update(list, budget)) drawn.push_back(list[refresh.map].direction);
        const Rows rows = rowsOf(*maps);
        for (const unsigned inGroup : rows.ofGroup) EXPECT_EQ(budget / 16, inGroup);
        double farthest = 0.0;
        for (const auto& light : list) {
            double nearest = 4.0;
            for (const osg::Vec3d& d : drawn) nearest = std::min(nearest, (d - light.direction).length());
            farthest = std::max(farthest, nearest);
        }
        EXPECT_LT(farthest, 2.0 * std::sqrt(4.0 / budget)) << budget;  // the radius of a cap of the mean area
    }
}

// The nearest lights of a direction have maps, while there are as many.
TEST_F(FirstMaps, AreTheNearestOfEachDirection)
{
    std::vector<bool> drawn(count);
    for (const auto& refresh : atlas->update(list, 32)) drawn[refresh.map] = true;
    const osg::ref_ptr<osg::Image> image = atlas->nearestImage();
    for (int y = 0; y < image->t(); ++y)
        for (int x = 0; x < image->s(); ++x)
            for (int k = 0; k < 4; ++k) {
                const uint32_t two = reinterpret_cast<const uint32_t*>(image->data(unsigned(x), unsigned(y)))[k];
                EXPECT_TRUE(drawn[two & 0xffffu] && drawn[two >> 16]);
            }
}

// Many triangles, of which the map of a small body's surroundings shows few.
TEST(ShadowAtlas, MoreMapsAreDrawnWhereLittleOfThemHasChanged)
{
    const int side = 200;
    const osg::ref_ptr<osg::Geometry> field = new osg::Geometry;
    const osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (int i = 0; i < side * side; ++i)
        for (const osg::Vec3& c : {osg::Vec3(0, 0, 0), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 1)})
            corners->push_back(c + osg::Vec3(float(i % side), float(i / side), 0.0f));
    field->setVertexArray(corners);
    field->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, int(corners->size())));
    const LightList list = evenLights();
    const osg::ref_ptr<ShadowAtlas> atlas = new ShadowAtlas(count, 64);
    std::vector<Caster> casters = triangle();
    casters.insert(casters.begin(), {field, osg::Matrixd(), nullptr});
    const auto show = [&](double x) {
        casters[1].worldFromModel = osg::Matrixd::translate(x, 50, 1);
        atlas->setCasters(CasterList(casters));
    };
    show(100);
    EXPECT_EQ(count, atlas->update(list, count).size());
    EXPECT_EQ(count, atlas->spent());
    show(101);
    std::vector<ShadowRefresh> drawn = atlas->update(list, 8);
    EXPECT_LE(atlas->spent(), 9u);  // the last one begins within the budget
    EXPECT_GE(drawn.size(), 12u);  // measured: 14; those of low lights show a long part
    EXPECT_LE(drawn.size(), 32u);
    for (const ShadowRefresh& refresh : drawn) {
        EXPECT_FALSE(refresh.region.isEmpty());
        EXPECT_LT(refresh.region.right - refresh.region.left, 10);
    }
    // A turned light's map is another one.
    LightList turned = list;
    for (auto& light : turned) light.direction = osg::Vec3d(light.direction.y(), -light.direction.x(), light.direction.z());
    drawn = atlas->update(turned, 8);
    EXPECT_EQ(8u, drawn.size());
    for (const ShadowRefresh& refresh : drawn) EXPECT_TRUE(refresh.region.isWhole());
}

TEST_F(FirstMaps, DarkLightsComeLast)
{
    LightList some = list;
    for (unsigned i = 0; i < count; i += 2) some[i].flux = osg::Vec3d();
    for (const auto& refresh : atlas->update(some, 128)) EXPECT_EQ(1u, refresh.map % 2);
    EXPECT_TRUE(atlas->complete());
    EXPECT_EQ(0u, atlas->waiting());
}

}  // namespace ShadowAtlas_test
