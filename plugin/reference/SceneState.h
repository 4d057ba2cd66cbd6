// SPDX-License-Identifier: MIT
// The state above a drawable, as the flattener reads it.
#pragma once

#include "surface/SurfaceState.h"

#include <reference/TriangleScene>

#include <map>
#include <set>

namespace osgEnvLight
{

/** Textures already read, by the texture and whether it is linear; and what could not be. */
class TextureCache
{
  public:
    std::shared_ptr<const TextureImage> get(const osg::Texture& texture, bool linear, std::string& reason);

  private:
    struct Entry {
        std::shared_ptr<const TextureImage> image;
        std::string reason;
    };
    std::map<std::pair<const osg::Texture*, bool>, Entry> _entries;
};

class SceneState : public SurfaceState
{
  public:
    void merge(const osg::StateSet& stateSet);

    /** Of a drawable.
     * @param linearColors  the host's colours are linear, not sRGB encoded
     * @param leftOut       receives what the material lacks against the picture */
    SurfaceMaterial material(const osg::Geometry& geometry, bool linearColors, TextureCache& textures,
                             std::set<std::string>& leftOut) const;
    osg::Matrixd textureMatrix() const;

  private:
    void setHostMaterial(SurfaceMaterial& m, bool linearColors) const;
    void setOwnMaterial(SurfaceMaterial& m) const;
    void setTexture(SurfaceMaterial& m, TextureCache& textures, std::set<std::string>& leftOut) const;
    template <class T>
    T uniform(const char* name, T value) const;

    Mode _alphaTest;
    Mode _cullFace;
    Mode _clip;
    Attribute _alphaFunction;
    Attribute _cullSide;
    Attribute _frontFace;
    Attribute _blendFunction;
    Attribute _polygonMode;
    std::map<std::string, osg::StateSet::RefUniformPair> _uniforms;
};

}  // namespace osgEnvLight
