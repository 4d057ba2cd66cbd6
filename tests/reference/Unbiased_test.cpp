// SPDX-License-Identifier: MIT
// The mean over seeds is the mean of a long run, whatever the estimator, and what it says of its own error is true.
#include <gtest/gtest.h>

#include <numeric>

#include "Maths.h"
#include "TestScenes.h"
#include "Traced.h"

namespace Unbiased_test
{

using namespace testmaths;

namespace
{

// Two-sided normal quantile for the smallest p-value that passes.
double limitOf(int runs)
{
    double low = 0.0, high = 10.0;
    for (int i = 0; i < 60; ++i) {
        const double z = 0.5 * (low + high);
        (std::erfc(z / std::sqrt(2.0)) > sidak(runs) ? low : high) = z;
    }
    return low;
}

// Cornish and Fisher's expansion of Student's t: what a normal quantile becomes with so many degrees of freedom.
double student(double z, int degrees)
{
    const double n = degrees, z3 = z * z * z;
    return z + (z3 + z) / (4.0 * n) + (5.0 * z3 * z * z + 16.0 * z3 + 3.0 * z) / (96.0 * n * n);
}

osg::ref_ptr<const osgEnvLight::RadianceMap> builtin(const std::string& name)
{
    osg::ref_ptr<osgEnvLight::EnvironmentMap> map = new osgEnvLight::EnvironmentMap;
    std::string error;
    EXPECT_TRUE(map->load(name, nullptr, error)) << error;
    return map->radiance(error);
}

// A map with a window in the dark: structure that every estimator finds in a few samples.
osg::ref_ptr<const osgEnvLight::RadianceMap> windowMap()
{
    const osg::ref_ptr<osg::Image> image = makeMap(64, 32, [](const osg::Vec3d& d) {
        const double sky = 0.3 + 0.2 * d.z() + (d * osg::Vec3d(-0.6, -0.3, 0.74) > 0.8 ? 4.0 : 0.0);
        return osg::Vec3d(sky, 0.8 * sky, 0.6 * sky);
    });
    osg::ref_ptr<osgEnvLight::EnvironmentMap> map = new osgEnvLight::EnvironmentMap(image);
    std::string error;
    return map->radiance(error);
}

double slopeOf(const std::vector<double>& x, const std::vector<double>& y)
{
    const double n = double(x.size());
    const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n, my = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double above = 0.0, below = 0.0;
    for (size_t i = 0; i < x.size(); ++i) {
        above += (x[i] - mx) * (y[i] - my);
        below += (x[i] - mx) * (x[i] - mx);
    }
    return above / below;
}

struct Spread {
    double mean = 0.0;
    double variance = 0.0;  // of one
};

Spread spreadOf(const std::vector<double>& values)
{
    Spread s;
    for (double v : values) s.mean += v / double(values.size());
    for (double v : values) s.variance += (v - s.mean) * (v - s.mean) / double(values.size() - 1);
    return s;
}

// The picture's mean with each of the seeds.
std::vector<Estimate> bySeeds(const Traced& view, const Environment& sky, ReferenceOptions options, int seeds)
{
    std::vector<Estimate> estimates;
    for (int i = 0; i < seeds; ++i) {
        options.seed = unsigned(1000 + i);
        estimates.push_back(estimateOf(view.render(sky, options), Layer::BEAUTY));
    }
    return estimates;
}

std::vector<double> valuesOf(const std::vector<Estimate>& estimates)
{
    std::vector<double> values;
    for (const Estimate& e : estimates) values.push_back(e.value);
    return values;
}

Traced viewOf(const TestScene& scene, int pixels)
{
    return perspectiveView(*scene.node, scene.eye, scene.target, pixels);
}

// Means over the four quarters of the picture: value and standard error.
std::vector<Estimate> quarters(const ReferenceResult& result)
{
    const Picture mean = result.mean(Layer::BEAUTY);
    const Picture error = result.standardError(Layer::BEAUTY);
    std::vector<Estimate> q(4);
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x) {
            Estimate& e = q[size_t(2 * (2 * y / mean.height) + 2 * x / mean.width)];
            ++e.pixels;
            e.value += mean.color(x, y).x();
            e.error += error.color(x, y).x() * error.color(x, y).x();
        }
    for (Estimate& e : q) {
        e.value /= e.pixels;
        e.error = std::sqrt(e.error) / e.pixels;
    }
    return q;
}

}  // namespace

