// SPDX-License-Identifier: MIT
// inverse-cdf as a random variable of its seed, and what all samplers owe whoever calls them: the same bytes, any count.
#include <gtest/gtest.h>

#include <osgEnvLight/LightSampler>

#include <algorithm>
#include <array>
#include <cstring>
#include <iostream>
#include <thread>

#include "Maps.h"

namespace LightStatistics_test
{

using namespace testmaths;
using glsl::vec2;
using glsl::vec3;
using osgEnvLight::DirectionalLight;
using osgEnvLight::LightList;
using osgEnvLight::LightSampler;
using osgEnvLight::RadianceMap;
using osgEnvLight::SampleOptions;

namespace
{

// A coloured sky with a lamp and a dark part, so that no line of it is even.
osg::ref_ptr<const RadianceMap> makeSky(int width = 64)
{
    return radianceOf(makeMap(width, width / 2, [](const vec3& d) {
        const vec3 sky = vec3(0.4, 0.7, 1.2) * std::max(d.z, 0.0) + vec3(0.3, 0.2, 0.1) * std::max(-d.z - 0.3, 0.0);
        return sky + vec3(9.0, 6.0, 2.0) * std::exp(30.0 * (glsl::dot(d, vec3(0.6, 0.64, 0.48)) - 1.0));
    }));
}

LightList pointsOf(const RadianceMap& map, unsigned count, unsigned seed, double floor = 0.0)
{
    SampleOptions options;
    options.seed = seed;
    options.floor = floor;
    return LightSampler::create("inverse-cdf")->sample(map, count, options);
}

double brightness(const RadianceMap& map, int x, int y)
{
    const float* t = map.texel(x, y);
    return double(t[0]) + double(t[1]) + double(t[2]);
}

// In texels, from the top left.
vec2 position(const osg::Vec3d& d, const RadianceMap& map)
{
    const double u = 0.5 - std::atan2(d.y(), d.x()) / (2.0 * pi);
    return vec2((u - std::floor(u)) * map.width, std::acos(std::clamp(d.z(), -1.0, 1.0)) / pi * map.height);
}

// The sums of the density over rows, and over the columns of each: another way to what the sampler inverts.
class Density
{
  public:
    explicit Density(const RadianceMap& map) : _map(map), _rows(size_t(map.height) + 1, 0.0)
    {
        for (int y = 0; y < map.height; ++y) _rows[size_t(y) + 1] = _rows[size_t(y)] + rowSum(y, map.width) * solidAngle(y);
    }
    double total() const { return _rows.back(); }
    double flux(int x, int y) const { return brightness(_map, x, y) * solidAngle(y); }

    // The point of the unit square that a direction was made from.
    vec2 unwarp(const osg::Vec3d& d) const
    {
        const vec2 p = position(d, _map);
        const int x = std::min(int(p.x), _map.width - 1);
        const int y = std::min(int(p.y), _map.height - 1);
        const double z0 = std::cos(pi * y / _map.height);
        const double z1 = std::cos(pi * (y + 1) / _map.height);
        const double row = rowSum(y, _map.width) * solidAngle(y);
        return vec2((rowSum(y, x) + (p.x - x) * brightness(_map, x, y)) / rowSum(y, _map.width),
                    (_rows[size_t(y)] + row * (z0 - d.z()) / (z0 - z1)) / total());
    }

  private:
    double solidAngle(int y) const { return texelSolidAngle(y, _map.width, _map.height); }
    double rowSum(int y, int end) const
    {
        double sum = 0.0;
        for (int x = 0; x < end; ++x) sum += brightness(_map, x, y);
        return sum;
    }

