// SPDX-License-Identifier: MIT
#pragma once

#include "Images.h"
#include "MaterialNames.h"

#include <osg/StateSet>
#include <osg/Texture2D>

#include <map>
#include <tuple>

namespace osgEnvLight::gltf
{

/** The materials of a file as state sets; MaterialNames.h says what is in them. */
class Materials
{
  public:
    explicit Materials(const Asset& asset) : _asset(asset), _images(asset), _textures(asset.model.textures.size()) {}

    /** What a primitive's geometry asks of its material. */
    struct Form {
        bool vertexColors = false;
        bool unlit = false;  // whatever the material says
    };
    /** One state set for each material and form. -1: glTF's default material. */
    osg::StateSet* stateSet(int material, Form form);

    bool isUnlit(int material) const;
    /** Linear factor of the vertex colours, and their alpha. */
    osg::Vec4d baseColor(int material) const;
    /** Of glTF's TEXCOORD_n that unit 0 takes. */
    unsigned baseTexCoord(int material) const;

  private:
    /** A texture as a material refers to it. */
    struct Use {
        int texture = -1;
        unsigned texCoord = 0;
        bool hasTransform = false;
        double offset[2] = {0.0, 0.0};
        double scale[2] = {1.0, 1.0};
        double rotation = 0.0;
    };
    template <class TextureInfo>
    Use use(const TextureInfo& info) const;
    static void readTransform(const tinygltf::Value& transform, Use& use);
    Use use(int material, const char* extensionName, const char* name) const;

    osg::Texture2D* texture(int index);
    void addMap(osg::StateSet& stateSet, int unit, const Use& use, unsigned baseTexCoord);
    void addBaseColor(osg::StateSet& stateSet, const Use& use);
    void addTextures(osg::StateSet& stateSet, int material);
    void addSurface(osg::StateSet& stateSet, const tinygltf::Material& m, Form form);
    void addExtensions(osg::StateSet& stateSet, const tinygltf::Material& m);
    void addBlending(osg::StateSet& stateSet, const tinygltf::Material& m);

    const tinygltf::Material& material(int index) const;

    const Asset& _asset;
    Images _images;
    tinygltf::Material _default;
    std::vector<osg::ref_ptr<osg::Texture2D>> _textures;
    std::map<std::tuple<int, bool, bool>, osg::ref_ptr<osg::StateSet>> _stateSets;
};

/** Linear colours as display values, as OpenSceneGraph shows them; above 1 they stay linear, as the nodekit takes them. */
osg::Vec4 displayColor(const osg::Vec4d& linear);

}  // namespace osgEnvLight::gltf
