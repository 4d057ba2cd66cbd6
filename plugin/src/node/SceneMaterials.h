/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/SceneDescription>

#include "base/JsonValue.h"

namespace osgEnvLight
{

/** An entry of a scene description's "materials". Throws std::runtime_error in words that name the key. */
MaterialDescription readMaterial(const JsonValue& value, const std::string& name);

/** Put materials on the state sets whose osg::Material, or on the nodes whose own name, they are for. Throws std::runtime_error
 * if nothing bears one of the names.
 * @param file  for the message */
void setMaterials(osg::Node& node, const std::vector<MaterialDescription>& materials, const std::string& file);

}  // namespace osgEnvLight
