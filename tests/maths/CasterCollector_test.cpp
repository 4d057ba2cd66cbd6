// SPDX-License-Identifier: MIT
#include "surface/CasterCollector.h"

#include <gtest/gtest.h>

#include <osg/AutoTransform>
#include <osg/BlendFunc>
#include <osg/Geode>
#include <osg/LOD>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PositionAttitudeTransform>
#include <osg/Switch>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <functional>

using osgEnvLight::Caster;
using osgEnvLight::CasterCollector;
using osgEnvLight::CasterList;
using osgEnvLight::ShownCasters;

namespace CasterCollector_test
{

osg::ref_ptr<osg::Geometry> triangle()
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::Vec3 corners[] = {osg::Vec3(0, 0, 0), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 0)};
    geometry->setVertexArray(new osg::Vec3Array(3, corners));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    return geometry;
}

osg::ref_ptr<osg::MatrixTransform> triangleAt(const osg::Matrixd& matrix)
{
    osg::ref_ptr<osg::MatrixTransform> at = new osg::MatrixTransform(matrix);
    at->addChild(triangle());
    return at;
}

/** Collects below a group as a view sees it. */
class Collection
{
  public:
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::Vec3d eye = osg::Vec3d(3, -7, 2);
    CasterList list;

    const CasterList& collect()
    {
        osg::ref_ptr<osgUtil::CullVisitor> cv = new osgUtil::CullVisitor;
        cv->setStateGraph(new osgUtil::StateGraph);
        cv->setRenderStage(new osgUtil::RenderStage);
        const osg::Matrixd view = osg::Matrixd::lookAt(eye, osg::Vec3d(0.3, 0.2, 0.1), osg::Vec3d(0, 0, 1));
        cv->pushViewport(new osg::Viewport(0, 0, 100, 100));
        cv->pushProjectionMatrix(new osg::RefMatrix(osg::Matrixd::perspective(40, 1, 1, 100)));
        cv->pushModelViewMatrix(new osg::RefMatrix(view), osg::Transform::ABSOLUTE_RF);
        CasterCollector collector(*cv, osg::Matrixd::inverse(view), _stateSets);
        collector.findSentLight(true);
        collector.collect(*root, list);
        return list;
    }

    /** Whether the list is another one now. */
    bool changes()
    {
        const unsigned former = list.version;
        return collect().version != former;
    }

  private:
    CasterCollector::StateSets _stateSets;
};

bool isNear(const osg::Matrixd& a, const osg::Matrixd& b, double slack)
{
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
            if (!(std::abs(a(i, k) - b(i, k)) <= slack)) return false;
    return true;
}

// To the bit: whoever keeps what it made of them does not look again.
TEST(CasterCollector, FromWhereverOneLooksTheListIsTheSame)
{
    Collection view;
    osg::ref_ptr<osg::MatrixTransform> outer = triangleAt(osg::Matrixd::rotate(0.7, osg::Vec3d(1, 2, 3)));
    osg::ref_ptr<osg::PositionAttitudeTransform> inner = new osg::PositionAttitudeTransform;
    inner->setPosition(osg::Vec3d(1e6, 0.1, -3));
    inner->addChild(triangleAt(osg::Matrixd::scale(2, 3, 4)));
    outer->addChild(inner);
    view.root->addChild(outer);
    view.collect();
    ASSERT_EQ(view.list.all.size(), 2u);
    const osg::Matrixd expected = osg::Matrixd::scale(2, 3, 4) * osg::Matrixd::translate(1e6, 0.1, -3) * outer->getMatrix();
    EXPECT_TRUE(isNear(view.list.all[1].worldFromModel, expected, 1e-9));
    for (int i = 1; i < 50; ++i) {
        view.eye = osg::Vec3d(3.0 + 0.37 * i, -7.0 - 1.9 * i * i, 2.0 + i);
        EXPECT_FALSE(view.changes()) << "frame " << i;
    }
}

