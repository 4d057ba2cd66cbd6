// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lights/PenroseSampler.h"
#include "lights/PenroseTiling.h"

#include <set>

#include "LightJudge.h"
#include "PenroseRelaxation.h"
#include "StudyMaps.h"

namespace PenroseSampler_test
{

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::choosePenrosePoints;
using osgEnvLight::correctedPosition;
using osgEnvLight::ImportanceGrid;
using osgEnvLight::LightList;
using osgEnvLight::LightSampler;
using osgEnvLight::LightTexels;
using osgEnvLight::PenrosePoint;
using osgEnvLight::PenroseRule;
using osgEnvLight::PenroseSampler;
using osgEnvLight::PenroseTable;
using osgEnvLight::penroseTable;

namespace
{

const PenroseTable none = {};

std::vector<PenrosePoint> flatPoints(size_t count)
{
    PenroseRule rule;
    rule.onePerCell = false;
    return choosePenrosePoints(ImportanceGrid(1, 1, {1.0}), count, rule);
}

// Mean distance to the nearest neighbour, in units of 1 / sqrt(density); 1.07 of a hexagonal lattice, .5 of random points.
double neighbourDistance(const std::vector<PenrosePoint>& points, const PenroseTable& table)
{
    std::vector<osg::Vec2d> p;
    for (const PenrosePoint& q : points) p.push_back(correctedPosition(q, table));
    double sum = 0.0;
    for (size_t i = 0; i < p.size(); ++i) {
        double least = 10.0;
        for (size_t j = 0; j < p.size(); ++j)
            if (j != i) least = std::min(least, (p[i] - p[j]).length2());
        sum += std::sqrt(least);
    }
    return sum / double(p.size()) * std::sqrt(double(p.size()) / 2.0);
}

}  // namespace

TEST(PenroseTiling, EveryNumberIsOneTile)
{
    // The numbers are unique, and those below any bound are spread evenly: as many in the domain as its area asks for,
    // within what the points of its border may add (its length 6 times half the density's root).
    const std::vector<PenrosePoint> points = flatPoints(20000);
    ASSERT_EQ(points.size(), 20000u);
    std::set<uint64_t> ranks;
    uint64_t last = 0;
    const double rate = double(points.back().rank) / double(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
        ranks.insert(points[i].rank);
        EXPECT_GT(points[i].rank, last);
        last = points[i].rank;
        EXPECT_NEAR(double(last) / rate, double(i + 1), 3.0 * std::sqrt(double(i + 1) / 2.0)) << i;
    }
    EXPECT_EQ(ranks.size(), points.size());
}

TEST(PenroseTiling, IndicesAndFrames)
{
    for (size_t count : {size_t(1), size_t(300), size_t(50000)})
        for (const PenrosePoint& p : flatPoints(count)) {
            EXPECT_LT(p.importanceIndex, 21u);
            EXPECT_LT(p.structuralIndex, 21u);
            EXPECT_GE(p.turn, 0);
            EXPECT_LT(p.turn, 20);
            // A tile's scale is its share of the area, but for the steps of phi between levels.
            EXPECT_GT(p.scale * p.scale * double(count), 0.2);
            EXPECT_LT(p.scale * p.scale * double(count), 20.0);
        }
}

TEST(PenroseTiling, MoreLightsKeepTheFormerVertices)
{
    const auto few = flatPoints(500);
    const auto many = flatPoints(800);
    for (size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].vertex, many[i].vertex);
}

TEST(PenroseTiling, MaximumIsNeverBelow)
{
    Random random(3);
    for (auto [w, h] : {std::pair(64, 32), std::pair(37, 21), std::pair(1, 5), std::pair(7, 1)}) {
        std::vector<double> values;
        for (int i = 0; i < w * h; ++i) values.push_back(std::exp(random.uniform(0.0, 20.0)));
        ImportanceGrid grid(w, h, values);
        for (int k = 0; k < 2000; ++k) {
            const double x0 = random.uniform(-0.5, 2.0), x1 = x0 + random.uniform(0.0, 0.7);
            const double y0 = random.uniform(-0.5, 1.0), y1 = y0 + random.uniform(0.0, 0.7);
            double greatest = 0.0;
            for (int j = 0; j < 9; ++j) {
                const double x = x0 + (x1 - x0) * random.uniform(), y = y0 + (y1 - y0) * random.uniform();
                if (x >= 0.0 && x < 2.0 && y >= 0.0 && y < 1.0) greatest = std::max(greatest, grid.importance(grid.cellAt(x, y)));
            }
            EXPECT_GE(grid.maximum(x0, y0, x1, y1), greatest);
        }
        grid.clear(0);
        EXPECT_EQ(grid.importance(0), 0.0);
    }
}

TEST(PenroseTiling, OneTexelAmongMany)
{
    // A lamp of one cell of 512 x 256 with all importance but 1e-9: any number of points finds it.
    std::vector<double> values(512 * 256, 1e-14);
    values[100 * 512 + 77] = 1.0;
    const ImportanceGrid grid(512, 256, values);
    PenroseRule rule;
    rule.onePerCell = false;
    for (size_t count : {size_t(1), size_t(64), size_t(4096)}) {
        const auto points = choosePenrosePoints(grid, count, rule);
        ASSERT_EQ(points.size(), count);
        for (const PenrosePoint& p : points) EXPECT_EQ(p.cell, 100u * 512u + 77u);
    }
    const auto once = choosePenrosePoints(grid, 100, PenroseRule());
    ASSERT_EQ(once.size(), 100u);
    EXPECT_EQ(once[0].cell, 100u * 512u + 77u);
}

