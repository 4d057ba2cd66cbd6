// SPDX-License-Identifier: MIT
#include <osgEnvLight/SphericalHarmonics>

#include <osgEnvLight/EnvironmentMap>

#include <vector>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// Order |m| of coefficient i, and whether it goes with the sine.
struct Azimuth {
    int m;
    bool sine;
};

Azimuth azimuth(int i)
{
    int l = harmonicBand(i);
    int m = i - (l == 0 ? 0 : l == 1 ? 2 : l == 2 ? 6 : 13);
    return {std::abs(m), m < 0};
}

// The part of basis i that depends on the polar angle only: its value where its cosine or sine is 1.
double polarPart(int i, double theta)
{
    Azimuth a = azimuth(i);
    double phi = a.sine ? 0.5 * glsl::PI / a.m : 0.0;
    return glsl::shBasis18(i, glsl::vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
}

std::array<osg::Vec3d, 18> project(const RadianceMap& map)
{
    // Separable: Fourier sums along each row, then the polar parts.
    const size_t width = size_t(map.width);
    std::vector<std::array<double, 5>> cosines(width);
    std::vector<std::array<double, 5>> sines(width);
    for (size_t x = 0; x < width; ++x)
        for (size_t m = 0; m < 5; ++m) {
            double phi = glsl::TWO_PI * (0.5 - (double(x) + 0.5) / double(width));
            cosines[x][m] = std::cos(double(m) * phi);
            sines[x][m] = std::sin(double(m) * phi);
        }
    std::array<osg::Vec3d, 18> result;
    for (int y = 0; y < map.height; ++y) {
        std::array<osg::Vec3d, 5> c;
        std::array<osg::Vec3d, 5> s;
        for (size_t x = 0; x < width; ++x) {
            const float* t = map.texel(int(x), y);
            osg::Vec3d radiance(t[0], t[1], t[2]);
            for (size_t m = 0; m < 5; ++m) {
                c[m] += radiance * cosines[x][m];
                s[m] += radiance * sines[x][m];
            }
        }
        double theta = glsl::PI * (y + 0.5) / map.height;
        double solidAngle = glsl::latlongTexelSolidAngle(y, glsl::vec2(map.width, map.height));
        for (int i = 0; i < 18; ++i) {
            Azimuth a = azimuth(i);
            result[size_t(i)] += (a.sine ? s : c)[size_t(a.m)] * (polarPart(i, theta) * solidAngle);
        }
    }
    return result;
}

// P_l^m from the two bands below: a (z P_(l-1)^m - b P_(l-2)^m), normalised.
struct Recursion {
    double a[9][9];
    double b[9][9];
    double diagonal[9];

    Recursion()
    {
        for (int m = 0; m <= 8; ++m) {
            diagonal[m] = m > 0 ? std::sqrt((2.0 * m + 1.0) / (2.0 * m)) : std::sqrt(0.25 / glsl::PI);
            for (int l = m + 1; l <= 8; ++l) {
                a[l][m] = std::sqrt((4.0 * l * l - 1.0) / (double(l) * l - double(m) * m));
                b[l][m] = std::sqrt((double(l - 1) * (l - 1) - double(m) * m) / (4.0 * (l - 1) * (l - 1) - 1.0));
            }
        }
    }
};

}  // namespace

int harmonicBand(int i)
{
    return i == 0 ? 0 : i < 4 ? 1 : i < 9 ? 2 : 4;
}

double cosineBand(int l)
{
    if (l == 1) return 2.0 * glsl::PI / 3.0;
    if (l % 2) return 0.0;
    // 2 pi (-1)^(l/2 - 1) / ((l + 2) (l - 1)) l! / (2^l (l/2)!^2); the last factor is the central binomial over 2^l.
    double binomial = 1.0;
    for (int i = 1; i <= l / 2; ++i) binomial *= (2.0 * i - 1.0) / (2.0 * i);
    return 2.0 * glsl::PI * (l / 2 % 2 ? 1.0 : -1.0) / ((l + 2.0) * (l - 1.0)) * binomial;
}

void evaluateHarmonics(int lastBand, const osg::Vec3d& d, double* result)
{
    static const Recursion r;
    const double root2 = std::sqrt(2.0);
    const double s = std::sqrt(d.x() * d.x() + d.y() * d.y());
    const double cosine = s > 1e-15 ? d.x() / s : 1.0;
    const double sine = s > 1e-15 ? d.y() / s : 0.0;
    double cosM = std::sqrt(0.5);  // makes 1 of the factor sqrt 2 that m > 0 has
    double sinM = 0.0;
    double diagonal = 1.0;
    for (int m = 0; m <= lastBand; ++m) {
        diagonal *= m > 0 ? s * r.diagonal[m] : r.diagonal[0];
        double last = 0.0;
        double p = diagonal;
        for (int l = m; l <= lastBand; ++l) {
            if (l > m) {
                const double next = r.a[l][m] * (d.z() * p - r.b[l][m] * last);
                last = p;
                p = next;
            }
            result[l * (l + 1) + m] = p * cosM * root2;
            if (m > 0) result[l * (l + 1) - m] = p * sinM * root2;
        }
        const double c = m == 0 ? cosine : cosM * cosine - sinM * sine;
        sinM = m == 0 ? sine : sinM * cosine + cosM * sine;
        cosM = c;
    }
}

const std::array<osg::Vec3d, 18>& RadianceMap::harmonics() const
{
    std::call_once(_once, [this] { _harmonics = project(*this); });
    return _harmonics;
}

}  // namespace osgEnvLight
