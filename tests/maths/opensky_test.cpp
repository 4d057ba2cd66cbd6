// SPDX-License-Identifier: MIT
// What is left of the sky when sectors of slices are blocked.
#include <gtest/gtest.h>

#include "glsl.h"

namespace opensky_test
{

namespace
{

// Slices about the view ray, whose receiver leans by tilt in the first one's plane.
glsl::Slices slicesAbout(const glsl::vec3& normal, int count)
{
    glsl::Slices r;
    r.view = glsl::vec3(0, 0, 1);
    r.count = count;
    for (int i = 0; i < count; ++i) {
        const double azimuth = glsl::PI * i / count;
        glsl::Slice& s = r.slice[i];
        s.along = glsl::vec3(std::cos(azimuth), std::sin(azimuth), 0.0);
        s.tilt = std::atan2(glm::dot(normal, s.along), glm::dot(normal, r.view));
        s.phase = 0.5;
        s.bits = 0;
    }
    return r;
}

}  // namespace

// Of a hemisphere weighted by cosine the mean direction is two thirds of the normal.
TEST(opensky, AllOfItIsOpenWhereNothingIs)
{
    for (const glsl::vec3& n : {glsl::vec3(0, 0, 1), glm::normalize(glsl::vec3(0.5, 0.3, 0.8))}) {
        const glsl::vec4 open = glsl::openSky(slicesAbout(n, 4), n);
        EXPECT_NEAR(open.w, 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(glsl::vec3(open), n), 2.0 / 3.0, 0.01);
        EXPECT_LT(glm::length(glm::cross(glsl::vec3(open), n)), 0.01);
    }
}

// Behind a wall as high as the sky: half of it, and its mean leans away by 4 / (3 pi).
TEST(opensky, HalfOfItBehindAWall)
{
    const glsl::vec3 n(0, 0, 1);
    glsl::Slices r = slicesAbout(n, 4);
    for (int i = 0; i < 4; ++i) r.slice[i].bits = 0x0000ffffu;  // against `along`: x < 0, and y < 0 for the slice along y
    r.slice[3].bits = 0xffff0000u;                              // that along (-1, 1)
    const glsl::vec4 open = glsl::openSky(r, n);
    EXPECT_NEAR(open.w, 0.5, 1e-12);
    EXPECT_NEAR(open.z, 1.0 / 3.0, 0.01);
    EXPECT_GT(open.x, 0.1);
    EXPECT_EQ(glsl::openSky(slicesAbout(n, 2), n).w, 1.0);
}

TEST(opensky, NothingIsOpenWhereAllIsBlocked)
{
    glsl::Slices r = slicesAbout(glsl::vec3(0, 0, 1), 2);
    r.slice[0].bits = r.slice[1].bits = 0xffffffffu;
    EXPECT_EQ(glsl::openSky(r, glsl::vec3(0, 0, 1)), glsl::vec4(0.0));
}

// All below the highest blocked sector of a side is blocked; the other side and what is above is not.
TEST(opensky, HorizonsFillWhatIsBelowThem)
{
    glsl::Slice s;
    s.tilt = 0.0;  // the view ray lies between sectors 15 and 16
    s.phase = 0.5;
    const auto filled = [&](unsigned bits) {
        s.bits = bits;
        return glsl::belowHorizons(s).bits;
    };
    EXPECT_EQ(filled(0u), 0u);
    EXPECT_EQ(filled(0x00000010u), 0x0000001fu);
    EXPECT_EQ(filled(0x04000000u), 0xfc000000u);
    EXPECT_EQ(filled(0x08000041u), 0xf800007fu);
    EXPECT_EQ(filled(0x80008001u), 0x8000ffffu);
    s.tilt = 0.5 * glsl::PI;  // seen along the surface: the view ray is the left horizon, all sectors are right of it
    EXPECT_EQ(filled(0x00000100u), 0xffffff00u);
    s.tilt = -0.5 * glsl::PI;
    EXPECT_EQ(filled(0x00000100u), 0x000001ffu);
}

}  // namespace opensky_test
