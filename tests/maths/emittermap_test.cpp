// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "glsl.h"

namespace emittermap_test
{

namespace
{

glsl::EmitterMap wideMap(int size)
{
    glsl::EmitterMap m;
    m.window = glsl::vec2(0, 0);
    m.tangent = glsl::EMITTER_MAP_TANGENT;
    m.nearest = 0.01;
    m.octaves = 12.0;
    m.corner = glsl::ivec2(0, 0);
    m.size = size;
    return m;
}

// The map of a plane without a back: its first surface at each texel's centre, 16 bits a number.
class PlaneMap
{
  public:
    PlaneMap(const glsl::EmitterMap& m, const glsl::vec3& normal, double offset) : texels(size_t(4 * m.size * m.size))
    {
        const double width = glsl::emitterTexelWidth(m);
        const glsl::vec2 gradient = glsl::vec2(normal.x, normal.y) * (m.nearest * width / offset);
        for (int y = 0; y < m.size; ++y)
            for (int x = 0; x < m.size; ++x) {
                const glsl::vec3 ray((x + 0.5) * width - m.tangent, (y + 0.5) * width - m.tangent, 1.0);
                const double height = m.nearest * glsl::dot(normal, ray) / offset;
                glsl::vec2 texel(0.0);
                if (height > 0.0)
                    texel = glsl::emitterTexel(1.0 - height, 1.0, glsl::vec3(glsl::length(gradient), 0.0, glsl::turnOf(gradient)),
                                               width, m.octaves);
                for (int i = 0; i < 2; ++i)
                    texels[size_t(4 * (y * m.size + x) + i)] = float(std::round(texel[i] * 65535.0) / 65535.0);
            }
        sampler = {texels.data(), m.size, m.size};
    }

