// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "Maths.h"

namespace sequence_test
{

using namespace testmaths;
using glsl::vec2;

TEST(sequence, RadicalInverseBitByBit)
{
    Random random(12);
    for (int i = 0; i < 10000; ++i) {
        const auto n = static_cast<std::uint32_t>(random.uniform() * 4294967296.0);
        double exact = 0.0;
        for (unsigned bit = 0; bit < 24; ++bit) exact += ((n >> bit) & 1u) * std::ldexp(1.0, -1 - int(bit));
        EXPECT_EQ(glsl::radicalInverse(n), exact);
    }
    EXPECT_EQ(glsl::radicalInverse(0), 0.0);
    EXPECT_EQ(glsl::radicalInverse(0xffffffffu), 1.0 - std::ldexp(1.0, -24));
}

TEST(sequence, HammersleyHasOnePointInEachElementaryInterval)
{
    for (unsigned k : {0u, 1u, 4u, 10u}) {
        const unsigned n = 1u << k;
        for (unsigned a = 0; a <= k; ++a) {
            std::set<std::pair<int, int>> cells;
            for (unsigned i = 0; i < n; ++i) {
                const vec2 p = glsl::hammersley(i, n);
                cells.insert({int(p.x * (1u << a)), int(p.y * (1u << (k - a)))});
            }
            EXPECT_EQ(cells.size(), n) << k << " " << a;
        }
    }
}

TEST(sequence, HammersleyStaysInsideTheSquare)
{
    for (unsigned n : {1u, 2u, 3u, 5u, 16u, 17u, 1000u, 4097u})
        for (unsigned i = 0; i < n; ++i) {
            const vec2 p = glsl::hammersley(i, n);
            EXPECT_GT(p.x, 0.0);
            EXPECT_LT(p.x, 1.0);
            EXPECT_GT(p.y, 0.0);
            EXPECT_LT(p.y, 1.0) << i << " of " << n;
        }
}

namespace
{

// How unevenly points lie in the torus [0,1)^2: the root mean square error that they leave in integrating functions of period 1,
// times their number [Sloan, Joe 1994, P_2].
double unevenness(const std::vector<vec2>& points)
{
    const auto kernel = [](double d) {
        const double t = d - std::floor(d);
        return 1.0 + 2.0 * pi * pi * (t * t - t + 1.0 / 6.0);
    };
    double sum = 0.0;
    for (const vec2& a : points)
        for (const vec2& b : points) sum += kernel(a.x - b.x) * kernel(a.y - b.y);
    const double n = double(points.size());
    return std::sqrt(sum / (n * n) - 1.0) * n;
}

}  // namespace

// Each pixel's, and all of a cell's: no worse than Hammersley's of as many, by more than a tenth (measured: .0501 at 4 a pixel).
TEST(sequence, CellPointsAreEvenInAPixelAndInACell)
{
    for (const int n : {4, 8, 16, 32}) {
        std::vector<vec2> cell, hammersley;
        for (int pixel = 0; pixel < 16; ++pixel) {
            std::vector<vec2> own, reference;
            for (int j = 0; j < n; ++j) {
                own.push_back(glsl::cellPoint(j, pixel, n));
                reference.push_back(glsl::hammersley(unsigned(j), unsigned(n)));
            }
            EXPECT_LE(unevenness(own), 1.1 * unevenness(reference)) << n << " of pixel " << pixel;
            cell.insert(cell.end(), own.begin(), own.end());
        }
        for (unsigned i = 0; i < cell.size(); ++i) hammersley.push_back(glsl::hammersley(i, unsigned(cell.size())));
        EXPECT_LE(unevenness(cell), 1.1 * unevenness(hammersley)) << n;
    }
}

TEST(sequence, BayerMatrix)
{
    // Bayer 1973
    const int matrix[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) EXPECT_EQ(glsl::bayer4(x, y), matrix[y % 4][x % 4]);
}

// Means and variances of numbers side by side, and of their products: 1/2, 1/12, 1/4; 65536 of them leave .005.
TEST(sequence, PixelNumbersHaveNothingInCommon)
{
    double sum = 0.0, square = 0.0, across = 0.0, up = 0.0;
    const unsigned side = 256;
    for (unsigned y = 0; y < side; ++y)
        for (unsigned x = 0; x < side; ++x) {
            const double n = glsl::pixelNumber(x, y);
            EXPECT_TRUE(n >= 0.0 && n < 1.0);
            sum += n;
            square += (n - 0.5) * (n - 0.5);
            across += n * glsl::pixelNumber(x + 1, y);
            up += n * glsl::pixelNumber(x, y + 1);
        }
    const double count = side * side;
    EXPECT_NEAR(sum / count, 0.5, 0.005);
    EXPECT_NEAR(square / count, 1.0 / 12.0, 0.005);
    EXPECT_NEAR(across / count, 0.25, 0.005);
    EXPECT_NEAR(up / count, 0.25, 0.005);
}

// Each 2^m points from a multiple of that on are a net: one in each rectangle of that area whose sides are halves of halves.
TEST(sequence, SobolPointsAreNets)
{
    for (int m = 0; m <= 10; ++m) {
        const unsigned count = 1u << m;
        for (const unsigned first : {0u, count, 5u * count})
            for (int columns = 0; columns <= m; ++columns) {
                std::vector<bool> taken(count);
                for (unsigned i = first; i < first + count; ++i) {
                    const glsl::vec2 p = glsl::sobolPoint(i);
                    ASSERT_TRUE(p.x >= 0.0 && p.x < 1.0 && p.y >= 0.0 && p.y < 1.0);
                    const auto x = unsigned(p.x * (1 << columns)), y = unsigned(p.y * (1 << (m - columns)));
                    taken[(y << columns) + x] = true;
                }
                EXPECT_EQ(std::count(taken.begin(), taken.end(), true), count) << first << " " << columns;
            }
    }
}

}  // namespace sequence_test
