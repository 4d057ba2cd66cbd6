// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <metrics/Display>
#include <metrics/Flip>

#include <limits>
#include <stdexcept>

#include "Maths.h"
#include "Pictures.h"

namespace Flip_test
{

using namespace testmaths;
using osg::Vec3d;
using osgEnvLight::flip;
using osgEnvLight::flipExposures;
using osgEnvLight::hdrFlip;
using osgEnvLight::Mask;
using osgEnvLight::Picture;
using osgEnvLight::ScalarMap;

namespace
{

double meanFlip(const Picture& a, const Picture& b, double pixelsPerDegree = osgEnvLight::defaultPixelsPerDegree)
{
    return mean(flip(a, b, 0.0, pixelsPerDegree), Mask::everything(a));
}

// Gradients, an edge, a fine pattern and colours.
Vec3d pattern(int x, int y)
{
    const double stripe = x > 14 ? 0.2 * ((x + y) % 2) : 0.0;
    return Vec3d(0.1 + 0.02 * x, y < 9 ? 0.2 : 0.6, 0.05 + 0.03 * y) + Vec3d(stripe, stripe, stripe);
}

Picture noisyPattern(int width, int height, double amplitude)
{
    Random random(21);
    return makePicture(width, height, [&](int x, int y) {
        Vec3d c = pattern(x, y);
        for (int k = 0; k < 3; ++k) c[k] = std::clamp(c[k] + amplitude * random.uniform(-1.0, 1.0), 0.0, 1.0);
        return c;
    });
}

// The paper once more, as its sums in two dimensions, for one pixel. L*a*b* of the primaries as tables print them.
class Paper
{
  public:
    Paper(const Picture& picture, double pixelsPerDegree) : _picture(picture), _ppd(pixelsPerDegree) {}

    /** Y / Yn, X / Xn, Z / Zn of a pixel; outside, of the border's. */
    Vec3d whitened(int x, int y) const
    {
        const Vec3d c = _picture.color(std::clamp(x, 0, _picture.width - 1), std::clamp(y, 0, _picture.height - 1));
        const Vec3d xn(0.412391, 0.357584, 0.180481), yn(0.212639, 0.715169, 0.072192), zn(0.019331, 0.119195, 0.950532);
        const Vec3d one(1.0, 1.0, 1.0);
        return Vec3d((yn * c) / (yn * one), (xn * c) / (xn * one), (zn * c) / (zn * one));
    }

    /** Hunt-adjusted L*a*b* after the filters of contrast sensitivity. */
    Vec3d lab(int x, int y) const
    {
        const double luminance = filter(x, y, 0, 1.0, 0.0047, 0.0, 1.0);
        const double redGreen = filter(x, y, 1, 1.0, 0.0053, 0.0, 1.0);
        const double blueYellow = filter(x, y, 2, 34.1, 0.04, 13.5, 0.025);
        return hunt(luminance, luminance + redGreen, luminance - blueYellow);
    }

    static Vec3d hunt(double y, double x, double z)
    {
        const double l = 116.0 * root(y) - 16.0;
        return Vec3d(l, 5.0 * l * (root(x) - root(y)), 2.0 * l * (root(y) - root(z)));
    }

    /** Norm of the first or second derivative's filter. */
    double feature(int x, int y, bool point) const
    {
        const double sigma = 0.041 * _ppd;
        const int radius = int(std::ceil(3.0 * sigma));
        Vec3d positive, negative;  // sums: of the weights, of x, of y
        for (int j = -radius; j <= radius; ++j)
            for (int i = -radius; i <= radius; ++i) {
                const double g = std::exp(-(i * i + j * j) / (2.0 * sigma * sigma));
                const double w = (point ? i * i / (sigma * sigma) - 1.0 : i) * g;
                (w > 0.0 ? positive : negative) += Vec3d(w, w * whitened(x + i, y + j)[0], w * whitened(x + j, y + i)[0]);
            }
        return std::hypot(positive[1] / positive[0] - negative[1] / negative[0],
                          positive[2] / positive[0] - negative[2] / negative[0]);
    }

