// SPDX-License-Identifier: MIT
// Coarse triangles for shadow maps and rays.
#include "surface/CoarseMesh.h"

#include "indirect/CasterBvh.h"

#include <TracedShapes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "glsl.h"

namespace CoarseMesh_test
{

using namespace osgEnvLight;

namespace
{

Caster casterOf(const TracedScene& scene, osg::Vec3Array* normals = nullptr)
{
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(new osg::Vec3Array(scene.positions.begin(), scene.positions.end()));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, int(scene.positions.size())));
    if (normals) geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    Caster caster;
    caster.geometry = geometry;
    return caster;
}

struct Size {
    double area = 0.0;
    double volume = 0.0;
};

Size sizeOf(const CasterMesh& mesh)
{
    Size size;
    for (const auto& t : mesh.triangles) {
        const osg::Vec3d a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        size.area += ((b - a) ^ (c - a)).length() / 2.0;
        size.volume += a * (b ^ c) / 6.0;
    }
    return size;
}

}  // namespace

// Shadow maps and probes tell a body's inside by the side that its triangles show.
TEST(CoarseMesh, CoarseTrianglesFaceAsTheFineOnesDid)
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

// The mean of a cell's vertices lies below a round surface; the planes of the triangles meet on it. With cells of .4 radii the
// means leave .90 of the volume, the planes .97.
TEST(CoarseMesh, ABallKeepsItsSize)
{
    TracedScene ball;
    addSphere(ball, addSurface(ball, true), osg::Vec3f(0.1f, 0.2f, 0.3f), 1.0f, 128);
    const Size fine = sizeOf(meshOf(casterOf(ball), osg::Vec3d()));
    for (double cell = 0.05; cell < 0.42; cell *= 1.3) {
        const CasterMesh mesh = coarseMesh(casterOf(ball), osg::Vec3d(), cell);
        ASSERT_LT(mesh.triangles.size(), ball.triangles.size() / 2) << cell;
        EXPECT_NEAR(sizeOf(mesh).volume / fine.volume, 1.0, 0.03) << cell;
        EXPECT_NEAR(sizeOf(mesh).area / fine.area, 1.0, 0.03) << cell;
    }
}

// A body that is small beside a cell is merged in smaller cells. Else every map of the atlas would draw all of its triangles.
TEST(CoarseMesh, SmallBodiesAreCoarserToo)
{
    TracedScene ball;
    addSphere(ball, addSurface(ball, true), osg::Vec3f(5.0f, 2.0f, 3.0f), 0.1f, 128);
    for (double cell = 0.1; cell < 3.0; cell *= 1.3) {
        const CasterMesh mesh = coarseMesh(casterOf(ball), osg::Vec3d(), cell);
        EXPECT_LT(mesh.triangles.size(), ball.triangles.size() / 8) << cell;
    }
}

// Light in a thin vessel must not end within its wall.
TEST(CoarseMesh, ThinWallsKeepTheirThickness)
{
    TracedScene vessel;  // a ball, and another around it that faces the other way
    const unsigned surface = addSurface(vessel, true);
    addSphere(vessel, surface, osg::Vec3f(0.1f, 0.2f, 0.3f), 1.0f, 128);
    TracedScene inside;
    addSphere(inside, addSurface(inside, true), osg::Vec3f(0.1f, 0.2f, 0.3f), 0.98f, 128);
    for (const auto& t : inside.triangles)
        addTriangle(vessel, surface, inside.positions[t[0]], inside.positions[t[2]], inside.positions[t[1]]);
    const double wall = sizeOf(meshOf(casterOf(vessel), osg::Vec3d())).volume;
    for (double cell = 0.05; cell < 0.3; cell *= 1.3) {
        const CasterMesh mesh = coarseMesh(casterOf(vessel), osg::Vec3d(), cell);
        ASSERT_LT(mesh.triangles.size(), vessel.triangles.size() / 2) << cell;
        EXPECT_NEAR(sizeOf(mesh).volume / wall, 1.0, 0.1) << cell;
        const CasterBvh bvh(tracedScene({{std::make_shared<CasterMesh>(mesh), {}}}));
        for (int i = 0; i < 100; ++i) {
            const glsl::vec3 d = glsl::directionFromOctahedral(glsl::hammersley(unsigned(i), 100u));
            const osg::Vec3f to(float(d.x), float(d.y), float(d.z));
            const auto hit = bvh.nearest(osg::Vec3f(0.1f, 0.2f, 0.3f), to);
            ASSERT_TRUE(hit);
            EXPECT_FALSE(hit->back) << cell << ", ray " << i;
        }
    }
}