TEST(CasterCollector, WhatFollowsTheViewIsWhereTheViewHasIt)
{
    Collection view;
    osg::ref_ptr<osg::MatrixTransform> held = triangleAt(osg::Matrixd::translate(0, 0, -5));
    held->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    held->addChild(triangleAt(osg::Matrixd::translate(1, 0, 0)));
    osg::ref_ptr<osg::AutoTransform> turned = new osg::AutoTransform;
    turned->setAutoRotateMode(osg::AutoTransform::ROTATE_TO_SCREEN);
    turned->setPosition(osg::Vec3d(2, 0, 0));
    turned->addChild(triangle());
    // Below a plain one, whose matrix for the eye is made only now.
    osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(0, 4, 0));
    moved->addChild(turned);
    for (osg::Node* node : {static_cast<osg::Node*>(held.get()), static_cast<osg::Node*>(moved.get())}) view.root->addChild(node);
    for (const osg::Vec3d& eye : {osg::Vec3d(3, -7, 2), osg::Vec3d(-5, 1, 4)}) {
        view.eye = eye;
        EXPECT_TRUE(view.changes());
        ASSERT_EQ(view.list.all.size(), 3u);
        const osg::Matrixd worldFromEye =
            osg::Matrixd::inverse(osg::Matrixd::lookAt(eye, osg::Vec3d(0.3, 0.2, 0.1), osg::Vec3d(0, 0, 1)));
        EXPECT_TRUE(isNear(view.list.all[0].worldFromModel, osg::Matrixd::translate(0, 0, -5) * worldFromEye, 1e-12));
        EXPECT_TRUE(isNear(view.list.all[1].worldFromModel, osg::Matrixd::translate(1, 0, -5) * worldFromEye, 1e-12));
        const osg::Matrixd& facing = view.list.all[2].worldFromModel;
        EXPECT_TRUE(isNear(osg::Matrixd::translate(facing.getTrans()), osg::Matrixd::translate(2, 4, 0), 1e-9));
        const osg::Vec3d z(facing(2, 0), facing(2, 1), facing(2, 2)),
            back(worldFromEye(2, 0), worldFromEye(2, 1), worldFromEye(2, 2));
        EXPECT_NEAR(z * back, 1.0, 1e-6);
    }
}

TEST(CasterCollector, LevelsOfDetailAreTheViews)
{
    Collection view;
    osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(triangle(), 0, 10);
    lod->addChild(triangle(), 10, 1000);
    osg::ref_ptr<osg::MatrixTransform> far = new osg::MatrixTransform(osg::Matrixd::translate(100, 0, 0));
    far->addChild(lod);
    view.root->addChild(far);
    for (const double distance : {5.0, 20.0}) {
        view.eye = osg::Vec3d(100, -distance, 0);
        view.collect();
        ASSERT_EQ(view.list.all.size(), 1u);
        EXPECT_EQ(view.list.all[0].geometry, lod->getChild(distance < 10 ? 0 : 1));
    }
}

TEST(CasterCollector, EachChangeIsSeenAtOnce)
{
    Collection view;
    osg::ref_ptr<osg::MatrixTransform> a = triangleAt(osg::Matrixd()), b = triangleAt(osg::Matrixd::translate(3, 0, 0));
    osg::ref_ptr<osg::Switch> chosen = new osg::Switch;
    chosen->addChild(triangle());
    for (osg::Node* node :
         {static_cast<osg::Node*>(a.get()), static_cast<osg::Node*>(b.get()), static_cast<osg::Node*>(chosen.get())})
        view.root->addChild(node);
    osg::ref_ptr<osg::Material> material = new osg::Material;
    a->getOrCreateStateSet()->setAttribute(material);
    osg::Geometry& geometry = *b->getChild(0)->asGeometry();
    osg::ref_ptr<osg::PrimitiveSet> triangles = geometry.getPrimitiveSet(0);

    const std::pair<const char*, std::function<void()>> changes[] = {
        {"a place", [&] { a->setMatrix(osg::Matrixd::translate(1e-9, 0, 0)); }},
        {"hidden", [&] { b->setNodeMask(0); }},
        {"shown", [&] { b->setNodeMask(~0u); }},
        {"vertices", [&] { geometry.getVertexArray()->dirty(); }},
        {"lines", [&] { geometry.setPrimitiveSet(0, new osg::DrawArrays(GL_LINES, 0, 2)); }},
        {"triangles", [&] { geometry.setPrimitiveSet(0, triangles); }},
        {"a bound", [&] { geometry.setInitialBound(osg::BoundingBox(0, 0, 0, 9, 9, 9)); }},
        {"a colour", [&] { material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 0, 0, 1)); }},
        {"opacity",
         [&] {
             material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 0, 0, 0.5f));
             a->getStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
         }},
        {"a switch", [&] { chosen->setValue(0, false); }},
        {"one more", [&] { view.root->insertChild(0, triangleAt(osg::Matrixd())); }},
        {"one less", [&] { view.root->removeChild(1); }},
        {"none", [&] { view.root->removeChildren(0, view.root->getNumChildren()); }},
    };
    view.collect();
    for (const auto& [name, change] : changes) {
        EXPECT_FALSE(view.changes()) << "before " << name;
        change();
        EXPECT_TRUE(view.changes()) << name;
    }
    EXPECT_TRUE(view.list.all.empty());
    EXPECT_FALSE(view.list.bound.valid());
}

