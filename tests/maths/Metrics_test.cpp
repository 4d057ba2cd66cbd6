// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <metrics/Display>
#include <metrics/Metrics>

#include <osgDB/WriteFile>

#include <limits>
#include <random>
#include <sstream>

#include "Maths.h"
#include "Pictures.h"
#include "Process.h"

namespace Metrics_test
{

using namespace testmaths;
using osg::Vec3d;
using osgEnvLight::compare;
using osgEnvLight::ErrorFigures;
using osgEnvLight::Mask;
using osgEnvLight::Picture;

namespace
{

const float notANumber = std::numeric_limits<float>::quiet_NaN();
const float infinity = std::numeric_limits<float>::infinity();

// Multiples of 1/64 below 4, which float adds without rounding.
Picture steps(int width, int height, double shift = 0.0, double factor = 1.0)
{
    return makePicture(width, height, [=](int x, int y) {
        return Vec3d((1 + x) % 64, (7 + 3 * y) % 64, (9 + x + y) % 64) / 64.0 * factor + Vec3d(shift, shift, shift);
    });
}

ErrorFigures compareAll(const Picture& picture, const Picture& reference)
{
    return compare(picture, reference, Mask::everything(reference));
}

// Two of Random's numbers make one of the normal distribution (Box, Muller).
double normal(Random& random)
{
    const double u = 1.0 - random.uniform();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * pi * random.uniform());
}

Picture noisy(const Picture& picture, double sigma, unsigned seed)
{
    Random random(seed);
    return makePicture(picture.width, picture.height, [&](int x, int y) {
        Vec3d c = picture.color(x, y);
        for (int k = 0; k < 3; ++k) c[k] += sigma * normal(random);
        return c;
    });
}

void writeExr(const Picture& picture, const std::string& file)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(picture.width, picture.height, 1, GL_RGB, GL_FLOAT);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            std::copy_n(picture.at(x, y), 3, reinterpret_cast<float*>(image->data(unsigned(x), unsigned(y))));
    ASSERT_TRUE(osgDB::writeImageFile(*image, file));
}

// The number after "name = " in a program's output.
double numberOf(const std::string& text, const std::string& name)
{
    const size_t at = text.find(name + " = ");
    if (at == std::string::npos) return std::nan("");
    std::istringstream in(text.substr(at + name.size() + 3));
    in.imbue(std::locale::classic());
    double value = std::nan("");
    in >> value;
    return value;
}

}  // namespace

TEST(Metrics, IdenticalPicturesHaveNoError)
{
    const Picture p = steps(31, 17);
    const ErrorFigures f = compareAll(p, p);
    EXPECT_EQ(f.pixels, 31u * 17u);
    for (double v : {f.rmse, f.relMse, f.tRmse, f.bias, f.p99, f.p999, f.worst, f.noise}) EXPECT_EQ(v, 0.0);
    EXPECT_EQ(f.worstX, -1);
    EXPECT_FALSE(f.resolved);
}

TEST(Metrics, ShiftedByAConstant)
{
    const Picture r = steps(64, 64);
    const ErrorFigures f = compareAll(steps(64, 64, -0.25), r);
    EXPECT_EQ(f.rmse, 0.25);
    EXPECT_EQ(f.mean, 63.0 / 128.0);  // each of 0 .. 63 once in a row or column
    EXPECT_NEAR(f.bias, -0.25 / f.mean, 1e-15);
    EXPECT_NEAR(f.nrmse(), 0.25 / f.mean, 1e-15);
    // The weights of luminance sum to 1 but for rounding.
    EXPECT_NEAR(f.worst, 0.25, 1e-15);
    EXPECT_NEAR(f.p99, 0.25 / f.meanLuminance, 1e-14);
    EXPECT_TRUE(f.resolved);
}

TEST(Metrics, Scaled)
{
    const ErrorFigures f = compareAll(steps(64, 64, 0.0, 2.0), steps(64, 64));
    EXPECT_NEAR(f.bias, 1.0, 1e-15);
    // Mean square of 0 .. 63 over 64^2: (n - 1)(2n - 1) / (6 n^2)
    EXPECT_NEAR(f.rmse, std::sqrt(63.0 * 127.0 / 6.0) / 64.0, 1e-15);
    // x - r = r: r^2 / (r^2 + (r/100)^2)
    const ErrorFigures constant = compareAll(makePicture(5, 4, 1.0), makePicture(5, 4, 0.5));
    EXPECT_NEAR(constant.relMse, 1.0 / 1.0001, 1e-15);
    EXPECT_NEAR(constant.relRmse(), std::sqrt(1.0 / 1.0001), 1e-15);
    // Of the mean 1/2: 1 / (1 + 1/2) - (1/2) / (1/2 + 1/2)
    EXPECT_NEAR(constant.tRmse, 1.0 / 6.0, 1e-15);
}

