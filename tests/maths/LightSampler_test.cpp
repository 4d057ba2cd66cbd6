// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <osgEnvLight/LightSampler>

#include <cstring>

#include "Maps.h"

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::DirectionalLight;
using osgEnvLight::LightList;
using osgEnvLight::RadianceMap;
using osgEnvLight::SplitSampler;

namespace
{

struct NamedMap {
    const char* name;
    int width;
    int height;
    Radiance radiance;
    double bound;  // of U at 128 lights
};

bool inWindow(const vec3& d)
{
    // Six windows on the horizon, 20 degrees wide and 30 high
    const double azimuth = std::atan2(d.y, d.x) * 180.0 / pi + 180.0;
    return std::abs(std::fmod(azimuth, 60.0) - 30.0) < 10.0 && std::abs(std::asin(d.z) * 180.0 / pi - 10.0) < 15.0;
}

// Bounds: .0025 for smooth maps, as `split` at 128 has .0015 as its mean over real ones. A constant map has nothing to
// sort by and gets .00256, the hard-edged windows .00317 (measured): a sixth above those.
const NamedMap maps[] = {
    {"constant", 256, 128, [](const vec3&) { return vec3(1.0, 0.5, 2.0); }, 0.0030},
    {"cos sky", 256, 128, [](const vec3& d) { return vec3(std::max(d.z, 0.0)); }, 0.0025},
    {"cos^4 sky", 256, 128, [](const vec3& d) { return vec3(std::pow(std::max(d.z, 0.0), 4.0)) * vec3(0.5, 0.7, 1.0); }, 0.0025},
    {"cos^16 sky", 256, 128, [](const vec3& d) { return vec3(std::pow(std::max(d.x, 0.0), 16.0)); }, 0.0025},
    {"overcast", 256, 128, [](const vec3& d) { return vec3(d.z > 0.0 ? (1.0 + 2.0 * d.z) / 3.0 : 0.1); }, 0.0025},
    {"checker", 256, 128,
     [](const vec3& d) {
         const int u = int(std::floor((std::atan2(d.y, d.x) / pi + 1.0) * 8.0));
         const int v = int(std::floor(std::acos(d.z) / pi * 8.0));
         return (u + v) % 2 ? vec3(4.0, 1.0, 0.2) : vec3(0.05);
     },
     0.0025},
    {"windows", 256, 128, [](const vec3& d) { return inWindow(d) ? vec3(20.0, 18.0, 15.0) : vec3(0.05); }, 0.0037}};

// sqrt(sum |E' - E|^2 / sum |E|^2) over 256 normals and RGB, no occluder (sampling.md 1).
double unoccludedError(const LightList& lights, const RadianceMap& map)
{
    const std::vector<vec3> normals = spiral(256);
    const std::vector<vec3> exact = irradiance(map, normals);
    double error = 0.0;
    double norm = 0.0;
    for (size_t i = 0; i < normals.size(); ++i) {
        vec3 e(0.0);
        for (const DirectionalLight& l : lights) {
            const double c = normals[i].x * l.direction[0] + normals[i].y * l.direction[1] + normals[i].z * l.direction[2];
            e += vec3(l.flux[0], l.flux[1], l.flux[2]) * std::max(c, 0.0);
        }
        error += glsl::dot(e - exact[i], e - exact[i]);
        norm += glsl::dot(exact[i], exact[i]);
    }
    return std::sqrt(error / norm);
}

LightList sample(const RadianceMap& map, unsigned count)
{
    return osg::ref_ptr<SplitSampler>(new SplitSampler)->sample(map, count);
}

void expectSound(const LightList& lights, const RadianceMap& map, unsigned count, const std::string& name)
{
    EXPECT_EQ(lights.size(), count) << name;
    osg::Vec3d sum;
    for (const DirectionalLight& l : lights) {
        EXPECT_NEAR(l.direction.length(), 1.0, 1e-12) << name << " " << count;
        for (int i = 0; i < 3; ++i) {
            EXPECT_TRUE(std::isfinite(l.flux[i])) << name << " " << count;
            EXPECT_GE(l.flux[i], 0.0) << name << " " << count;
        }
        sum += l.flux;
    }
    // The bound that sampling.md 8 sets; its prototype reached 4e-13.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[i], map.flux[i], 1e-6 * map.flux[i]) << name << " " << count;
}

osg::ref_ptr<const RadianceMap> oneTexel(int width, int height, int x, int y, vec3 colour = vec3(1000.0, 500.0, 250.0))
{
    osg::ref_ptr<osg::Image> image = makeMap(width, height, [](const vec3&) { return vec3(0.0); });
    for (int i = 0; i < 3; ++i) texelOf(*image, x, y)[i] = float(colour[i]);
    return radianceOf(image);
}

}  // namespace

