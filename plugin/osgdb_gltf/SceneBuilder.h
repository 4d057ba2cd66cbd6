// SPDX-License-Identifier: MIT
#pragma once

#include "Animations.h"
#include "Meshes.h"
#include "Skins.h"

#include <osg/MatrixTransform>

namespace osgEnvLight::gltf
{

/** The nodes of a file's scene, from the root down. */
class SceneBuilder
{
  public:
    explicit SceneBuilder(const Asset& asset);

    osg::ref_ptr<osg::Group> build(bool keepYUp);

  private:
    std::vector<int> roots() const;
    void findParents();
    osg::ref_ptr<osg::Group> makeNode(int index, bool mirrored);
    osg::ref_ptr<osg::Group> makeTransform(int index);
    void addMesh(osg::Group& group, int index);
    osg::ref_ptr<osg::Geode> movingGeode(int index);
    void addInstances(osg::Group& group, osg::Geode* geode, const tinygltf::Value& instancing, const std::string& path);
    void addCamera(osg::Group& group, const tinygltf::Node& node);
    void addLight(osg::Group& group, const tinygltf::Node& node);
    void finish(osg::Group& root);

    const Asset& _asset;
    Accessors _accessors;
    Meshes _meshes;
    Skins _skins;
    Animations _animations;
    std::vector<int> _parents;
    std::vector<bool> _bones, _moved, _morphed;
    std::vector<osg::ref_ptr<osg::Group>> _nodes;    // of the scene
    std::vector<osg::ref_ptr<osg::Geode>> _skinned;  // below the skeleton
    osg::ref_ptr<osg::StateSet> _lightModes;
    int _lights = 0;
};

}  // namespace osgEnvLight::gltf
