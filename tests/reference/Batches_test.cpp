// SPDX-License-Identifier: MIT
// What the reference works out for many samples at once is what it works out for each.
#include <gtest/gtest.h>

#include <random>

#include "TestScenes.h"
#include "Traced.h"

namespace Batches_test
{

using namespace osgEnvLight;

namespace
{

glm::dvec3 randomDirection(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

std::vector<Ray> randomRays(std::mt19937& random, size_t count)
{
    std::vector<Ray> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 from = 20.0 * randomDirection(random);
        rays.push_back({from, glm::normalize(2.0 * randomDirection(random) - from)});
    }
    return rays;
}

}  // namespace

TEST(RayScene, ManyRaysMeetWhatEachOfThemMeets)
{
    std::mt19937 random(2);
    for (const TestScene& scene : testScenes()) {
        const Traced view = perspectiveView(*scene.node, scene.eye, scene.target, 1);
        const RayScene rays(view.triangles());
        for (const auto kind : {RayScene::CAMERA, RayScene::ANY})
            for (size_t count : {1u, 3u, 4u, 16u, 17u, 100u, 1000u}) {
                const std::vector<Ray> batch = randomRays(random, count);
                std::vector<std::uint64_t> seeds;
                for (size_t i = 0; i < count; ++i) seeds.push_back(random());
                std::vector<SurfaceHit> hits(count);
                rays.nearest(batch.data(), count, kind, seeds.data(), hits.data());
                for (size_t i = 0; i < count; ++i) {
                    SurfaceHit single;
                    EXPECT_EQ(rays.nearest(batch[i], kind, seeds[i], single), hits[i].mesh != nullptr) << scene.name;
                    if (!single.mesh || !hits[i].mesh) continue;
                    // On an edge either triangle may be the one.
                    EXPECT_NEAR(glm::length(single.position - hits[i].position), 0.0, 1e-5) << scene.name;
                    EXPECT_NEAR(single.distance, hits[i].distance, 1e-5) << scene.name;
                }
            }
    }
}

TEST(RayScene, ShadowRaysEndAtTheirDistance)
{
    std::mt19937 random(5);
    const TestScene scene = testScenes().front();
    const Traced view = perspectiveView(*scene.node, scene.eye, scene.target, 1);
    const RayScene rays(view.triangles());
    const std::vector<Ray> batch = randomRays(random, 1000);
    std::vector<RayEnd> ends(batch.size());
    std::vector<float> through(batch.size());
    std::uniform_real_distribution<double> distance(15.0, 25.0);
    for (RayEnd& end : ends) end.distance = distance(random);
    rays.transmittance(batch.data(), batch.size(), through.data(), ends.data());
    int stopped = 0;
    for (size_t i = 0; i < batch.size(); ++i) {
        SurfaceHit hit;
        const bool stops = rays.nearest(batch[i], RayScene::ANY, 0, hit) && hit.distance < ends[i].distance;
        float alone = 0.5f;
        rays.transmittance(&batch[i], 1, &alone, &ends[i]);
        EXPECT_EQ(stops ? 0.0f : 1.0f, through[i]);
        EXPECT_EQ(alone, through[i]);
        stopped += stops;
    }
    EXPECT_GT(stopped, 50);
    EXPECT_LT(stopped, 950);
}

TEST(RayScene, ManyRaysGetThroughAsEachOfThemDoes)
{
    std::mt19937 random(3);
    for (const TestScene& scene : testScenes()) {
        const Traced view = perspectiveView(*scene.node, scene.eye, scene.target, 1);
        const RayScene rays(view.triangles());
        for (size_t count : {1u, 2u, 16u, 17u, 1000u}) {
            const std::vector<Ray> batch = randomRays(random, count);
            std::vector<float> through(count, -1.0f);
            rays.transmittance(batch.data(), count, through.data());
            for (size_t i = 0; i < count; ++i) {
                float single = -1.0f;
                rays.transmittance(&batch[i], 1, &single);
                EXPECT_FLOAT_EQ(single, through[i]) << scene.name;
            }
        }
    }
}

TEST(Environment, ManyDirectionsBringWhatEachOfThemBrings)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit;
    const osg::ref_ptr<osg::Image> image =
        makeMap(38, 19, [](const osg::Vec3d& d) { return osg::Vec3d(1.0 + d.x(), 2.0, 1.5 + d.z()); });
    const osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap(image);
    std::string error;
    const osg::ref_ptr<const RadianceMap> radiance = map->radiance(error);
    ASSERT_TRUE(radiance) << error;
    const MapEnvironment sky(*radiance, 30.0, 2.0);
    for (size_t count : {0u, 1u, 16u, 50u}) {
        std::vector<glm::dvec3> directions;
        std::vector<glm::dvec2> squares;
        for (size_t i = 0; i < count; ++i) {
            directions.push_back(randomDirection(random));
            squares.emplace_back(unit(random), unit(random));
        }
        std::vector<Incident> from, sampled;
        sky.fromEach(directions, true, from);
        sky.sampleEach(squares, sampled);
        ASSERT_EQ(count, from.size());
        ASSERT_EQ(count, sampled.size());
        for (size_t i = 0; i < count; ++i) {
            const Incident in = sky.from(directions[i], true), s = sky.sample(squares[i]);
            EXPECT_EQ(in.radiance, from[i].radiance);
            EXPECT_EQ(in.density, from[i].density);
            EXPECT_EQ(s.direction, sampled[i].direction);
            EXPECT_EQ(s.radiance, sampled[i].radiance);
            // What is sampled is what is there.
            EXPECT_NEAR(sky.from(s.direction).radiance.r, s.radiance.r, 1e-5 * s.radiance.r);
        }
    }
}

TEST(Environment, SamplesComeWithTheirDensity)
{
    // A bright spot in one row, two rows that are nearly black, and a black map.
    const auto radiance = [](double spot, double sky) {
        return [=](const osg::Vec3d& d) {
            return osg::Vec3d(1, 1, 1) * (d * osg::Vec3d(0.6, 0, 0.8) > 0.97 ? spot : std::abs(d.z()) < 0.1 ? 1e-9 * sky : sky);
        };
    };
    for (const auto& [spot, sky] : {std::pair(1.0, 1.0), {1e6, 1.0}, {0.0, 0.0}}) {
        const osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap(makeMap(66, 33, radiance(spot, sky)));
        std::string error;
        const osg::ref_ptr<const RadianceMap> read = map->radiance(error);
        ASSERT_TRUE(read) << error;
        const MapEnvironment environment(*read, 20.0, 1.0);
        const int n = 400;
        double flux = 0.0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const Incident in = environment.sample({(i + 0.37) / n, (j + 0.37) / n});
                ASSERT_GT(in.density, 0.0);
                EXPECT_NEAR(glm::length(in.direction), 1.0, 1e-9);
                flux += in.radiance.r / in.density / (n * n);
                // None of these points is on the border of two texels.
                EXPECT_NEAR(environment.from(in.direction, true).density / in.density, 1.0, 1e-9)
                    << spot << ", " << i << ", " << j;
            }
        EXPECT_NEAR(flux, read->flux[0], 0.01 * read->flux[0]) << spot;
    }
}

}  // namespace Batches_test
