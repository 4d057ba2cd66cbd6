// SPDX-License-Identifier: MIT
#pragma once

#include "Accessors.h"
#include "Materials.h"

#include <osg/Geode>
#include <osg/Geometry>

namespace osgEnvLight::gltf
{

/** The meshes of a file as geodes. A mesh that several nodes show is one geode, unless skins or morph targets move its vertices.
 */
class Meshes
{
  public:
    Meshes(const Asset& asset, Accessors& accessors)
        : _asset(asset), _accessors(accessors), _materials(asset), _geodes(asset.model.meshes.size())
    {
    }

    /** Without morph targets and skin, shared. */
    osg::Geode* geode(int mesh);

    bool hasTargets(int mesh) const;
    std::size_t primitives(int mesh) const { return _asset.model.meshes[std::size_t(mesh)].primitives.size(); }

    /** One primitive for one node: an osgAnimation::MorphGeometry with the weights where the mesh has morph targets. */
    osg::ref_ptr<osg::Geometry> primitive(int mesh, std::size_t primitive, const std::vector<double>& weights);

    /** "meshes[1].primitives[0]" */
    static std::string path(int mesh, std::size_t primitive);

  private:
    int attribute(const tinygltf::Primitive& p, const char* name) const;
    int matching(const tinygltf::Primitive& p, const char* name, std::size_t vertices, const std::string& path) const;
    void fill(osg::Geometry& geometry, int mesh, std::size_t primitive);
    void fillTextureCoordinates(osg::Geometry& geometry, const tinygltf::Primitive& p, const std::string& path);
    void fillColors(osg::Geometry& geometry, const tinygltf::Primitive& p, const std::string& path);
    void fillTargets(osg::Geometry& geometry, int mesh, std::size_t primitive, const std::vector<double>& weights);

    const Asset& _asset;
    Accessors& _accessors;
    Materials _materials;
    std::vector<osg::ref_ptr<osg::Geode>> _geodes;
};

}  // namespace osgEnvLight::gltf
