// SPDX-License-Identifier: MIT
// Rays to the points of a sun's disc, through a height map.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "glsl.h"

namespace sunshadow_test
{

namespace
{

const int side = 64;

// A whole map, whose heights stand for 64 units.
class Heights
{
  public:
    explicit Heights(const std::function<double(int x, int y)>& height)
    {
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                for (double h : {height(x, y) / side, height(x, y) / side, 0.0, 0.0}) _texels.push_back(float(h));
    }

    // Height at which a ray from xy over a floor at 8 that moves by slope for each unit of height is blocked. point: that looks,
    // not far off.
    double blocker(glsl::vec2 xy, glsl::vec2 slope) const { return blocker(xy, slope, xy); }
    double blocker(glsl::vec2 xy, glsl::vec2 slope, glsl::vec2 point, double height = 8.0) const
    {
        glsl::SunMap m{glsl::ivec2(0), side, double(side), 1.0, glsl::ivec2(0), glsl::vec2(1.0), glsl::vec2(0.0)};
        glsl::SunReceiver r{glsl::vec3(point, height), glsl::vec2(0.0), 0.05, 3.0};
        return glsl::sunBlocker(glsl::sampler2D{_texels.data(), side, side}, m, r, xy, slope);
    }

  private:
    std::vector<float> _texels;
};

const double floorHeight = 8.0;

}  // namespace

// A wall's foot at x = 10, where the floor ends: the map shows the wall before it, and beyond it nothing.
TEST(sunshadow, ATexelWithoutTheReceiversSurfaceSaysNothing)
{
    const Heights wall([](int x, int) { return x < 10 ? 20.0 : 0.0; });
    for (const double across : {9.2, 9.8, 10.0, 10.3})
        EXPECT_GT(wall.blocker({across, 16.3}, {0.0, 0.0}, {9.9, 16.4}), 0.0) << across;
    const Heights table([](int x, int) { return x < 10 ? floorHeight : 0.0; });
    for (const double across : {9.2, 9.8, 10.0, 10.3})
        EXPECT_LT(table.blocker({across, 16.3}, {0.0, 0.0}, {9.9, 16.4}), 0.0) << across;
}

// The map shows a table alone. A receiver lies far below it. The table hides the sun; where the map shows nothing, nothing does.
TEST(sunshadow, BelowAllThatAMapShowsWhatItShowsHides)
{
    const Heights table([](int x, int y) { return x < 10 && y < 32 ? 20.0 : SUN_NOTHING * side; });
    for (const double height : {-1.0, -100.0, -1e4}) {
        EXPECT_NEAR(20.0 - height, table.blocker({5.5, 16.5}, {0.0, 0.0}, {5.5, 16.5}, height), 1e-9) << height;
        EXPECT_LT(table.blocker({20.5, 16.5}, {0.0, 0.0}, {20.5, 16.5}, height), 0.0) << height;
        EXPECT_LT(table.blocker({-50.5, 16.5}, {0.0, 0.0}, {-50.5, 16.5}, height), 0.0) << height;
        // Towards the table's middle, from beside the map
        const double rise = 20.0 - height;
        EXPECT_NEAR(rise, table.blocker({-20.5, 16.5}, {26.0 / rise, 0.0}, {-20.5, 16.5}, height), 5e-2 * rise) << height;
    }
}

// A sheet hides a floor and crosses it at x = 10. The texel there shows the sheet, which is as high as the floor.
TEST(sunshadow, ASheetHidesAFloorUpToWhereTheyMeet)
{
    const Heights wall([](int x, int) { return floorHeight + 2.0 * (10 - x); });
    for (const double across : {9.2, 9.8, 10.3, 10.9})
        EXPECT_GT(wall.blocker({across, 16.3}, {0.0, 0.0}, {9.9, 16.4}), 0.0) << across;
    // The sun sees the floor at the sheet's foot: nothing hides it.
    const Heights before([](int x, int) { return x < 10 ? floorHeight + 2.0 * (10 - x) : floorHeight; });
    for (const double across : {10.3, 10.9, 11.2})
        EXPECT_LT(before.blocker({across, 16.3}, {0.0, 0.0}, {10.9, 16.4}), 0.0) << across;
}

// The disc cut into 16 parts of the same area: each holds its share of a cell's points.
TEST(sunshadow, PointsCoverTheDiscEvenly)
{
    // Pairs look where penumbrae are, and may lie off the middle by a part of the disc.
    for (const auto& [count, off] : {std::pair(2, 0.06), std::pair(16, 0.02)}) {
        glsl::vec2 mean(0.0);
        double square = 0.0;
        std::vector<int> parts(16, 0);
        for (int group = 0; group < 16; ++group)
            for (int k = 0; k < count; ++k) {
                const glsl::vec2 p = glsl::sunDiscPoint(k, count, group);
                const double r2 = glm::dot(p, p);
                ASSERT_LE(r2, 1.0);
                mean += p / (16.0 * count);
                square += r2 / (16.0 * count);
                const int ring = std::min(int(4.0 * r2), 3);
                const int sector = std::min(int((std::atan2(p.y, p.x) / (2.0 * glsl::PI) + 0.5) * 4.0), 3);
                ++parts[size_t(4 * ring + sector)];
            }
        EXPECT_LT(glm::length(mean), off) << count;
        EXPECT_NEAR(square, 0.5, 0.02) << count;
        for (int n : parts) EXPECT_EQ(n, count) << count;
    }
}

// A pixel's own points lie on all sides and at all radii of the disc: the mean of any half of it is off by little.
TEST(sunshadow, PointsOfAPixelBalance)
{
    for (const auto& [count, most] : {std::pair(2, 0.36), std::pair(16, 0.09)})
        for (int group = 0; group < 16; ++group) {
            glsl::vec2 mean(0.0);
            for (int k = 0; k < count; ++k) mean += glsl::sunDiscPoint(k, count, group) / double(count);
            EXPECT_LT(glm::length(mean), most) << count << " " << group;
        }
}

TEST(sunshadow, NothingAboveAFloorBlocks)
{
    const Heights flat([](int, int) { return floorHeight; });
    for (double angle = 0.0; angle < 6.0; angle += 0.5)
        EXPECT_LT(flat.blocker(glsl::vec2(31.3, 30.8), 0.1 * glsl::vec2(std::cos(angle), std::sin(angle))), 0.0);
    EXPECT_LT(flat.blocker(glsl::vec2(31.3, 30.8), glsl::vec2(0.0)), 0.0);
}

// A sheet over x < 32 at any height: rays that leave from beneath it pass its edge where it is, those that come from beside it
// meet it, whatever the intervals they are followed in.
TEST(sunshadow, ASheetsEdgeIsWhereItIs)
{
    for (double above : {2.0, 7.0, 19.0, 48.0}) {
        const Heights sheet([&](int x, int) { return x < 32 ? floorHeight + above : floorHeight; });
        for (double slope : {-0.2, -0.09, -0.03, 0.03, 0.09, 0.2})
            for (double x = 20.25; x < 44.0; x += 0.5) {
                const double there = x + slope * above;
                // Within SUN_STEEP of the floor it is one with it, and its edge known to a texel.
                if (std::abs(there - 32.0) < (above < 10.0 ? 1.0 : 0.01)) continue;
                const double b = sheet.blocker(glsl::vec2(x, 30.5), glsl::vec2(slope, 0.0));
                if (there < 32.0)
                    EXPECT_NEAR(b, above, 1e-5) << "above " << above << " slope " << slope << " x " << x;
                else
                    EXPECT_LT(b, 0.0) << "above " << above << " slope " << slope << " x " << x;
            }
    }
}

// What rises no further above the receiver's plane than rounding does is the receiver itself; a body whose middle is below
// the plane is another's only well above it.
TEST(sunshadow, TheReceiversOwnPlaneHidesNothing)
{
    const glsl::SunReceiver r{glsl::vec3(10.5, 10.5, 8.0), glsl::vec2(2.0, 0.0), 0.1, 3.0};
    const auto hides = [&](double first, double middle, double x) {
        return glsl::sunHides(r, glsl::vec4(first, middle, x, 10.5));
    };
    EXPECT_FALSE(hides(10.0, 10.0, 11.5));  // on it
    EXPECT_FALSE(hides(10.09, 10.09, 11.5));
    EXPECT_TRUE(hides(10.2, 10.2, 11.5));
    EXPECT_FALSE(hides(12.0, 7.0, 11.5));
    EXPECT_TRUE(hides(13.2, 7.0, 11.5));
}

TEST(sunshadow, BeyondAMapTheWholeScenesServes)
{
    // Two maps side by side: of the whole scene, and of its middle quarter, of half the texel.
    std::vector<float> texels;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x)
            for (float h : {x < 4 ? 0.25f : 0.5f, 0.125f, 0.0f, 0.0f}) texels.push_back(h);
    const glsl::sampler2D maps{texels.data(), 8, 4};
    const glsl::SunMap m{glsl::ivec2(4, 0), 4, 16.0, 1.0, glsl::ivec2(0, 0), glsl::vec2(0.5), glsl::vec2(1.0)};
    EXPECT_EQ(glsl::vec4(8.0, 2.0, 1.5, 2.5), glsl::sunSurface(maps, m, glsl::vec2(1.2, 2.9)));
    EXPECT_EQ(glsl::vec4(4.0, 2.0, 5.0, 3.0), glsl::sunSurface(maps, m, glsl::vec2(4.3, 2.9)));  // texel (3, 2) of the whole
    EXPECT_LT(glsl::sunSurface(maps, m, glsl::vec2(6.1, 2.9)).x, 0.0);                           // beyond both
}

}  // namespace sunshadow_test
