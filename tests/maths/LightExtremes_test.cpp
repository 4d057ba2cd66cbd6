// SPDX-License-Identifier: MIT
// The extremes of systems.md 4, A and B, as far as they concern maps and light lists; by their numbers there.
#include <gtest/gtest.h>

#include "lights/DiffuseCarrier.h"
#include "environment/DominantLight.h"
#include "lights/LightRegions.h"
#include "environment/SphericalHarmonics.h"

#include <algorithm>

#include "LightJudge.h"
#include "StudyMaps.h"

namespace LightExtremes_test
{

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::DirectionalLight;
using osgEnvLight::LightList;
using osgEnvLight::LightSampler;
using osgEnvLight::MomentTable;
using osgEnvLight::RadianceMap;
using osgEnvLight::SampleOptions;

namespace
{

LightList sample(const RadianceMap& map, const std::string& sampler, unsigned count = 128, double floor = 0.0)
{
    SampleOptions options;
    options.floor = floor;
    return LightSampler::create(sampler)->sample(map, count, options);
}

// What every list owes.
void expectSound(const LightList& lights, const RadianceMap& map, const std::string& name, double tolerance = 1e-6)
{
    ASSERT_FALSE(lights.empty()) << name;
    osg::Vec3d sum;
    for (const DirectionalLight& l : lights) {
        ASSERT_NEAR(l.direction.length(), 1.0, 1e-12) << name;
        for (int k = 0; k < 3; ++k) ASSERT_TRUE(std::isfinite(l.flux[k]) && l.flux[k] >= 0.0) << name;
        sum += l.flux;
    }
    const osg::Vec3d ones(1, 1, 1);
    EXPECT_NEAR((sum * ones) / (map.flux * ones), 1.0, tolerance) << name;
}

// Carriers and suns too.
void expectAllSound(const RadianceMap& map, const std::string& name)
{
    for (const char* sampler : LightSampler::names())
        for (double floor : {0.0, 1.0}) {
            // Points that follow something else than the flux have it on average: 128 of the lattice within some percent.
            const bool onAverage = floor > 0.0 && sampler == std::string("inverse-cdf");
            expectSound(sample(map, sampler, 128, floor), map, name + ", " + sampler, onAverage ? 0.03 : 1e-6);
        }
    const osgEnvLight::HarmonicsError error = osgEnvLight::predictHarmonicsError(map);
    EXPECT_TRUE(std::isfinite(error.nine) && std::isfinite(error.eighteen)) << name;
    EXPECT_TRUE(std::isfinite(osgEnvLight::measureLights(map, sample(map, "auto")))) << name;
    for (const osg::Vec3d& c : map.harmonics()) EXPECT_TRUE(std::isfinite(c.length())) << name;
    const osgEnvLight::SunSplit split = osgEnvLight::splitSuns(map, 16);
    osg::Vec3d sum = split.residual->flux;
    for (const auto& sun : split.suns) sum += sun.flux;
    EXPECT_NEAR(sum.length() / map.flux.length(), 1.0, 1e-6) << name;
}

osg::Vec3d irradianceOfHarmonics(const RadianceMap& map, const vec3& n)
{
    osg::Vec3d sum;
    for (int i = 0; i < 18; ++i)
        sum += map.harmonics()[size_t(i)] * (osgEnvLight::cosineBand(osgEnvLight::harmonicBand(i)) * glsl::shBasis18(i, n));
    return sum;
}

}  // namespace

TEST(LightExtremes, OneLitTexelOfALargeMap)  // 4
{
    const int w = 2048;
    const int h = 1024;
    osg::ref_ptr<osg::Image> image = makeMap(w, h, [](const vec3&) { return vec3(0.0); });
    std::fill_n(texelOf(*image, 1500, 300), 3, 1e6f);
    const auto map = radianceOf(image);
    const vec3 d = texelDirection(1500, 300, w, h);
    const osg::Vec3d direction(d.x, d.y, d.z);
    const double flux = 1e6 * texelSolidAngle(300, w, h);
    EXPECT_NEAR(map->flux[1], flux, 1e-5 * flux);
    for (const char* sampler : LightSampler::names()) {
        double sum = 0.0;
        for (const DirectionalLight& l : sample(*map, sampler)) {
            // Points lie anywhere in the texel; all others see where in a block of texels its flux is.
            EXPECT_LT((l.direction - direction).length(), sampler == std::string("inverse-cdf") ? 0.71 * pi / h : 1e-10)
                << sampler;
            sum += l.flux[1];
        }
        EXPECT_NEAR(sum, flux, 1e-5 * flux) << sampler;
    }
    const osgEnvLight::SunSplit split = osgEnvLight::splitSuns(*map, 16);
    ASSERT_EQ(split.suns.size(), 1u);
    EXPECT_NEAR(split.suns[0].flux[1], flux, 1e-5 * flux);
    EXPECT_LT((split.suns[0].direction - direction).length(), 1e-6);
}

TEST(LightExtremes, LitTexelAtThePole)  // 5
{
    for (int y : {0, 31}) {
        osg::ref_ptr<osg::Image> image = makeMap(64, 32, [](const vec3&) { return vec3(0.0); });
        std::fill_n(texelOf(*image, 17, y), 3, 1.0f);
        const auto map = radianceOf(image);
        // A 64th of the cap of pi / 32, not of the band at the equator.
        EXPECT_NEAR(map->flux[0], 2.0 * pi / 64.0 * (1.0 - std::cos(pi / 32.0)), 1e-12);
        expectAllSound(*map, "pole " + std::to_string(y));
    }
}

TEST(LightExtremes, LargestAndSmallestValues)  // 7, 8
{
    // Of half floats and near the end of single ones; subnormal radiance; all in one map.
    const Radiance shape = [](const vec3& d) { return vec3(1.5 + d.z, 1.0 + 0.5 * d.x, 1.0); };
    for (double scale : {65504.0, 1e30, 1e-30, 1e-40}) {
        const auto map = radianceOf(makeMap(64, 32, [&](const vec3& d) { return shape(d) * scale; }));
        EXPECT_GT(map->mean, 0.0);
        EXPECT_GE(map->maximum, 2.0 * scale);
        expectAllSound(*map, std::to_string(std::log10(scale)));
    }
    osg::ref_ptr<osg::Image> image = makeMap(64, 32, [&](const vec3& d) { return shape(d) * 1e-40; });
    std::fill_n(texelOf(*image, 5, 9), 3, 1e30f);
    std::fill_n(texelOf(*image, 50, 20), 3, 65504.0f);
    expectAllSound(*radianceOf(image), "1e-40 to 1e30");
}

TEST(LightExtremes, TurningByHalfATurnOverTheSeam)  // 11
{
    const vec3 normals[] = {vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -0.6, 0.8), glsl::normalize(vec3(-1, 1, -1))};
    for (const StudyMap& study : syntheticMaps(256)) {
        const auto map = radianceOf(study.image);
        const auto other = radianceOf(makeMap(256, 128, [&](const vec3& d) {
            const int x = int((0.5 - std::atan2(-d.y, -d.x) / (2.0 * pi)) * 256.0) % 256;
            const float* t = map->texel(x, int(std::acos(d.z) / pi * 128.0));
            return vec3(t[0], t[1], t[2]);
        }));
        for (const vec3& n : normals) {
            const osg::Vec3d e = irradianceOfHarmonics(*map, n);
            EXPECT_LT((irradianceOfHarmonics(*other, vec3(-n.x, -n.y, n.z)) - e).length(), 1e-6 * e.length()) << study.name;
        }
        // Lists begin to divide at the seam: other lights, no larger error.
        const double u = LightJudge(*map, false).unoccludedError(sample(*map, "auto"));
        EXPECT_NEAR(LightJudge(*other, false).unoccludedError(sample(*other, "auto")), u, 0.5 * u) << study.name;
    }
}

