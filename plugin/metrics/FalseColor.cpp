// SPDX-License-Identifier: MIT
#include <metrics/FalseColor>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <metrics/Display>

namespace osgEnvLight
{

namespace
{

using osg::Vec3d;
using Ramp = std::vector<Vec3d>;

const Ramp diverging = {Vec3d(0.06, 0.16, 0.45), Vec3d(0.30, 0.55, 0.85), Vec3d(1.0, 1.0, 1.0), Vec3d(0.90, 0.45, 0.35),
                        Vec3d(0.48, 0.04, 0.10)};

const Ramp magma = {Vec3d(0.001, 0.000, 0.014), Vec3d(0.040, 0.031, 0.134), Vec3d(0.113, 0.065, 0.277),
                    Vec3d(0.212, 0.062, 0.419), Vec3d(0.317, 0.072, 0.485), Vec3d(0.415, 0.110, 0.505),
                    Vec3d(0.513, 0.148, 0.508), Vec3d(0.614, 0.182, 0.499), Vec3d(0.716, 0.215, 0.475),
                    Vec3d(0.817, 0.256, 0.436), Vec3d(0.904, 0.320, 0.388), Vec3d(0.961, 0.418, 0.360),
                    Vec3d(0.987, 0.536, 0.382), Vec3d(0.996, 0.654, 0.446), Vec3d(0.997, 0.770, 0.535),
                    Vec3d(0.992, 0.884, 0.640), Vec3d(0.987, 0.991, 0.750)};

// t in [0,1] along the ramp.
Vec3d colour(const Ramp& ramp, double t)
{
    if (std::isnan(t)) return Vec3d(0.0, 1.0, 0.0);
    const double x = std::clamp(t, 0.0, 1.0) * double(ramp.size() - 1);
    const size_t i = std::min(size_t(x), ramp.size() - 2);
    const double share = x - double(i);
    return ramp[i] * (1.0 - share) + ramp[i + 1] * share;
}

void set(Picture& picture, int x, int y, const Vec3d& c)
{
    float* p = picture.at(x, y);
    for (int k = 0; k < 3; ++k) p[k] = float(c[k]);
    p[3] = 1.0f;
}

void requireScale(double scale)
{
    if (!(scale > 0.0)) throw std::invalid_argument("the scale of false colours must be above 0");
}

}  // namespace

Picture signedDifference(const Picture& picture, const Picture& reference, double scale)
{
    requireScale(scale);
    requireSameSize(picture, reference);
    Picture result(picture.width, picture.height);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const double difference = luminance(picture.color(x, y) - reference.color(x, y));
            set(result, x, y, colour(diverging, 0.5 + 0.5 * difference / scale));
        }
    return result;
}

Picture magnitude(const ScalarMap& map, double scale)
{
    requireScale(scale);
    Picture result(map.width, map.height);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) set(result, x, y, colour(magma, map.at(x, y) / scale));
    return result;
}

}  // namespace osgEnvLight
