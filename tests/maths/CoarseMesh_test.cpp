// SPDX-License-Identifier: MIT
// Coarse triangles for shadow maps and rays.
#include "surface/CasterMesh.h"

#include <TracedShapes.h>

#include <gtest/gtest.h>

#include <cmath>

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

// A probe in a body whose inside is not known lights what is about the body by the dark in it.
TEST(CasterMesh, ABodyStaysClosedHoweverCoarse)
{
    for (const unsigned segments : {24u, 37u, 64u})
        for (double cell = 0.03; cell < 0.5; cell *= 1.17) {
            TracedScene bodies;
            const unsigned surface = addSurface(bodies, true);
            // Of which the small one merges with the large one's side.
            addSphere(bodies, surface, osg::Vec3f(0.1f, 0.2f, 0.3f), 1.0f, segments);
            addSphere(bodies, surface, osg::Vec3f(1.05f, 0.2f, 0.3f), 0.1f, segments);
            const std::string what = std::to_string(segments) + " segments, cells of " + std::to_string(cell);
            EXPECT_TRUE(isClosed(coarseMesh(casterOf(bodies), osg::Vec3d(), cell))) << what;
            bodies.positions.resize(bodies.positions.size() - 3);  // a corner each
            EXPECT_FALSE(isClosed(coarseMesh(casterOf(bodies), osg::Vec3d(), 1e-6))) << what;
        }
}

// Vertices at one place, computed in two ways, may differ in their last digit.
TEST(CasterMesh, ABodyIsClosedWhateverItsVerticesRoundTo)
{
    for (unsigned seed = 1; seed < 40; ++seed) {
        TracedScene ball;
        addSphere(ball, addSurface(ball, true), osg::Vec3f(0.3f, 0.1f, 0.7f), 1.0f + 0.01f * float(seed), 48);
        unsigned random = seed;
        for (osg::Vec3f& p : ball.positions)
            for (int k = 0; k < 3; ++k) {
                random = random * 1664525u + 1013904223u;
                p[k] = std::nextafter(p[k], random >> 31 ? 10.0f : -10.0f);
            }
        EXPECT_TRUE(isClosed(coarseMesh(casterOf(ball), osg::Vec3d(), 1e-6))) << seed;
    }
}

}  // namespace CasterMesh_test
