// SPDX-License-Identifier: MIT
#include "DisplayPng.h"

#include <osg/Image>
#include <osgDB/Registry>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace tradeoff
{

namespace
{

// IEC 61966-2-1
double srgb(double x)
{
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

osg::ref_ptr<osg::Image> displayImage(const osgEnvLight::Picture& picture, Encoding encoding, double scale)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(picture.width, picture.height, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double value = scale * double(picture.at(x, y)[c]);
                const double display = value > 0.0 ? std::min(value, 1.0) : 0.0;  // NaN is black
                const double code = 255.0 * (encoding == LINEAR ? srgb(display) : display);
                image->data(unsigned(x), unsigned(y))[c] = static_cast<unsigned char>(std::lround(code));
            }
    return image;
}

std::string png(const osg::Image& image)
{
    osgDB::ReaderWriter* writer = osgDB::Registry::instance()->getReaderWriterForExtension("png");
    std::ostringstream stream;
    if (!writer || !writer->writeImage(image, stream).success())
        throw std::runtime_error("PNG can't be written: OpenSceneGraph's plugin osgdb_png is missing");
    return stream.str();
}

std::string base64(const std::string& bytes)
{
    const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace

std::string pngUri(const osgEnvLight::Picture& picture, Encoding encoding, double scale)
{
    return "data:image/png;base64," + base64(png(*displayImage(picture, encoding, scale)));
}

}  // namespace tradeoff