TEST(PenroseTiling, OnePointInACellUntilAllAreFull)
{
    Random random(12);
    std::vector<double> values;
    for (int i = 0; i < 128 * 64; ++i) values.push_back(i % 5 ? std::exp(random.uniform(0.0, 20.0)) : 0.0);
    const size_t lit = values.size() - (values.size() + 4) / 5;
    const ImportanceGrid grid(128, 64, values);
    for (size_t count : {size_t(1), size_t(1000), lit - 1, lit, lit + 100}) {
        const auto points = choosePenrosePoints(grid, count, PenroseRule());
        EXPECT_EQ(points.size(), std::min(count, lit));
        std::set<size_t> cells;
        for (const PenrosePoint& p : points) {
            cells.insert(p.cell);
            EXPECT_EQ(p.cell, grid.cellAt(p.vertex.x(), p.vertex.y()));
            EXPECT_GT(values[p.cell], 0.0);
        }
        EXPECT_EQ(cells.size(), points.size());
    }
}

TEST(PenroseTable, BlueNoise)
{
    // sampling.md 2: .85 without the table, .93 with it; mean over the densities between two levels of subdivision, at
    // counts other than those the table was made with.
    double plain = 0.0;
    double corrected = 0.0;
    for (int k = 0; k < 8; ++k) {
        const auto points = flatPoints(size_t(1000.0 * std::pow(2.618, (k + 0.5) / 8.0)));
        plain += neighbourDistance(points, none) / 8.0;
        corrected += neighbourDistance(points, penroseTable) / 8.0;
    }
    EXPECT_NEAR(plain, 0.86, 0.02);
    EXPECT_GT(corrected, 0.93);
}

TEST(PenroseTable, IsWhatItsProgramMakes)
{
    // Every fifth row, as it takes a tenth of a second each. .0005 of three digits, and what another compiler's arithmetic adds.
    for (unsigned density = 0; density < 21; density += 5) {
        PenroseTable made = {};
        relaxPenroseRow(density, made);
        int rows = 0;
        for (size_t i = 0; i < 21; ++i) {
            if (made.shift[i][0][0] == 0.0f) continue;
            ++rows;
            for (size_t s = 0; s < 21; ++s)
                for (size_t k = 0; k < 2; ++k) EXPECT_NEAR(made.shift[i][s][k], penroseTable.shift[i][s][k], 0.005f);
        }
        EXPECT_EQ(rows, 1);
    }
    for (const auto& row : penroseTable.shift) EXPECT_NE(row[1][1], 0.0f);
}

TEST(PenroseSampler, AcceptanceOnRealMaps)
{
    // sampling.md 8: over the error of the golden lattice at 128, geometric mean: <= 1 with the flux of what is nearest,
    // <= 2.5 with equal shares. And what the class promises.
    const std::vector<StudyMap> maps = realMaps(512);
    if (maps.empty()) GTEST_SKIP() << "no real maps";
    double nearest = 0.0;
    double equal = 0.0;
    double lattice = 0.0;
    for (const StudyMap& m : maps) {
        const auto map = radianceOf(m.image);
        const LightJudge judge(*map, false);
        auto logError = [&](const LightList& l) { return std::log(judge.unoccludedError(l)) / double(maps.size()); };
        nearest += logError(LightSampler::create("penrose")->sample(*map, 128));
        lattice += logError(LightSampler::create("inverse-cdf")->sample(*map, 128));
        equal += logError(PenroseSampler::equalShares(LightTexels(*map, 512), 128, none));
    }
    EXPECT_LT(std::exp(nearest - lattice), 1.0);
    EXPECT_LT(std::exp(equal - lattice), 2.5);
    EXPECT_LT(std::exp(nearest), 0.0020);
}

TEST(PenroseSampler, EveryLightHasFlux)
{
    Random random(4);
    osg::ref_ptr<osg::Image> image = makeMap(128, 64, [&](const vec3&) { return vec3(std::exp(random.uniform(-10.0, 10.0))); });
    const auto map = radianceOf(image);
    for (unsigned count : {16u, 1024u, 8191u}) {
        const LightList lights = LightSampler::create("penrose")->sample(*map, count);
        ASSERT_EQ(lights.size(), count);
        for (const auto& l : lights) EXPECT_GT(l.flux[0], 0.0);
    }
}

TEST(PenroseSampler, EqualSharesAreEqual)
{
    const auto map = radianceOf(makeMap(128, 64, [](const vec3& d) { return vec3(1.0 + d.z) * vec3(1.0, 0.5, 0.2); }));
    const LightTexels texels(*map, 512);
    const LightList lights = PenroseSampler::equalShares(texels, 200, none);
    ASSERT_EQ(lights.size(), 200u);
    for (const auto& l : lights)
        EXPECT_NEAR(l.flux * osg::Vec3d(1, 1, 1), map->flux * osg::Vec3d(1, 1, 1) / 200.0, 1e-6 * map->flux[0]);
}

}  // namespace PenroseSampler_test
