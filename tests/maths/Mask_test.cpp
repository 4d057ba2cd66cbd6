// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <metrics/Mask>

#include <cmath>
#include <stdexcept>

#include "Pictures.h"

namespace Mask_test
{

using namespace testmaths;
using osg::Vec3d;
using osgEnvLight::Mask;
using osgEnvLight::Picture;
using osgEnvLight::withoutEdges;

namespace
{

const int width = 24;
const int height = 16;

Picture facing()
{
    return makePicture(width, height, 0.0, 0.0, 1.0);
}

Picture flatDepth(double depth = 5.0)
{
    return makePicture(width, height, depth, 0.0, 0.0);
}

// What remains, column by column, must not depend on the row.
std::string columns(const Mask& mask)
{
    std::string row;
    for (int x = 0; x < mask.width; ++x) {
        row += mask.at(x, 0) ? '#' : '.';
        for (int y = 1; y < mask.height; ++y) EXPECT_EQ(mask.at(x, y), mask.at(x, 0)) << x << ' ' << y;
    }
    return row;
}

}  // namespace

TEST(Mask, GeometryAndBoth)
{
    Picture p = facing();
    for (int x = 0; x < width; ++x) p.at(x, 3)[3] = 0.0f;
    p.at(5, 4)[3] = 0.25f;
    const Mask geometry = Mask::geometry(p);
    EXPECT_EQ(geometry.pixels(), size_t(width * (height - 1)));
    EXPECT_FALSE(geometry.at(7, 3));
    EXPECT_TRUE(geometry.at(5, 4));
    EXPECT_EQ(Mask::everything(p).pixels(), size_t(width * height));
    EXPECT_EQ((geometry & Mask::everything(p)).pixels(), geometry.pixels());
    EXPECT_EQ((geometry & Mask(width, height, false)).pixels(), 0u);
    EXPECT_EQ(Mask().pixels(), 0u);
    EXPECT_THROW(geometry & Mask(width, height + 1, true), std::invalid_argument);
    EXPECT_THROW(withoutEdges(geometry, p, Picture(1, 1)), std::invalid_argument);
    EXPECT_THROW(withoutEdges(geometry, Picture(1, 1), p), std::invalid_argument);
}

TEST(Mask, Unmarked)
{
    Picture marks(3, 1);
    marks.at(1, 0)[0] = 0.25f;
    marks.at(2, 0)[1] = 1.0f;  // not red
    const Mask mask = Mask::unmarked(marks);
    EXPECT_TRUE(mask.at(0, 0));
    EXPECT_FALSE(mask.at(1, 0));
    EXPECT_TRUE(mask.at(2, 0));
}

TEST(Mask, CoverageEdge)
{
    Picture p = facing();
    for (int y = 0; y < height; ++y)
        for (int x = 10; x < width; ++x) p.at(x, y)[3] = 0.0f;
    EXPECT_EQ(columns(withoutEdges(Mask::geometry(p), p, flatDepth())), "#########...............");
}

TEST(Mask, DepthStep)
{
    const auto stepAt = [](int column, double far) {
        const Picture depth = makePicture(width, height, [=](int x, int) { return Vec3d(x < column ? 5.0 : far, 0.0, 0.0); });
        return columns(withoutEdges(Mask::everything(depth), facing(), depth));
    };
    EXPECT_EQ(stepAt(10, 5.1), "#########..#############");
    EXPECT_EQ(stepAt(10, 5.04), std::string(width, '#'));
    // At the border, the line through the next pixel inside decides.
    EXPECT_EQ(stepAt(1, 6.0), "..######################");
    EXPECT_EQ(stepAt(width - 1, 6.0), "######################..");
}

TEST(Mask, SlantedPlanesHaveNoEdges)
{
    // The depth of a plane n.p = 1 along the ray (x, y, 1): 1 / (n.(x, y, 1)). The nearest rows change by a quarter a pixel.
    const Picture depth =
        makePicture(width, height, [](int x, int y) { return Vec3d(1.0 / (0.03 * x + 0.2 * y + 0.6), 0.0, 0.0); });
    EXPECT_EQ(withoutEdges(Mask::everything(depth), facing(), depth).pixels(), size_t(width * height));
}

TEST(Mask, DepthStepAlongADiagonalAndAcrossRows)
{
    const Picture diagonal = makePicture(width, height, [](int x, int y) { return Vec3d(x < y ? 5.0 : 6.0, 0.0, 0.0); });
    const Mask d = withoutEdges(Mask::everything(diagonal), facing(), diagonal);
    const Picture rows = makePicture(width, height, [](int, int y) { return Vec3d(y < 8 ? 5.0 : 6.0, 0.0, 0.0); });
    const Mask r = withoutEdges(Mask::everything(rows), facing(), rows);
    for (int y = 2; y < height - 2; ++y)
        for (int x = 2; x < width - 2; ++x) {
            // Of the 8 neighbours the farthest across is a diagonal one: x - y changes by 2.
            EXPECT_EQ(d.at(x, y), x - y > 1 || x - y < -2) << x << ' ' << y;
            EXPECT_EQ(r.at(x, y), y != 7 && y != 8) << x << ' ' << y;
        }
}

TEST(Mask, NormalEdge)
{
    const auto turnAt10 = [](double angle) {
        // Any length will do.
        const Picture p = makePicture(width, height, [=](int x, int) {
            return x < 10 ? Vec3d(0.0, 0.0, 0.3) : Vec3d(std::sin(angle), 0.0, std::cos(angle));
        });
        return columns(withoutEdges(Mask::everything(p), p, flatDepth()));
    };
    EXPECT_EQ(turnAt10(0.36), "#########..#############");
    EXPECT_EQ(turnAt10(0.34), std::string(width, '#'));
    EXPECT_EQ(turnAt10(3.1), "#########..#############");
}

TEST(Mask, TinyPictures)
{
    for (auto [w, h] : {std::pair(1, 1), std::pair(2, 1), std::pair(1, 5), std::pair(2, 2)}) {
        const Picture p = makePicture(w, h, 1.0);
        EXPECT_EQ(withoutEdges(Mask::everything(p), p, p).pixels(), size_t(w * h));
    }
    EXPECT_EQ(withoutEdges(Mask(), Picture(), Picture()).pixels(), 0u);
}

}  // namespace Mask_test
