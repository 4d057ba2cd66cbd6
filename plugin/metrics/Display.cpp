// SPDX-License-Identifier: MIT
#include <metrics/Display>

#include <algorithm>
#include <cmath>

#include <metrics/Metrics>

namespace osgEnvLight
{

namespace
{

double encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

}  // namespace

double luminance(const osg::Vec3d& rgb)
{
    return rgb * osg::Vec3d(0.2126, 0.7152, 0.0722);
}

osg::Vec3d exposed(const osg::Vec3d& radiance, double stops)
{
    const osg::Vec3d scaled = radiance * std::exp2(stops);
    osg::Vec3d result;
    for (int k = 0; k < 3; ++k) result[k] = scaled[k] > 0.0 ? std::min(scaled[k], 1.0) : 0.0;
    return result;
}

Picture displayEncoded(const Picture& picture, double stops)
{
    Picture result = picture;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const osg::Vec3d linear = exposed(picture.color(x, y), stops);
            for (int k = 0; k < 3; ++k) result.at(x, y)[k] = float(encode(linear[k]));
        }
    return result;
}

double automaticExposure(const Picture& reference, const Mask& mask)
{
    requireSameSize(reference, mask);
    std::vector<double> luminances;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const double l = luminance(reference.color(x, y));
            if (mask.at(x, y) && std::isfinite(l)) luminances.push_back(l);
        }
    const double bright = percentile(luminances, 900);
    return bright > 0.0 ? std::log2(0.6 / bright) : 0.0;
}

}  // namespace osgEnvLight
