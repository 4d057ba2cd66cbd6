// SPDX-License-Identifier: MIT
#include "DisplayPng.h"

#include <metrics/Display>

#include <osgDB/Registry>

#include <sstream>
#include <stdexcept>

namespace tradeoff
{

namespace
{

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

std::string pngUri(const osgEnvLight::Picture& encoded)
{
    return "data:image/png;base64," + base64(png(*osgEnvLight::eightBit(encoded)));
}

}  // namespace tradeoff
