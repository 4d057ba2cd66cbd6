// SPDX-License-Identifier: MIT
// Where the frame before showed what moves.
#include "SmoothedCard.h"

#include <surface/CasterMotion.h>

#include <osgEnvLight/SurfaceProgram>

#include <osg/MatrixTransform>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace Motion_test
{

using namespace osgEnvLight;
using namespace smoothed;

namespace
{

enum Mover { BY_MATRIX, BY_VERTICES, BY_PROGRAM };

// Slanted bars, 2.6 pixels wide and 5.5 apart, before a wall that is as bright as the map.
class Bars
{
  public:
    explicit Bars(Mover mover) : _mover(mover)
    {
        osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
        for (int i = -12; i <= 12; ++i) {
            const auto first = unsigned(_vertices->size());
            const osg::Vec3d low(0.25 * i, -0.1, -2), across(0.12, 0, 0), up(0.6, 0, 4);
            for (const osg::Vec3d& v : {low, low + across, low + across + up, low + up}) _vertices->push_back(osg::Vec3(v));
            for (const unsigned k : {0u, 1u, 2u, 0u, 2u, 3u}) indices->push_back(first + k);
        }
        const osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_OVERALL, 1);
        (*normals)[0].set(0, -1, 0);
        _geometry->setVertexArray(_vertices);
        _geometry->setNormalArray(normals);
        _geometry->addPrimitiveSet(indices);
        _geometry->setUseDisplayList(false);
        _geometry->setDataVariance(osg::Object::DYNAMIC);
        Material::setLambert(*_geometry->getOrCreateStateSet(), osg::Vec3f(0.05f, 0.05f, 0.05f));
        if (mover == BY_PROGRAM) {
            _geometry->getStateSet()->setAttributeAndModes(SurfaceProgram::create(
                "uniform vec3 way; void envlightVertex(inout vec4 vertex, inout vec3 normal) { vertex.xyz += way; }"));
            _geometry->getStateSet()->addUniform(_way);
        }
        transform->addChild(_geometry);
    }

    void move(const osg::Vec3d& way)
    {
        if (_mover == BY_MATRIX) transform->setMatrix(osg::Matrixd::translate(way));
        if (_mover == BY_PROGRAM) _way->set(osg::Vec3(way));
        if (_mover != BY_VERTICES) return;
        for (osg::Vec3& v : *_vertices) v += osg::Vec3(way) - _last;
        _last = osg::Vec3(way);
        _vertices->dirty();
        _geometry->dirtyBound();
    }

    const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform;

  private:
    const Mover _mover;
    const osg::ref_ptr<osg::Vec3Array> _vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::Geometry> _geometry = new osg::Geometry;
    const osg::ref_ptr<osg::Uniform> _way = new osg::Uniform("way", osg::Vec3());
    osg::Vec3 _last;
};

// Of a motion of 2.2 and .7 pixels a frame, before a still view.
MovingErrors errorsOfMover(int antialias, Mover mover)
{
    const auto begin = [&](LitScene& lit) -> Step {
        Bars bars(mover);
        lit.addChild(bars.transform);
        return [bars](SceneRenderer& renderer, int frame) mutable {
            renderer.lookAt(osg::Vec3d(0, -4, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1), 40.0);
            bars.move(osg::Vec3d(0.1 * frame - 0.8, 0, 0.03 * frame));
        };
    };
    return errorsOfMotion(antialias, begin, [](const LitScene& lit, int frame) {
        const bool averages = lit.getSettings()->antialias == Settings::ANTIALIAS_TEMPORAL;
        EXPECT_EQ(averages && frame > 0, lit.plan().runs("motion")) << lit.plan().reason("motion");
    });
}

}  // namespace