TEST(LightExtremes, AMillionFramesOfTurning)  // 13
{
    // The angle is what is kept, and each frame's matrix is made from it. A thousand turns by adding to it: off by no more
    // than the rounding of a million sums up to 3.6e5, 3e-11 each.
    osg::ref_ptr<osgEnvLight::EnvironmentMap> map = new osgEnvLight::EnvironmentMap;
    for (int frame = 0; frame < 1000000; ++frame) map->setRotation(map->getRotation() + 0.36);
    EXPECT_NEAR(map->getRotation(), 360000.0, 3e-5);
    const osg::Matrixd m = osg::Matrixd::rotate(osg::DegreesToRadians(-map->getRotation()), 0, 0, 1);
    osg::Matrixd transposed;
    transposed.transpose(m);
    const osg::Matrixd square = m * transposed;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(m(i, k), i == k ? 1.0 : 0.0, 1e-6);
            EXPECT_NEAR(square(i, k), i == k ? 1.0 : 0.0, 1e-15);
        }
}

TEST(LightExtremes, MedianCutOfAConstantMapIsEven)  // 16
{
    const auto map = radianceOf(makeMap(256, 128, [](const vec3&) { return vec3(1.0); }));
    const MomentTable table(*map, 256);
    osgEnvLight::RegionRule rule;
    rule.exponent = 0.0;
    rule.bestAxis = false;
    rule.wholeTexels = true;
    for (size_t count : {16u, 64u, 256u}) {
        const auto regions = osgEnvLight::divideRegions(table, {wholeRegion(table)}, count, rule);
        ASSERT_EQ(regions.size(), count);
        double covered = 0.0;
        for (const osgEnvLight::LightRegion& r : regions) {
            // A row, or column, of it more or less: the widest of its texel rows, or its share of one column.
            const double row = (r.u1 - r.u0) * texelSolidAngle(64, 256, 128);
            EXPECT_NEAR(r.light.flux, 4.0 * pi / double(count), std::max(row, r.light.flux / (r.u1 - r.u0))) << count;
            covered += r.light.flux;
        }
        EXPECT_NEAR(covered, 4.0 * pi, 1e-9);
    }
}

