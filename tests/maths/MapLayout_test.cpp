// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <limits>
#include <osgEnvLight/LightSampler>
#include "Layouts.h"

namespace MapLayout_test
{

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::DirectionalLight;
using osgEnvLight::EnvironmentMap;
using osgEnvLight::MapLayout;
using osgEnvLight::RadianceMap;

namespace
{

const float notANumber = std::numeric_limits<float>::quiet_NaN();

const std::vector<vec3> axes = {{1.0, 0.0, 0.0},  {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0},
                                {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0},  {0.0, 0.0, -1.0}};

// Another colour about each axis.
vec3 sixColours(const vec3& d)
{
    static const vec3 colours[6] = {{4.0, 0.1, 0.2}, {0.3, 2.0, 0.1}, {0.2, 0.4, 3.0},
                                    {2.0, 1.5, 0.1}, {0.5, 1.0, 5.0}, {0.6, 0.2, 0.7}};
    vec3 sum(0.02);
    for (size_t i = 0; i < 6; ++i) sum += colours[i] * std::pow(std::max(glsl::dot(d, axes[i]), 0.0), 4.0);
    return sum;
}

std::vector<LaidOut> allLayouts(int side)
{
    std::vector<LaidOut> all = cubeLayouts(side);
    for (const LaidOut& l : squareLayouts(2 * side)) all.push_back(l);
    return all;
}

osg::ref_ptr<EnvironmentMap> environmentOf(const LaidOut& l, const osg::ref_ptr<osg::Image>& image)
{
    osg::ref_ptr<EnvironmentMap> environment = new EnvironmentMap(image.get());
    environment->setLayout(l.layout);
    return environment;
}

osg::ref_ptr<const RadianceMap> radianceOf(const LaidOut& l, const osg::ref_ptr<osg::Image>& image)
{
    std::string error;
    osg::ref_ptr<const RadianceMap> map = environmentOf(l, image)->radiance(error);
    if (!map) throw std::runtime_error(error);
    return map;
}

std::vector<vec3> irradianceOf(const osgEnvLight::LightList& lights)
{
    std::vector<vec3> result(axes.size(), vec3(0.0));
    for (const DirectionalLight& l : lights)
        for (size_t i = 0; i < axes.size(); ++i) {
            const double c = glsl::dot(vec3(l.direction[0], l.direction[1], l.direction[2]), axes[i]);
            result[i] += vec3(l.flux[0], l.flux[1], l.flux[2]) * std::max(c, 0.0);
        }
    return result;
}

void expectNear(const std::vector<vec3>& found, const std::vector<vec3>& expected, double relative)
{
    for (size_t i = 0; i < expected.size(); ++i)
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[i][k] / expected[i][k], 1.0, relative) << "axis " << i << ", channel " << k;
}

// The direction of the map's flux.
vec3 centroid(const RadianceMap& map)
{
    vec3 sum(0.0);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            sum += double(map.texel(x, y)[0]) * texelSolidAngle(y, map.width, map.height) *
                   texelDirection(x, y, map.width, map.height);
    return glsl::normalize(sum);
}

// The texel whose direction is nearest to d.
struct Nearest {
    int x = 0;
    int y = 0;
    int slice = 0;
    vec3 direction = vec3(0.0);
};

Nearest nearestTexel(const LaidOut& l, const vec3& d)
{
    Nearest best;
    for (int slice = 0; slice < l.slices; ++slice)
        for (int y = 0; y < l.height; ++y)
            for (int x = 0; x < l.width; ++x) {
                vec3 e;
                if (texelDirection(l, x, y, slice, e) && glsl::dot(d, e) > glsl::dot(d, best.direction))
                    best = Nearest{x, y, slice, e};
            }
    return best;
}

std::string errorOf(int width, int height, int slices, MapLayout layout)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, slices, GL_RGB, GL_FLOAT);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(0));
    image->setFileName("some.exr");
    osg::ref_ptr<EnvironmentMap> environment = new EnvironmentMap(image.get());
    environment->setLayout(layout);
    std::string error;
    const bool made = environment->radiance(error).valid();
    EXPECT_EQ(made, error.empty());
    return error;
}