// Measured: .78 of the error without averaging; .82 where vertices change, for these start anew in each frame. Looked up as if it
// stood still, a body has 2.27 times the error. Smoothed edges have .39 of it on such bars.
TEST(Motion, WhatMovesLeavesNothingBehind)
{
    for (const Mover mover : {BY_MATRIX, BY_VERTICES, BY_PROGRAM}) {
        const MovingErrors off = errorsOfMover(Settings::ANTIALIAS_OFF, mover);
        const MovingErrors temporal = errorsOfMover(Settings::ANTIALIAS_TEMPORAL, mover);
        EXPECT_LT(temporal.error, 0.9 * off.error) << mover;
        EXPECT_LT(temporal.change, 0.95 * off.change) << mover;
    }
}

// Else all would be drawn a second time.
TEST(Motion, AViewThatMovesMovesNothing)
{
    const osg::ref_ptr<LitScene> lit = card(Settings::ANTIALIAS_TEMPORAL, true);
    for (const Mover mover : {BY_MATRIX, BY_VERTICES, BY_PROGRAM}) lit->addChild(Bars(mover).transform);
    SceneRenderer renderer(size, size);
    for (int i = 0; i < 3; ++i) {
        renderer.lookAt(osg::Vec3d(0.1 * i, -4, 0.03 * i), osg::Vec3d(0.2 * i, 0, 0), osg::Vec3d(0, 0, 1), 40.0);
        renderer.render(lit, 1);
        EXPECT_FALSE(lit->plan().runs("motion")) << lit->plan().reason("motion");
        EXPECT_TRUE(lit->plan().runs("temporal"));
    }
}

namespace
{

struct Place {
    osg::Vec3d origin;
    bool isParallel;
};

// Bars that move to one side while the view moves to the other, before the card, which stands still.
MovingErrors errorsAt(int antialias, const Place& place)
{
    return errorsOfMotion(antialias, [&](LitScene& lit) -> Step {
        Bars bars(BY_MATRIX);
        const osg::ref_ptr<osg::MatrixTransform> there = new osg::MatrixTransform(osg::Matrixd::translate(place.origin));
        there->addChild(bars.transform);
        there->addChild(lit.getChild(0));
        lit.removeChildren(0, 1);
        lit.addChild(there);
        return [bars, place](SceneRenderer& renderer, int frame) mutable {
            bars.move(osg::Vec3d(0.04 * frame - 0.3, 0, 0));
            const osg::Vec3d eye = place.origin + osg::Vec3d(-0.03 * frame, -4, 0.013 * frame);
            renderer.lookAt(eye, eye + osg::Vec3d(0, 4, 0), osg::Vec3d(0, 0, 1), 40.0);
            const double half = 4.0 * std::tan(osg::DegreesToRadians(20.0));
            if (place.isParallel) renderer.viewer().getCamera()->setProjectionMatrixAsOrtho(-half, half, -half, half, 1, 10);
        };
    });
}

}  // namespace

// Measured .63, .60 and .63 of the error without, and as much of its change.
TEST(Motion, IsFoundInParallelProjectionAndOnTheGlobe)
{
    for (const Place& place : {Place{{}, false}, Place{{}, true}, Place{{6.4e6, 1e6, 0}, false}}) {
        const MovingErrors off = errorsAt(Settings::ANTIALIAS_OFF, place);
        const MovingErrors temporal = errorsAt(Settings::ANTIALIAS_TEMPORAL, place);
        EXPECT_LT(temporal.error, 0.7 * off.error) << place.origin.x() << place.isParallel;
        EXPECT_LT(temporal.change, 0.7 * off.change) << place.origin.x() << place.isParallel;
    }
}

namespace
{

Caster casterOf(const osg::ref_ptr<osg::Geode>& geode, const osg::Vec3d& place)
{
    return {geode->getDrawable(0)->asGeometry(), osg::Matrixd::translate(place), nullptr, 1};
}

}  // namespace

