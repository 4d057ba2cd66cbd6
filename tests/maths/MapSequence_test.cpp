// SPDX-License-Identifier: MIT
// Lights drawn from a map without end.
#include "lights/MapSequence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Maps.h"

namespace MapSequence_test
{

using glsl::vec3;
using osgEnvLight::DirectionalLight;
using osgEnvLight::MapSequence;
using testmaths::makeMap;
using testmaths::radianceOf;

namespace
{

// Of the irradiance about n over its quadrature, from count lights.
double errorOf(const osgEnvLight::RadianceMap& map, const vec3& n, unsigned count)
{
    MapSequence sequence(map);
    double sum = 0.0;
    for (unsigned i = 0; i < count; i += 16)
        for (const DirectionalLight& light : sequence.next(16)) {
            const double c = light.direction * osg::Vec3d(n.x, n.y, n.z);
            if (c > 0.0) sum += light.flux[1] * c * 16.0 / count;
        }
    const double truth = testmaths::irradiance(map, {n})[0].y;
    return std::abs(sum / truth - 1.0);
}

}  // namespace

TEST(MapSequence, EveryPartOfAConstantMapIsDrawnAlike)
{
    const auto map = radianceOf(makeMap(32, 16, [](const vec3&) { return vec3(2.0); }));
    MapSequence sequence(*map);
    osg::Vec3d flux, mean;
    const int batches = 64;
    for (int i = 0; i < batches; ++i)
        for (const DirectionalLight& light : sequence.next(16)) {
            EXPECT_NEAR(1.0, light.direction.length(), 1e-12);
            flux += light.flux / batches;
            mean += light.direction / (16.0 * batches);
        }
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(8.0 * osg::PI, flux.ptr()[k], 1e-5);  // the map's texels are floats
        EXPECT_NEAR(0.0, mean.ptr()[k], 5e-3);            // R2: a few over the number of points
    }
}

// A lamp of a texel and a dim sky of another colour: no light misses the one, and the other still comes out.
TEST(MapSequence, ConvergesFasterThanChance)
{
    const auto map = radianceOf(makeMap(64, 32, [](const vec3& d) {
        return d.x > 0.97 ? vec3(300.0, 200.0, 100.0) : vec3(0.2, 0.3, 0.6) * (d.z > 0.0 ? 1.0 : 0.25);
    }));
    for (const vec3& n : {vec3(0.0, 0.0, 1.0), vec3(0.6, 0.0, 0.8), vec3(0.0, -1.0, 0.0)}) {
        // By chance the spread of a light's share over sqrt(N) is 6 % at 512 lights and .8 % at 32768.
        EXPECT_LT(errorOf(*map, n, 512), 0.06);
        EXPECT_LT(errorOf(*map, n, 32768), 0.004);
    }
}

TEST(MapSequence, BeginsAnew)
{
    const auto map = radianceOf(makeMap(64, 32, [](const vec3& d) { return vec3(2.0 + d.z, 1.0, 1.0); }));
    MapSequence sequence(*map);
    const osgEnvLight::LightList first = sequence.next(7);
    sequence.restart();
    const osgEnvLight::LightList again = sequence.next(7);
    for (size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(first[i].direction, again[i].direction);
        EXPECT_EQ(first[i].flux, again[i].flux);
    }
}

TEST(MapSequence, ABlackMapHasOnlyDarkLights)
{
    const auto map = radianceOf(makeMap(8, 4, [](const vec3&) { return vec3(0.0); }));
    for (const DirectionalLight& light : MapSequence(*map).next(16)) {
        EXPECT_EQ(osg::Vec3d(), light.flux);
        EXPECT_NEAR(1.0, light.direction.length(), 1e-12);
    }
}

}  // namespace MapSequence_test
