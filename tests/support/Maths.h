// SPDX-License-Identifier: MIT
// Oracles for the tests: quadrature, random numbers that are the same everywhere, the chi-squared test. Nothing here
// uses what it judges.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "glsl.h"

namespace testmaths
{

inline const double pi = std::acos(-1.0);

/** Uniform in [0,1), the same on every machine: std::uniform_real_distribution is not. */
class Random
{
  public:
    explicit Random(std::uint32_t seed) : _bits(seed) {}
    double uniform() { return double(_bits()) / 4294967296.0; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    glsl::vec2 square()
    {
        const double x = uniform();
        return glsl::vec2(x, uniform());
    }
    glsl::vec3 direction()
    {
        const double z = uniform(-1.0, 1.0);
        const double phi = uniform(0.0, 2.0 * pi);
        const double s = std::sqrt(1.0 - z * z);
        return glsl::vec3(s * std::cos(phi), s * std::sin(phi), z);
    }
    glsl::vec3 upper()
    {
        glsl::vec3 d = direction();
        d.z = std::abs(d.z);
        return d;
    }

  private:
    std::mt19937 _bits;
};

/** n points in all directions, evenly: a spiral with the golden angle. */
std::vector<glsl::vec3> spiral(int n);

/** Gauss-Legendre nodes and weights on [low, high]: exact for polynomials of degree 2n-1. */
struct Gauss {
    std::vector<double> x;
    std::vector<double> w;
};
Gauss gauss(int n, double low, double high);

/** Integral of f over the band of directions whose z lies in [z0, z1]: Gauss-Legendre in z, trapezia in azimuth. */
double integrateBand(const std::function<double(const glsl::vec3&)>& f, double z0, double z1, int nz = 64, int nphi = 128);

/** Direction about +Z whose tangent of the polar angle is `slope`. */
glsl::vec3 fromSlope(double slope, double phi);

/** Integral over the upper hemisphere of f peaked about +Z with width alpha (as tangent of the polar angle): the variable
 * t = s/(1+s), s = tan/alpha, spreads peak and tail evenly.*/
double integratePeak(const std::function<double(const glsl::vec3&)>& f, double alpha, int nt = 400, int nphi = 64);

/** Scale and offset of F0 in the directional albedo that microfacets have for one bounce, seen from v: the albedo table's values.
 * @param integrate  a function of the light's direction over the upper hemisphere */
using Integrand = std::function<double(const glsl::vec3&)>;
glsl::vec2 microfacetAlbedo(int brdf, const glsl::vec3& v, double roughness,
                            const std::function<double(const Integrand&)>& integrate);

/** Probability that chi-squared with this many degrees of freedom exceeds x. */
double chiSquaredTail(double x, int degrees);

/** Histogram against expected counts; bins that expect fewer than 5 are pooled [Cochran]. The p-value. */
double chiSquaredTest(const std::vector<double>& observed, const std::vector<double>& expected);

/** Smallest p-value that passes when `runs` independent tests together may fail once in a hundred [Sidak]. */
inline double sidak(int runs)
{
    return 1.0 - std::pow(1.0 - 0.01, 1.0 / runs);
}

}  // namespace testmaths