  private:
    static double root(double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : 841.0 / 108.0 * t + 4.0 / 29.0; }

    double filter(int x, int y, int channel, double a1, double b1, double a2, double b2) const
    {
        const int radius = int(std::ceil(3.0 * std::sqrt(0.04 / 2.0) / pi * _ppd));
        double sum = 0.0, weights = 0.0;
        for (int j = -radius; j <= radius; ++j)
            for (int i = -radius; i <= radius; ++i) {
                const double z = (i * i + j * j) / (_ppd * _ppd);
                const double w =
                    a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * z / b1) + a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * z / b2);
                const Vec3d v = whitened(x + i, y + j);
                sum += w * (channel == 0 ? v[0] : channel == 1 ? v[1] - v[0] : v[0] - v[2]);
                weights += w;
            }
        return sum / weights;
    }

    const Picture& _picture;
    double _ppd;
};

double colourDifference(const Vec3d& a, const Vec3d& b)
{
    // Green: (87.735, -86.183, 83.180); blue: (32.297, 79.187, -107.860)
    const Vec3d green(87.735, -0.87735 * 86.183, 0.87735 * 83.180);
    const Vec3d blue(32.297, 0.32297 * 79.187, -0.32297 * 107.860);
    const auto distance = [](const Vec3d& p, const Vec3d& q) {
        return std::pow(std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]), 0.7);
    };
    const double part = distance(a, b) / distance(green, blue);
    return part < 0.4 ? part * 0.95 / 0.4 : 0.95 + (part - 0.4) / 0.6 * 0.05;
}

double paperFlip(const Picture& a, const Picture& b, int x, int y, double pixelsPerDegree)
{
    const Paper pa(a, pixelsPerDegree);
    const Paper pb(b, pixelsPerDegree);
    const double edge = std::abs(pa.feature(x, y, false) - pb.feature(x, y, false));
    const double point = std::abs(pa.feature(x, y, true) - pb.feature(x, y, true));
    return std::pow(colourDifference(pa.lab(x, y), pb.lab(x, y)), 1.0 - std::sqrt(std::max(edge, point) / std::sqrt(2.0)));
}

}  // namespace

TEST(Flip, IdenticalPicturesGiveZero)
{
    const Picture p = noisyPattern(30, 20, 0.1);
    for (double v : flip(p, p, 0.3).values) EXPECT_EQ(v, 0.0);
    for (double v : hdrFlip(p, p).values) EXPECT_EQ(v, 0.0);
}

TEST(Flip, AgainstDirectSums)
{
    const Picture a = noisyPattern(30, 20, 0.1);
    const Picture b = noisyPattern(30, 20, 0.0);
    for (double pixelsPerDegree : {osgEnvLight::defaultPixelsPerDegree, 20.0}) {
        const ScalarMap map = flip(a, b, 0.0, pixelsPerDegree);
        for (auto [x, y] : {std::pair(0, 0), std::pair(29, 19), std::pair(7, 8), std::pair(15, 9), std::pair(20, 3)})
            // The test's matrix and colours have 6 and 5 digits: 1e-5 measured.
            EXPECT_NEAR(map.at(x, y), paperFlip(a, b, x, y, pixelsPerDegree), 3e-5) << x << ' ' << y;
    }
}

TEST(Flip, GreenAgainstBlueIsTheLargest)
{
    const Picture green = makePicture(8, 8, 0.0, 1.0, 0.0);
    const Picture blue = makePicture(8, 8, 0.0, 0.0, 1.0);
    EXPECT_NEAR(meanFlip(green, blue), 1.0, 1e-12);
    for (const Picture& p : {makePicture(8, 8, 1.0, 0.0, 0.0), makePicture(8, 8, 0.0), makePicture(8, 8, 1.0)}) {
        EXPECT_LT(meanFlip(p, green), 1.0);
        EXPECT_LT(meanFlip(p, blue), 1.0);
    }
}

