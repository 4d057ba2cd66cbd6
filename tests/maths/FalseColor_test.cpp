// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <metrics/Display>
#include <metrics/FalseColor>

#include <limits>
#include <stdexcept>

#include "Maths.h"
#include "Pictures.h"

namespace FalseColor_test
{

using namespace testmaths;
using osg::Vec3d;
using osgEnvLight::automaticExposure;
using osgEnvLight::Mask;
using osgEnvLight::Picture;
using osgEnvLight::ScalarMap;

namespace
{

const float notANumber = std::numeric_limits<float>::quiet_NaN();

Vec3d differenceColour(double difference, double scale)
{
    return signedDifference(makePicture(1, 1, 1.0 + difference), makePicture(1, 1, 1.0), scale).color(0, 0);
}

Vec3d magnitudeColour(double value, double scale)
{
    ScalarMap map(1, 1);
    map.at(0, 0) = value;
    return magnitude(map, scale).color(0, 0);
}

double lightness(const Vec3d& encoded)
{
    const Vec3d linear(glsl::srgbDecode(encoded[0]), glsl::srgbDecode(encoded[1]), glsl::srgbDecode(encoded[2]));
    const double y = osgEnvLight::luminance(linear);
    return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

}  // namespace

TEST(FalseColor, SignedDifference)
{
    EXPECT_EQ(differenceColour(0.0, 0.1), Vec3d(1.0, 1.0, 1.0));
    double above = 100.0, below = 100.0;
    for (int i = 1; i <= 8; ++i) {
        const Vec3d red = differenceColour(i / 8.0, 1.0);
        const Vec3d blue = differenceColour(-i / 8.0, 1.0);
        EXPECT_GT(red[0], red[2]) << i;
        EXPECT_GT(blue[2], blue[0]) << i;
        EXPECT_LT(lightness(red), above) << i;
        EXPECT_LT(lightness(blue), below) << i;
        above = lightness(red);
        below = lightness(blue);
    }
    EXPECT_EQ(differenceColour(0.5, 0.5), differenceColour(40.0, 0.5));
    EXPECT_EQ(differenceColour(-0.5, 0.5), differenceColour(-40.0, 0.5));
}

TEST(FalseColor, MagnitudeRisesEvenly)
{
    // CIE L* of the ramp is nearly a line from 0 to 98: a quarter of its mean slope at least, twice at most.
    for (int i = 0; i < 32; ++i) {
        const double step = lightness(magnitudeColour((i + 1) / 32.0, 1.0)) - lightness(magnitudeColour(i / 32.0, 1.0));
        EXPECT_GT(step, 0.25 * 98.0 / 32.0) << i;
        EXPECT_LT(step, 2.0 * 98.0 / 32.0) << i;
    }
    EXPECT_LT(lightness(magnitudeColour(0.0, 1.0)), 1.0);
    EXPECT_EQ(magnitudeColour(7.0, 7.0), magnitudeColour(1e30, 7.0));
    EXPECT_EQ(magnitudeColour(3.5, 7.0), magnitudeColour(0.5, 1.0));
}

TEST(FalseColor, NotANumberShows)
{
    const Vec3d green(0.0, 1.0, 0.0);
    EXPECT_EQ(differenceColour(double(notANumber), 1.0), green);
    EXPECT_EQ(magnitudeColour(double(notANumber), 1.0), green);
}

TEST(FalseColor, WrongArguments)
{
    const Picture p(2, 2);
    EXPECT_THROW(signedDifference(p, p, 0.0), std::invalid_argument);
    EXPECT_THROW(signedDifference(p, Picture(1, 2), 1.0), std::invalid_argument);
    EXPECT_THROW(magnitude(ScalarMap(2, 2), double(notANumber)), std::invalid_argument);
    EXPECT_EQ(magnitude(ScalarMap(), 1.0).pixels(), 0u);
}

TEST(Display, EncodedIsSrgbOfTheExposed)
{
    Picture p = makePicture(2, 1, 0.1, 0.0005, 3.0);
    p.at(1, 0)[0] = notANumber;
    p.at(1, 0)[1] = -2.0f;
    p.at(1, 0)[2] = std::numeric_limits<float>::infinity();
    p.at(1, 0)[3] = 0.5f;
    const Picture e = displayEncoded(p, 1.0);
    // One rounding to float going in, one coming out.
    EXPECT_NEAR(double(e.at(0, 0)[0]), glsl::srgbEncode(0.2), 1e-7);
    EXPECT_NEAR(double(e.at(0, 0)[1]), glsl::srgbEncode(0.001), 1e-9);
    EXPECT_EQ(e.at(0, 0)[2], 1.0f);
    EXPECT_EQ(e.color(1, 0), Vec3d(0.0, 0.0, 1.0));
    EXPECT_EQ(e.alpha(1, 0), 0.5f);
}

TEST(Display, AutomaticExposure)
{
    // 1 .. 100: the 90th of them comes to .6, the background and NaN don't count.
    Picture p = makePicture(11, 10, [](int x, int y) {
        const double v = 10 * y + x + 1;
        return Vec3d(v, v, v);
    });
    for (int y = 0; y < 10; ++y) {
        std::fill_n(p.at(10, y), 3, 1e6f);
        p.at(10, y)[3] = 0.0f;
    }
    EXPECT_NEAR(90.0 * std::exp2(automaticExposure(p, Mask::geometry(p))), 0.6, 1e-14);
    std::fill_n(p.at(0, 0), 3, notANumber);  // was 1: the 90th percentile of 2 .. 100 is 91
    EXPECT_NEAR(91.0 * std::exp2(automaticExposure(p, Mask::geometry(p))), 0.6, 1e-14);
    EXPECT_EQ(automaticExposure(makePicture(3, 3, 0.0), Mask(3, 3, true)), 0.0);
    EXPECT_EQ(automaticExposure(p, Mask(11, 10, false)), 0.0);
    EXPECT_THROW(automaticExposure(p, Mask(1, 1, true)), std::invalid_argument);
}

}  // namespace FalseColor_test
