// SPDX-License-Identifier: MIT
#pragma once

#include "Accessors.h"

#include <osgAnimation/Bone>
#include <osgAnimation/RigGeometry>

namespace osgEnvLight::gltf
{

/** The skins of a file for osgAnimation. There a bone has one inverse bind matrix; in glTF several skins may bind a joint. So
 * each joint of each skin is a bone of its own, without a transform, below the bone that the joint's node is. All bones are below
 * one Skeleton above the scene, and so are the skinned meshes: their nodes' transforms do not count (glTF 2.0, 3.7.3.3). */
class Skins
{
  public:
    Skins(const Asset& asset, Accessors& accessors) : _asset(asset), _accessors(accessors), _used(asset.model.skins.size()) {}

    bool any() const { return !_asset.model.skins.empty(); }

    /** Which nodes have to be bones: joints, and what is above them. */
    std::vector<bool> boneNodes(const std::vector<int>& parents) const;

    /** Adds the joints of the rigs below the bones of `nodes`; those that are null are not in the scene. */
    void addJoints(const std::vector<osg::ref_ptr<osg::Group>>& nodes);

    /** `source` moved by a skin. `primitive` is its path, for messages. */
    osg::ref_ptr<osgAnimation::RigGeometry> rig(osg::Geometry* source, int skin, const tinygltf::Primitive& p,
                                                const std::string& primitive);

  private:
    osg::ref_ptr<osgAnimation::VertexInfluenceMap> influences(std::size_t vertices, int skin, const tinygltf::Primitive& p,
                                                              const std::string& primitive);

    const Asset& _asset;
    Accessors& _accessors;
    std::vector<bool> _used;  // by a rig
};

}  // namespace osgEnvLight::gltf
