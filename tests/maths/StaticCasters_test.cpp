// SPDX-License-Identifier: MIT
// Which casters are merged: at all times all of them are drawn, once.
#include "surface/StaticCasters.h"

#include <gtest/gtest.h>

#include <set>

namespace StaticCasters_test
{

using osgEnvLight::Caster;
using osgEnvLight::CasterList;
using osgEnvLight::StaticCasters;

namespace
{

const double slack = 1e-3;

// A triangle of area 2^index / 2, so that the area of some says which they are.
Caster triangle(unsigned index, const osg::Vec3d& at = osg::Vec3d())
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (const osg::Vec3& c : {osg::Vec3(0, 0, 0), osg::Vec3(float(1u << index), 0, 0), osg::Vec3(0, 1, 0)})
        corners->push_back(c);
    geometry->setVertexArray(corners);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    return {geometry, osg::Matrixd::translate(at), nullptr, 0};
}

// Of all triangles, times 2.
unsigned areaOf(const std::vector<Caster>& casters)
{
    double sum = 0.0;
    for (const Caster& caster : casters) {
        const auto& v = static_cast<const osg::Vec3Array&>(*caster.geometry->getVertexArray());
        const osg::PrimitiveSet& set = *caster.geometry->getPrimitiveSet(0);
        for (unsigned i = 0; i + 2 < set.getNumIndices(); i += 3)
            sum += double(((v[set.index(i + 1)] - v[set.index(i)]) ^ (v[set.index(i + 2)] - v[set.index(i)])).length());
    }
    return unsigned(sum + 0.5);
}

class Still : public testing::Test
{
  protected:
    Still()
    {
        for (unsigned i = 0; i < 5; ++i) casters.push_back(triangle(i, osg::Vec3d(100.0 * i, 0, 0)));
        still.setPlace(osg::Vec3d(7, 0, 0), 0.01);
        still.update(CasterList(casters), true, slack);
    }
    void expect(unsigned mergedArea, size_t loose)
    {
        const std::vector<Caster> drawn = still.drawn();
        ASSERT_EQ(loose + (mergedArea > 0 ? 1 : 0), drawn.size());
        if (mergedArea > 0) {
            EXPECT_EQ(mergedArea, areaOf({drawn[0]}));
        }
        unsigned all = areaOf(casters);
        EXPECT_EQ(all, areaOf(drawn));
        EXPECT_EQ(trianglesOf(casters), still.triangles());
    }
    void move(size_t index, double x) { casters[index].worldFromModel = osg::Matrixd::translate(x, 50, 0); }
    void stand(unsigned frames)
    {
        for (unsigned i = 0; i < frames; ++i) still.update(CasterList(casters), false, slack);
    }

    std::vector<Caster> casters;
    StaticCasters still;
};

}  // namespace

TEST_F(Still, AllAreMergedAtFirst)
{
    expect(31, 0);
    EXPECT_EQ(osg::Vec3d(7, 0, 0), still.drawn()[0].worldFromModel.getTrans());
    const auto& v = static_cast<const osg::Vec3Array&>(*still.drawn()[0].geometry->getVertexArray());
    std::set<float> lefts;
    for (const osg::Vec3& p : v)
        if (p.y() == 1.0f) lefts.insert(p.x());
    EXPECT_EQ((std::set<float>{-7, 93, 193, 293, 393}), lefts);
}

// Only their places tell them apart.
TEST_F(Still, OfManyOfOneGeometryThoseThatMoveAreFound)
{
    const osg::ref_ptr<const osg::Geometry> geometry = casters[0].geometry;
    casters.clear();
    for (int i = 0; i < 100; ++i) casters.push_back({geometry, osg::Matrixd::translate(i, 0, 0), nullptr, 0});
    still.update(CasterList(casters), true, slack);
    stand(StaticCasters::patience);
    expect(100, 0);
    for (size_t i = 0; i < 100; i += 3) move(i, -7.0 * double(i + 1));
    still.update(CasterList(casters), true, slack);
    expect(66, 34);
    casters.erase(casters.begin() + 10, casters.begin() + 20);
    still.update(CasterList(casters), true, slack);
    expect(59, 31);
}

TEST_F(Still, WhatMovesIsDrawnBesideTheRest)
{
    move(1, 0.0);
    still.update(CasterList(casters), true, slack);
    expect(29, 1);
    const osg::ref_ptr<const osg::Geometry> rest = still.drawn()[0].geometry;
    for (int i = 1; i < 20; ++i) {
        move(1, i);
        still.update(CasterList(casters), true, slack);
        EXPECT_EQ(rest, still.drawn()[0].geometry);
    }
    expect(29, 1);
    stand(StaticCasters::patience - 1);
    expect(29, 1);
    stand(1);
    expect(31, 0);
    const osg::ref_ptr<const osg::Geometry> all = still.drawn()[0].geometry;
    stand(20);
    EXPECT_EQ(all, still.drawn()[0].geometry);
}

TEST_F(Still, AllMoveAndCome)
{
    for (size_t i = 0; i < casters.size(); ++i) move(i, double(i));
    still.update(CasterList(casters), true, slack);
    expect(0, 5);
    stand(StaticCasters::patience);
    expect(31, 0);
}

TEST_F(Still, SomeGoAndSomeAreNew)
{
    casters.erase(casters.begin() + 2);
    casters.insert(casters.begin() + 1, triangle(6));
    casters.push_back(triangle(7));
    still.update(CasterList(casters), true, slack);
    expect(27, 2);
    stand(StaticCasters::patience);
    expect(27 + 64 + 128, 0);
    casters.clear();
    still.update(CasterList(casters), true, slack);
    expect(0, 0);
}

TEST_F(Still, OneShapeInManyPlaces)
{
    for (int i = 0; i < 3; ++i) {
        casters.push_back(casters[3]);
        casters.back().worldFromModel = osg::Matrixd::translate(0, 0, i);
    }
    still.update(CasterList(casters), true, slack);
    stand(StaticCasters::patience);
    expect(55, 0);
    casters[6].worldFromModel = osg::Matrixd::translate(0, 0, -9);
    still.update(CasterList(casters), true, slack);
    expect(47, 1);
}

// The casters' matrices come from the view's, and are rounded anew with it.
TEST_F(Still, RoundingIsNoMotion)
{
    for (Caster& c : casters) c.worldFromModel.postMult(osg::Matrixd::translate(1e-9, 0, 0));
    move(4, 3.0);
    still.update(CasterList(casters), true, slack);
    expect(15, 1);
}

TEST_F(Still, PerforatedOnesStayAsTheyAre)
{
    casters[0].state = new osg::StateSet;
    still.update(CasterList(casters), true, slack);
    expect(30, 1);
    stand(3 * StaticCasters::patience);
    expect(30, 1);
}

TEST_F(Still, AnotherPlaceMergesAnew)
{
    const osg::ref_ptr<const osg::Geometry> former = still.drawn()[0].geometry;
    still.setPlace(osg::Vec3d(7, 0, 0), 0.015);  // about the same
    still.update(CasterList(casters), false, slack);
    EXPECT_EQ(former, still.drawn()[0].geometry);
    still.setPlace(osg::Vec3d(-7, 0, 0), 0.01);
    still.update(CasterList(casters), false, slack);
    EXPECT_NE(former, still.drawn()[0].geometry);
    expect(31, 0);
}

}  // namespace StaticCasters_test
