// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace osgEnvLight::gltf
{

/** Whether every property that the reader uses has the type, the range and the size that glTF 2.0 prescribes, every index a
 * target, and every required extension is known. Throws std::runtime_error that names the file, the property, what was expected
 * and what was found. What it passes, tinygltf reads without loss. */
void checkSchema(const nlohmann::json& document, const std::string& name);

}  // namespace osgEnvLight::gltf
