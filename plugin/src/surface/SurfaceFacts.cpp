// SPDX-License-Identifier: MIT
#include "surface/SurfaceFacts.h"

#include <osg/NodeVisitor>
#include <osg/StateSet>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>
#include <functional>

#include "glsl.h"
#include "lib/tone.glsl"

namespace osgEnvLight
{

namespace
{

const osg::Image* imageOf(const osg::Texture& texture)
{
    const osg::Image* image = texture.getNumImages() > 0 ? texture.getImage(0) : nullptr;
    return image && image->data() ? image : nullptr;
}

bool isFloat(GLenum type)
{
    return type == GL_FLOAT || type == GL_HALF_FLOAT || type == GL_DOUBLE;
}

bool isFloatFormat(GLint format)
{
    switch (format) {
        case GL_RGBA32F_ARB:
        case GL_RGB32F_ARB:
        case GL_RGBA16F_ARB:
        case GL_RGB16F_ARB:
        case GL_LUMINANCE32F_ARB:
        case GL_LUMINANCE16F_ARB:
        case GL_R32F:
        case GL_R16F:
        case GL_RG32F:
        case GL_RG16F:
            return true;
        default:
            return false;
    }
}

bool isSrgbFormat(GLint format)
{
    switch (format) {
        case GL_SRGB:
        case GL_SRGB8:
        case GL_SRGB_ALPHA:
        case GL_SRGB8_ALPHA8:
        case GL_COMPRESSED_SRGB_S3TC_DXT1_EXT:
        case GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT:
        case GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT:
        case GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT:
            return true;
        default:
            return false;
    }
}

bool hasAlpha(GLint format)
{
    switch (format) {
        case 0:
        case 1:
        case 3:
        case GL_RGB:
        case GL_RGB5:
        case GL_RGB8:
        case GL_RGB16:
        case GL_RED:
        case GL_RG:
        case GL_BGR:
        case GL_LUMINANCE:
        case GL_LUMINANCE8:
        case GL_SRGB:
        case GL_SRGB8:
        case GL_RGB16F_ARB:
        case GL_RGB32F_ARB:
        case GL_COMPRESSED_RGB:
        case GL_COMPRESSED_RGB_S3TC_DXT1_EXT:
        case GL_COMPRESSED_SRGB_S3TC_DXT1_EXT:
            return false;
        default:
            return true;
    }
}

// All that can be known without an image.
TextureFacts ofFormat(const osg::Texture& texture)
{
    const GLint format = texture.getInternalFormat();
    return {hasAlpha(format), isFloatFormat(format) || isSrgbFormat(format), format == GL_ALPHA || format == GL_ALPHA8};
}

template <class Array>
bool anyBelow(const Array& colors, double one)
{
    for (const auto& c : colors)
        if (double(c.a()) < one) return true;
    return false;
}

template <class Array>
osg::Vec3f meanOf(const Array& colors, double one)
{
    osg::Vec3d sum;
    for (const auto& c : colors) sum += osg::Vec3d(double(c[0]), double(c[1]), double(c[2])) / one;
    return colors.empty() ? osg::Vec3f(1, 1, 1) : osg::Vec3f(sum / double(colors.size()));
}

// Counts texels that look like those of a normal map or of a mask. Measured with 265 images: 77 of Crytek's Sponza, and those
// that come with OpenSceneGraph, Assimp and Blender. Of what is not black in the 22 normal maps, .87 and more are loosely of unit
// length, in 20 of them .88 and more tightly, and the mean leans by .03 at most; no other image with .46 loose ones leans by less
// than .24. The three masks are black or white in .88 of their texels and more; so are drawings of lines, but no map of gloss.
class TexelCensus
{
  public:
    void add(const osg::Vec4& c)
    {
        const float most = std::max({c[0], c[1], c[2]}), least = std::min({c[0], c[1], c[2]});
        const bool black = most < 0.1f, grey = most - least < 0.025f;
        ++_all;
        _grey += grey;
        _black += black;
        _white += grey && least > 0.9f;
        if (black) return;  // between the parts of an atlas
        const osg::Vec3f direction(2.0f * c[0] - 1.0f, 2.0f * c[1] - 1.0f, 2.0f * c[2] - 1.0f);
        const float off = direction[2] > 0.0f ? std::abs(direction.length() - 1.0f) : 1.0f;
        _loose += off < 0.25f;
        _tight += off < 0.1f;
        _sum += direction;
        _tilt += double(direction[0] * direction[0] + direction[1] * direction[1]);
    }