void expectError(const std::string& error, const std::vector<std::string>& words)
{
    for (const std::string& w : words) EXPECT_NE(error.find(w), std::string::npos) << "'" << w << "' in: " << error;
}

}  // namespace

TEST(MapLayout, NamesAndBack)
{
    for (size_t i = 0; i < osgEnvLight::mapLayoutNames().size(); ++i) {
        MapLayout layout = MapLayout::LATLONG;
        EXPECT_TRUE(osgEnvLight::mapLayoutFromName(osgEnvLight::mapLayoutNames()[i], layout));
        EXPECT_EQ(size_t(layout), i);
    }
    MapLayout layout = MapLayout::STRIP;
    EXPECT_FALSE(osgEnvLight::mapLayoutFromName("cylinder", layout));
    EXPECT_EQ(layout, MapLayout::STRIP);
    EXPECT_EQ(osgEnvLight::mapLayoutNames()[size_t(MapLayout::OCTAHEDRAL)], "octahedral");
}

TEST(MapLayout, SixDirectionsLightAlikeInEveryLayout)
{
    const auto latlong = testmaths::radianceOf(makeMap(256, 128, sixColours));
    const std::vector<vec3> expected = irradiance(*latlong, axes);
    const auto sampler = osgEnvLight::LightSampler::create("split");
    const std::vector<vec3> byLights = irradianceOf(sampler->sample(*latlong, 64));
    for (const LaidOut& l : allLayouts(64)) {
        SCOPED_TRACE(l);
        const auto map = radianceOf(l, makeImage(l, sixColours));
        EXPECT_EQ(map->width, 256);
        EXPECT_EQ(map->height, 128);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(map->flux[k] / latlong->flux[k], 1.0, 0.01);
        expectNear(irradiance(*map, axes), expected, 0.01);
        expectNear(irradianceOf(sampler->sample(*map, 64)), byLights, 0.01);
    }
}

TEST(MapLayout, EveryTexelLooksWhereItShould)
{
    for (const LaidOut& l : allLayouts(64)) {
        SCOPED_TRACE(l);
        const auto map = radianceOf(l, makeImage(l, [](const vec3& d) { return d + 1.0; }));
        double worst = 0.0;
        for (int y = 0; y < map->height; ++y)
            for (int x = 0; x < map->width; ++x) {
                const vec3 d = texelDirection(x, y, map->width, map->height);
                const float* t = map->texel(x, y);
                worst = std::max(worst, glsl::length(vec3(t[0], t[1], t[2]) - 1.0 - d));
            }
        // Half a source texel where reading is clamped; behind a ball the texels are long.
        EXPECT_LT(worst, l.layout == MapLayout::MIRROR_BALL ? 0.25 : 0.03);
    }
}

TEST(MapLayout, OneBrightTexelIsFoundWhereItLooks)
{
    const vec3 directions[] = {{0.8, 0.5, 0.2},  {0.7, -0.4, -0.3}, {0.2, 0.9, -0.35},  {-0.3, 0.8, 0.4},  {0.25, -0.8, 0.45},
                               {0.2, 0.35, 0.9}, {-0.3, -0.2, 0.9}, {0.4, -0.25, -0.9}, {-0.3, 0.35, -0.8}};
    const vec3 behind[] = {{-0.8, 0.5, 0.2}, {-0.8, -0.35, -0.4}, {-0.8, -0.3, 0.5}, {-0.9, 0.15, -0.25}};
    const auto expectFound = [](const LaidOut& l, const vec3& d) {
        const osg::ref_ptr<osg::Image> image = makeImage(l, [](const vec3&) { return vec3(0.0); });
        const Nearest n = nearestTexel(l, glsl::normalize(d));
        std::fill_n(texelOf(*image, n.x, n.y, n.slice), 3, 1000.0f);
        const auto map = radianceOf(l, image);
        EXPECT_LT(glsl::length(centroid(*map) - n.direction), pi / map->height) << l << ": " << d.x << " " << d.y << " " << d.z;
    };
    for (const LaidOut& l : allLayouts(32))
        for (const vec3& d : directions) expectFound(l, d);
    for (const LaidOut& l : allLayouts(32))
        for (const vec3& d : behind)
            if (l.layout != MapLayout::MIRROR_BALL) expectFound(l, d);
}

