// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <osgEnvLight/EnvironmentMap>

#include <limits>

#include "Maps.h"

namespace EnvironmentMap_test
{

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::EnvironmentMap;
using osgEnvLight::RadianceMap;

namespace
{

const float notANumber = std::numeric_limits<float>::quiet_NaN();
const float infinity = std::numeric_limits<float>::infinity();

osg::ref_ptr<osg::Image> constant(int width, int height, double value = 1.0)
{
    return makeMap(width, height, [value](const vec3&) { return vec3(value); });
}

}  // namespace

TEST(EnvironmentMap, FluxAndMean)
{
    const auto map = radianceOf(makeMap(64, 32, [](const vec3&) { return vec3(1.0, 2.0, 3.0); }));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(map->flux[i] / (4.0 * pi * (i + 1)), 1.0, 1e-13);
    EXPECT_NEAR(map->mean, 0.2126 + 2.0 * 0.7152 + 3.0 * 0.0722, 1e-13);
    EXPECT_EQ(map->maximum, 3.0);
    EXPECT_EQ(map->notFinite + map->negative, 0u);
}

TEST(EnvironmentMap, TopRowIsPlusZ)
{
    const auto map = radianceOf(makeMap(64, 32, [](const vec3& d) { return vec3(d.z > 0.9 ? 5.0 : 0.0); }));
    EXPECT_EQ(map->texel(0, 0)[0], 5.0f);
    EXPECT_EQ(map->texel(0, 31)[0], 0.0f);
}

TEST(EnvironmentMap, OriginAtTheTopIsRespected)
{
    const osg::ref_ptr<osg::Image> image = makeMap(8, 4, [](const vec3& d) { return vec3(2.0 + d.z); });
    const float top = texelOf(*image, 0, 0)[0];
    image->flipVertical();
    image->setOrigin(osg::Image::TOP_LEFT);
    EXPECT_EQ(radianceOf(image)->texel(3, 0)[1], top);
}

TEST(EnvironmentMap, SmallAndThin)
{
    for (auto [w, h] : {std::pair(1, 1), std::pair(4, 2), std::pair(2, 1), std::pair(7, 1), std::pair(1, 9)})
        EXPECT_NEAR(radianceOf(constant(w, h, 2.5))->mean, 2.5, 1e-13) << w << "x" << h;
}

TEST(EnvironmentMap, OtherShapesAreRefused)
{
    for (auto [w, h] : {std::pair(3, 2), std::pair(5, 3), std::pair(2, 4)}) {
        osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap(constant(w, h).get());
        std::string error;
        EXPECT_FALSE(map->radiance(error));
        EXPECT_NE(error.find(std::to_string(w) + "x" + std::to_string(h)), std::string::npos) << error;
        EXPECT_NE(error.find("twice as wide as high"), std::string::npos) << error;
    }
    osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap(new osg::Image);
    std::string error;
    EXPECT_FALSE(map->radiance(error));
    EXPECT_NE(error.find("empty"), std::string::npos) << error;
}

TEST(EnvironmentMap, NotFiniteTexelsAreCountedAndMadeZero)
{
    const osg::ref_ptr<osg::Image> image = constant(16, 8);
    texelOf(*image, 3, 2)[0] = notANumber;
    texelOf(*image, 4, 2)[1] = infinity;
    texelOf(*image, 5, 2)[2] = -infinity;
    std::fill_n(texelOf(*image, 6, 2), 3, notANumber);
    const auto map = radianceOf(image);
    EXPECT_EQ(map->notFinite, 4u);
    EXPECT_EQ(map->negative, 0u);
    EXPECT_EQ(map->texel(3, 2)[0], 0.0f);
    EXPECT_EQ(map->texel(3, 2)[1], 1.0f);  // only what is wrong
    EXPECT_EQ(map->texel(4, 2)[1], 0.0f);
    EXPECT_EQ(map->texel(5, 2)[2], 0.0f);
    const double lost = 2.0 * texelSolidAngle(2, 16, 8);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(map->flux[i], 4.0 * pi - lost, 1e-12);
    EXPECT_EQ(map->maximum, 1.0);
}

TEST(EnvironmentMap, NegativeTexelsBelowTheToleranceAreClamped)
{
    const osg::ref_ptr<osg::Image> image = constant(16, 8);
    texelOf(*image, 0, 4)[0] = -0.001f;
    texelOf(*image, 1, 4)[1] = -0.002f;
    for (bool strict : {false, true}) {
        osg::ref_ptr<EnvironmentMap> environment = new EnvironmentMap(image.get());
        environment->setStrict(strict);
        std::string error;
        const osg::ref_ptr<const RadianceMap> map = environment->radiance(error);
        ASSERT_TRUE(map) << error;
        EXPECT_EQ(map->negative, 2u);
        const double solidAngle = texelSolidAngle(4, 16, 8);
        const double share = 0.003 * solidAngle / (3.0 * 4.0 * pi - 2.0 * solidAngle);
        EXPECT_NEAR(map->negativeShare / share, 1.0, 1e-6);  // -.001 and -.002 as floats
        EXPECT_LT(map->negativeShare, 1e-4);
        EXPECT_EQ(map->texel(0, 4)[0], 0.0f);
    }
}

TEST(EnvironmentMap, NegativeTexelsAboveTheToleranceAreRefusedByStrict)
{
    const osg::ref_ptr<osg::Image> image = constant(16, 8);
    texelOf(*image, 2, 4)[0] = -1.0f;
    osg::ref_ptr<EnvironmentMap> environment = new EnvironmentMap(image.get());
    std::string error;
    const osg::ref_ptr<const RadianceMap> map = environment->radiance(error);
    ASSERT_TRUE(map) << error;
    EXPECT_GT(map->negativeShare, 1e-4);
    environment->setStrict(true);
    EXPECT_FALSE(environment->radiance(error));
    EXPECT_NE(error.find("pixel (2, 4)"), std::string::npos) << error;
    EXPECT_NE(error.find("strict"), std::string::npos) << error;
    environment->setStrict(false);
    EXPECT_TRUE(environment->radiance(error));
    EXPECT_TRUE(error.empty()) << error;
}

TEST(EnvironmentMap, StrictRefusesNotFiniteAndNamesTheFirst)
{
    const osg::ref_ptr<osg::Image> image = constant(16, 8);
    image->setFileName("broken.exr");
    texelOf(*image, 9, 3)[0] = notANumber;
    texelOf(*image, 9, 5)[0] = notANumber;
    osg::ref_ptr<EnvironmentMap> environment = new EnvironmentMap(image.get());
    environment->setStrict(true);
    std::string error;
    EXPECT_FALSE(environment->radiance(error));
    for (const char* part : {"broken.exr", "2 texels are not finite", "pixel (9, 3)", "strict"})
        EXPECT_NE(error.find(part), std::string::npos) << error;
}

TEST(EnvironmentMap, AllNegativeAndBlack)
{
    const auto negative = radianceOf(constant(8, 4, -1.0));
    EXPECT_EQ(negative->negativeShare, 1.0);
    EXPECT_EQ(negative->mean, 0.0);
    const auto black = radianceOf(constant(8, 4, 0.0));
    EXPECT_EQ(black->mean, 0.0);
    EXPECT_EQ(black->negative, 0u);
    EXPECT_EQ(black->negativeShare, 0.0);
}

TEST(EnvironmentMap, RebuiltWhenTheModifiedCountChanges)
{
    const osg::ref_ptr<osg::Image> image = constant(8, 4);
    osg::ref_ptr<EnvironmentMap> environment = new EnvironmentMap(image.get());
    std::string error;
    const osg::ref_ptr<const RadianceMap> first = environment->radiance(error);
    environment->setRotation(90.0);
    environment->setIntensity(3.0);
    EXPECT_EQ(environment->radiance(error), first);
    std::fill_n(texelOf(*image, 0, 0), 3, 9.0f);
    EXPECT_EQ(environment->radiance(error), first);
    image->dirty();
    const osg::ref_ptr<const RadianceMap> second = environment->radiance(error);
    ASSERT_TRUE(second);
    EXPECT_NE(second, first);
    EXPECT_EQ(second->maximum, 9.0);
    EXPECT_EQ(first->maximum, 1.0);  // a draw thread may still read it
    environment->setImage(constant(4, 2, 7.0).get());
    EXPECT_EQ(environment->radiance(error)->maximum, 7.0);
}

TEST(EnvironmentMap, ErrorStaysUntilTheImageChanges)
{
    osg::ref_ptr<EnvironmentMap> environment = new EnvironmentMap(constant(3, 2).get());
    std::string first;
    std::string second;
    EXPECT_FALSE(environment->radiance(first));
    EXPECT_FALSE(environment->radiance(second));
    EXPECT_EQ(first, second);
    environment->setImage(constant(4, 2).get());
    EXPECT_TRUE(environment->radiance(second));
    EXPECT_TRUE(second.empty());
}

TEST(EnvironmentMap, EightBitImagesAreEncoded)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(188));
    // sRGB 188 is .50288654 linear [IEC 61966-2-1]
    EXPECT_NEAR(radianceOf(image)->texel(0, 0)[0], 0.50288654, 1e-7);
}

TEST(EnvironmentMap, LargeRadianceKeepsItsDigits)
{
    const auto map = radianceOf(constant(32, 16, 1e30));
    EXPECT_NEAR(map->mean / double(1e30f), 1.0, 1e-12);
}

TEST(EnvironmentMap, LoadNamesWhatIsMissing)
{
    osg::ref_ptr<EnvironmentMap> environment = new EnvironmentMap;
    for (const char* name : {"no-such-map.hdr", "no-such-map.exr", "no-such-map"}) {
        std::string error;
        EXPECT_FALSE(environment->load(name, nullptr, error));
        EXPECT_NE(error.find(std::string("'") + name + "'"), std::string::npos) << error;
        EXPECT_EQ(environment->getMap(), "sky");
    }
}

}  // namespace EnvironmentMap_test