TEST(CasterMotion, FindsThoseThatAreElsewhereOrOfAnotherShape)
{
    const osg::ref_ptr<osg::Geode> a = makeBox(osg::Vec3d(-1, -1, -1), osg::Vec3d(1, 1, 1)),
                                   b = makeQuad({}, {1, 0, 0}, {0, 1, 0});
    const osg::Vec3d eye(0, 0, 10);
    CasterMotion motion;
    std::vector<Caster> casters = {casterOf(a, {}), casterOf(b, {3, 0, 0}), casterOf(a, {6, 0, 0})};
    EXPECT_TRUE(motion.update(casters, eye).empty()) << "the first frame";
    EXPECT_TRUE(motion.update(casters, eye).empty());
    casters[2].worldFromModel = osg::Matrixd::translate(6, 0.1, 0);
    std::vector<MovedCaster> moved = motion.update(casters, eye);
    ASSERT_EQ(1u, moved.size());
    EXPECT_EQ(osg::Vec3d(6, 0.1, 0), moved[0].caster.worldFromModel.getTrans());
    EXPECT_EQ(osg::Vec3d(6, 0, 0), moved[0].formerWorldFromModel.getTrans());
    EXPECT_FALSE(moved[0].isChanged);
    ++casters[1].shape;
    moved = motion.update(casters, eye);
    ASSERT_EQ(1u, moved.size());
    EXPECT_EQ(casters[1].geometry, moved[0].caster.geometry);
    EXPECT_TRUE(moved[0].isChanged);
    motion.forget();
    casters[0].worldFromModel = osg::Matrixd::translate(1, 0, 0);
    EXPECT_TRUE(motion.update(casters, eye).empty()) << "the frame before is forgotten";
}

// Those that come and go leave the others what they are.
TEST(CasterMotion, FollowsAListThatChanges)
{
    const osg::ref_ptr<osg::Geode> a = makeBox(osg::Vec3d(-1, -1, -1), osg::Vec3d(1, 1, 1)),
                                   b = makeQuad({}, {1, 0, 0}, {0, 1, 0});
    const osg::Vec3d eye(0, 0, 10);
    CasterMotion motion;
    motion.update({casterOf(a, {}), casterOf(b, {3, 0, 0}), casterOf(a, {6, 0, 0})}, eye);
    EXPECT_TRUE(motion.update({casterOf(a, {}), casterOf(a, {6, 0, 0})}, eye).empty());
    EXPECT_TRUE(motion.update({casterOf(b, {9, 0, 0}), casterOf(a, {}), casterOf(a, {6, 0, 0})}, eye).empty());
    const std::vector<MovedCaster> moved =
        motion.update({casterOf(a, {}), casterOf(a, {6.5, 0, 0}), casterOf(b, {8, 0, 0})}, eye);
    ASSERT_EQ(2u, moved.size());
    EXPECT_EQ(osg::Vec3d(6, 0, 0), moved[0].formerWorldFromModel.getTrans());
    EXPECT_EQ(osg::Vec3d(9, 0, 0), moved[1].formerWorldFromModel.getTrans());
}

// A turn counts by what it moves; what an eye on the globe leaves in the last digits does not.
TEST(CasterMotion, IsWhatAPictureShows)
{
    const osg::ref_ptr<osg::Geode> bar = makeBox(osg::Vec3d(0, 0, 0), osg::Vec3d(1000, 1, 1));
    const auto countTurned = [&](double angle, const osg::Vec3d& place, double eyeDistance) {
        CasterMotion motion;
        const osg::Vec3d eye = place + osg::Vec3d(0, 0, eyeDistance);
        Caster caster = casterOf(bar, place);
        motion.update({caster}, eye);
        caster.worldFromModel = osg::Matrixd::rotate(angle, 0, 0, 1) * caster.worldFromModel;
        return motion.update({caster}, eye).size();
    };
    EXPECT_EQ(1u, countTurned(1e-4, {}, 2000)) << "a tenth of a unit at 2000";
    EXPECT_EQ(0u, countTurned(1e-6, {}, 2000)) << "a thousandth of a unit there";
    EXPECT_EQ(1u, countTurned(1e-6, {}, 100)) << "before the eye";
    EXPECT_EQ(0u, countTurned(1e-12, {6.4e6, 0, 0}, 1)) << "a billionth of a unit on the globe";
    EXPECT_EQ(1u, countTurned(1e-7, {6.4e6, 0, 0}, 1)) << "a tenth of a millimetre there";
}

}  // namespace Motion_test
