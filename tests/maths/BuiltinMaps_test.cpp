// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <osgEnvLight/BuiltinMaps>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "Maps.h"

namespace BuiltinMaps_test
{

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::builtinMapNames;
using osgEnvLight::createBuiltinMap;

namespace
{

constexpr int width = 1024, height = 512;
const double degree = pi / 180;
const vec3 sun(std::cos(45 * degree) * std::cos(-130 * degree), std::cos(45 * degree) * std::sin(-130 * degree),
               std::sin(45 * degree));

vec3 radianceAt(osg::Image& image, int x, int y)
{
    const float* t = texelOf(image, x, y);
    return vec3(t[0], t[1], t[2]);
}

double luminance(const vec3& c)
{
    return glm::dot(c, vec3(0.2126, 0.7152, 0.0722));
}

// Luminance integrals of the upper half, with the sun's texels told from the sky by a threshold between the two.
struct SkyParts {
    double skyMean = 0, skyIrradiance = 0, sunIrradiance = 0, sunFlux = 0;
    vec3 sunCentroid = vec3(0.0);
};

SkyParts measure(osg::Image& image)
{
    SkyParts parts;
    const double around = luminance(radianceAt(image, static_cast<int>(width * (0.5 + 130.0 / 360)) + 8, height / 4));
    for (int y = 0; y < height / 2; ++y)
        for (int x = 0; x < width; ++x) {
            const vec3 d = texelDirection(x, y, width, height);
            const double omega = texelSolidAngle(y, width, height);
            const double value = luminance(radianceAt(image, x, y));
            const double sky = std::acos(std::min(1.0, double(glm::dot(d, sun)))) < 1 * degree ? std::min(value, around) : value;
            parts.skyMean += sky * omega / (2 * pi);
            parts.skyIrradiance += sky * d.z * omega;
            parts.sunIrradiance += (value - sky) * d.z * omega;
            parts.sunFlux += (value - sky) * omega;
            parts.sunCentroid += d * ((value - sky) * omega);
        }
    parts.sunCentroid = glm::normalize(parts.sunCentroid);
    return parts;
}

}  // namespace

TEST(BuiltinMaps, NamesAreKnownAndOthersAreNull)
{
    EXPECT_EQ(builtinMapNames(), (std::vector<std::string>{"sky", "studio"}));
    for (const std::string& name : builtinMapNames()) EXPECT_TRUE(createBuiltinMap(name)) << name;
    for (const char* name : {"", "Sky", "sky.exr", "night"}) EXPECT_FALSE(createBuiltinMap(name)) << name;
}

TEST(BuiltinMaps, FormatFiniteNotNegativeNotBlack)
{
    for (const std::string& name : builtinMapNames()) {
        const auto image = createBuiltinMap(name);
        ASSERT_EQ(image->s(), width);
        ASSERT_EQ(image->t(), height);
        EXPECT_EQ(image->getPixelFormat(), GLenum(GL_RGB));
        EXPECT_EQ(image->getDataType(), GLenum(GL_FLOAT));
        const auto map = radianceOf(image);
        EXPECT_EQ(map->notFinite + map->negative, 0u) << name;
        EXPECT_GT(map->mean, 0.1) << name;
        EXPECT_LT(map->mean, 2.0) << name;
    }
}

TEST(BuiltinMaps, EachCallMakesTheSameNewImage)
{
    for (const std::string& name : builtinMapNames()) {
        const auto a = createBuiltinMap(name), b = createBuiltinMap(name);
        EXPECT_NE(a, b);
        EXPECT_EQ(std::memcmp(a->data(), b->data(), a->getTotalSizeInBytes()), 0) << name;
    }
}

TEST(BuiltinMaps, SkyHasTheBrightnessItIsMadeFor)
{
    const SkyParts parts = measure(*createBuiltinMap("sky"));
    EXPECT_NEAR(parts.skyMean, 0.5, 0.005);
    const double whitePlane = (parts.skyIrradiance + parts.sunIrradiance) / pi;
    EXPECT_GT(whitePlane, 1.8);
    EXPECT_LT(whitePlane, 3.0);
}

// Four times the sky's irradiance on a horizontal plane, under 45 degrees.
TEST(BuiltinMaps, SunFluxAgainstItsClosedForm)
{
    const SkyParts parts = measure(*createBuiltinMap("sky"));
    EXPECT_NEAR(parts.sunFlux / (4 * parts.skyIrradiance / std::sin(45 * degree)), 1.0, 0.01);
}

TEST(BuiltinMaps, SunIsInItsPlaceAndOfItsSize)
{
    const auto image = createBuiltinMap("sky");
    const SkyParts parts = measure(*image);
    EXPECT_LT(glm::length(glm::cross(parts.sunCentroid, sun)), 0.02 * degree);
    EXPECT_GT(glm::dot(parts.sunCentroid, sun), 0.0);
    const double disc = 2 * pi * (1 - std::cos(0.265 * degree));
    double brightest = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) brightest = std::max(brightest, double(luminance(radianceAt(*image, x, y))));
    EXPECT_LT(brightest, 1.02 * parts.sunFlux / disc + 10);
    EXPECT_GT(brightest, 0.5 * parts.sunFlux / disc);
}

TEST(BuiltinMaps, SkyIsAboveAndBlueAndTheGroundBelowIsLitByIt)
{
    const auto image = createBuiltinMap("sky");
    const vec3 zenith = radianceAt(*image, width / 4, 1), nadir = radianceAt(*image, width / 4, height - 2);
    EXPECT_GT(zenith.b, 1.5 * zenith.r);
    const SkyParts parts = measure(*image);
    EXPECT_NEAR(pi * luminance(nadir) / (parts.skyIrradiance + parts.sunIrradiance), 0.2, 0.02);
}

// No step across the seam that is larger than those beside it, and none at the horizon.
TEST(BuiltinMaps, NoSeamAndNoHorizonLine)
{
    for (const std::string& name : builtinMapNames()) {
        const auto image = createBuiltinMap(name);
        for (int y = 0; y < height; ++y) {
            const auto step = [&](int from, int to) {
                return double(glm::length(radianceAt(*image, from, y) - radianceAt(*image, to, y)));
            };
            const double beside = std::max(step(width - 2, width - 1), step(0, 1));
            EXPECT_LT(step(width - 1, 0), 1.5 * beside + 1e-3) << name << " row " << y;
        }
        for (int x = 0; x < width; x += 16) {
            const vec3 a = radianceAt(*image, x, height / 2 - 1), b = radianceAt(*image, x, height / 2);
            EXPECT_LT(glm::length(a - b), 0.1 * glm::length(a) + 1e-4) << name << " column " << x;
        }
    }
}

TEST(BuiltinMaps, StudioIsADarkRoomWithFiveSoftBoxes)
{
    const auto map = radianceOf(createBuiltinMap("studio"));
    double dark = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (map->texel(x, y)[1] < 0.2f) dark += texelSolidAngle(y, width, height) / (4 * pi);
    EXPECT_GT(dark, 0.7);
    EXPECT_LT(dark, 0.95);
    EXPECT_GT(map->maximum, 8.0);
    EXPECT_LT(map->maximum, 20.0);
}

}  // namespace BuiltinMaps_test
