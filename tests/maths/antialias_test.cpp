// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

#include <functional>

namespace antialias_test
{

using namespace testmaths;
using glsl::ivec2;
using glsl::vec4;

namespace
{

const int size = 64;

// A picture of display values, and what smoothing makes of it.
class Smoothed
{
  public:
    explicit Smoothed(const std::function<double(double, double)>& value) : _texels(size_t(4 * size * size), 1.0f)
    {
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                for (int k = 0; k < 3; ++k) _texels[size_t(4 * (y * size + x) + k)] = float(value(x + 0.5, y + 0.5));
    }

    double before(int x, int y) const { return double(_texels[size_t(4 * (y * size + x))]); }

    double after(int x, int y) const
    {
        const glsl::sampler2D picture{_texels.data(), size, size};
        const glsl::EdgeShift shift = glsl::edgeShift(picture, ivec2(x, y));
        EXPECT_GE(shift.share, 0.0);
        EXPECT_LE(shift.share, 0.5);
        return (1.0 - shift.share) * before(x, y) + shift.share * before(x + shift.side.x, y + shift.side.y);
    }

  private:
    std::vector<float> _texels;
};

// Mean over a pixel.
double covered(const std::function<double(double, double)>& value, int x, int y)
{
    const int n = 32;
    double sum = 0.0;
    for (int i = 0; i < n * n; ++i) sum += value(x + (i % n + 0.5) / n, y + (i / n + 0.5) / n);
    return sum / (n * n);
}

struct Error {
    double before = 0.0;
    double after = 0.0;
};

// Root mean square over the picture, without a margin.
Error errorOf(const std::function<double(double, double)>& value)
{
    const Smoothed picture(value);
    Error e;
    for (int y = 16; y < size - 16; ++y)
        for (int x = 16; x < size - 16; ++x) {
            const double truth = covered(value, x, y);
            e.before += std::pow(picture.before(x, y) - truth, 2.0);
            e.after += std::pow(picture.after(x, y) - truth, 2.0);
        }
    return {std::sqrt(e.before), std::sqrt(e.after)};
}

}  // namespace

// A straight edge at any angle comes nearer to what each pixel is covered by. At 45 degrees, where all steps are one pixel long,
// all pixels of the edge look alike, and nothing tells where in them it runs: measured .77 of the error at 44 degrees.
TEST(antialias, StraightEdgesAreCoverage)
{
    for (const double dark : {0.0, 0.5})
        for (int degrees = 2; degrees < 180; degrees += 7) {
            const double a = degrees * pi / 180.0;
            const auto edge = [&](double x, double y) {
                return (x - size / 2.3) * std::sin(a) - (y - size / 2.1) * std::cos(a) > 0.0 ? 0.9 : dark;
            };
            const Error e = errorOf(edge);
            EXPECT_LT(e.after, 0.8 * e.before) << degrees << " " << dark;
        }
}

TEST(antialias, LongStepsBecomeRamps)
{
    const auto edge = [](double x, double y) { return y - 32.0 > (x - 32.0) / 8.0 ? 1.0 : 0.0; };
    const Error e = errorOf(edge);
    EXPECT_LT(e.after, 0.1 * e.before);
}

TEST(antialias, WhatHasNoStepsStays)
{
    const std::function<double(double, double)> pictures[] = {
        [](double, double) { return 0.5; },                        // even
        [](double x, double y) { return 0.2 + 0.005 * (x + y); },  // a shaded surface
        [](double x, double) { return x > 32.0 ? 1.0 : 0.0; },     // edges along pixels
        [](double, double y) { return y > 32.0 ? 1.0 : 0.0; },
        [](double x, double y) { return 0.5 + 0.015 * std::cos(3 * x) * std::sin(2 * y); },  // noise below what is seen
    };
    for (const auto& picture : pictures) {
        const Smoothed smoothed(picture);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) ASSERT_EQ(smoothed.before(x, y), smoothed.after(x, y)) << x << " " << y;
    }
}

// Never beyond its neighbours, whatever the picture: a checkerboard, single pixels, a corner of the picture.
TEST(antialias, MixesNeighboursOnly)
{
    const std::function<double(double, double)> pictures[] = {
        [](double x, double y) { return (int(x) + int(y)) % 2 ? 1.0 : 0.0; },
        [](double x, double y) { return int(x) % 7 == 3 && int(y) % 5 == 2 ? 1.0 : 0.0; },
        [](double x, double y) { return std::hypot(x, y) < 20.0 ? 1.0 : 0.0; },
    };
    for (const auto& picture : pictures) {
        const Smoothed smoothed(picture);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double after = smoothed.after(x, y);
                ASSERT_GE(after, 0.0);
                ASSERT_LE(after, 1.0);
            }
    }
}

}  // namespace antialias_test