TEST(LightSampler, ExactCountAndFlux)
{
    for (const NamedMap& m : maps) {
        const auto map = radianceOf(makeMap(m.width, m.height, m.radiance));
        for (unsigned count : {1u, 2u, 3u, 16u, 128u, 1009u}) expectSound(sample(*map, count), *map, count, m.name);
    }
}

TEST(LightSampler, TinyMaps)
{
    for (auto [w, h] : {std::pair(1, 1), std::pair(2, 1), std::pair(4, 2), std::pair(7, 1), std::pair(1, 5)}) {
        Random random(41);
        const auto map =
            radianceOf(makeMap(w, h, [&](const vec3&) { return vec3(random.uniform(), random.uniform(), random.uniform()); }));
        for (unsigned count : {1u, 2u, 3u, 16u, 128u, 1009u})
            expectSound(sample(*map, count), *map, count, std::to_string(w) + "x" + std::to_string(h));
    }
}

TEST(LightSampler, OneTexel)
{
    const int w = 128;
    const int h = 64;
    for (auto [x, y] :
         {std::pair(0, 0), std::pair(77, 0), std::pair(0, 63), std::pair(0, 32), std::pair(127, 32), std::pair(64, 20)}) {
        const auto map = oneTexel(w, h, x, y);
        const vec3 d = texelDirection(x, y, w, h);
        for (unsigned count : {1u, 2u, 3u, 16u, 128u, 1009u}) {
            const LightList lights = sample(*map, count);
            expectSound(lights, *map, count, std::to_string(x) + "," + std::to_string(y));
            // What is lit lies within the texel, or a cell of 2 x 2 texels at most: corner to corner 3 texels of pi/64
            for (const DirectionalLight& l : lights) {
                if (l.flux.length() < 1e-9 * map->flux.length()) continue;
                EXPECT_GT(d.x * l.direction[0] + d.y * l.direction[1] + d.z * l.direction[2], std::cos(3.0 * pi / h));
            }
        }
    }
}

TEST(LightSampler, OneTexelOfOneColour)
{
    for (int channel = 0; channel < 3; ++channel) {
        vec3 colour(0.0);
        colour[channel] = 42.0;
        const auto map = oneTexel(64, 32, 40, 9, colour);
        expectSound(sample(*map, 16), *map, 16, "channel " + std::to_string(channel));
    }
}

TEST(LightSampler, BlackMapHasNoLights)
{
    const auto map = radianceOf(makeMap(64, 32, [](const vec3&) { return vec3(0.0); }));
    EXPECT_TRUE(sample(*map, 128).empty());
    EXPECT_TRUE(sample(*radianceOf(makeMap(64, 32, maps[0].radiance)), 0).empty());
}

TEST(LightSampler, VectorIrradiance)
{
    for (const NamedMap& m : maps) {
        const auto map = radianceOf(makeMap(m.width, m.height, m.radiance));
        const double u = unoccludedError(sample(*map, 128), *map);
        EXPECT_LT(u, m.bound) << m.name;
    }
}

