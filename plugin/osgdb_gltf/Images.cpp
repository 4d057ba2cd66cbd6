// SPDX-License-Identifier: MIT
#include "Images.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
// They are written to a buffer that threads share.
#define STBI_NO_FAILURE_STRINGS
#define STBI_MAX_DIMENSIONS 16384
#include <stb_image.h>

namespace osgEnvLight::gltf
{

namespace
{

/** Deflate's limit, and about JPEG's: one byte of a file can't stand for more bytes of a picture. */
constexpr std::uint64_t mostPixelBytes = 1032;

/** Of a picture as it is compressed: in a grey or indexed PNG, pixels may be single bits. */
std::uint64_t packedBytes(const Bytes& file, std::uint64_t width, std::uint64_t height, std::uint64_t channels)
{
    constexpr std::size_t depthPlace = 24, kindPlace = 25;  // in the header of a PNG [PNG specification, 11.2.2]
    constexpr unsigned grey = 0, indexed = 3;
    const bool isPng = file.size() > kindPlace && file[0] == 0x89 && file[1] == 'P';
    const bool isNarrow = isPng && (unsigned(file[kindPlace]) == grey || unsigned(file[kindPlace]) == indexed);
    const std::uint64_t bits = isNarrow ? std::min(unsigned(file[depthPlace]), 8u) : 8 * channels;
    return (width * bits + 7) / 8 * height;
}

std::string kindOf(const Bytes& bytes)
{
    const std::string start(bytes.begin(), bytes.begin() + std::ptrdiff_t(std::min<std::size_t>(bytes.size(), 12)));
    if (start.size() == 12 && start.compare(0, 4, "RIFF") == 0 && start.compare(8, 4, "WEBP") == 0) return "WebP";
    if (start.compare(0, 7, "\xabKTX 20") == 0) return "KTX2";
    return "something else";
}

osg::ref_ptr<osg::Image> decode(const Bytes& bytes, const Asset& asset, const std::string& path)
{
    const int size = bytes.size() <= 0x7fffffff ? int(bytes.size()) : 0;
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels))
        asset.fail(path, "a PNG or JPEG image of at most 16384 pixels a side", kindOf(bytes));
    if (width < 1 || height < 1 || width > STBI_MAX_DIMENSIONS || height > STBI_MAX_DIMENSIONS ||
        packedBytes(bytes, std::uint64_t(width), std::uint64_t(height), std::uint64_t(channels)) > mostPixelBytes * bytes.size())
        asset.fail(path, "as many pixels as a file of " + std::to_string(bytes.size()) + " bytes can hold",
                   std::to_string(width) + " x " + std::to_string(height));
    unsigned char* pixels = stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 0);
    if (!pixels) asset.fail(path, "a PNG or JPEG image", "a damaged one");

    const GLenum formats[] = {GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_RGB, GL_RGBA};
    osg::ref_ptr<osg::Image> image = new osg::Image;
    const GLenum format = formats[channels - 1];
    image->setImage(width, height, 1, GLint(format), format, GL_UNSIGNED_BYTE, pixels, osg::Image::USE_MALLOC_FREE);
    image->setOrigin(osg::Image::TOP_LEFT);
    return image;
}

}  // namespace

osg::Image* Images::image(int index)
{
    osg::ref_ptr<osg::Image>& image = _images[std::size_t(index)];
    if (!image) {
        image = decode(_asset.image(index), _asset, element("images", std::size_t(index)));
        const std::string& uri = _asset.uris[std::size_t(index)];
        if (uri.compare(0, 5, "data:") != 0) image->setFileName(uri);
    }
    return image.get();
}

}  // namespace osgEnvLight::gltf