// Crossing planes are exact about their edge, wherever it lies in a cell.
TEST(CoarseMesh, ABoxKeepsItsCorners)
{
    TracedScene box;
    const unsigned surface = addSurface(box, true);
    const int steps = 40;
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < steps * steps; ++i) {
            const auto at = [&](int du, int dv) {
                const float u = float(i % steps + du) / steps, v = float(i / steps + dv) / steps;
                osg::Vec3f p;
                const int axis = face % 3;
                p[axis] = face < 3 ? 1.0f : 0.0f;
                p[(axis + 1) % 3] = face < 3 ? u : v;
                p[(axis + 2) % 3] = face < 3 ? v : u;
                return p;
            };
            for (const auto& corners : {std::array<osg::Vec3f, 3>{at(0, 0), at(1, 0), at(1, 1)}, {at(0, 0), at(1, 1), at(0, 1)}})
                addTriangle(box, surface, corners[0], corners[1], corners[2]);
        }
    for (double cell : {0.07, 0.1, 0.13, 0.3}) {
        const CasterMesh mesh = coarseMesh(casterOf(box), osg::Vec3d(), cell);
        ASSERT_LT(mesh.triangles.size(), box.triangles.size() / 2) << cell;
        EXPECT_NEAR(sizeOf(mesh).volume, 1.0, 1e-3) << cell;
        EXPECT_NEAR(sizeOf(mesh).area, 6.0, 1e-2) << cell;
    }
}

// A probe in a body whose inside is not known lights what is about the body by the dark in it.
TEST(CoarseMesh, ABodyStaysClosedHoweverCoarse)
{
    for (const int segments : {24, 37, 64})
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
TEST(CoarseMesh, ABodyIsClosedWhateverItsVerticesRoundTo)
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
        EXPECT_TRUE(isClosed(meshOf(casterOf(ball), osg::Vec3d()))) << seed;
    }
}

// Mirrors show by their corners' normals what they reflect: a ball of triangles is round. Those of an ellipsoid are not the
// directions of its corners.
TEST(CoarseMesh, CornersKeepTheirNormals)
{
    TracedScene ball;
    addSphere(ball, addSurface(ball, true), osg::Vec3f(), 1.0f, 64);
    Caster caster = casterOf(ball, new osg::Vec3Array(ball.positions.begin(), ball.positions.end()));
    caster.worldFromModel = osg::Matrixd::scale(1, 1, 2) * osg::Matrixd::translate(7, 0, 0);
    const osg::Vec3d origin(7, 0, 0);
    for (const double cell : {1e-6, 0.1}) {  // as it is, and coarse: corners of one cell are up to .17 apart
        const CasterMesh mesh = coarseMesh(caster, origin, cell);
        ASSERT_EQ(mesh.triangles.size(), mesh.normals.size());
        const double most = cell < 0.01 ? 0.001 : 0.17;
        for (size_t i = 0; i < mesh.triangles.size(); ++i)
            for (size_t k = 0; k < 3; ++k) {
                const osg::Vec3f& p = mesh.positions[mesh.triangles[i][k]];
                osg::Vec3d exact(p.x(), p.y(), p.z() / 4);
                exact.normalize();
                const glsl::vec3 n = glsl::unpackDirection(double(mesh.normals[i][k]));
                EXPECT_LT((osg::Vec3d(n.x, n.y, n.z) - exact).length(), most) << cell;
            }
    }
}

TEST(CoarseMesh, FlatTrianglesHaveNoNormals)
{
    TracedScene box;
    addBox(box, addSurface(box, true), osg::Vec3f(-1, -1, -1), osg::Vec3f(1, 1, 1), false);
    EXPECT_TRUE(meshOf(casterOf(box), osg::Vec3d()).normals.empty());
    EXPECT_TRUE(meshOf(casterOf(box, new osg::Vec3Array(2)), osg::Vec3d()).normals.empty()) << "fewer normals than vertices";
    const osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    for (size_t i = 0; i < box.positions.size(); ++i) normals->push_back(box.normal(i / 3));
    normals->back() = osg::Vec3(0, 0, std::numeric_limits<float>::quiet_NaN());
    for (const CasterMesh::Normals& n : meshOf(casterOf(box, normals), osg::Vec3d()).normals) EXPECT_EQ(CasterMesh::flat, n);
}

}  // namespace CoarseMesh_test