TEST(CasterCollector, TheBoundIsOfAll)
{
    Collection view;
    view.root->addChild(triangleAt(osg::Matrixd::translate(5, 6, 7)));
    view.root->addChild(triangleAt(osg::Matrixd::rotate(osg::PI_2, osg::Vec3d(0, 0, 1)) * osg::Matrixd::scale(2, 2, 2)));
    view.collect();
    EXPECT_NEAR((view.list.bound._min - osg::Vec3d(-2, 0, 0)).length(), 0.0, 1e-12);
    EXPECT_NEAR((view.list.bound._max - osg::Vec3d(6, 7, 7)).length(), 0.0, 1e-12);
}

// A motion that was too slow to be seen is compared again, with finer maps also.
TEST(ShownCasters, TakeWhatTheyDoNotShow)
{
    Collection view;
    osg::ref_ptr<osg::MatrixTransform> body = triangleAt(osg::Matrixd());
    view.root->addChild(body);
    ShownCasters shown;
    EXPECT_TRUE(shown.take(view.collect(), 0.01));
    EXPECT_FALSE(shown.take(view.list, 0.01));
    body->setMatrix(osg::Matrixd::translate(0.006, 0, 0));
    EXPECT_FALSE(shown.take(view.collect(), 0.01));
    EXPECT_TRUE(shown.take(view.list, 0.001));
    EXPECT_FALSE(shown.take(view.list, 0.0));
    EXPECT_EQ(shown.all()[0].worldFromModel, body->getMatrix());
    view.list.clear();
    EXPECT_TRUE(shown.take(view.list, 0.01));
    EXPECT_TRUE(shown.take(view.collect(), 0.01));
}

void expectBox(const osgEnvLight::ChangedPart& part, const osg::Vec3d& low, const osg::Vec3d& high)
{
    EXPECT_FALSE(part.isWhole());
    EXPECT_NEAR((part.box()._min - low).length(), 0.0, 1e-9);
    EXPECT_NEAR((part.box()._max - high).length(), 0.0, 1e-9);
}

// Where a caster was and where it is; what only looks different casts the same shadow.
TEST(ShownCasters, KnowWhereShadowsHaveChanged)
{
    Collection view;
    osg::ref_ptr<osg::MatrixTransform> a = triangleAt(osg::Matrixd()), b = triangleAt(osg::Matrixd::translate(100, 0, 0));
    view.root->addChild(a);
    view.root->addChild(b);
    ShownCasters shown;
    shown.take(view.collect(), 0.0);
    a->setMatrix(osg::Matrixd::translate(10, 20, 30));
    osg::ref_ptr<osg::Material> red = new osg::Material;
    red->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 0, 0, 1));
    b->getOrCreateStateSet()->setAttribute(red);
    ASSERT_TRUE(shown.take(view.collect(), 0.0));
    expectBox(shown.changed(), osg::Vec3d(0, 0, 0), osg::Vec3d(11, 21, 30));
    view.root->addChild(triangleAt(osg::Matrixd::translate(-5, 0, 0)));
    ASSERT_TRUE(shown.take(view.collect(), 0.0));
    expectBox(shown.changed(), osg::Vec3d(-5, 0, 0), osg::Vec3d(-4, 1, 0));
    view.root->removeChild(2);
    ASSERT_TRUE(shown.take(view.collect(), 0.0));
    expectBox(shown.changed(), osg::Vec3d(-5, 0, 0), osg::Vec3d(-4, 1, 0));
    // The application need not say that the bound is another: from the second change on it is measured.
    osg::Geometry& geometry = *b->getChild(0)->asGeometry();
    auto& vertices = static_cast<osg::Vec3Array&>(*geometry.getVertexArray());
    vertices.dirty();
    ASSERT_TRUE(shown.take(view.collect(), 0.0));
    EXPECT_TRUE(shown.changed().isWhole());
    vertices[1] = osg::Vec3(7, 0, 0);
    vertices.dirty();
    ASSERT_TRUE(shown.take(view.collect(), 0.0));
    expectBox(shown.changed(), osg::Vec3d(100, 0, 0), osg::Vec3d(107, 1, 0));
    b->setMatrix(osg::Matrixd::translate(100, 0, 4));
    ASSERT_TRUE(shown.take(view.collect(), 0.0));
    expectBox(shown.changed(), osg::Vec3d(100, 0, 0), osg::Vec3d(107, 1, 4));
}

}  // namespace CasterCollector_test