TEST(LightSampler, ErrorFallsWithTheCount)
{
    // sampling.md 2: slope -1.3 of U for `split`; -1.1 is what its section 8 asks. Over a factor 16 in N: 16^-1.1 = .047
    // of the geometric mean over the maps.
    double logFall = 0.0;
    for (const NamedMap& m : maps) {
        const auto map = radianceOf(makeMap(m.width, m.height, m.radiance));
        logFall +=
            std::log(unoccludedError(sample(*map, 1024), *map) / unoccludedError(sample(*map, 64), *map)) / std::size(maps);
    }
    EXPECT_LT(logFall / std::log(16.0), -1.1);
}

TEST(LightSampler, Rotations)
{
    // One map turned in steps of no texel: no lucky alignment. .0025 as above.
    for (int k = 0; k < 5; ++k) {
        const double a = 0.37 * k;
        const auto map = radianceOf(makeMap(256, 128, [a](const vec3& d) {
            const double x = std::cos(a) * d.x - std::sin(a) * d.z;
            return vec3(std::exp(4.0 * (x - 1.0)) + 0.05);
        }));
        EXPECT_LT(unoccludedError(sample(*map, 128), *map), 0.0025) << k;
    }
}

TEST(LightSampler, WeightsRepairTheMoments)
{
    // The list of region fluxes before the weights is not public: stretch the weights of a good list and let
    // matchHarmonics pull them back.
    const auto map = radianceOf(makeMap(256, 128, maps[4].radiance));
    LightList lights = sample(*map, 128);
    osg::Vec3d before;
    osg::Vec3d after;
    for (DirectionalLight& l : lights) {
        before += l.flux;
        l.flux *= 1.0 + 0.2 * l.direction[0];
        after += l.flux;
    }
    for (DirectionalLight& l : lights)
        for (int i = 0; i < 3; ++i) l.flux[i] *= before[i] / after[i];
    const double spoilt = unoccludedError(lights, *map);
    osgEnvLight::matchHarmonics(lights, *map);
    expectSound(lights, *map, 128, "repaired");
    // A 20 % tilt is an error of several %; regularisation leaves a trace of it.
    EXPECT_GT(spoilt, 0.02);
    EXPECT_LT(unoccludedError(lights, *map), 0.1 * spoilt);
}

TEST(LightSampler, SameBytesTwice)
{
    for (const NamedMap& m : maps) {
        const LightList a = sample(*radianceOf(makeMap(m.width, m.height, m.radiance)), 128);
        const LightList b = sample(*radianceOf(makeMap(m.width, m.height, m.radiance)), 128);
        ASSERT_EQ(a.size(), b.size());
        EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(DirectionalLight)), 0) << m.name;
    }
}

TEST(LightSampler, ScaleOfTheMapIsScaleOfTheFlux)
{
    const auto map = radianceOf(makeMap(128, 64, maps[4].radiance));
    const auto bright = radianceOf(makeMap(128, 64, [](const vec3& d) { return maps[4].radiance(d) * 1048576.0; }));
    const LightList a = sample(*map, 64);
    const LightList b = sample(*bright, 64);
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].direction, b[i].direction);
        EXPECT_NEAR(b[i].flux[1] / 1048576.0, a[i].flux[1], 1e-9 * a[i].flux[1]);
    }
}

TEST(LightSampler, WideRange)
{
    // A texel of 1e6 over a dim sky, as a photographed sun
    osg::ref_ptr<osg::Image> image = makeMap(256, 128, [](const vec3& d) { return vec3(0.2 + 0.1 * d.z); });
    std::fill_n(texelOf(*image, 100, 30), 3, 1e6f);
    const auto map = radianceOf(image);
    for (unsigned count : {1u, 16u, 128u}) expectSound(sample(*map, count), *map, count, "sun");
    EXPECT_LT(unoccludedError(sample(*map, 128), *map), 0.0025);
}
