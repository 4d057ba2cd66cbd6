// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>
#include <osgDB/Options>

#include <istream>
#include <string>

namespace osgEnvLight::gltf
{

/** A .gltf or .glb file as a scene graph. `options` say where files beside it are looked for (data base path); "keepYUp" in them
 * leaves out the rotation from glTF's +Y up to OpenSceneGraph's +Z up.
 *
 * Read: the default scene, else the first, else all nodes without a parent; meshes of all modes and component types, sparse
 * accessors, morph targets, skins, animations (the first one plays, in a loop), and the extensions of Schema.cpp. Cameras, names
 * of what OpenSceneGraph has no place for, and extras are left out.
 *
 * On failure the result is null and `error` is one line that starts with `name`; otherwise `error` is empty. Throws nothing; safe
 * on several threads at once. */
osg::ref_ptr<osg::Node> readGltf(std::istream& in, const std::string& name, const osgDB::Options* options, std::string& error);

}  // namespace osgEnvLight::gltf
