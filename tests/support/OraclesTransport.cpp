// SPDX-License-Identifier: MIT
#include "Oracles.h"

#include <algorithm>
#include <cmath>

#include "Maths.h"

namespace testmaths::oracle
{

// B1 = E1 + rho1 B2, B2 = E2 + rho2 B1.
std::pair<double, double> parallelPlates(double e1, double e2, double rho1, double rho2)
{
    const double loop = 1.0 - rho1 * rho2;
    return {(e1 + rho1 * e2) / loop, (e2 + rho2 * e1) / loop};
}

// The inner one sees only the outer: F12 = 1; by reciprocity F21 = (r1 / r2)^2, the rest is F22.
// B1 = E1 + rho1 B2, B2 = E2 + rho2 (F21 B1 + F22 B2).
std::pair<double, double> concentricSpheres(double r1, double r2, double e1, double e2, double rho1, double rho2)
{
    const double f21 = (r1 / r2) * (r1 / r2);
    const double b2 = (e2 + rho2 * f21 * e1) / (1.0 - rho2 * (1.0 - f21 + f21 * rho1));
    return {e1 + rho1 * b2, b2};
}

// cos = cos' = d / (2 r): the kernel is 1 / (4 pi r^2), so every point receives mean(B) = mean(E) / (1 - rho).
double integratingSphere(double e, double meanE, double rho)
{
    return e + rho * meanE / (1.0 - rho);
}

// The form factors of a point sum to 1: B = E + rho B.
double closedBox(double e, double rho)
{
    return e / (1.0 - rho);
}

// The opening fills F = (1 - cos) / 2 of the sphere, so of each point's form factors: B = rho (F pi L + (1 - F) B).
double sphericalCavity(double rho, double openingAngle)
{
    const double f = 0.5 * (1.0 - std::cos(openingAngle));
    return rho * f / (1.0 - rho * (1.0 - f));
}

// The tail of sum rho^k from k = bounces + 1.
double missingAfter(int bounces, double rho)
{
    return std::pow(rho, bounces + 1);
}

// h^2 int du / (u max(u, c^2)) over u = d^2 from h^2 to S = h^2 + R^2:
// h^2 (ln(c^2 / h^2) / c^2 + 1 / c^2 - 1 / S) where h < c < sqrt(S).
double clampedDisk(double radius, double height, double clamp)
{
    const double hh = height * height, s = hh + radius * radius;
    const double cc = std::clamp(clamp * clamp, hh, s);
    return hh * (std::log(cc / hh) / std::max(clamp * clamp, hh) + 1.0 / cc - 1.0 / s);
}

// h^2 int du / (u (u + a)) over u = d^2, a = area / pi: (h^2 / a) ln((1 + a / h^2) / (1 + a / S)).
double diskKernel(double radius, double height, double area)
{
    const double hh = height * height, a = area / pi;
    return hh / a * (std::log1p(a / hh) - std::log1p(a / (hh + radius * radius)));
}

// Poisson's sum over the grid of h^2 / (pi d^4), whose Fourier transform is q h K_1(q h): q = 2 pi |k| / spacing. Terms
// beyond q h = 40 are below 40 e^-40.
double pointGrid(double height, double spacing, double x, double y)
{
    const double unit = 2.0 * pi * height / spacing;
    const int last = int(40.0 / unit);
    double sum = 1.0;
    for (int j = 0; j <= last; ++j)
        for (int i = j == 0 ? 1 : 0; i * i + j * j <= last * last; ++i) {
            const double z = unit * std::hypot(i, j);
            const double signs = (i > 0 ? 2.0 : 1.0) * (j > 0 ? 2.0 : 1.0);
            sum += signs * std::cos(2.0 * pi * i * x) * std::cos(2.0 * pi * j * y) * z * std::cyl_bessel_k(1.0, z);
        }
    return sum;
}

// It adds delta with the probability x / delta, else nothing: x delta - x^2. At most delta^2 / 4.
double stochasticCulling(double x, double delta)
{
    return x < delta ? x * (delta - x) : 0.0;
}

}  // namespace testmaths::oracle
