// SPDX-License-Identifier: MIT
#include <osgEnvLight/DiffuseCarrier>

#include <osgEnvLight/SphericalHarmonics>

#include <algorithm>
#include <cmath>
#include <functional>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double smallError = 0.002;  // below what half floats and the occlusion term leave

// The map as the lights of its own texels, or of blocks of them no larger than 1.4 degrees (the error of a block's own
// irradiance is of second order: under 1e-4).
LightList texelLights(const RadianceMap& map)
{
    const int block = std::max(map.width / 256, 1);
    const int width = (map.width + block - 1) / block;
    const int height = (map.height + block - 1) / block;
    LightList lights(size_t(width) * size_t(height));
    const glsl::vec2 size(map.width, map.height);
    for (int y = 0; y < map.height; ++y) {
        const double solidAngle = glsl::latlongTexelSolidAngle(y, size);
        for (int x = 0; x < map.width; ++x) {
            const float* t = map.texel(x, y);
            lights[size_t(y / block) * size_t(width) + size_t(x / block)].flux += osg::Vec3d(t[0], t[1], t[2]) * solidAngle;
        }
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glsl::vec3 d = glsl::directionFromLatlong((glsl::vec2(x, y) + 0.5) / glsl::vec2(width, height));
            lights[size_t(y) * size_t(width) + size_t(x)].direction = osg::Vec3d(d.x, d.y, d.z);
        }
    return lights;
}

osg::Vec3d irradiance(const LightList& lights, const osg::Vec3d& n)
{
    osg::Vec3d sum;
    for (const DirectionalLight& l : lights) sum += l.flux * std::max(l.direction * n, 0.0);
    return sum;
}

osg::Vec3d irradiance(const RadianceMap& map, const osg::Vec3d& n)
{
    osg::Vec3d sum;
    for (int i = 0; i < 18; ++i)
        sum += map.harmonics()[size_t(i)] * (cosineBand(harmonicBand(i)) * glsl::shBasis18(i, glsl::vec3(n[0], n[1], n[2])));
    return osg::Vec3d(std::max(sum[0], 0.0), std::max(sum[1], 0.0), std::max(sum[2], 0.0));
}

}  // namespace

DiffuseCarrier chooseCarrier(const RadianceMap& map, const LightList& lights)
{
    const LightList texels = texelLights(map);
    const int count = 64;
    double square = 0.0;
    DiffuseCarrier result{false, 0.0, 0.0};
    for (int i = 0; i < count; ++i) {
        // A spiral with the golden angle covers the sphere evenly.
        const double z = 1.0 - 2.0 * (i + 0.5) / count;
        const double phi = 2.399963229728653 * i;
        const double s = std::sqrt(1.0 - z * z);
        const osg::Vec3d n(s * std::cos(phi), s * std::sin(phi), z);
        const osg::Vec3d truth = irradiance(texels, n);
        square += truth.length2();
        result.harmonicsError += (irradiance(map, n) - truth).length2();
        result.lightsError += (irradiance(lights, n) - truth).length2();
    }
    result.harmonicsError = square > 0.0 ? std::sqrt(result.harmonicsError / square) : 0.0;
    result.lightsError = square > 0.0 ? std::sqrt(result.lightsError / square) : 0.0;
    result.harmonics = result.harmonicsError <= std::max(result.lightsError, smallError);
    return result;
}

}  // namespace osgEnvLight