    std::vector<float> texels;
    glsl::sampler2D sampler;
};

}  // namespace

// 16 bits, at a thousandth and at a thousand times the nearest distance.
TEST(emittermap, HeightsKeepTheirShareAtAnyDistance)
{
    for (double height : {1.0, 0.3, 1e-2, 1e-3}) {
        const double code = std::round(glsl::packedHeight(height, 12.0) * 65535.0) / 65535.0;
        EXPECT_NEAR(1.0, glsl::unpackedHeight(code, 12.0) / height, 0.5 * 12.0 * std::log(2.0) / 65535.0 * 1.001) << height;
    }
    EXPECT_EQ(0.0, glsl::packedHeight(0.0, 12.0));
    EXPECT_EQ(0.0, glsl::unpackedHeight(0.0, 12.0));
    EXPECT_EQ(0.0, glsl::packedHeight(1e-9, 12.0));  // beyond the farthest
}

TEST(emittermap, PlaceIsThePerspectiveOne)
{
    const glsl::EmitterMap m = wideMap(128);
    const glsl::vec3 middle = glsl::emitterMapPlace(m, glsl::vec3(0, 0, 3));
    EXPECT_NEAR(64.0, middle.x, 1e-12);
    EXPECT_NEAR(64.0, middle.y, 1e-12);
    EXPECT_NEAR(0.01 / 3.0, middle.z, 1e-12);
    EXPECT_NEAR(128.0 * 0.75, glsl::emitterMapPlace(m, glsl::vec3(3, 0, 3)).x, 1e-12);
    for (const glsl::vec3& out : {glsl::vec3(0, 0, 0), glsl::vec3(0, 0, -1), glsl::vec3(6.001, 0, 3), glsl::vec3(0, -6.001, 3)})
        EXPECT_EQ(0.0, glsl::emitterMapPlace(m, out).z);
}

// Height at the texel's centre, by the ray through it.
TEST(emittermap, RiseIsThatOfThePlane)
{
    const glsl::EmitterMap m = wideMap(64);
    const glsl::vec3 p(0.7, -1.1, 2.0), n = glsl::normalize(glsl::vec3(0.3, 0.2, -0.9));
    const glsl::vec3 place = glsl::emitterMapPlace(m, p);
    const glsl::vec2 xy(place.x, place.y), center = glsl::floor(xy) + 0.5;
    const double width = glsl::emitterTexelWidth(m);
    const glsl::vec3 ray(center.x * width - m.tangent, center.y * width - m.tangent, 1.0);
    const double atCenter = m.nearest * glsl::dot(n, ray) / glsl::dot(n, p);
    EXPECT_NEAR(atCenter / place.z - 1.0, glsl::emitterMapRise(m, p, n, center - xy), 1e-12);
    EXPECT_EQ(0.0, glsl::emitterMapRise(m, p, -n, center - xy));  // it faces away
}

// A floor without a back, level and aslant, does not shade itself anywhere; a point a texel below it does.
TEST(emittermap, ASheetIsSeenAndHidesWhatLiesBehindIt)
{
    const glsl::EmitterMap m = wideMap(64);
    for (double tilt : {0.0, 0.4, 1.0}) {
        const glsl::vec3 n(std::sin(tilt), 0.0, -std::cos(tilt));
        const double offset = -2.0 * std::cos(tilt);  // through (0, 0, 2)
        const PlaneMap map(m, n, offset);
        int wrong = 0, leaks = 0, count = 0;
        for (int i = 0; i < 4000; ++i) {
            const double s = 3.8 * ((i * 0.61803398875) - std::floor(i * 0.61803398875)) - 1.9, t = 3.8 * (i / 4000.0) - 1.9;
            const glsl::vec3 ray(s, t, 1.0);
            const double distance = offset / glsl::dot(n, ray);
            if (!(distance > 0.0) || distance > 20.0) continue;
            const auto sees = [&](const glsl::vec3& p) {
                const glsl::vec3 place = glsl::emitterMapPlace(m, p);
                return place.z > 0.0 ? glsl::emitterMapLinearShare(map.sampler, m, p, n, place) : 1.0;
            };
            const glsl::vec3 on = distance * ray;
            const double texel = glsl::emitterTexelWidth(m) * on.z;
            const double cosine = std::abs(glsl::dot(n, glsl::normalize(on)));
            ++count;
            wrong += sees(glsl::atlasLookupPoint(on, n, cosine, texel)) < 1.0 - 1e-12 ? 1 : 0;
            leaks += sees(on - n * (4.0 * texel)) > 0.0 ? 1 : 0;
        }
        ASSERT_GT(count, 1000);
        EXPECT_EQ(0, wrong) << tilt;
        EXPECT_EQ(0, leaks) << tilt;
    }
}

TEST(emittermap, SplineWeightsAreAPartition)
{
    for (double d = -0.5; d <= 0.5; d += 0.0625) {
        double sum = 0.0, mean = 0.0;
        for (int side = -1; side <= 1; ++side) {
            EXPECT_GE(glsl::splineWeight(side, d), 0.0);
            sum += glsl::splineWeight(side, d);
            mean += side * glsl::splineWeight(side, d);
        }
        EXPECT_NEAR(1.0, sum, 1e-15);
        EXPECT_NEAR(d, mean, 1e-15);
    }
}

// A sheet before half of the view: its shadow on a plane behind it, level and aslant, goes from none to all within so many texels
// on either side, half-way at its edge. The plane shades itself nowhere.
template <class Share>
void expectSmoothEdge(const Share& share, double reach)
{
    const glsl::EmitterMap m = wideMap(64);
    for (double tilt : {0.0, 0.5, 1.1}) {
        const glsl::vec3 n(std::sin(tilt), 0.0, -std::cos(tilt));
        const double offset = -2.0 * std::cos(tilt);
        PlaneMap map(m, n, offset);
        const PlaneMap sheet(m, glsl::vec3(0, 0, -1), -0.5);  // at distance 1/2
        for (size_t i = 0; i < map.texels.size(); ++i)
            if (i / 4 % 64 < 32) map.texels[i] = sheet.texels[i];
        const auto at = [&](double texels) {
            const glsl::vec3 ray(texels * glsl::emitterTexelWidth(m), 0.3, 1.0);
            const glsl::vec3 p = ray * (offset / glsl::dot(n, ray));
            return share(map.sampler, m, p, n, glsl::emitterMapPlace(m, p));
        };
        double before = 0.0;
        for (int i = 0; i < 400; ++i) {
            const double texels = (i - 200) / 40.0;  // from the edge
            const double seen = at(texels);
            if (texels < -reach) {
                EXPECT_EQ(0.0, seen) << tilt << " " << texels;
            }
            if (texels > reach) {
                EXPECT_NEAR(1.0, seen, 1e-12) << tilt << " " << texels;
            }
            EXPECT_GE(seen, before - 1e-12) << tilt << " " << texels;
            before = seen;
        }
        EXPECT_NEAR(0.5, at(0.0), 1e-12) << tilt;
    }
}

TEST(emittermap, AShadowsEdgeIsSmooth)
{
    expectSmoothEdge(glsl::emitterMapShare, 1.5);
    expectSmoothEdge(glsl::emitterMapLinearShare, 0.5);
}

}  // namespace emittermap_test