TEST(Metrics, NoiseOfKnownSigma)
{
    const double sigma = 0.1;
    const Picture truth = steps(96, 64);
    const Picture reference = noisy(truth, sigma, 5);
    const double n = 3.0 * 96.0 * 64.0;
    // The mean of n squares has the standard deviation sigma^2 sqrt(2/n).
    const double deviation = sigma * sigma * std::sqrt(2.0 / n);
    const ErrorFigures raw = compareAll(truth, reference);
    EXPECT_NEAR(raw.rmse * raw.rmse, sigma * sigma, 4.0 * deviation);
    EXPECT_LT(std::abs(raw.bias * raw.mean), 4.0 * sigma / std::sqrt(n));

    const Picture standardError = makePicture(96, 64, sigma);
    const ErrorFigures f = compare(truth, reference, standardError, Mask::everything(truth));
    EXPECT_LE(f.rmse * f.rmse, 4.0 * deviation);
    EXPECT_NEAR(f.noise, sigma, 1e-8);  // sigma as float
    // To first order in sigma: the slope of the tone curve is at most 2, at 0, where its bend takes some of the noise back.
    EXPECT_LT(f.tRmse, 0.2 * raw.tRmse);
    EXPECT_NEAR(f.tNoise, raw.tRmse, 0.02 * raw.tRmse);
    EXPECT_FALSE(f.resolved);
}

TEST(Metrics, DifferenceBelowTheReferencesNoise)
{
    const double sigma = 0.1, n = 3.0 * 96.0 * 64.0;
    for (double difference : {0.03, 0.1, 0.5}) {
        const Picture picture = steps(96, 64, difference);
        const ErrorFigures f =
            compare(picture, noisy(steps(96, 64), sigma, 6), makePicture(96, 64, sigma), Mask::everything(picture));
        // Variance of (difference - noise)^2: 2 sigma^4 + 4 difference^2 sigma^2
        const double deviation = sigma * std::sqrt((2.0 * sigma * sigma + 4.0 * difference * difference) / n);
        EXPECT_NEAR(f.rmse * f.rmse, difference * difference, 4.0 * deviation);
        EXPECT_TRUE(f.resolved) << difference;
    }
}

TEST(Metrics, NoiseIsTakenForErrorAsSeldomAsStated)
{
    // One grey sample for all channels of a pixel, as the rule assumes: 3 standard deviations of a sum of 1024 squares of a
    // normal variable are exceeded with a probability of .23 % (chi-squared), so by more than 8 of 400 with 4e-6 (Poisson).
    const Picture truth = makePicture(32, 32, 1.0);
    const Picture standardError = makePicture(32, 32, 0.5);
    int resolved = 0;
    Random random(11);
    for (int i = 0; i < 400; ++i) {
        const Picture reference = makePicture(32, 32, [&](int, int) {
            const double v = 1.0 + 0.5 * normal(random);
            return Vec3d(v, v, v);
        });
        resolved += compare(truth, reference, standardError, Mask::everything(truth)).resolved;
    }
    EXPECT_LE(resolved, 8);
}

TEST(Metrics, OneBadPixel)
{
    const Picture r = makePicture(20, 10, 1.0);
    Picture x = r;
    std::fill_n(x.at(13, 4), 3, 9.0f);
    const ErrorFigures f = compareAll(x, r);
    EXPECT_EQ(f.p99, 0.0);  // 199 of 200 are right
    EXPECT_NEAR(f.p999, 8.0, 1e-14);
    EXPECT_NEAR(f.worst, 8.0, 1e-14);
    EXPECT_EQ(f.worstX, 13);
    EXPECT_EQ(f.worstY, 4);
    EXPECT_NEAR(f.rmse, std::sqrt(64.0 / 200.0), 1e-15);
    Mask without = Mask::everything(r);
    without.set(13, 4, false);
    EXPECT_EQ(compare(x, r, without).rmse, 0.0);
    EXPECT_EQ(compare(x, r, without).pixels, 199u);
}

TEST(Metrics, PercentileIsTheNearestRank)
{
    std::vector<double> values;
    for (int i = 1000; i >= 1; --i) values.push_back(i);
    EXPECT_EQ(osgEnvLight::percentile(values, 990), 990.0);
    EXPECT_EQ(osgEnvLight::percentile(values, 999), 999.0);
    EXPECT_EQ(osgEnvLight::percentile(values, 1000), 1000.0);
    EXPECT_EQ(osgEnvLight::percentile(values, 0), 1.0);
    values = {3.0, 1.0};
    EXPECT_EQ(osgEnvLight::percentile(values, 500), 1.0);
    EXPECT_EQ(osgEnvLight::percentile(values, 501), 3.0);
    values.clear();
    EXPECT_EQ(osgEnvLight::percentile(values, 990), 0.0);
}