TEST(LightExtremes, RegionsWithoutFluxAreDropped)  // 17
{
    osg::ref_ptr<osg::Image> image = makeMap(256, 128, [](const vec3&) { return vec3(0.0); });
    std::fill_n(texelOf(*image, 40, 50), 3, 7.0f);
    std::fill_n(texelOf(*image, 41, 50), 3, 5.0f);
    const auto map = radianceOf(image);
    EXPECT_EQ(sample(*map, "median-cut", 16).size(), 2u);
    // With a floor nothing is without what decides: all lights stand, most of them dark.
    const LightList lights = sample(*map, "median-cut", 16, 1.0);
    EXPECT_EQ(lights.size(), 16u);
    expectSound(lights, *map, "floor");
}

TEST(LightExtremes, DarkLightsOfTheFloorStayInTheDark)
{
    // A lit half along each axis: a light without flux stands in the dark half, one with flux in the lit one. Differences of
    // sums once gave dark regions some 1e-17 of the flux, and the direction of rounding.
    for (const osg::Vec3d& axis : {osg::Vec3d(0, 0, 1), osg::Vec3d(0, 0, -1), osg::Vec3d(1, 0, 0), osg::Vec3d(0, -1, 0)}) {
        const auto map = radianceOf(
            makeMap(256, 128, [&](const vec3& d) { return vec3(osg::Vec3d(d.x, d.y, d.z) * axis > 0.0 ? 1.0 : 0.0); }));
        for (const char* sampler : {"auto", "split", "median-cut"})
            for (unsigned count : {16u, 128u, 256u, 1009u}) {
                const LightList lights = sample(*map, sampler, count, 1.0);
                ASSERT_EQ(lights.size(), count);
                unsigned dark = 0;
                for (const DirectionalLight& l : lights) {
                    const bool isDark = l.flux == osg::Vec3d();
                    EXPECT_EQ(isDark, l.direction * axis < 0.0) << sampler << " " << count << ": " << l.direction * axis;
                    dark += isDark;
                }
                // The floor is one mean: a third of the lit half's two means.
                EXPECT_NEAR(dark, 0.25 * count, 0.05 * count + 2.0) << sampler << " " << count;
            }
    }
}

}  // namespace LightExtremes_test
