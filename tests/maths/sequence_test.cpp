// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "Maths.h"

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

TEST(sequence, BayerMatrix)
{
    // Bayer 1973
    const int matrix[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) EXPECT_EQ(glsl::bayer4(x, y), matrix[y % 4][x % 4]);
}
