// SPDX-License-Identifier: MIT
#include "Oracles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "Maths.h"

namespace testmaths::oracle
{

namespace
{

void requirePowerOfTwo(size_t size)
{
    if (size == 0 || (size & (size - 1)) != 0) throw std::invalid_argument("Haar's functions need a power of two of elements");
}

// Solid angle from the face's centre to (x, y) of it, the cube's half edge 1: int int (1 + x^2 + y^2)^(-3/2).
double cubeCorner(double x, double y)
{
    return std::atan2(x * y, std::sqrt(1.0 + x * x + y * y));
}

// (1 - e^(-2x)) / x, the limit 2 included.
double decay(double x)
{
    return x > 0.0 ? -std::expm1(-2.0 * x) / x : 2.0;
}

}  // namespace

// 2 pi int mu^n dmu.
double cosineLobe(double n)
{
    return 2.0 * pi / (n + 1.0);
}

// 2 pi int mu^(n+1) dmu.
double cosineLobeWithCosine(double n)
{
    return 2.0 * pi / (n + 2.0);
}

// alpha^2 / (pi (cos^2 (alpha^2 - 1) + 1)^2) at cos = 1 (Trowbridge, Reitz 1975; Walter et al. 2007, eq. 33).
double ggxPeak(double alpha)
{
    return 1.0 / (pi * alpha * alpha);
}

// There cos^2 = 1 / (1 + alpha^2), and the bracket is 2 alpha^2 cos^2: the peak over 4 cos^4.
double ggxAtWidth(double alpha)
{
    const double inverseSquareCos = 1.0 + alpha * alpha;
    return ggxPeak(alpha) * inverseSquareCos * inverseSquareCos / 4.0;
}

// Lambda = (1/mu - 1) / 2 and D = 1 / pi leave f mu' = mu' / (2 pi (mu + mu')): int mu' / (mu + mu') dmu'.
double roughestAlbedo(double cosine)
{
    return cosine > 0.0 ? 1.0 - cosine * std::log1p(1.0 / cosine) : 1.0;
}

// 2 pi int mu P_l dmu over [0,1] (Ramamoorthi, Hanrahan 2001, eq. 8): pi, 2 pi / 3, for even l
// 2 pi (-1)^(l/2-1) / ((l + 2) (l - 1)) l! / (2^l (l/2)!^2), else 0.
double cosineBand(int l)
{
    if (l == 0) return pi;
    if (l == 1) return 2.0 * pi / 3.0;
    if (l % 2 == 1) return 0.0;
    double binomial = 1.0;  // l! / (2^l (l/2)!^2)
    for (int k = 1; k <= l / 2; ++k) binomial *= (2.0 * k - 1.0) / (2.0 * k);
    return (l % 4 == 2 ? 2.0 : -2.0) * pi * binomial / ((l + 2.0) * (l - 1.0));
}

// Funk and Hecke: A_l = sqrt(4 pi / (2 l + 1)) times the coefficient.
double cosineCoefficient(int l)
{
    return cosineBand(l) * std::sqrt((2.0 * l + 1.0) / (4.0 * pi));
}

// The light's coefficients are Y_lm(l); by the addition theorem sum_m Y_lm(l) Y_lm(n) = (2 l + 1) / (4 pi) P_l(l.n).
double reconstructedCosine(int bands, double cosine)
{
    double sum = 0.0;
    for (int l = 0; l < bands; ++l) sum += (2.0 * l + 1.0) / (4.0 * pi) * cosineBand(l) * std::legendre(unsigned(l), cosine);
    return sum;
}

// 2 pi int e^(s (z - 1)) dz over [-1,1].
double sphericalGaussian(double sharpness)
{
    return 2.0 * pi * decay(sharpness);
}

// The exponents add to u.v - s1 - s2, u = s1 a1 + s2 a2: a Gaussian of sharpness |u| and height e^(|u| - s1 - s2).
double sphericalGaussianProduct(double sharpness1, double sharpness2, double angle)
{
    const double half = std::sin(0.5 * angle);
    const double sum = sharpness1 + sharpness2;
    const double loss = 4.0 * sharpness1 * sharpness2 * half * half;  // sum^2 - u^2
    const double u = std::sqrt(std::max(sum * sum - loss, 0.0));
    return sum > 0.0 ? std::exp(-loss / (u + sum)) * 2.0 * pi * decay(u) : 4.0 * pi;
}

// Function 2^j + k is 2^(j/2) on the first half of the k-th of 2^j parts and -2^(j/2) on the second, over sqrt(size); function
// 0 is 1 / sqrt(size).
double haarFunction(int index, int position, int size)
{
    requirePowerOfTwo(size_t(size));
    if (index == 0) return 1.0 / std::sqrt(double(size));
    int parts = 1;
    while (2 * parts <= index) parts *= 2;
    const int length = size / parts;
    if (position / length != index - parts) return 0.0;
    return (position % length < length / 2 ? 1.0 : -1.0) / std::sqrt(double(length));
}

// Inner products with the functions.
std::vector<double> haarCoefficients(const std::vector<double>& values)
{
    requirePowerOfTwo(values.size());
    const int n = int(values.size());
    std::vector<double> result(values.size());
    for (int k = 0; k < n; ++k)
        for (int i = 0; i < n; ++i) result[size_t(k)] += haarFunction(k, i, n) * values[size_t(i)];
    return result;
}

// The sum of the functions: the transposed matrix is the inverse.
std::vector<double> haarValues(const std::vector<double>& coefficients)
{
    requirePowerOfTwo(coefficients.size());
    const int n = int(coefficients.size());
    std::vector<double> result(coefficients.size());
    for (int k = 0; k < n; ++k)
        for (int i = 0; i < n; ++i) result[size_t(i)] += haarFunction(k, i, n) * coefficients[size_t(k)];
    return result;
}

// Differences of cubeCorner() over the texel's corners.
double cubeTexelSolidAngle(int x, int y, int size)
{
    const double x0 = 2.0 * x / size - 1.0, x1 = 2.0 * (x + 1) / size - 1.0;
    const double y0 = 2.0 * y / size - 1.0, y1 = 2.0 * (y + 1) / size - 1.0;
    return cubeCorner(x1, y1) - cubeCorner(x0, y1) - cubeCorner(x1, y0) + cubeCorner(x0, y0);
}

}  // namespace testmaths::oracle
