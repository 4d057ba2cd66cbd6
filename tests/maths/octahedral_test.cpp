// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lights/MapTextures.h"

#include "Maths.h"
#include "Maps.h"

namespace octahedral_test
{

using namespace testmaths;
using glsl::vec2;
using glsl::vec3;

namespace
{

// A pyramid as the GPU gets it, for the functions of lib run on the CPU.
class Pyramid
{
  public:
    explicit Pyramid(const osgEnvLight::RadianceMap* map) : _textures(new osgEnvLight::MapTextures(map))
    {
        const osg::Image& image = *_textures->pyramid()->getImage();
        _width = image.s();
        _height = image.t();
        for (int y = 0; y < _height; ++y)
            for (int x = 0; x < _width; ++x) {
                const float* t = reinterpret_cast<const float*>(image.data(unsigned(x), unsigned(y)));
                _texels.insert(_texels.end(), {t[0], t[1], t[2], 1.0f});
            }
    }
    double side() const { return _textures->pyramidSide(); }
    double lastLevel() const { return _textures->pyramidLastLevel(); }
    double at(const vec3& d, double lod) const
    {
        return glsl::pyramidLookup({_texels.data(), _width, _height}, side(), lastLevel(), d, lod).y;
    }

  private:
    osg::ref_ptr<osgEnvLight::MapTextures> _textures;
    int _width;
    int _height;
    std::vector<float> _texels;
};

}  // namespace

TEST(octahedral, Convention)
{
    const std::pair<vec3, vec2> table[] = {{vec3(0, 0, 1), vec2(0.5, 0.5)},  {vec3(1, 0, 0), vec2(1.0, 0.5)},
                                           {vec3(-1, 0, 0), vec2(0.0, 0.5)}, {vec3(0, 1, 0), vec2(0.5, 1.0)},
                                           {vec3(0, -1, 0), vec2(0.5, 0.0)}, {vec3(0, 0, -1), vec2(1.0, 1.0)}};
    for (const auto& [d, st] : table) EXPECT_LT(glsl::length(glsl::octahedralFromDirection(d) - st), 1e-15);
    for (vec2 corner : {vec2(0, 0), vec2(0, 1), vec2(1, 0), vec2(1, 1)})
        EXPECT_LT(glsl::length(glsl::directionFromOctahedral(corner) - vec3(0, 0, -1)), 1e-15);
}

TEST(octahedral, RoundTrip)
{
    Random random(19);
    for (int i = 0; i < 10000; ++i) {
        const vec3 d = random.direction();
        const vec2 st = glsl::octahedralFromDirection(d * random.uniform(1e-3, 1e3));
        EXPECT_GE(std::min(st.x, st.y), 0.0);
        EXPECT_LE(std::max(st.x, st.y), 1.0);
        EXPECT_LT(glsl::length(glsl::directionFromOctahedral(st) - d), 1e-14);
    }
}

TEST(octahedral, EdgesAreFoldedInTheirMiddles)
{
    for (double s : {0.0, 0.1, 0.3, 0.5})
        for (double edge : {0.0, 1.0}) {
            EXPECT_LT(
                glsl::length(glsl::directionFromOctahedral(vec2(s, edge)) - glsl::directionFromOctahedral(vec2(1.0 - s, edge))),
                1e-15);
            EXPECT_LT(
                glsl::length(glsl::directionFromOctahedral(vec2(edge, s)) - glsl::directionFromOctahedral(vec2(edge, 1.0 - s))),
                1e-15);
        }
}

TEST(octahedral, DensityIsTheJacobian)
{
    Random random(20);
    const double h = 1e-5;
    for (int i = 0; i < 2000; ++i) {
        const vec2 st = 0.01 + 0.98 * random.square();
        const vec2 p = 2.0 * st - 1.0;
        const double crease = std::min({std::abs(p.x), std::abs(p.y), std::abs(1.0 - std::abs(p.x) - std::abs(p.y))});
        if (crease < 4.0 * h) continue;
        const vec3 ds = glsl::directionFromOctahedral(st + vec2(h, 0)) - glsl::directionFromOctahedral(st - vec2(h, 0));
        const vec3 dt = glsl::directionFromOctahedral(st + vec2(0, h)) - glsl::directionFromOctahedral(st - vec2(0, h));
        // Central differences: h^2 times a third derivative of order 1e2
        EXPECT_NEAR(glsl::octahedralSolidAngleDensity(st), glsl::length(glsl::cross(ds, dt)) / (4.0 * h * h), 1e-6);
    }
}

TEST(octahedral, DensityIntegratesToTheSphere)
{
    // By symmetry 8 times the triangle s > 1/2, t > 1/2, s + t < 3/2, where the density is smooth.
    const Gauss g = gauss(40, 0.0, 1.0);
    double sum = 0.0;
    for (size_t i = 0; i < g.x.size(); ++i)
        for (size_t j = 0; j < g.x.size(); ++j) {
            const double a = 0.5 * g.x[i];
            const double b = (0.5 - a) * g.x[j];
            const double area = g.w[i] * g.w[j] * 0.5 * (0.5 - a);
            sum += area * (glsl::octahedralSolidAngleDensity(vec2(0.5 + a, 0.5 + b)) +
                           glsl::octahedralSolidAngleDensity(vec2(1.0 - a, 1.0 - b)));
        }
    EXPECT_NEAR(4.0 * sum, 4.0 * pi, 1e-12);
}

TEST(octahedral, LevelsOfTheAtlasDoNotOverlap)
{
    for (double side = 4.0; side <= 1024.0; side *= 2.0) {
        struct Box {
            vec2 low, high;
        };
        std::vector<Box> boxes;
        const int last = int(std::log2(side / 4.0));
        for (int level = 0; level <= last; ++level) {
            const vec2 corner = glsl::pyramidLevelCorner(side, level);
            EXPECT_EQ(corner, glsl::floor(corner));
            boxes.push_back({corner, corner + glsl::pyramidLevelSide(side, level) + 2.0});
        }
        EXPECT_EQ(glsl::pyramidLevelSide(side, last), 4.0);
        for (size_t i = 0; i < boxes.size(); ++i)
            for (size_t j = 0; j < i; ++j)
                EXPECT_TRUE(boxes[i].low.x >= boxes[j].high.x || boxes[j].low.x >= boxes[i].high.x ||
                            boxes[i].low.y >= boxes[j].high.y || boxes[j].low.y >= boxes[i].high.y)
                    << side << " " << i << " " << j;
    }
}

TEST(octahedral, ConstantMapAtEveryLod)
{
    const Pyramid pyramid(radianceOf(makeMap(64, 32, [](const vec3&) { return vec3(3.0); })).get());
    for (const vec3& d : spiral(200))
        for (double lod : {-5.0, 0.0, 0.3, 1.0, 2.7, 99.0}) EXPECT_NEAR(pyramid.at(d, lod), 1.0, 1e-6);  // floats
}

TEST(octahedral, LookUpsAreContinuousOverTheFoldedEdges)
{
    // Noise has the largest steps a fold could show. Texels are floats of order 1.
    Random random(21);
    const Pyramid pyramid(radianceOf(makeMap(128, 64, [&](const vec3&) { return vec3(random.uniform()); })).get());
    for (double lod : {0.0, 1.0, 2.0, 2.5, 3.0, 4.0})
        for (int i = 1; i < 400; ++i)
            for (double edge : {1e-9, 1.0 - 1e-9}) {
                const double s = i / 400.0;
                for (bool alongT : {false, true}) {
                    auto at = [&](double x) {
                        return pyramid.at(glsl::directionFromOctahedral(alongT ? vec2(edge, x) : vec2(x, edge)), lod);
                    };
                    EXPECT_NEAR(at(s), at(1.0 - s), 1e-5) << lod << " " << s;
                }
            }
}

TEST(octahedral, LookUpsAreContinuousEverywhere)
{
    Random random(22);
    const Pyramid pyramid(radianceOf(makeMap(128, 64, [&](const vec3&) { return vec3(random.uniform()); })).get());
    for (int i = 0; i < 20000; ++i) {
        const vec3 d = random.direction();
        const vec3 e = glsl::normalize(d + 1e-7 * random.direction());
        const double lod = random.uniform(0.0, 4.0);
        // A step of 1e-7 over texels of width > 1/64 with differences < 2, both axes, three levels of slack
        EXPECT_NEAR(pyramid.at(d, lod), pyramid.at(e, lod), 1e-4);
    }
}

TEST(octahedral, LookUpsBetweenLevelsAreLinear)
{
    Random random(23);
    const Pyramid pyramid(radianceOf(makeMap(128, 64, [&](const vec3&) { return vec3(random.uniform()); })).get());
    for (const vec3& d : spiral(300)) {
        EXPECT_NEAR(pyramid.at(d, 1.25), 0.75 * pyramid.at(d, 1.0) + 0.25 * pyramid.at(d, 2.0), 1e-12);
        EXPECT_EQ(pyramid.at(d, -3.0), pyramid.at(d, 0.0));
        EXPECT_EQ(pyramid.at(d, 50.0), pyramid.at(d, pyramid.lastLevel()));
    }
}

TEST(octahedral, EveryLevelKeepsTheFlux)
{
    // A lobe: sums of level x solid angle over the sphere stay the mean (1 in units of the mean), to the error of the
    // bilinear interpolation of the map and of the look-up: both second order in the texel, .01 at side 4.
    const Pyramid pyramid(radianceOf(makeMap(128, 64, [](const vec3& d) { return vec3(1.0 + d.x + 0.5 * d.z * d.z); })).get());
    for (double lod : {0.0, 1.0, 2.0, 3.0, 4.0})
        EXPECT_NEAR(integrateBand([&](const vec3& d) { return pyramid.at(d, lod); }, -1.0, 1.0, 200, 400) / (4.0 * pi), 1.0,
                    lod < 3 ? 2e-3 : 1e-2)
            << lod;
}

// At (1, 1, 1) the map is widest. Half a step of 1/4094 along both sides moves a point of x + y + z = 1 by (1, 1, -2) / 4094 there, at a
// distance of 1 / sqrt 3 from the origin: an angle of sqrt(18) / 4094.
TEST(octahedral, ADirectionFitsInto24Bits)
{
    Random random(9);
    for (int i = 0; i < 100000; ++i) {
        const vec3 d = random.direction();
        const double code = glsl::packDirection(d);
        ASSERT_EQ(code, std::floor(code));
        ASSERT_LT(code, double(1 << 24));
        ASSERT_EQ(code, double(float(code)));
        ASSERT_LT(glsl::length(glsl::unpackDirection(code) - d), 1.05e-3);
    }
    for (const vec3& axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(-1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1)})
        EXPECT_EQ(axis, glsl::unpackDirection(glsl::packDirection(axis)));
}

}  // namespace octahedral_test