// Of 100 texels each. A face's rim is stretched, its corner texels are as small as the samples are far apart; measured:
// means of .990 to 1.005, single texels of .71 to 1.29.
TEST(MapLayout, SmallLightsKeepTheirFlux)
{
    Random random(5);
    for (const LaidOut& l : allLayouts(32)) {
        SCOPED_TRACE(l);
        double mean = 0.0;
        for (int n = 0; n < 100; ++n) {
            const Nearest t = nearestTexel(l, random.direction());
            double flux = 0.0;
            const osg::ref_ptr<osg::Image> image =
                osgEnvLight::convertToLatlong(l.layout, l.width, l.height, [&](int x, int y, int slice, double solidAngle) {
                    if (x != t.x || y != t.y || slice != t.slice) return osg::Vec3d();
                    flux = 1000.0 * solidAngle;
                    return osg::Vec3d(1000.0, 1000.0, 1000.0);
                });
            const double ratio = testmaths::radianceOf(image)->flux[0] / flux;
            EXPECT_NEAR(ratio, 1.0, 0.35);
            mean += ratio / 100;
        }
        EXPECT_NEAR(mean, 1.0, 0.02);
    }
}

TEST(MapLayout, ConstantStaysConstant)
{
    for (int side : {1, 2, 3, 7, 32})
        for (const LaidOut& l : allLayouts(side)) {
            SCOPED_TRACE(l);
            const auto map = radianceOf(l, makeImage(
                                               l, [](const vec3&) { return vec3(1.0, 0.3, 7e4); }, notANumber));
            EXPECT_EQ(map->notFinite, 0u);
            EXPECT_EQ(map->height, l.isCube() ? 2 * side : l.side());
            EXPECT_EQ(map->width, 2 * map->height);
            for (int i = 0; i < map->width * map->height; ++i) {
                const float* t = map->texel(i % map->width, i / map->width);
                ASSERT_NEAR(t[0], 1.0, 1e-6);
                ASSERT_NEAR(t[1] / 0.3, 1.0, 1e-6);
                ASSERT_NEAR(t[2] / 7e4, 1.0, 1e-6);
            }
        }
}

TEST(MapLayout, OddSquares)
{
    for (int side : {1, 3, 5, 33})
        for (const LaidOut& l : squareLayouts(side)) {
            const auto map = radianceOf(l, makeImage(
                                               l, [](const vec3&) { return vec3(2.0); }, notANumber));
            EXPECT_NEAR(map->mean, 2.0, 1e-6) << l;
            EXPECT_NEAR(map->maximum, 2.0, 1e-6) << l;
        }
}

TEST(MapLayout, SolidAnglesCoverTheSphere)
{
    for (const LaidOut& l : allLayouts(64)) {
        double sum = 0.0;
        osgEnvLight::convertToLatlong(l.layout, l.width, l.height, [&sum](int, int, int, double solidAngle) {
            sum += solidAngle;
            return osg::Vec3d();
        });
        EXPECT_NEAR(sum / (4.0 * pi), 1.0, 0.002) << l;
    }
}