TEST(Flip, UniformGreys)
{
    // Without edges and colour only the lightness differs.
    for (auto [a, b] : {std::pair(0.0, 1.0), std::pair(0.2, 0.3), std::pair(0.5, 0.5 + 1e-4)}) {
        const double expected = colourDifference(Paper::hunt(a, a, a), Paper::hunt(b, b, b));
        // The primaries' printed digits: 1e-5. Values of a picture are floats: 6e-8 of 1e-4, to the power of .7.
        EXPECT_NEAR(meanFlip(makePicture(5, 4, a), makePicture(5, 4, b)), expected, 1e-4 * expected + 1e-7);
        EXPECT_NEAR(meanFlip(makePicture(1, 1, a), makePicture(1, 1, b)), expected, 1e-4 * expected + 1e-7);
    }
}

TEST(Flip, SymmetricAndMonotone)
{
    const Picture r = noisyPattern(40, 30, 0.0);
    double before = 0.0;
    for (double amplitude : {0.01, 0.03, 0.1, 0.3}) {
        const Picture x = noisyPattern(40, 30, amplitude);
        const double f = meanFlip(x, r);
        EXPECT_DOUBLE_EQ(f, meanFlip(r, x));
        EXPECT_GT(f, before) << amplitude;
        // Seen from farther away, noise is less visible.
        EXPECT_LT(meanFlip(x, r, 2.0 * osgEnvLight::defaultPixelsPerDegree), f);
        before = f;
    }
    EXPECT_THROW(flip(r, Picture(30, 40), 0.0), std::invalid_argument);
}

TEST(Flip, ExposureIsAppliedToBoth)
{
    const Picture a = makePicture(4, 4, 0.05, 0.1, 0.2);
    const Picture b = makePicture(4, 4, 0.1, 0.1, 0.1);
    const Picture a4 = makePicture(4, 4, 0.2, 0.4, 0.8);
    const Picture b4 = makePicture(4, 4, 0.4, 0.4, 0.4);
    EXPECT_NEAR(mean(flip(a, b, 2.0), Mask::everything(a)), meanFlip(a4, b4), 1e-12);
    // What is beyond the display's white in both is the same.
    EXPECT_EQ(mean(flip(a, b, 6.0), Mask::everything(a)), 0.0);
}

TEST(Flip, ExposuresOfHdr)
{
    // .85 of the curve (a x^2 + b x) / (c x^2 + d x + e) is reached where the exposed luminance is x:
    const auto curve = [](double x) {
        const double y = 0.6 * x;
        return y * (2.51 * y + 0.03) / (y * (2.43 * y + 0.59) + 0.14);
    };
    Picture p = makePicture(9, 9, 0.25);
    std::fill_n(p.at(4, 4), 3, 64.0f);
    std::fill_n(p.at(0, 0), 3, 0.0f);
    std::fill_n(p.at(1, 0), 3, std::numeric_limits<float>::quiet_NaN());
    const auto range = flipExposures(p);
    EXPECT_NEAR(curve(64.0 * std::exp2(range.start)), 0.85, 1e-12);
    EXPECT_NEAR(curve(0.25 * std::exp2(range.stop)), 0.85, 1e-12);
    EXPECT_NEAR(range.stop - range.start, 8.0, 1e-12);
    EXPECT_EQ(flipExposures(makePicture(2, 2, 3.0)).count, 2);
    EXPECT_EQ(flipExposures(makePicture(2, 2, 0.0)).count, 1);
    EXPECT_EQ(mean(hdrFlip(makePicture(2, 2, 0.0), makePicture(2, 2, 0.0)), Mask(2, 2, true)), 0.0);
}

TEST(Flip, HdrSeesWhatOneExposureDoesNot)
{
    // A highlight beyond the display's white at the exposure of the rest, and a difference within it.
    const auto highlight = [](double value) {
        return makePicture(24, 16, [=](int x, int) { return x < 16 ? Vec3d(0.2, 0.2, 0.2) : Vec3d(value, value, value); });
    };
    const Picture a = highlight(30.0);
    const Picture b = highlight(60.0);
    EXPECT_EQ(meanFlip(a, b), 0.0);
    EXPECT_GT(hdrFlip(a, b).at(23, 8), 0.1);
    EXPECT_EQ(hdrFlip(a, b).at(0, 8), 0.0);
}

}  // namespace Flip_test