    TexelKind kind() const
    {
        const double shown = _all - _black;
        if (_grey >= 0.95 * _all && _black + _white >= 0.85 * _all && std::min(_black, _white) >= 0.03 * _all)
            return TexelKind::MASK;
        const double lean = std::max(std::abs(double(_sum[0])), std::abs(double(_sum[1])));
        if (shown < 1.0 || _loose < 0.75 * shown || lean > 0.15 * shown) return TexelKind::COLORS;
        const bool differ = _tilt > 0.05 * 0.05 * shown;
        return _tight >= 0.88 * shown && differ ? TexelKind::NORMALS : TexelKind::NORMALS_PERHAPS;
    }

  private:
    double _all = 0.0, _grey = 0.0, _black = 0.0, _white = 0.0, _loose = 0.0, _tight = 0.0, _tilt = 0.0;
    osg::Vec3f _sum;
};

// By 32 x 32 texels at most.
void addMeans(TextureFacts& facts, const osg::Image& image)
{
    if (facts.alphaOnly) facts.mean = osg::Vec3f(1, 1, 1);
    if (facts.alphaOnly || image.s() < 1 || image.t() < 1) return;
    const int columns = std::min(image.s(), 32), rows = std::min(image.t(), 32);
    osg::Vec3d sum;
    double alpha = 0.0;
    TexelCensus census;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const osg::Vec4 c =
                image.getColor(unsigned((2 * x + 1) * image.s() / (2 * columns)), unsigned((2 * y + 1) * image.t() / (2 * rows)));
            for (int k = 0; k < 3; ++k) sum[k] += facts.linear ? double(c.ptr()[k]) : glsl::srgbDecode(double(c.ptr()[k]));
            alpha += double(c.a());
            census.add(c);
        }
    facts.mean = osg::Vec3f(sum / double(columns * rows));
    facts.opacity = float(alpha / double(columns * rows));
    if (!facts.linear) facts.texels = census.kind();
}

class TextureLooker : public osg::NodeVisitor
{
  public:
    explicit TextureLooker(SurfaceFacts& facts) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _facts(facts)
    {
        setNodeMaskOverride(~0u);
    }
    void apply(osg::Node& node) override
    {
        if (const osg::StateSet* s = node.getStateSet())
            for (unsigned unit = 0; unit < s->getNumTextureAttributeLists(); ++unit) {
                const osg::StateAttribute* a = s->getTextureAttribute(unit, osg::StateAttribute::TEXTURE);
                if (const osg::Texture* texture = a ? a->asTexture() : nullptr) _facts.of(*texture);
            }
        traverse(node);
    }

  private:
    SurfaceFacts& _facts;
};

}  // namespace

bool SurfaceFacts::hasTexels(const osg::Texture& texture)
{
    if (imageOf(texture) || texture.getTextureWidth() > 0) return true;
    const auto* flat = dynamic_cast<const osg::Texture2D*>(&texture);
    return flat && flat->getSubloadCallback();
}

TextureFacts SurfaceFacts::measure(const osg::Texture& texture)
{
    const osg::Image* image = imageOf(texture);
    if (!image) return ofFormat(texture);
    const GLenum pixels = image->getPixelFormat();
    const bool given = texture.getInternalFormatMode() == osg::Texture::USE_USER_DEFINED_FORMAT;
    TextureFacts facts{image->isImageTranslucent(),
                       isFloat(image->getDataType()) || (given && isSrgbFormat(texture.getInternalFormat())), pixels == GL_ALPHA};
    addMeans(facts, *image);
    const std::string& file = image->getFileName();
    facts.image = file.empty() ? std::hash<const osg::Image*>()(image) : std::hash<std::string>()(file);
    return facts;
}

