/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Array>
#include <osg/Image>
#include <osg/Node>
#include <osg/Texture>
#include <osg/Vec3f>
#include <osg/observer_ptr>

#include <map>
#include <mutex>

namespace osgEnvLight
{

/** What the texels of an image look like. */
enum class TexelKind {
    COLORS,
    NORMALS_PERHAPS,  // nearly all are directions about +z, as in a normal map; so may be an image of pale blue
    NORMALS,          // all are, of unit length, and they differ
    MASK              // nearly all are black or white, and both are there
};

/** What the texels of a texture say of the surfaces that bear it. */
struct TextureFacts {
    bool translucent = false;                        // some alpha is less than 1
    bool linear = false;                             // colours are scene-linear: floats, or in a format that the GPU decodes
    bool alphaOnly = false;                          // it has no colour: GL_ALPHA
    osg::Vec3f mean = osg::Vec3f(0.5f, 0.5f, 0.5f);  // colour, linear; grey where no image was seen
    float opacity = 1.0f;                            // mean alpha
    TexelKind texels = TexelKind::COLORS;
    size_t image = 0;  // tells images apart: by their files' names, else by their addresses; 0: none was seen
};

/** Remembers what texels and vertex colours say, so that they are read once: OSG gives a texture's image away when it has
 * been uploaded (osgUtil::Optimizer, unRefImageDataAfterApply), and reading them in each frame would cost more than drawing.
 * One for each LitScene; nothing is written to the user's objects. Thread-safe.*/
class OSGENVLIGHT_EXPORT SurfaceFacts : public osg::Referenced
{
  public:
    /** Of a texture as it is now, or as it was when its image was last there. Where no image was ever seen, or it keeps
     * changing (a video), the format decides: with an alpha channel, translucent. */
    TextureFacts of(const osg::Texture& texture);

    /** Whether some alpha of vertex colours is less than 1. */
    bool isTranslucent(const osg::Array& colors);

    /** Mean of vertex colours, as they are. */
    osg::Vec3f meanColor(const osg::Array& colors);

    /** Read all textures below a node while their images are there: before they are uploaded. */
    void look(osg::Node& node);

    /** Entries, dead ones included until the next clean-up. */
    size_t size() const;

    /** The same without a memory. */
    static TextureFacts measure(const osg::Texture& texture);
    static bool measure(const osg::Array& colors);
    static osg::Vec3f measureMean(const osg::Array& colors);

    /** False for a texture that OSG does not draw with: its image is missing, and nothing else fills it. */
    static bool hasTexels(const osg::Texture& texture);

  protected:
    ~SurfaceFacts() override = default;

  private:
    struct TextureEntry {
        osg::observer_ptr<const osg::Texture> texture;
        osg::observer_ptr<const osg::Image> image;
        unsigned modified = 0;
        unsigned changes = 0;
        TextureFacts facts;
    };
    struct ArrayEntry {
        osg::observer_ptr<const osg::Array> array;
        unsigned modified = 0;
        bool translucent = false;
        osg::Vec3f mean;
    };
    const ArrayEntry& entryOf(const osg::Array& colors);
    void forgetDead();

    mutable std::mutex _mutex;
    std::map<const osg::Texture*, TextureEntry> _textures;
    std::map<const osg::Array*, ArrayEntry> _arrays;
    size_t _cleanUpAt = 256;
};

}  // namespace osgEnvLight