    const RadianceMap& _map;
    std::vector<double> _rows;
};

// The largest difference between the area of a box from the origin and the share of the points in it.
double starDiscrepancy(std::vector<vec2> points)
{
    std::sort(points.begin(), points.end(), [](const vec2& a, const vec2& b) { return a.x < b.x; });
    const double n = double(points.size());
    std::vector<double> ys = {1.0};
    for (const vec2& p : points) ys.push_back(p.y);
    double worst = 0.0;
    for (double y : ys) {
        // Boxes that end just before each point, and just after.
        double inside = 0.0;
        double closed = 0.0;
        for (const vec2& p : points) {
            worst = std::max(worst, p.x * y - inside / n);
            inside += p.y < y;
            closed += p.y <= y;
            worst = std::max(worst, closed / n - p.x * y);
        }
        worst = std::max(worst, y - inside / n);
    }
    return worst;
}

bool sameBytes(const LightList& a, const LightList& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(DirectionalLight)) == 0;
}

}  // namespace

TEST(InverseCdf, PointsFollowTheDensity)
{
    // One point of a list for each seed: those are independent, points of one list are not. Cells of 8 x 8 texels.
    const auto map = makeSky();
    const Density density(*map);
    const unsigned seeds = 20000;
    for (double floor : {0.0, 0.5}) {
        std::vector<double> observed(32, 0.0);
        std::vector<double> expected(32, 0.0);
        const double uniform = 3.0 * floor * map->meanOfChannels();
        for (int y = 0; y < map->height; ++y)
            for (int x = 0; x < map->width; ++x)
                expected[size_t(y / 8 * 8 + x / 8)] +=
                    seeds * (density.flux(x, y) + uniform * texelSolidAngle(y, map->width, map->height)) /
                    (density.total() + 4.0 * pi * uniform);
        for (unsigned seed = 0; seed < seeds; ++seed) {
            const LightList list = pointsOf(*map, 7, seed, floor);
            const vec2 p = position(list[seed % 7].direction, *map);
            observed[size_t(std::min(int(p.y / 8.0), 3) * 8 + std::min(int(p.x / 8.0), 7))] += 1.0;
        }
        EXPECT_GT(chiSquaredTest(observed, expected), sidak(2)) << floor;
    }
}

TEST(InverseCdf, PointsAreEvenerThanRandomOnes)
{
    // Of the points before the warp, for a count of the golden ratio's and for another: random points have some .075, the
    // lattice .015 at most under ten shifts (1.2 ln(N)/N is .026).
    const auto map = makeSky();
    const Density density(*map);
    for (unsigned count : {233u, 256u}) {
        double random = 0.0;
        double lattice = 0.0;
        for (unsigned seed = 0; seed < 10; ++seed) {
            Random numbers(seed + 100);
            std::vector<vec2> square(count);
            for (vec2& p : square) p = numbers.square();
            random += starDiscrepancy(square) / 10.0;
            std::vector<vec2> points;
            for (const DirectionalLight& l : pointsOf(*map, count, seed)) points.push_back(density.unwarp(l.direction));
            lattice = std::max(lattice, starDiscrepancy(points));
        }
        std::cout << "star discrepancy of " << count << " points: lattice, at most " << lattice << "; random, mean " << random
                  << "\n";
        EXPECT_LT(lattice, 1.2 * std::log(double(count)) / count);
        EXPECT_LT(lattice, random / 3.0);
    }
}

TEST(InverseCdf, Unbiased)
{
    // The mean over seeds of each channel's flux, and of the irradiance about six normals, is the map's: 21 t-tests that
    // together fail once in a hundred (10000 seeds: Student's distribution is the normal one).
    const auto map = makeSky();
    const std::vector<vec3> normals = spiral(6);
    const std::vector<vec3> truth = irradiance(*map, normals);
    const int seeds = 10000;
    std::array<double, 21> expected{}, sum{}, squares{};
    for (size_t k = 0; k < 3; ++k) {
        expected[k] = map->flux[int(k)];
        for (size_t i = 0; i < 6; ++i) expected[3 + 3 * i + k] = truth[i][int(k)];
    }
    for (int seed = 0; seed < seeds; ++seed) {
        std::array<double, 21> x{};
        for (const DirectionalLight& l : pointsOf(*map, 8, unsigned(seed)))
            for (size_t k = 0; k < 3; ++k) {
                x[k] += l.flux[int(k)];
                for (size_t i = 0; i < 6; ++i) {
                    const vec3& n = normals[i];
                    x[3 + 3 * i + k] += l.flux[int(k)] * std::max(l.direction * osg::Vec3d(n.x, n.y, n.z), 0.0);
                }
            }
        for (size_t i = 0; i < x.size(); ++i) {
            sum[i] += x[i];
            squares[i] += x[i] * x[i];
        }
    }
    for (size_t i = 0; i < sum.size(); ++i) {
        const double mean = sum[i] / seeds;
        const double deviation = std::sqrt(std::max(squares[i] / seeds - mean * mean, 0.0) / (seeds - 1));
        const double t = std::abs(mean - expected[i]) / deviation;
        EXPECT_GT(std::erfc(t / std::sqrt(2.0)), sidak(21)) << i << ": " << mean << ", expected " << expected[i];
    }
}

