// SPDX-License-Identifier: MIT
// Coarse triangles for shadow maps and rays.
#include "surface/CasterMesh.h"

#include <TracedShapes.h>

#include <gtest/gtest.h>

namespace CasterMesh_test
{

using namespace osgEnvLight;

namespace
{

Caster casterOf(const TracedScene& scene)
{
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(new osg::Vec3Array(scene.positions.begin(), scene.positions.end()));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, int(scene.positions.size())));
    Caster caster;
    caster.geometry = geometry;
    return caster;
}

}  // namespace

// Shadow maps and probes tell a body's inside by the side that its triangles show.
TEST(CasterMesh, CoarseTrianglesFaceAsTheFineOnesDid)
{
    TracedScene ball;
    addSphere(ball, addSurface(ball, true), osg::Vec3f(), 1.0f, 64);
    const CasterMesh mesh = coarseMesh(casterOf(ball), osg::Vec3d(), 0.1);
    ASSERT_LT(mesh.triangles.size(), ball.triangles.size() / 4);
    ASSERT_GT(mesh.triangles.size(), 100u);
    for (const auto& t : mesh.triangles) {
        const osg::Vec3f a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        EXPECT_GT(((b - a) ^ (c - a)) * (a + b + c), 0.0f);
    }
    EXPECT_TRUE(tracedScene({{std::make_shared<CasterMesh>(mesh), {}}}).surfaces[0].closed);
}

}  // namespace CasterMesh_test