TEST(ReferenceUnbiased, MeanOverSeedsIsThatOfAHundredTimesTheSamples)
{
    const osg::ref_ptr<const osgEnvLight::RadianceMap> map = windowMap();
    const osgEnvLight::MapEnvironment sky(*map, 30.0, 1.0);
    const std::vector<TestScene> scenes = testScenes();
    const int seeds = 32, runs = 3 * 7;
    for (size_t s = 0; s < 7; ++s) {
        const Traced view = viewOf(scenes[s], 16);
        // Interiors are lit along paths; panes and fences are seen and shadowed by chance.
        const auto paths = scenes[s].name == "interior" ? ReferenceOptions::FULL : ReferenceOptions::DIRECT;
        ReferenceOptions longRun = makeOptions(ReferenceOptions::MIS, 80, 10, 7);
        longRun.paths = paths;
        const Estimate truth = estimateOf(view.render(sky, longRun), Layer::BEAUTY);
        ASSERT_GT(truth.value, 0.0) << scenes[s].name;
        for (const auto estimator : allEstimators) {
            ReferenceOptions options = makeOptions(estimator, 4, 2);
            options.paths = paths;
            const Spread spread = spreadOf(valuesOf(bySeeds(view, sky, options, seeds)));
            const double deviation = std::sqrt(spread.variance / seeds + truth.error * truth.error);
            EXPECT_LE(std::abs(spread.mean - truth.value), student(limitOf(runs), seeds - 1) * deviation + 1e-7 * truth.value)
                << scenes[s].name << ", " << nameOf(estimator) << ": " << spread.mean << " for " << truth.value;
            EXPECT_LT(deviation, 0.02 * truth.value) << scenes[s].name << ", " << nameOf(estimator);
        }
    }
}

TEST(ReferenceUnbiased, EstimatorsAgreeUnderTheBuiltinMaps)
{
    const std::vector<TestScene> scenes = testScenes();
    const int runs = int(scenes.size()) * 4 * 2;
    const double limit = limitOf(runs);
    const osg::ref_ptr<const osgEnvLight::RadianceMap> map = builtin("studio");
    const osgEnvLight::MapEnvironment studio(*map, 0.0, 1.0);
    for (const TestScene& scene : scenes) {
        const Traced view = viewOf(scene, 32);
        const std::vector<Estimate> mis = quarters(view.render(studio, makeOptions(ReferenceOptions::MIS, 16, 8)));
        for (const auto estimator : {ReferenceOptions::COSINE, ReferenceOptions::UNIFORM}) {
            // The mean of a quarter is one over 130 000 samples: normal, for a lobe or a lamp of any size here.
            const std::vector<Estimate> other = quarters(view.render(studio, makeOptions(estimator, 32, 16)));
            for (size_t q = 0; q < 4; ++q)
                EXPECT_LE(std::abs(mis[q].value - other[q].value),
                          limit * std::hypot(mis[q].error, other[q].error) + 1e-6 * mis[q].value)
                    << scene.name << ", " << nameOf(estimator) << ", quarter " << q << ": " << mis[q].value << " +- "
                    << mis[q].error << ", " << other[q].value << " +- " << other[q].error;
        }
    }
}

