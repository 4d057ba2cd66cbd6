// SPDX-License-Identifier: MIT
// The map filtered by lobes beforehand, beside integrals over the sphere.
#include <gtest/gtest.h>

#include "lights/MapTextures.h"

#include "Maps.h"
#include "Maths.h"

namespace PrefilteredMap_test
{

using namespace testmaths;
using glsl::vec2;
using glsl::vec3;
using osgEnvLight::MapTextures;

namespace
{

// A pixel of a level's square, one outside at most.
const float* texelAt(MapTextures& textures, unsigned level, int x, int y)
{
    const glsl::ivec2 p = glsl::ivec2(glsl::pyramidLevelCorner(textures.pyramidSide(), level)) + 1 + glsl::ivec2(x, y);
    return reinterpret_cast<const float*>(textures.prefiltered()->getImage()->data(unsigned(p.x), unsigned(p.y)));
}

// What a lobe seen from straight above its normal reflects of the map, over its albedo and the map's mean, in green: the sum over
// all texels.
double integral(const osgEnvLight::RadianceMap& map, const vec3& normal, double alpha)
{
    double sum = 0.0, whole = 0.0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const double c = glsl::dot(texelDirection(x, y, map.width, map.height), normal);
            if (c <= 0.0) continue;
            const vec3 local(std::sqrt(std::max(1.0 - c * c, 0.0)), 0.0, c);
            const double w = glsl::ggxBrdf(vec3(0, 0, 1), local, alpha) * c * texelSolidAngle(y, map.width, map.height);
            sum += w * double(map.texel(x, y)[1]);
            whole += w;
        }
    return sum / whole / map.mean;
}

// Root mean square over directions of all levels that the map's own texels resolve, in shares of the mean.
double errorUnder(const Radiance& radiance)
{
    const auto map = radianceOf(makeMap(256, 128, radiance));
    osgEnvLight::MapOptions options;
    options.suns = osgEnvLight::Settings::SUNS_OFF;
    const osg::ref_ptr<MapTextures> textures = new MapTextures(map.get(), options);
    Random random(7);
    double squares = 0.0;
    int count = 0;
    for (unsigned level = 1; level <= textures->pyramidLastLevel(); ++level) {
        const int side = int(textures->pyramidSide() >> level);
        for (int i = 0; i < 40; ++i, ++count) {
            const glsl::ivec2 p(random.uniform() * side, random.uniform() * side);
            const vec3 normal = glsl::directionFromOctahedral((vec2(p) + 0.5) / double(side));
            const double exact = integral(*map, normal, glsl::prefilteredAlpha(textures->pyramidSide(), level));
            const double error = double(texelAt(*textures, level, p.x, p.y)[1]) - exact;
            squares += error * error;
        }
    }
    return std::sqrt(squares / count);
}

}  // namespace

TEST(PrefilteredMap, AnEvenMapStaysEven)
{
    const auto map = radianceOf(makeMap(64, 32, [](const vec3&) { return vec3(3, 2, 1); }));
    const osg::ref_ptr<MapTextures> textures = new MapTextures(map.get());
    for (unsigned level = 0; level <= textures->pyramidLastLevel(); ++level) {
        const int side = int(textures->pyramidSide() >> level);
        for (int y = -1; y <= side; ++y)
            for (int x = -1; x <= side; ++x)
                for (int i = 0; i < 3; ++i)
                    EXPECT_NEAR(double(texelAt(*textures, level, x, y)[i]), (3 - i) / map->mean, 1e-5)
                        << level << " " << x << " " << y;
    }
}

// Directions of each lobe, each as wide as its share: measured, .32 % of the mean, and 1.6 % under a lamp with an edge.
TEST(PrefilteredMap, LevelsAreIntegralsOverTheirLobes)
{
    EXPECT_LT(errorUnder([](const vec3& d) { return vec3(1.0 + 0.8 * d.z + 0.5 * d.x * d.y); }), 0.005);
    EXPECT_LT(errorUnder([](const vec3& d) { return vec3(d.x > 0.9 ? 30.0 : d.z > 0.0 ? 1.0 : 0.2); }), 0.025);
}

// Of lobes as narrow as a texel of the map a share of the map itself is due.
TEST(PrefilteredMap, ALevelsAlphaIsItsOwn)
{
    for (const double side : {64.0, 512.0})
        for (double level = 0.0; level < 5.0; level += 0.5)
            EXPECT_NEAR(glsl::prefilteredLevel(side, glsl::prefilteredAlpha(side, level)), level, 1e-12);
    EXPECT_LT(glsl::prefilteredLevel(512.0, 0.001), 0.0);
    EXPECT_NEAR(glsl::prefilteredAlpha(512.0, osgEnvLight::pyramidLastLevel(512)), 1.0, 1e-12);
}

// The middle of a smooth lobe is the mirror direction, that of a rough one above it.
TEST(PrefilteredMap, RoughLobesLeanToTheNormal)
{
    const vec3 v = glsl::normalize(vec3(0.9, 0.1, 0.3));
    EXPECT_LT(glsl::length(glsl::dominantDirection(v, 0.0) - vec3(-v.x, -v.y, v.z)), 1e-12);
    double below = v.z;
    for (const double alpha : {0.1, 0.3, 0.6, 0.9}) {
        const double height = glsl::dominantDirection(v, alpha).z;
        EXPECT_GT(height, below);
        below = height;
    }
    EXPECT_NEAR(glsl::dominantDirection(v, 1.0).z, 1.0, 1e-12);
}

}  // namespace PrefilteredMap_test
