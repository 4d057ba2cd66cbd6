// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lights/MapTextures.h"
#include "environment/SphericalHarmonics.h"

#include "Maps.h"

namespace SphericalHarmonics_test
{

using namespace testmaths;
using glsl::vec3;

TEST(SphericalHarmonics, CosineBands)
{
    // A_l = 2 pi int_0^1 P_l(z) z dz; polynomials of degree 5, which 8 nodes integrate exactly
    const std::function<double(double)> legendre[] = {[](double) { return 1.0; }, [](double z) { return z; },
                                                      [](double z) { return 1.5 * z * z - 0.5; },
                                                      [](double z) { return (35.0 * z * z * z * z - 30.0 * z * z + 3.0) / 8.0; }};
    const int bands[] = {0, 1, 2, 4};
    const Gauss g = gauss(8, 0.0, 1.0);
    for (size_t k = 0; k < 4; ++k) {
        double sum = 0.0;
        for (size_t i = 0; i < g.x.size(); ++i) sum += 2.0 * pi * g.w[i] * g.x[i] * legendre[k](g.x[i]);
        EXPECT_NEAR(osgEnvLight::cosineBand(bands[k]), sum, 1e-14);
    }
}

TEST(SphericalHarmonics, CosineBandsAbove)
{
    EXPECT_NEAR(osgEnvLight::cosineBand(6), pi / 64.0, 1e-15);
    EXPECT_NEAR(osgEnvLight::cosineBand(8), -pi / 128.0, 1e-15);
    for (int l : {3, 5, 7}) EXPECT_EQ(osgEnvLight::cosineBand(l), 0.0);
}

TEST(SphericalHarmonics, AllBands)
{
    // Orthonormal: by Gauss in z and trapezia in azimuth, exact for products of degree 16.
    std::vector<std::vector<double>> gram(81, std::vector<double>(81, 0.0));
    const Gauss g = gauss(12, -1.0, 1.0);
    double y[81];
    for (size_t i = 0; i < g.x.size(); ++i)
        for (int k = 0; k < 24; ++k) {
            const double s = std::sqrt(1.0 - g.x[i] * g.x[i]);
            const double phi = 2.0 * pi * k / 24.0;
            osgEnvLight::evaluateHarmonics(8, osg::Vec3d(s * std::cos(phi), s * std::sin(phi), g.x[i]), y);
            for (size_t a = 0; a < 81; ++a)
                for (size_t b = 0; b < 81; ++b) gram[a][b] += g.w[i] * 2.0 * pi / 24.0 * y[a] * y[b];
        }
    for (size_t a = 0; a < 81; ++a)
        for (size_t b = 0; b < 81; ++b) EXPECT_NEAR(gram[a][b], a == b ? 1.0 : 0.0, 1e-12) << a << " " << b;
    // The same signs and order as lib/sh.glsl, the poles included.
    for (vec3 d : spiral(50)) {
        if (d.z > 0.95) d = vec3(0, 0, 1);
        osgEnvLight::evaluateHarmonics(8, osg::Vec3d(d.x, d.y, d.z), y);
        for (int i = 0; i < 18; ++i) EXPECT_NEAR(y[i < 9 ? i : i + 7], glsl::shBasis18(i, d), 1e-13) << i;
    }
}

TEST(SphericalHarmonics, BandOfACoefficient)
{
    const int bands[18] = {0, 1, 1, 1, 2, 2, 2, 2, 2, 4, 4, 4, 4, 4, 4, 4, 4, 4};
    for (int i = 0; i < 18; ++i) EXPECT_EQ(osgEnvLight::harmonicBand(i), bands[i]);
}

TEST(SphericalHarmonics, ProjectionOfABasisFunction)
{
    // A map that is one basis function plus a constant gives that function's coefficient and no other. The quadrature is
    // the midpoint rule in the polar angle: its error at 256 rows is below (pi/256)^2 l^2 = 2.4e-3, floats below it.
    for (int i : {1, 2, 3, 4, 6, 8, 9, 11, 13, 14, 16, 17}) {
        const auto map = radianceOf(makeMap(512, 256, [i](const vec3& d) { return vec3(2.0 + glsl::shBasis18(i, d)); }));
        for (int j = 0; j < 18; ++j) {
            const double exact = (i == j ? 1.0 : 0.0) + (j == 0 ? 2.0 * std::sqrt(4.0 * pi) : 0.0);
            EXPECT_NEAR(map->harmonics()[size_t(j)][0], exact, 2.4e-3) << i << " " << j;
        }
    }
}

TEST(SphericalHarmonics, SumOverTexels)
{
    // The separable sum against the plain one over directions and solid angles, on noise in three channels.
    Random random(31);
    const auto map = radianceOf(
        makeMap(64, 32, [&](const vec3&) { return vec3(random.uniform(), random.uniform(), 10.0 * random.uniform()); }));
    for (int i = 0; i < 18; ++i) {
        vec3 sum(0.0);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 64; ++x) {
                const float* t = map->texel(x, y);
                sum += vec3(t[0], t[1], t[2]) * texelSolidAngle(y, 64, 32) * glsl::shBasis18(i, texelDirection(x, y, 64, 32));
            }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(map->harmonics()[size_t(i)][c], sum[c], 1e-11) << i;  // rounding of 2048 terms
    }
}

TEST(SphericalHarmonics, IrradianceOfSkies)
{
    // cos^k sky about +Z: E(up) = 2 pi/(k+2). cos itself and its even powers have no odd bands above 1 under the clamp:
    // 18 terms leave band 6 and up, |A_6 L_6| < .5 % of E for k = 1, 2; the map's texels less.
    for (int k : {1, 2}) {
        const auto map = radianceOf(makeMap(512, 256, [k](const vec3& d) { return vec3(std::pow(std::max(d.z, 0.0), k)); }));
        osg::ref_ptr<osgEnvLight::MapTextures> textures = new osgEnvLight::MapTextures(map.get());
        std::vector<vec3> c(18);
        for (unsigned i = 0; i < 18; ++i) {
            osg::Vec3f v;
            ASSERT_TRUE(textures->harmonics()->getElement(i, v));
            c[i] = vec3(v.x(), v.y(), v.z());
        }
        const double e = glsl::shIrradiance(c.data(), vec3(0, 0, 1)).x * pi * map->mean;
        EXPECT_NEAR(e / (2.0 * pi / (k + 2.0)), 1.0, 5e-3) << k;
    }
}

}  // namespace SphericalHarmonics_test