// Blind samples meet the built-in sky's sun too seldom for any test. Without it the radiance is the sky's; the sun alone is a
// disc. Both together must be what MIS makes of the whole.
TEST(ReferenceUnbiased, SunAndSkyApartAddUp)
{
    const osg::ref_ptr<const osgEnvLight::RadianceMap> map = builtin("sky");
    const osgEnvLight::SunSplit split = osgEnvLight::splitSuns(*map, 8);
    ASSERT_EQ(1u, split.suns.size());
    const osgEnvLight::MapEnvironment whole(*map, 0.0, 1.0), rest(*split.residual, 0.0, 1.0);
    const osgEnvLight::SunEnvironment sun(split.suns, 0.0, 1.0);
    for (const TestScene& scene : testScenes()) {
        if (scene.name == "mirror" || scene.name == "interior") continue;  // a mirror shows the sun's shape; no light comes in
        const Traced view = viewOf(scene, 16);
        ReferenceOptions options = makeOptions(ReferenceOptions::MIS, 128, 8);
        auto estimate = [&](const Environment& sky) { return estimateOf(view.render(sky, options), Layer::BEAUTY); };
        const Estimate all = estimate(whole), apart = estimate(rest), alone = estimate(sun);
        const double sum = apart.value + alone.value;
        // The map's sun is a few texels about the disc's place: shadows' edges move by less than a texel, 1/8 degree.
        EXPECT_NEAR(all.value, sum, 4.0 * (all.error + apart.error + alone.error) + 0.01 * sum) << scene.name;
        EXPECT_GT(alone.value, 0.3 * sum) << scene.name;
        const Estimate blind = estimateOf(view.render(rest, makeOptions(ReferenceOptions::COSINE, 64, 16)), Layer::BEAUTY);
        EXPECT_NEAR(blind.value, apart.value, limitOf(8) * std::hypot(blind.error, apart.error)) << scene.name;
    }
}

TEST(ReferenceUnbiased, StandardErrorsAreHonest)
{
    const osg::ref_ptr<const osgEnvLight::RadianceMap> map = windowMap();
    const osgEnvLight::MapEnvironment sky(*map, 0.0, 1.0);
    const std::vector<TestScene> scenes = testScenes();
    const int seeds = 64, runs = 3 * 5;
    for (size_t s : {0u, 1u, 3u, 4u, 5u}) {
        const Traced view = viewOf(scenes[s], 16);
        for (const auto estimator : allEstimators) {
            const std::vector<Estimate> estimates = bySeeds(view, sky, makeOptions(estimator, 4, 8), seeds);
            double reported = 0.0;
            for (const Estimate& e : estimates) reported += e.error * e.error / seeds;
            // The reported variance, a mean over seeds and pixels, is itself known to well under 1 %.
            const double ratio = (seeds - 1) * spreadOf(valuesOf(estimates)).variance / reported;
            const double tail = chiSquaredTail(ratio, seeds - 1);
            EXPECT_GT(std::min(tail, 1.0 - tail), 0.5 * sidak(runs))
                << scenes[s].name << ", " << nameOf(estimator) << ": " << ratio << " of " << seeds - 1;
        }
    }
}

TEST(ReferenceUnbiased, ErrorFallsAsTheRootOfTheSamplesOrFaster)
{
    const osg::ref_ptr<const osgEnvLight::RadianceMap> map = windowMap();
    const osgEnvLight::MapEnvironment sky(*map, 0.0, 1.0);
    const std::vector<TestScene> scenes = testScenes();
    const Traced view = viewOf(scenes[0], 16);
    const Picture truth = view.render(sky, makeOptions(ReferenceOptions::MIS, 4096, 2, 99)).mean(Layer::BEAUTY);
    for (const auto estimator : {ReferenceOptions::COSINE, ReferenceOptions::MIS}) {
        std::vector<double> x, y;
        for (unsigned n : {4u, 16u, 64u, 256u}) {
            double square = 0.0;
            for (unsigned seed = 0; seed < 8; ++seed) {
                const Picture p = view.render(sky, makeOptions(estimator, n, 1, 1000 * n + seed)).mean(Layer::BEAUTY);
                square += std::pow(rootMeanSquare(p, truth), 2.0);
            }
            x.push_back(std::log(n));
            y.push_back(0.5 * std::log(square / 8.0));
        }
        const double slope = slopeOf(x, y);
        RecordProperty(std::string("slope_") + nameOf(estimator), std::to_string(slope));
        // Over 8 seeds of 200 pixels the root mean square is known to 1 / sqrt(2 x 1600) = 2 %, and to three times that where
        // it comes from a few bright samples: the slope to .06 sqrt(2) / ln 64 = .02.
        if (estimator == ReferenceOptions::COSINE) {
            EXPECT_NEAR(slope, -0.5, 0.05);
        } else {
            EXPECT_LT(slope, -0.55);
        }
    }
}

}  // namespace Unbiased_test
