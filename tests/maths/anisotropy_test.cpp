// SPDX-License-Identifier: MIT
// GGX's microfacets with an alpha along x and another along y.
#include "surface/AlbedoTable.h"

#include <gtest/gtest.h>

#include "Maths.h"

namespace anisotropy_test
{

using namespace testmaths;
using glsl::Anisotropy;
using glsl::vec2;
using glsl::vec3;

namespace
{

const vec2 pairs[] = {vec2(1.0, 1.0), vec2(0.5, 0.1), vec2(0.05, 0.4), vec2(1.0, 0.01), vec2(0.02, 0.001)};

vec3 eyeAt(double degrees, double azimuth)
{
    const double t = degrees * pi / 180.0, p = azimuth * pi / 180.0;
    return vec3(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
}

// A normal by its slopes in units of the alphas, in polar coordinates.
vec3 normalAt(double r, double phi, const vec2& alpha)
{
    return glsl::normalize(vec3(alpha * r * vec2(std::cos(phi), std::sin(phi)), 1.0));
}

// Second formulations: by slopes, and by the slope along the direction [Heitz 2014, eq. 85, 80].
double distribution(const vec3& h, const vec2& alpha)
{
    const double x = h.x / h.z / alpha.x, y = h.y / h.z / alpha.y;
    return 1.0 / (pi * alpha.x * alpha.y * std::pow(h.z, 4) * std::pow(1.0 + x * x + y * y, 2));
}

double lambda(const vec3& v, const vec2& alpha)
{
    const double slope2 = (std::pow(alpha.x * v.x, 2) + std::pow(alpha.y * v.y, 2)) / (v.z * v.z);
    return 0.5 * (std::sqrt(1.0 + slope2) - 1.0);
}

double visibleNormals(const vec3& v, const vec3& h, const vec2& alpha)
{
    return distribution(h, alpha) * std::max(glsl::dot(v, h), 0.0) / ((1.0 + lambda(v, alpha)) * v.z);
}

// Over all normals, of a density per solid angle.
double overNormals(const std::function<double(const vec3&)>& density, const vec2& alpha, int nt = 200, int nphi = 256)
{
    const Gauss g = gauss(nt, 0.0, 1.0);
    double sum = 0.0;
    for (size_t i = 0; i < g.x.size(); ++i)
        for (int j = 0; j < nphi; ++j) {
            const double t = g.x[i], r = t / (1.0 - t);
            const vec3 h = normalAt(r, 2.0 * pi * (j + 0.5) / nphi, alpha);
            // An area of slopes is h.z^-3 of solid angle.
            const double area = alpha.x * alpha.y * r / ((1.0 - t) * (1.0 - t)) * std::pow(h.z, 3);
            sum += g.w[i] * 2.0 * pi / nphi * area * density(h);
        }
    return sum;
}

// Scale and offset of F0 in the albedo, over the light's directions.
vec2 albedo(const vec3& v, const vec2& alpha)
{
    const auto share = [&](bool grazing) {
        return overNormals(
            [&](const vec3& h) {
                const double c = glsl::dot(v, h);
                const vec3 l = 2.0 * c * h - v;
                if (c <= 0.0 || l.z <= 0.0) return 0.0;
                const double f = std::pow(1.0 - c, 5.0);
                return 4.0 * c * glsl::ggxBrdf(v, l, alpha) * l.z * (grazing ? f : 1.0 - f);  // dl = 4 (v h) dh
            },
            alpha);
    };
    return vec2(share(false), share(true));
}

vec2 tableAt(double along, double across, double cosV)
{
    const osg::ref_ptr<osg::Image> table = osgEnvLight::albedoTableImage(true);
    const auto at = [&](int x, int y) {
        const float* t = reinterpret_cast<const float*>(table->data(unsigned(x), unsigned(y)));
        return vec2(t[0], t[1]);
    };
    const double x = along * 31.0, y = std::sqrt(cosV) * 31.0, z = across * 8.0;
    const int i = std::min(int(x), 30), j = std::min(int(y), 30), k = std::min(int(z), 7);
    vec2 sum(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const int a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
        const double w = (a ? x - i : 1.0 - (x - i)) * (b ? y - j : 1.0 - (y - j)) * (c ? z - k : 1.0 - (z - k));
        sum += w * at(32 * (3 + k + c) + i + a, j + b);
    }
    return sum;
}

}  // namespace

TEST(anisotropy, ComesBackFromItsThirteenBits)
{
    for (double strength : {0.0, 0.2, 0.5, 1.0})
        for (double degrees : {0.0, 1.0, 45.0, 90.0, 179.0, 180.0, 270.0, -30.0, 1000.0}) {
            Anisotropy a;
            a.strength = strength;
            a.angle = degrees * pi / 180.0;
            const glsl::uint bits = glsl::packAnisotropy(a);
            EXPECT_LT(bits, 1u << 13);
            const Anisotropy back = glsl::unpackAnisotropy(bits);
            EXPECT_NEAR(strength, back.strength, 0.5 / 31 + 1e-12);
            EXPECT_NEAR(std::abs(std::cos(a.angle - back.angle)), 1.0, 1.0 - std::cos(pi / 512.0) + 1e-9) << degrees;
            EXPECT_EQ(bits, glsl::kindParameters(glsl::packKind(BRDF_ANISOTROPIC, bits)));
            EXPECT_EQ(BRDF_ANISOTROPIC, glsl::kindBrdf(glsl::packKind(BRDF_ANISOTROPIC, bits)));
        }
}

TEST(anisotropy, AlphasAsInTheExtension)
{
    EXPECT_EQ(vec2(0.25, 0.25), glsl::anisotropicAlpha(0.25, 0.0));
    EXPECT_EQ(vec2(1.0, 0.25), glsl::anisotropicAlpha(0.25, 1.0));
    EXPECT_DOUBLE_EQ(0.25 + 0.75 * 0.36, glsl::anisotropicAlpha(0.25, 0.6).x);
    const vec2 smooth = glsl::anisotropicAlpha(0.0, 1.0);
    EXPECT_TRUE(smooth.y > 0.0 && smooth.x == 1.0);
}

TEST(anisotropy, EqualAlphasAreAsOne)
{
    Random random(31);
    for (int i = 0; i < 1000; ++i) {
        const double alpha = std::pow(10.0, random.uniform(-3.0, 0.0));
        const vec2 both(alpha, alpha);
        const vec3 v = random.upper(), l = random.upper(), h = glsl::normalize(v + l);
        EXPECT_NEAR(glsl::ggxD(h, both) / glsl::ggxD(h, alpha), 1.0, 1e-12);
        EXPECT_NEAR(glsl::ggxBrdf(v, l, both) / glsl::ggxBrdf(v, l, alpha), 1.0, 1e-12);
        EXPECT_NEAR(glsl::ggxReflectionPdf(v, h, both) / glsl::ggxReflectionPdf(v, h, alpha), 1.0, 1e-12);
        EXPECT_NEAR(glsl::lobeShare(v, l, both) / glsl::lobeShare(v, l, alpha), 1.0, 1e-12);
    }
}

TEST(anisotropy, DistributionHasUnitProjectedArea)
{
    for (const vec2& alpha : pairs)
        EXPECT_NEAR(overNormals([&](const vec3& h) { return glsl::ggxD(h, alpha) * h.z; }, alpha), 1.0, 1e-9) << alpha.x;
}

TEST(anisotropy, ValueBySlopes)
{
    Random random(32);
    for (const vec2& alpha : pairs)
        for (int i = 0; i < 2000; ++i) {
            const vec3 h = normalAt(std::exp(random.uniform(-4.0, 4.0)), random.uniform(0.0, 2.0 * pi), alpha);
            EXPECT_NEAR(glsl::ggxD(h, alpha) / distribution(h, alpha), 1.0, 1e-10);
            const vec3 v = random.upper();
            const vec3 l = 2.0 * glsl::dot(v, h) * h - v;
            if (v.z < 1e-2 || l.z < 1e-2 || glsl::dot(v, h) < 1e-3) continue;
            const double exact = distribution(h, alpha) / (4.0 * v.z * l.z * (1.0 + lambda(v, alpha) + lambda(l, alpha)));
            EXPECT_NEAR(glsl::ggxBrdf(v, l, alpha) / exact, 1.0, 1e-6);
            EXPECT_NEAR(glsl::ggxBrdf(l, v, alpha) / glsl::ggxBrdf(v, l, alpha), 1.0, 1e-12);
            const double pdf = visibleNormals(v, h, alpha) / (4.0 * glsl::dot(v, h));
            EXPECT_NEAR(glsl::ggxReflectionPdf(v, h, alpha) / pdf, 1.0, 1e-9);
        }
}

TEST(anisotropy, SamplesFollowTheVisibleNormals)
{
    const int samples = 200000, nt = 12, nphi = 24;
    Random random(33);
    for (const vec2& alpha : pairs)
        for (double azimuth : {0.0, 35.0, 90.0}) {
            const vec3 v = eyeAt(70.0, azimuth);
            std::vector<double> observed(nt * nphi), expected(nt * nphi);
            for (int i = 0; i < samples; ++i) {
                const vec3 h = glsl::ggxVisibleNormalSample(v, alpha, random.square());
                const double x = h.x / h.z / alpha.x, y = h.y / h.z / alpha.y, r = std::hypot(x, y);
                const int ring = std::min(int(r / (1.0 + r) * nt), nt - 1);
                const int spoke = std::min(int((std::atan2(y, x) / (2.0 * pi) + 0.5) * nphi), nphi - 1);
                observed[size_t(ring * nphi + spoke)] += 1.0;
            }
            const Gauss g = gauss(12, 0.0, 1.0);
            for (int ring = 0; ring < nt; ++ring)
                for (int spoke = 0; spoke < nphi; ++spoke)
                    for (size_t i = 0; i < g.x.size(); ++i)
                        for (size_t j = 0; j < g.x.size(); ++j) {
                            const double t = (ring + g.x[i]) / nt, r = t / (1.0 - t);
                            const vec3 h = normalAt(r, 2.0 * pi * ((spoke + g.x[j]) / nphi - 0.5), alpha);
                            const double area = alpha.x * alpha.y * r / ((1.0 - t) * (1.0 - t)) * std::pow(h.z, 3);
                            expected[size_t(ring * nphi + spoke)] +=
                                samples * g.w[i] * g.w[j] * area * visibleNormals(v, h, alpha) * 2.0 * pi / nt / nphi;
                        }
            EXPECT_GT(chiSquaredTest(observed, expected), sidak(15)) << alpha.x << " " << alpha.y << " " << azimuth;
        }
}

// Along the alphas' own directions the table is of the lobe itself, but for its 256 points and the steps between its nodes.
// Between them it takes the normals' slopes along and across the view for independent.
TEST(anisotropy, AlbedoOfTheTableAgainstQuadrature)
{
    double worst = 0.0, slanted = 0.0;
    for (const double strength : {0.4, 0.7, 1.0})
        for (const double roughness : {0.2, 0.4, 0.7})
            for (const double degrees : {10.0, 50.0, 75.0})
                for (const double azimuth : {0.0, 45.0, 90.0}) {
                    const vec2 alpha = glsl::anisotropicAlpha(roughness * roughness, strength);
                    const vec3 v = eyeAt(degrees, azimuth);
                    const vec2 about = glsl::anisotropicRoughness(alpha, v);
                    const vec2 table = tableAt(about.x, about.y, v.z), exact = albedo(v, alpha);
                    const double error = std::abs(table.x + table.y - exact.x - exact.y);
                    (azimuth == 45.0 ? slanted : worst) = std::max(azimuth == 45.0 ? slanted : worst, error);
                    EXPECT_LE(exact.x + exact.y, 1.0 + 1e-6);
                }
    EXPECT_LT(worst, 0.01);    // measured .0064
    EXPECT_LT(slanted, 0.04);  // measured .036
}

TEST(anisotropy, RoughnessAboutTheView)
{
    const vec2 alpha(0.64, 0.04);
    const auto expectRoughness = [&](double along, double across, const vec3& v) {
        const vec2 r = glsl::anisotropicRoughness(alpha, v);
        EXPECT_NEAR(along, r.x, 1e-12);
        EXPECT_NEAR(across, r.y, 1e-12);
    };
    expectRoughness(0.8, 0.2, eyeAt(60.0, 0.0));
    expectRoughness(0.2, 0.8, eyeAt(60.0, 90.0));
    expectRoughness(0.8, 0.2, vec3(0, 0, 1));
    const double between = std::sqrt(std::sqrt(0.5 * (0.64 * 0.64 + 0.04 * 0.04)));
    expectRoughness(between, between, eyeAt(60.0, 45.0));
}

TEST(anisotropy, ExtremesAreFinite)
{
    for (double roughness : {0.0, 1e-3, 0.5, 1.0})
        for (double strength : {1.0 / 31.0, 0.5, 1.0})
            for (double mu : {1.0, 1e-2, 1e-4, 1e-8})
                for (double azimuth : {0.0, 45.0, 90.0})
                    for (double x : {0.0, 0.5, 1.0 - 1e-9})
                        for (double y : {0.0, 0.5, 1.0 - 1e-9}) {
                            const vec2 alpha = glsl::anisotropicAlpha(roughness * roughness, strength);
                            const vec3 v = eyeAt(std::acos(mu) * 180.0 / pi, azimuth);
                            const vec3 h = glsl::ggxVisibleNormalSample(v, alpha, vec2(x, y));
                            EXPECT_NEAR(glsl::length(h), 1.0, 1e-12);
                            const vec3 l = 2.0 * glsl::dot(v, h) * h - v;
                            EXPECT_TRUE(std::isfinite(glsl::ggxBrdf(v, l, alpha)));
                            EXPECT_TRUE(std::isfinite(glsl::ggxReflectionPdf(v, h, alpha)));
                        }
}

TEST(anisotropy, AFrameTurnedAboutItsNormal)
{
    Random random(34);
    for (int i = 0; i < 100; ++i) {
        const vec3 n = random.direction();
        const glsl::mat3 frame = glsl::frameAround(n);
        const double angle = random.uniform(0.0, pi);
        const glsl::mat3 turned = glsl::turnedFrame(frame, angle);
        EXPECT_NEAR(glsl::dot(turned[0], frame[0]), std::cos(angle), 1e-12);
        EXPECT_NEAR(glsl::dot(turned[0], frame[1]), std::sin(angle), 1e-12);
        EXPECT_NEAR(glsl::dot(glsl::cross(turned[0], turned[1]), n), 1.0, 1e-12);
    }
}

}  // namespace anisotropy_test