TEST(MapLayout, ReadsWhatTheLayoutUsesOnceInRows)
{
    for (const LaidOut& l : allLayouts(4)) {
        SCOPED_TRACE(l);
        std::vector<int> expected;
        std::vector<int> found;
        vec3 d;
        for (int slice = 0; slice < l.slices; ++slice)
            for (int y = 0; y < l.height; ++y)
                for (int x = 0; x < l.width; ++x)
                    if (texelDirection(l, x, y, slice, d)) expected.push_back((slice * l.height + y) * l.width + x);
        osgEnvLight::convertToLatlong(l.layout, l.width, l.height, [&](int x, int y, int slice, double) {
            found.push_back((slice * l.height + y) * l.width + x);
            return osg::Vec3d();
        });
        EXPECT_EQ(found, expected);
    }
}

TEST(MapLayout, WhatIsNotFiniteIsNamedByItsPixelInTheSource)
{
    for (const LaidOut& l : allLayouts(8)) {
        SCOPED_TRACE(l);
        const Nearest n = nearestTexel(l, glsl::normalize(vec3(0.3, -0.8, -0.4)));
        const osg::ref_ptr<osg::Image> image = makeImage(
            l, [](const vec3&) { return vec3(1.0); }, notANumber);
        texelOf(*image, n.x, n.y, n.slice)[1] = notANumber;
        const auto map = radianceOf(l, image);
        EXPECT_EQ(map->notFinite, 1u);
        EXPECT_LT(map->flux[1], map->flux[0]);
        EXPECT_NEAR(map->flux[0], 4.0 * pi, 1e-5);
        osg::ref_ptr<EnvironmentMap> strict = environmentOf(l, image);
        strict->setStrict(true);
        std::string error;
        EXPECT_FALSE(strict->radiance(error));
        const std::string pixel = "pixel (" + std::to_string(n.x) + ", " + std::to_string(n.y) + ")";
        expectError(error, {"1 texels are not finite", pixel, l.layout == MapLayout::CUBE ? "of face +X" : "strict"});
    }
}

TEST(MapLayout, NegativeShareIsThatOfTheSource)
{
    for (const LaidOut& l : allLayouts(32)) {
        SCOPED_TRACE(l);
        const auto map = radianceOf(l, makeImage(
                                           l, [](const vec3& d) { return vec3(d.z < 0.0 ? -1.0 : 1.0); }, -5.0f));
        EXPECT_NEAR(map->negativeShare, 1.0, 0.08);
    }
}

TEST(MapLayout, AutoGoesByTheShape)
{
    const struct {
        int width, height, slices;
        MapLayout layout;
    } cases[] = {{8, 4, 1, MapLayout::LATLONG},
                 {6, 1, 1, MapLayout::LATLONG},
                 {1, 6, 1, MapLayout::LATLONG},
                 {1, 1, 1, MapLayout::LATLONG},
                 {3, 4, 1, MapLayout::VERTICAL_CROSS},
                 {9, 12, 1, MapLayout::VERTICAL_CROSS},
                 {4, 3, 1, MapLayout::HORIZONTAL_CROSS},
                 {20, 15, 1, MapLayout::HORIZONTAL_CROSS},
                 {12, 2, 1, MapLayout::STRIP},
                 {3, 18, 1, MapLayout::STRIP},
                 {5, 5, 6, MapLayout::CUBE},
                 {1, 1, 6, MapLayout::CUBE}};
    for (const auto& c : cases) {
        MapLayout layout = MapLayout::AUTO;
        EXPECT_EQ(osgEnvLight::resolveMapLayout(layout, c.width, c.height, c.slices), "");
        EXPECT_EQ(layout, c.layout) << c.width << "x" << c.height << "x" << c.slices;
        EXPECT_EQ(errorOf(c.width, c.height, c.slices, MapLayout::AUTO), "");
        EXPECT_EQ(errorOf(c.width, c.height, c.slices, c.layout), "");
    }
}