TEST(Metrics, NothingToCompare)
{
    const Picture p = makePicture(4, 3, 1.0);
    for (const ErrorFigures& f : {compare(p, makePicture(4, 3, 5.0), Mask(4, 3, false)), compareAll(Picture(), Picture())}) {
        EXPECT_EQ(f.pixels, 0u);
        for (double v : {f.mean, f.rmse, f.nrmse(), f.relRmse(), f.bias, f.p99, f.p999, f.worst}) EXPECT_EQ(v, 0.0);
        EXPECT_FALSE(f.resolved);
    }
}

TEST(Metrics, OnePixel)
{
    const ErrorFigures f = compareAll(makePicture(1, 1, 3.0), makePicture(1, 1, 2.0));
    EXPECT_EQ(f.rmse, 1.0);
    EXPECT_EQ(f.bias, 0.5);
    EXPECT_NEAR(f.p99, 0.5, 1e-15);
    EXPECT_EQ(f.worstX, 0);
}

TEST(Metrics, SizesThatDiffer)
{
    const Picture a(4, 3);
    const Picture b(3, 4);
    EXPECT_THROW(compare(a, a, a, Mask::everything(b)), std::invalid_argument);
    EXPECT_THROW(compare(a, a, b, Mask::everything(a)), std::invalid_argument);
    try {
        compareAll(a, b);
        ADD_FAILURE() << "nothing thrown";
    } catch (const std::invalid_argument& e) {
        EXPECT_STREQ(e.what(), "sizes differ: 4 x 3 and 3 x 4");
    }
}

TEST(Metrics, NotFinitePixelsAreCountedApart)
{
    const Picture r = makePicture(4, 4, 1.0);
    Picture x = makePicture(4, 4, 1.5);
    x.at(0, 0)[1] = notANumber;
    x.at(1, 0)[2] = infinity;
    Picture standardError = makePicture(4, 4, 0.0);
    standardError.at(2, 0)[0] = notANumber;
    const ErrorFigures f = compare(x, r, standardError, Mask::everything(r));
    EXPECT_EQ(f.notFinite, 3u);
    EXPECT_EQ(f.pixels, 13u);
    EXPECT_EQ(f.rmse, 0.5);
    // The same NaN in both is still no agreement.
    EXPECT_EQ(compareAll(x, x).notFinite, 2u);
    Mask second(4, 4, false);
    second.set(1, 0, true);
    EXPECT_EQ(compare(x, r, second).notFinite, 1u);
}

TEST(Metrics, BlackReference)
{
    const Picture black = makePicture(3, 3, 0.0);
    const ErrorFigures same = compareAll(black, black);
    for (double v : {same.bias, same.relMse, same.nrmse(), same.p99}) EXPECT_EQ(v, 0.0);
    const ErrorFigures f = compareAll(makePicture(3, 3, 1.0), black);
    for (double v : {f.bias, f.relMse, f.nrmse(), f.p99}) EXPECT_EQ(v, double(infinity));
    EXPECT_EQ(f.rmse, 1.0);
}

TEST(Metrics, SecondImplementation)
{
    if (runProgram({"oiiotool", "--help"}).status != 0) GTEST_SKIP() << "oiiotool is not installed";
    const TemporaryFolder folder;
    const Picture r = steps(57, 31);
    Picture x = noisy(r, 0.05, 9);
    std::fill_n(x.at(20, 7), 3, 6.0f);
    writeExr(x, folder.file("x.exr"));
    writeExr(r, folder.file("r.exr"));
    const std::string said = runProgram({"oiiotool", folder.file("x.exr"), folder.file("r.exr"), "--diff"}).out;
    const ErrorFigures f = compareAll(x, r);
    // It prints 6 digits.
    EXPECT_NEAR(numberOf(said, "RMS error"), f.rmse, 5e-6 * f.rmse) << said;
    // Row 0 is at the bottom here, at the top there.
    EXPECT_NE(said.find("@ (20, 23"), std::string::npos) << said;
    EXPECT_EQ(f.worstX, 20);
    EXPECT_EQ(f.worstY, 7);
    double largest = 0.0;
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(x.color(20, 7)[k] - r.color(20, 7)[k]));
    EXPECT_NEAR(numberOf(said, "Max error "), largest, 5e-6 * largest) << said;
    // Where a picture is brighter everywhere, its mean error is the bias.
    writeExr(steps(57, 31, 0.75), folder.file("x.exr"));
    const std::string shifted = runProgram({"oiiotool", folder.file("x.exr"), folder.file("r.exr"), "--diff"}).out;
    const ErrorFigures g = compareAll(steps(57, 31, 0.75), r);
    const double sum = g.bias * g.mean;
    EXPECT_NEAR(numberOf(shifted, "Mean error"), sum, 5e-6 * sum) << shifted;
    EXPECT_NEAR(numberOf(shifted, "Max error "), g.worst, 5e-6) << shifted;
}

}  // namespace Metrics_test
