// SPDX-License-Identifier: MIT
#include "indirect/SurfaceCells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "TracedShapes.h"

namespace SurfaceCells_test
{

using osg::Vec3f;
using osgEnvLight::CasterBvh;
using osgEnvLight::NearestPoint;
using osgEnvLight::SurfaceCells;
using osgEnvLight::SurfacePart;
using osgEnvLight::SurfacePoint;
using osgEnvLight::TracedScene;

namespace
{

constexpr unsigned partsPerPoint = 16;

struct Made {
    explicit Made(const TracedScene& scene)
        : points(placeSurfacePoints(scene, 4096)),
          bvh(scene),
          parts(placeSurfaceParts(scene, points, NearestPoint(points, scene, bvh), partsPerPoint)),
          cells(scene, parts, partsPerPoint)
    {
    }
    std::vector<SurfacePoint> points;
    CasterBvh bvh;
    std::vector<SurfacePart> parts;
    SurfaceCells cells;
};

// The points of the eight cells about a place, as pass/scenecells.glsl takes them, by their weights.
template <class Visit>
void forPointsAt(const SurfaceCells& cells, const Vec3f& place, int facing, const Visit& visit)
{
    const Vec3f at = (place - cells.low) / cells.width - Vec3f(0.5f, 0.5f, 0.5f);
    for (int corner = 0; corner < 8; ++corner) {
        int cell[3];
        float weight = 1.0f;
        for (int k = 0; k < 3; ++k) {
            const float first = std::floor(at[k]);
            cell[k] = std::clamp(int(first) + (corner >> k & 1), 0, cells.count[size_t(k)] - 1);
            weight *= corner >> k & 1 ? at[k] - first : 1.0f - at[k] + first;
        }
        for (const SurfaceCells::Share& s : cells.shares[cells.entry(cell[0], cell[1], cell[2], facing)])
            if (s.weight > 0.0f && weight > 0.0f) visit(s, weight);
    }
}

}  // namespace

// On the floor and the ceiling of a room.
TEST(SurfaceCells, KnowEachPlaceOfASurfaceByPointsNearItThatFaceLikeIt)
{
    TracedScene scene;
    addBox(scene, addSurface(scene, true), Vec3f(-2, -2, 0), Vec3f(2, 2, 3), true);
    const Made made(scene);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> between(-1.9f, 1.9f);
    for (int i = 0; i < 500; ++i) {
        const Vec3f place(between(random), between(random), i % 2 ? 0.0f : 3.0f);
        double sure = 0.0;
        forPointsAt(made.cells, place, i % 2 ? 5 : 4, [&](const SurfaceCells::Share& s, float weight) {
            sure += double(weight * s.weight);
            EXPECT_FLOAT_EQ(i % 2 ? 1.0f : -1.0f, made.points[s.point].normal.z());
            EXPECT_LT((made.points[s.point].position - place).length(), 4.0f * made.cells.width);
        });
        EXPECT_GT(sure, 4.0) << place.x() << " " << place.y() << ": as pass/surfacecells.frag asks";
        forPointsAt(made.cells, place, i % 2 ? 4 : 5,
                    [&](const SurfaceCells::Share&, float) { ADD_FAILURE() << "nothing faces that way here"; });
    }
}

// A mean over cells goes on evenly: of light that changes evenly along a wall, it is that light, but for the width of a cell.
TEST(SurfaceCells, KeepLightThatChangesEvenly)
{
    TracedScene scene;
    addQuad(scene, addSurface(scene, false), Vec3f(-2, -2, 0), Vec3f(4, 0, 0), Vec3f(0, 4, 0));
    const Made made(scene);
    double worst = 0.0;
    for (float x = -1.5f; x <= 1.5f; x += 0.01f) {
        double sum = 0.0, all = 0.0;
        forPointsAt(made.cells, Vec3f(x, 0.3f, 0), 5, [&](const SurfaceCells::Share& s, float weight) {
            sum += double(weight * s.weight * made.points[s.point].position.x());
            all += double(weight * s.weight);
        });
        worst = std::max(worst, std::abs(sum / all - double(x)));
    }
    EXPECT_LT(worst, 0.35 * double(made.cells.width));
}

TEST(SurfaceCells, CountEachPartOnce)
{
    TracedScene scene;
    addSphere(scene, addSurface(scene, true), Vec3f(5, -3, 100), 0.01f, 12);
    const Made made(scene);
    double sum = 0.0;
    for (const SurfaceCells::Shares& shares : made.cells.shares)
        for (const SurfaceCells::Share& s : shares) sum += double(s.weight);
    EXPECT_LE(sum, double(made.parts.size()) * (1.0 + 1e-4));
    EXPECT_GE(sum, 0.9 * double(made.parts.size())) << "more points than a cell has room for are rare";
}

// Two specks far apart, a thread, a ground: the table stays a texture of any OpenGL.
TEST(SurfaceCells, AreFewWhateverTheSceneIs)
{
    for (int i = 0; i < 4; ++i) {
        TracedScene scene;
        const unsigned surface = addSurface(scene, i % 2 == 0);
        if (i == 0) addBox(scene, surface, Vec3f(0, 0, 0), Vec3f(1, 1, 1));
        if (i == 0) addBox(scene, surface, Vec3f(1e6f, 1e6f, 1e6f), Vec3f(1e6f + 1, 1e6f + 1, 1e6f + 1));
        if (i == 1) addQuad(scene, surface, Vec3f(), Vec3f(1e5f, 0, 0), Vec3f(0, 0, 1e-3f));
        if (i == 2) addBox(scene, surface, Vec3f(0, 0, 0), Vec3f(1e-3f, 1e-3f, 1e5f));
        if (i == 3) addQuad(scene, surface, Vec3f(), Vec3f(1e4f, 0, 0), Vec3f(0, 1e4f, 0));
        const Made made(scene);
        ASSERT_EQ(4096u, made.points.size()) << i;
        EXPECT_LE(made.cells.count[0], 128) << i;
        EXPECT_LE(made.cells.count[1] * made.cells.count[2], 128 * 64) << i;
        EXPECT_LE(made.cells.shares.size(), size_t(SurfaceCells::most) * 6) << i;
    }
}

}  // namespace SurfaceCells_test
