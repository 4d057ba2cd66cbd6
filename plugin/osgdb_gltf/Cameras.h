// SPDX-License-Identifier: MIT
#pragma once

#include "Asset.h"

#include <osg/CameraView>

namespace osgEnvLight::gltf
{

/** A perspective camera in the frame of its node, which it is named after if it has no name. Its planes and its aspect ratio are
 * left to the viewer. */
osg::ref_ptr<osg::CameraView> makeCamera(const Asset::Camera& camera, const tinygltf::Node& node);

}  // namespace osgEnvLight::gltf
