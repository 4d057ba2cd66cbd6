// SPDX-License-Identifier: MIT
#include <reference/TextureImage>

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// Index into n texels, or -1 for the border.
int wrapped(int i, int n, osg::Texture::WrapMode mode)
{
    switch (mode) {
        case osg::Texture::REPEAT:
            return ((i % n) + n) % n;
        case osg::Texture::MIRROR: {
            const int j = ((i % (2 * n)) + 2 * n) % (2 * n);
            return j < n ? j : 2 * n - 1 - j;
        }
        case osg::Texture::CLAMP_TO_BORDER:
            return i < 0 || i >= n ? -1 : i;
        default:
            return std::clamp(i, 0, n - 1);
    }
}

// The image that OpenGL gets: unless told otherwise, osg::Texture scales to powers of two whatever the context supports.
// Not its cap to the largest size that the context has.
osg::ref_ptr<const osg::Image> uploaded(const osg::Image& image, bool powersOfTwo)
{
    const int s = osg::Image::computeNearestPowerOfTwo(image.s()), t = osg::Image::computeNearestPowerOfTwo(image.t());
    if (!powersOfTwo || (s == image.s() && t == image.t())) return &image;
    const osg::ref_ptr<osg::Image> result = new osg::Image(image, osg::CopyOp::DEEP_COPY_ALL);
    result->scaleImage(s, t, 1);
    return result;
}

bool mipmapped(osg::Texture::FilterMode mode)
{
    return mode != osg::Texture::LINEAR && mode != osg::Texture::NEAREST;
}

glm::vec4 decoded(const glm::vec4& c)
{
    const glsl::vec3 rgb = glsl::srgbDecode3(glsl::vec3(c));
    return glm::vec4(glm::vec3(rgb), c.a);
}

}  // namespace

std::shared_ptr<const TextureImage> TextureImage::create(const osg::Texture& texture, bool linear, std::string& reason)
{
    const osg::Image* image = texture.getNumImages() > 0 ? texture.getImage(0) : nullptr;
    if (!dynamic_cast<const osg::Texture2D*>(&texture) || !image || image->s() < 1 || image->t() < 1 || !image->data())
        reason = "not a two-dimensional texture with an image";
    else if (image->isCompressed())
        reason = "compressed";
    else {
        std::shared_ptr<TextureImage> t = std::make_shared<TextureImage>();
        t->_wrapS = texture.getWrap(osg::Texture::WRAP_S);
        t->_wrapT = texture.getWrap(osg::Texture::WRAP_T);
        t->_minFilter = texture.getFilter(osg::Texture::MIN_FILTER);
        t->_magFilter = texture.getFilter(osg::Texture::MAG_FILTER);
        const osg::Vec4d border = texture.getBorderColor();
        t->_border = glm::dvec4(border.x(), border.y(), border.z(), border.w());
        const GLint format = texture.getInternalFormat();
        const bool decodedByFormat = format == GL_SRGB8 || format == GL_SRGB8_ALPHA8;
        t->_decode = !linear;
        const osg::ref_ptr<const osg::Image> resized = uploaded(*image, texture.getResizeNonPowerOfTwoHint());
        Level level{resized->s(), resized->t(), {}};
        level.texels.reserve(size_t(level.width) * size_t(level.height));
        for (unsigned y = 0; y < unsigned(level.height); ++y)
            for (unsigned x = 0; x < unsigned(level.width); ++x) {
                const osg::Vec4 c = resized->getColor(x, y);
                const glm::vec4 texel(c.r(), c.g(), c.b(), c.a());
                level.texels.push_back(decodedByFormat ? decoded(texel) : texel);
            }
        t->_levels.push_back(std::move(level));
        while (mipmapped(t->_minFilter) && (t->_levels.back().width > 1 || t->_levels.back().height > 1))
            t->_levels.push_back(halved(t->_levels.back()));
        return t;
    }
    return nullptr;
}

TextureImage::Level TextureImage::halved(const Level& fine)
{
    Level result{std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), {}};
    const double stepX = double(fine.width) / result.width;
    const double stepY = double(fine.height) / result.height;
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            // The mean over the texel's part of the image: of an odd number of texels, more than two.
            glm::dvec4 sum(0.0);
            const double left = x * stepX, right = std::min(left + stepX, double(fine.width));
            const double low = y * stepY, high = std::min(low + stepY, double(fine.height));
            for (int fy = int(low); fy < high; ++fy)
                for (int fx = int(left); fx < right; ++fx) {
                    const double h = std::min(fy + 1.0, high) - std::max(double(fy), low);
                    const double w = std::min(fx + 1.0, right) - std::max(double(fx), left);
                    sum += w * h * glm::dvec4(fine.texels[size_t(fy) * size_t(fine.width) + size_t(fx)]);
                }
            result.texels.push_back(glm::vec4(sum / (stepX * stepY)));
        }
    return result;
}

glm::dvec4 TextureImage::texel(const Level& level, int s, int t) const
{
    const int x = wrapped(s, level.width, _wrapS);
    const int y = wrapped(t, level.height, _wrapT);
    if (x < 0 || y < 0) return _border;
    return glm::dvec4(level.texels[size_t(y) * size_t(level.width) + size_t(x)]);
}

glm::dvec4 TextureImage::filtered(const Level& level, const glm::dvec2& st, bool linear) const
{
    // Coordinates beyond what an int holds have no texel in float either.
    const glm::dvec2 p = glm::clamp(st * glm::dvec2(level.width, level.height) - (linear ? 0.5 : 0.0), -1e9, 1e9);
    const glm::ivec2 i(glm::floor(p));
    if (!linear) return texel(level, i.x, i.y);
    const glm::dvec2 f = p - glm::dvec2(i);
    return glm::mix(glm::mix(texel(level, i.x, i.y), texel(level, i.x + 1, i.y), f.x),
                    glm::mix(texel(level, i.x, i.y + 1), texel(level, i.x + 1, i.y + 1), f.x), f.y);
}

glm::dvec4 TextureImage::sample(const glm::dvec2& st, const glm::dvec2& dx, const glm::dvec2& dy) const
{
    const glm::dvec2 size(_levels[0].width, _levels[0].height);
    const double rho = std::max(glm::length(dx * size), glm::length(dy * size));
    const double lod = std::clamp(std::log2(std::max(rho, 1e-30)), -1000.0, double(_levels.size() - 1));
    glm::dvec4 c;
    if (lod <= 0.0) {
        c = filtered(_levels[0], st, _magFilter == osg::Texture::LINEAR);
    } else {
        const bool linear = _minFilter == osg::Texture::LINEAR || _minFilter == osg::Texture::LINEAR_MIPMAP_LINEAR ||
                            _minFilter == osg::Texture::LINEAR_MIPMAP_NEAREST;
        const bool between =
            _minFilter == osg::Texture::LINEAR_MIPMAP_LINEAR || _minFilter == osg::Texture::NEAREST_MIPMAP_LINEAR;
        const double level = between ? std::floor(lod) : std::floor(lod + 0.5);
        const size_t i = std::min(size_t(level), _levels.size() - 1);
        c = filtered(_levels[i], st, linear);
        if (between && i + 1 < _levels.size()) c = glm::mix(c, filtered(_levels[i + 1], st, linear), lod - level);
    }
    return _decode ? glm::dvec4(glsl::srgbDecode3(glsl::vec3(c)), c.a) : c;
}

}  // namespace osgEnvLight
