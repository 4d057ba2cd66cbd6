// SPDX-License-Identifier: MIT
// Area lights that stand for meshes that glow.
#include "surface/MeshShapes.h"

#include <TracedShapes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace MeshShapes_test
{

using namespace osgEnvLight;

namespace
{

CasterMesh meshOf(const TracedScene& scene)
{
    CasterMesh mesh;
    for (const osg::Vec3f& p : scene.positions) mesh.positions.push_back(p);
    for (unsigned i = 0; i + 2 < mesh.positions.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
    return mesh;
}

// A fan about the first corner.
CasterMesh fan(const std::vector<osg::Vec3f>& corners)
{
    CasterMesh mesh;
    mesh.positions = corners;
    for (unsigned i = 2; i < corners.size(); ++i) mesh.triangles.push_back({0, i - 1, i});
    return mesh;
}

// A tube along z, without ends.
CasterMesh tube(float radius, float length, unsigned sides, unsigned rings)
{
    CasterMesh mesh;
    for (unsigned ring = 0; ring <= rings; ++ring)
        for (unsigned side = 0; side < sides; ++side) {
            const double angle = 2.0 * osg::PI * side / sides;
            mesh.positions.emplace_back(radius * float(std::cos(angle)), radius * float(std::sin(angle)),
                                        length * float(ring) / float(rings));
        }
    for (unsigned ring = 0; ring < rings; ++ring)
        for (unsigned side = 0; side < sides; ++side) {
            const unsigned a = ring * sides + side, b = ring * sides + (side + 1) % sides;
            mesh.triangles.push_back({a, b, b + sides});
            mesh.triangles.push_back({a, b + sides, a + sides});
        }
    return mesh;
}

double fluxOf(const std::vector<Emitter>& shapes)
{
    double sum = 0.0;
    for (const Emitter& e : shapes) sum += e.flux();
    return sum;
}

// What the lights show to a viewer far away in that direction.
double shownTo(const std::vector<Emitter>& shapes, const osg::Vec3d& direction)
{
    double sum = 0.0;
    for (const Emitter& e : shapes) sum += e.radiance[0] * e.area * std::max(e.normal * direction, 0.0);
    return sum;
}

}  // namespace

TEST(MeshShapes, AQuadIsARectangle)
{
    const std::vector<Emitter> shapes = shapesOf(fan({{1, 0, 2}, {4, 0, 2}, {4, 1, 2}, {1, 1, 2}}), true);
    ASSERT_EQ(shapes.size(), 1u);
    EXPECT_EQ(shapes[0].shape, AreaLight::RECTANGLE);
    EXPECT_NEAR((shapes[0].center - osg::Vec3d(2.5, 0.5, 2)).length(), 0.0, 1e-6);
    EXPECT_NEAR((shapes[0].normal - osg::Vec3d(0, 0, 1)).length(), 0.0, 1e-6);
    EXPECT_NEAR(shapes[0].area, 3.0, 1e-6);
    EXPECT_TRUE(shapes[0].twoSided);
    EXPECT_TRUE(shapes[0].drawn);
    EXPECT_FALSE(shapesOf(fan({{1, 0, 2}, {4, 0, 2}, {4, 1, 2}, {1, 1, 2}}), false)[0].twoSided);
}

// As modellers divide them, with corners on the edges.
TEST(MeshShapes, AQuadOfManyTrianglesIsOneRectangle)
{
    TracedScene grid;
    const unsigned surface = addSurface(grid, false);
    for (int x = 0; x < 5; ++x)
        for (int y = 0; y < 3; ++y)
            addQuad(grid, surface, osg::Vec3f(float(x), float(y), 0), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    const std::vector<Emitter> shapes = shapesOf(meshOf(grid), false);
    ASSERT_EQ(shapes.size(), 1u);
    EXPECT_EQ(shapes[0].shape, AreaLight::RECTANGLE);
    EXPECT_NEAR(shapes[0].area, 15.0, 1e-4);
}

TEST(MeshShapes, ARoundPlateIsADiscAndAnAngleAPolygon)
{
    std::vector<osg::Vec3f> circle;
    for (int i = 0; i < 32; ++i)
        circle.emplace_back(0.5f * float(std::cos(2 * osg::PI * i / 32)), 0.5f * float(std::sin(2 * osg::PI * i / 32)), 1.0f);
    const std::vector<Emitter> plate = shapesOf(fan(circle), false);
    ASSERT_EQ(plate.size(), 1u);
    EXPECT_EQ(plate[0].shape, AreaLight::DISC);
    EXPECT_NEAR(plate[0].area, 16 * 0.25 * std::sin(2 * osg::PI / 32), 1e-6);  // the plate's, not its circle's
    EXPECT_NEAR(plate[0].radius() * plate[0].radius() * osg::PI, plate[0].area, 1e-9);

    const std::vector<Emitter> angle = shapesOf(fan({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}), false);
    ASSERT_EQ(angle.size(), 1u);
    EXPECT_EQ(angle[0].shape, AreaLight::POLYGON);
    EXPECT_EQ(angle[0].vertices.size(), 6u);
    EXPECT_NEAR(angle[0].area, 3.0, 1e-6);
}

TEST(MeshShapes, ABallIsASphereThatSendsAsMuch)
{
    TracedScene ball;
    addSphere(ball, addSurface(ball, true), osg::Vec3f(3, 2, 1), 0.25f, 24);
    const std::vector<Emitter> shapes = shapesOf(meshOf(ball), true);
    ASSERT_EQ(shapes.size(), 1u);
    EXPECT_EQ(shapes[0].shape, AreaLight::SPHERE);
    EXPECT_NEAR((shapes[0].center - osg::Vec3d(3, 2, 1)).length(), 0.0, 1e-3);
    EXPECT_NEAR(shapes[0].radius(), 0.25, 1e-3);
    double area = 0.0;
    for (size_t i = 0; i + 2 < ball.positions.size(); i += 3)
        area += 0.5 * ((ball.positions[i + 1] - ball.positions[i]) ^ (ball.positions[i + 2] - ball.positions[i])).length();
    EXPECT_NEAR(fluxOf(shapes), osg::PI * area, 1e-3 * area);
    EXPECT_FALSE(shapes[0].twoSided);
}

// A closed body sends to its outside only, however it is drawn and whichever way its triangles turn.
TEST(MeshShapes, ABoxIsSixRectanglesThatFaceOutwards)
{
    TracedScene box;
    addBox(box, addSurface(box, true), osg::Vec3f(0, 0, 0), osg::Vec3f(1, 2, 3));
    CasterMesh mesh = meshOf(box);
    for (int turn = 0; turn < 2; ++turn) {
        const std::vector<Emitter> shapes = shapesOf(mesh, true);
        ASSERT_EQ(shapes.size(), 6u);
        for (const Emitter& e : shapes) {
            EXPECT_EQ(e.shape, AreaLight::RECTANGLE);
            EXPECT_FALSE(e.twoSided);
            EXPECT_GT((e.center - osg::Vec3d(0.5, 1, 1.5)) * e.normal, 0.4);
        }
        EXPECT_NEAR(fluxOf(shapes), osg::PI * 22.0, 1e-4);
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    }
}

// Seen from afar a tube is as bright from all sides about it, and darker the more one looks along it.
TEST(MeshShapes, ATubeIsStripsThatShowAsMuch)
{
    const double radius = 0.05, length = 1.2;
    const std::vector<Emitter> shapes = shapesOf(tube(float(radius), float(length), 32, 8), true);
    ASSERT_LE(shapes.size(), 16u);  // a straight one needs no more
    EXPECT_NEAR(fluxOf(shapes), osg::PI * 2.0 * osg::PI * radius * length, 0.01 * osg::PI * 2.0 * osg::PI * radius * length);
    double least = 1e9, most = 0.0;
    for (int i = 0; i < 64; ++i) {
        const double angle = 2.0 * osg::PI * i / 64;
        const double shown = shownTo(shapes, osg::Vec3d(std::cos(angle), std::sin(angle), 0));
        least = std::min(least, shown);
        most = std::max(most, shown);
    }
    EXPECT_NEAR(least, 2.0 * radius * length, 0.1 * 2.0 * radius * length);
    EXPECT_NEAR(most, 2.0 * radius * length, 0.1 * 2.0 * radius * length);
    for (const Emitter& e : shapes) EXPECT_NEAR(e.u.length(), 0.5 * length, 0.1 * length);
    for (const Emitter& e : shapes) {  // outside of the tube, or its own surface would hide it
        EXPECT_FALSE(e.twoSided);
        EXPECT_GE(osg::Vec2d(e.center.x(), e.center.y()).length(), radius * std::cos(osg::PI / 32) - 1e-6);
    }
}

TEST(MeshShapes, BodiesOfOneMeshAreLightsOfTheirOwn)
{
    TracedScene lamps;
    const unsigned surface = addSurface(lamps, true);
    for (int i = 0; i < 5; ++i) addSphere(lamps, surface, osg::Vec3f(float(i), 0, 0), 0.1f, 12);
    addQuad(lamps, surface, osg::Vec3f(0, 0, 3), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    const std::vector<Emitter> shapes = shapesOf(meshOf(lamps), false);
    ASSERT_EQ(shapes.size(), 6u);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(shapes[size_t(i)].shape, AreaLight::SPHERE) << i;
}

// A frame about a window: flat, but with a hole.
TEST(MeshShapes, AFlatRingIsPlatesOfItsArea)
{
    TracedScene ring;
    const unsigned surface = addSurface(ring, false);
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y)
            if (x % 3 == 0 || y % 3 == 0)
                addQuad(ring, surface, osg::Vec3f(float(x), float(y), 0), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    const std::vector<Emitter> shapes = shapesOf(meshOf(ring), false);
    ASSERT_GE(shapes.size(), 1u);
    double area = 0.0;
    for (const Emitter& e : shapes) {
        EXPECT_EQ(e.shape, AreaLight::RECTANGLE);
        EXPECT_GT((e.center - osg::Vec3d(2, 2, 0)).length(), 1.0);  // not in the hole
        area += e.area;
    }
    EXPECT_NEAR(area, 12.0, 1e-4);
}

TEST(MeshShapes, OfNothingThereAreNone)
{
    EXPECT_TRUE(shapesOf(CasterMesh(), true).empty());
    EXPECT_TRUE(shapesOf(fan({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), true).empty());
    EXPECT_TRUE(shapesOf(fan({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), true).empty());
    EXPECT_EQ(shapesOf(fan({{0, 0, 0}, {1e-6f, 0, 0}, {0, 1e-6f, 0}}), true).size(), 1u);
    EXPECT_EQ(shapesOf(fan({{0, 0, 0}, {1e6f, 0, 0}, {0, 1e6f, 0}}), true).size(), 1u);
}

}  // namespace MeshShapes_test
