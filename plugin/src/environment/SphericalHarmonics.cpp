// SPDX-License-Identifier: MIT
#include "environment/SphericalHarmonics.h"

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

// Fourier sums of one row, orders 0 to 4. Half a turn on, even orders repeat and odd ones change sign: where the width is
// even, sums and differences of opposite texels take half the products.
class RowSums
{
  public:
    explicit RowSums(int width) : _step(width % 2 ? 0 : width / 2), _count(size_t(_step ? _step : width))
    {
        for (size_t x = 0; x < _count; ++x)
            for (size_t m = 0; m < 5; ++m) {
                const double phi = glsl::TWO_PI * (0.5 - (double(x) + 0.5) / width);
                _waves.push_back(std::cos(double(m) * phi));
                _waves.push_back(std::sin(double(m) * phi));
            }
    }

    void sum(const float* row, std::array<osg::Vec3d, 5>& cosines, std::array<osg::Vec3d, 5>& sines) const
    {
        double sums[10][3] = {};
        const double* wave = _waves.data();
        for (size_t x = 0; x < _count; ++x, wave += 10) {
            const float* t = row + 3 * x;
            const float* opposite = t + 3 * _step;
            for (int k = 0; k < 3; ++k) {
                const double even = _step ? double(t[k]) + double(opposite[k]) : double(t[k]);
                const double odd = _step ? double(t[k]) - double(opposite[k]) : double(t[k]);
                for (int m = 0; m < 10; ++m) sums[m][k] += wave[m] * (m / 2 % 2 ? odd : even);
            }
        }
        for (size_t m = 0; m < 5; ++m) {
            cosines[m].set(sums[2 * m][0], sums[2 * m][1], sums[2 * m][2]);
            sines[m].set(sums[2 * m + 1][0], sums[2 * m + 1][1], sums[2 * m + 1][2]);
        }
    }

  private:
    int _step;
    size_t _count;
    std::vector<double> _waves;  // cos and sin of each order, column by column
};

std::array<osg::Vec3d, 18> project(const RadianceMap& map)
{
    // Separable: Fourier sums along each row, then the polar parts.
    const RowSums rows(map.width);
    std::array<osg::Vec3d, 18> result;
    for (int y = 0; y < map.height; ++y) {
        std::array<osg::Vec3d, 5> c;
        std::array<osg::Vec3d, 5> s;
        rows.sum(map.texel(0, y), c, s);
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