osg::Vec3f SurfaceFacts::measureMean(const osg::Array& colors)
{
    if (const auto* a = dynamic_cast<const osg::Vec4Array*>(&colors)) return meanOf(*a, 1.0);
    if (const auto* a = dynamic_cast<const osg::Vec3Array*>(&colors)) return meanOf(*a, 1.0);
    if (const auto* a = dynamic_cast<const osg::Vec4dArray*>(&colors)) return meanOf(*a, 1.0);
    if (const auto* a = dynamic_cast<const osg::Vec4ubArray*>(&colors)) return meanOf(*a, 255.0);
    return osg::Vec3f(1, 1, 1);
}

bool SurfaceFacts::measure(const osg::Array& colors)
{
    if (const auto* floats = dynamic_cast<const osg::Vec4Array*>(&colors)) return anyBelow(*floats, 1.0);
    if (const auto* doubles = dynamic_cast<const osg::Vec4dArray*>(&colors)) return anyBelow(*doubles, 1.0);
    if (const auto* bytes = dynamic_cast<const osg::Vec4ubArray*>(&colors)) return anyBelow(*bytes, 255.0);
    return false;
}

TextureFacts SurfaceFacts::of(const osg::Texture& texture)
{
    const osg::Image* image = imageOf(texture);
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _textures.find(&texture);
    const bool known = found != _textures.end() && found->second.texture.valid();
    if (known && (!image || (found->second.image == image && found->second.modified == image->getModifiedCount())))
        return found->second.facts;
    if (!image) return ofFormat(texture);  // it may yet come
    TextureEntry entry;
    entry.texture = &texture;
    entry.image = image;
    entry.modified = image->getModifiedCount();
    entry.changes = known ? found->second.changes + 1 : 0;
    entry.facts = measure(texture);
    // The second change is one of many: no frame of a video is searched for its least alpha.
    if (entry.changes > 1) entry.facts.translucent = hasAlpha(GLint(image->getPixelFormat()));
    _textures[&texture] = entry;
    forgetDead();
    return entry.facts;
}

const SurfaceFacts::ArrayEntry& SurfaceFacts::entryOf(const osg::Array& colors)
{
    ArrayEntry& entry = _arrays[&colors];
    if (entry.array != &colors || entry.modified != colors.getModifiedCount())
        entry = {&colors, colors.getModifiedCount(), measure(colors), measureMean(colors)};
    return entry;
}

bool SurfaceFacts::isTranslucent(const osg::Array& colors)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const bool translucent = entryOf(colors).translucent;
    forgetDead();
    return translucent;
}

osg::Vec3f SurfaceFacts::meanColor(const osg::Array& colors)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const osg::Vec3f mean = entryOf(colors).mean;
    forgetDead();
    return mean;
}

void SurfaceFacts::look(osg::Node& node)
{
    TextureLooker looker(*this);
    node.accept(looker);
}

size_t SurfaceFacts::size() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _textures.size() + _arrays.size();
}

// When there are twice as many as were alive the last time.
void SurfaceFacts::forgetDead()
{
    if (_textures.size() + _arrays.size() < _cleanUpAt) return;
    for (auto it = _textures.begin(); it != _textures.end();)
        it = it->second.texture.valid() ? std::next(it) : _textures.erase(it);
    for (auto it = _arrays.begin(); it != _arrays.end();) it = it->second.array.valid() ? std::next(it) : _arrays.erase(it);
    _cleanUpAt = std::max<size_t>(256, 2 * (_textures.size() + _arrays.size()));
}

}  // namespace osgEnvLight
