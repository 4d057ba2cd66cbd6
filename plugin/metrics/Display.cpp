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

unsigned char byteOf(float value)
{
    return static_cast<unsigned char>(std::lround(255.0f * (value > 0.0f ? std::min(value, 1.0f) : 0.0f)));
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

osg::ref_ptr<osg::Image> eightBit(const Picture& encoded)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(encoded.width, encoded.height, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    for (int y = 0; y < encoded.height; ++y)
        for (int x = 0; x < encoded.width; ++x) {
            unsigned char* out = image->data(unsigned(x), unsigned(y));
            for (int k = 0; k < 3; ++k) out[k] = byteOf(encoded.at(x, y)[k]);
        }
    return image;
}

osg::ref_ptr<osg::Image> eightBitCovered(const Picture& encoded)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(encoded.width, encoded.height, 1, GL_RGBA, GL_UNSIGNED_BYTE, 1);
    for (int y = 0; y < encoded.height; ++y)
        for (int x = 0; x < encoded.width; ++x) {
            unsigned char* out = image->data(unsigned(x), unsigned(y));
            const float* in = encoded.at(x, y);
            out[3] = byteOf(in[3]);
            for (int k = 0; k < 3; ++k) out[k] = out[3] > 0 ? byteOf(in[k] / std::min(in[3], 1.0f)) : 0;
        }
    return image;
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
