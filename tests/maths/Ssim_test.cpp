// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <metrics/Display>
#include <metrics/Ssim>

#include <stdexcept>

#include "Maths.h"
#include "Pictures.h"

namespace Ssim_test
{

using namespace testmaths;
using osg::Vec3d;
using osgEnvLight::Mask;
using osgEnvLight::Picture;
using osgEnvLight::ScalarMap;
using osgEnvLight::ssim;

namespace
{

Picture randomPicture(int width, int height, unsigned seed)
{
    Random random(seed);
    return makePicture(width, height, [&](int, int) {
        const double red = random.uniform(), green = random.uniform();
        return Vec3d(red, green, random.uniform());
    });
}

double grey(const Picture& encoded, int x, int y)
{
    const float* p = encoded.at(x, y);
    return 0.2126 * double(p[0]) + 0.7152 * double(p[1]) + 0.0722 * double(p[2]);
}

// The paper's sums over the window, centred moments, nothing separated.
double direct(const Picture& a, const Picture& b, int x, int y)
{
    double weights = 0.0, ma = 0.0, mb = 0.0, va = 0.0, vb = 0.0, cov = 0.0;
    const auto window = [&](auto&& add) {
        for (int j = std::max(y - 5, 0); j <= std::min(y + 5, a.height - 1); ++j)
            for (int i = std::max(x - 5, 0); i <= std::min(x + 5, a.width - 1); ++i)
                add(std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / 4.5), grey(a, i, j), grey(b, i, j));
    };
    window([&](double w, double xa, double xb) { weights += w, ma += w * xa, mb += w * xb; });
    ma /= weights;
    mb /= weights;
    window([&](double w, double xa, double xb) {
        va += w / weights * (xa - ma) * (xa - ma);
        vb += w / weights * (xb - mb) * (xb - mb);
        cov += w / weights * (xa - ma) * (xb - mb);
    });
    return (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
}

double meanSsim(const Picture& a, const Picture& b)
{
    return mean(ssim(a, b, 0.0), Mask::everything(a));
}

}  // namespace

TEST(Ssim, IdenticalPicturesGiveOne)
{
    const Picture p = randomPicture(40, 30, 1);
    const ScalarMap map = ssim(p, p, 1.5);
    for (double v : map.values) EXPECT_EQ(v, 1.0);
    EXPECT_EQ(mean(map, Mask::everything(p)), 1.0);
    EXPECT_EQ(mean(map, Mask(40, 30, false)), 0.0);
}

TEST(Ssim, AgainstDirectSums)
{
    const Picture a = randomPicture(23, 17, 2);
    const Picture b = randomPicture(23, 17, 3);
    const double stops = -0.7;
    const ScalarMap map = ssim(a, b, stops);
    const Picture ea = displayEncoded(a, stops);
    const Picture eb = displayEncoded(b, stops);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            // The moments' difference loses 1e-16 of values about .5; the denominator is 9e-4 at least.
            EXPECT_NEAR(map.at(x, y), direct(ea, eb, x, y), 1e-12) << x << ' ' << y;
}

TEST(Ssim, UniformPictures)
{
    // Only the term of the means is left.
    const auto encode = [](double x) { return glsl::srgbEncode(x); };
    for (auto [x, r] : {std::pair(0.2, 0.5), std::pair(0.0, 1.0), std::pair(0.3, 0.31)}) {
        const double a = encode(x), b = encode(r);
        // What the encoded picture holds are floats: 6e-8
        EXPECT_NEAR(meanSsim(makePicture(12, 12, x), makePicture(12, 12, r)), (2 * a * b + 1e-4) / (a * a + b * b + 1e-4), 3e-7);
    }
    EXPECT_NEAR(meanSsim(makePicture(1, 1, 0.0), makePicture(1, 1, 1.0)), 1e-4 / (1.0 + 1e-4), 1e-12);
}

TEST(Ssim, FallsWithNoise)
{
    const Picture r = makePicture(48, 48, [](int x, int y) {
        const double v = 0.4 + 0.2 * std::sin(0.4 * x) * std::cos(0.3 * y);
        return Vec3d(v, v, v);
    });
    double before = 1.0;
    for (double amplitude : {0.01, 0.03, 0.1, 0.3}) {
        Random random(4);
        const Picture x = makePicture(48, 48, [&](int i, int j) {
            const double d = amplitude * random.uniform(-1.0, 1.0);
            return r.color(i, j) + Vec3d(d, d, d);
        });
        const double s = meanSsim(x, r);
        EXPECT_LT(s, before) << amplitude;
        before = s;
    }
    EXPECT_THROW(ssim(r, Picture(48, 47), 0.0), std::invalid_argument);
}

}  // namespace Ssim_test