TEST(InverseCdf, FluxIsColourOverDensity)
{
    const auto map = makeSky();
    const Density density(*map);
    const unsigned count = 5000;
    for (double floor : {0.0, 1.0}) {
        const double uniform = 3.0 * floor * map->meanOfChannels();
        for (const DirectionalLight& l : pointsOf(*map, count, 3, floor)) {
            const vec2 p = position(l.direction, *map);
            // On a border either texel is right.
            if (std::min(glsl::fract(p.x), glsl::fract(p.y)) < 1e-9 || std::max(glsl::fract(p.x), glsl::fract(p.y)) > 1.0 - 1e-9)
                continue;
            const float* t = map->texel(int(p.x), int(p.y));
            // Of the directions, over solid angle.
            const double pdf = (brightness(*map, int(p.x), int(p.y)) + uniform) / (density.total() + 4.0 * pi * uniform);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(l.flux[k], double(t[k]) / pdf / count, 1e-9 * double(t[k]) / pdf / count);
        }
    }
}

TEST(LightSampler, SameBytesFromFourThreadsAtOnce)
{
    // The map too is new to them: its harmonics are made at the first call.
    for (const char* sampler : LightSampler::names()) {
        const LightList expected = LightSampler::create(sampler)->sample(*makeSky(256), 200);
        const auto map = makeSky(256);
        const auto shared = LightSampler::create(sampler);
        std::array<std::array<LightList, 2>, 4> lists;
        std::vector<std::thread> threads;
        for (auto& own : lists)
            threads.emplace_back([&] {
                for (LightList& list : own) list = shared->sample(*map, 200);
            });
        for (std::thread& thread : threads) thread.join();
        for (const auto& own : lists)
            for (const LightList& list : own) EXPECT_TRUE(sameBytes(list, expected)) << sampler;
    }
}

TEST(LightSampler, AnyCountIsExact)
{
    // Of those that divide texels: counts up to 300 and far more than texels.
    const auto map = makeSky();
    auto expectCount = [&](const char* sampler, unsigned count, SampleOptions::Weights weights) {
        SampleOptions options;
        options.weights = weights;
        const LightList lights = LightSampler::create(sampler)->sample(*map, count, options);
        ASSERT_EQ(lights.size(), count) << sampler;
        double sum = 0.0;
        for (const DirectionalLight& l : lights) sum += l.flux * osg::Vec3d(1, 1, 1);
        const double flux = map->flux * osg::Vec3d(1, 1, 1);
        EXPECT_NEAR(sum, flux, 1e-6 * flux) << sampler << " " << count;
    };
    for (const char* sampler : {"auto", "split", "inverse-cdf"}) {
        for (unsigned count = 1; count <= 300; ++count) expectCount(sampler, count, SampleOptions::WEIGHTS_AUTO);
        expectCount(sampler, 65536, SampleOptions::WEIGHTS_AUTO);
    }
    // Without weights: their time at a million is Newton's.
    for (const char* sampler : {"split", "inverse-cdf"}) expectCount(sampler, 1000000, SampleOptions::WEIGHTS_OFF);
}

}  // namespace LightStatistics_test