TEST(MapLayout, OtherShapesAreRefusedByNameAndSize)
{
    expectError(errorOf(8, 8, 1, MapLayout::AUTO), {"'some.exr' is 8x8", "angular", "mirror-ball", "octahedral"});
    expectError(errorOf(5, 3, 1, MapLayout::AUTO), {"'some.exr' is 5x3", "twice as wide as high", "cross", "6NxN"});
    expectError(errorOf(8, 4, 6, MapLayout::AUTO), {"is 8x4 in 6 slices", "six square"});
    expectError(errorOf(4, 4, 5, MapLayout::AUTO), {"is 4x4 in 5 slices", "one slice"});
    expectError(errorOf(4, 3, 1, MapLayout::LATLONG), {"'some.exr' is 4x3", "twice as wide as high"});
    expectError(errorOf(4, 3, 1, MapLayout::VERTICAL_CROSS), {"'some.exr' is 4x3", "3Nx4N"});
    expectError(errorOf(3, 4, 1, MapLayout::HORIZONTAL_CROSS), {"'some.exr' is 3x4", "4Nx3N"});
    expectError(errorOf(10, 2, 1, MapLayout::STRIP), {"'some.exr' is 10x2", "6NxN or Nx6N"});
    expectError(errorOf(4, 4, 1, MapLayout::CUBE), {"'some.exr' is 4x4", "six faces"});
    for (MapLayout layout : {MapLayout::ANGULAR, MapLayout::MIRROR_BALL, MapLayout::OCTAHEDRAL}) {
        const std::string& name = osgEnvLight::mapLayoutNames()[size_t(layout)];
        expectError(errorOf(8, 4, 1, layout), {"'some.exr' is 8x4", "NxN", "'" + name + "'"});
        expectError(errorOf(4, 4, 6, layout), {"is 4x4 in 6 slices", "one slice"});
    }
    expectError(errorOf(4, 4, 1, MapLayout(77)), {"'some.exr'", "latlong, vertical-cross"});
}

TEST(MapLayout, IsPartOfWhatTheMapIsMadeFrom)
{
    const LaidOut l = squareLayouts(8)[0];
    const osg::ref_ptr<EnvironmentMap> environment = environmentOf(l, makeImage(l, sixColours));
    std::string error;
    const osg::ref_ptr<const RadianceMap> first = environment->radiance(error);
    EXPECT_EQ(environment->radiance(error), first);
    const osg::ref_ptr<EnvironmentMap> copy = new EnvironmentMap(*environment);
    EXPECT_EQ(copy->getLayout(), MapLayout::ANGULAR);
    environment->setLayout(MapLayout::OCTAHEDRAL);
    const osg::ref_ptr<const RadianceMap> second = environment->radiance(error);
    ASSERT_TRUE(second) << error;
    EXPECT_NE(second, first);
    environment->setLayout(MapLayout::AUTO);
    EXPECT_FALSE(environment->radiance(error));
    EXPECT_NE(error.find("octahedral"), std::string::npos) << error;
    environment->setLayout(MapLayout::ANGULAR);
    EXPECT_TRUE(environment->radiance(error));
    EXPECT_TRUE(environment->load("studio", nullptr, error)) << error;
    EXPECT_TRUE(environment->radiance(error)) << error;
    environment->setImage(nullptr);
    EXPECT_TRUE(environment->radiance(error)) << error;
}

TEST(MapLayout, EightBitCrossesAreEncoded)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(4, 3, 1, GL_RGB, GL_UNSIGNED_BYTE);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(188));
    // sRGB 188 is .50288654 linear [IEC 61966-2-1]
    EXPECT_NEAR(testmaths::radianceOf(image)->mean, 0.50288654, 1e-7);
}

TEST(MapLayout, OriginAtTheTopIsRespected)
{
    const LaidOut l = cubeLayouts(8)[0];
    const osg::ref_ptr<osg::Image> image = makeImage(l, sixColours);
    const auto expected = radianceOf(l, image);
    image->flipVertical();
    image->setOrigin(osg::Image::TOP_LEFT);
    const auto found = radianceOf(l, image);
    EXPECT_EQ(found->flux, expected->flux);
    EXPECT_EQ(found->texel(3, 1)[1], expected->texel(3, 1)[1]);
}

}  // namespace MapLayout_test
