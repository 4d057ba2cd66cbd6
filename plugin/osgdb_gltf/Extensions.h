// SPDX-License-Identifier: MIT
// What tinygltf leaves of an extension. The schema has checked the types of what is asked for.
#pragma once

#include "TinyGltf.h"

#include <osg/Vec3f>

namespace osgEnvLight::gltf
{

/** Null where the file does not use it. */
inline const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name)
{
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

inline double numberOf(const tinygltf::Value& object, const char* key, double otherwise)
{
    return object.Has(key) ? object.Get(key).GetNumberAsDouble() : otherwise;
}

/** Of a list. */
inline double numberAt(const tinygltf::Value& object, const char* key, int index, double otherwise)
{
    return object.Has(key) ? object.Get(key).Get(index).GetNumberAsDouble() : otherwise;
}

inline osg::Vec3f colorOf(const tinygltf::Value& object, const char* key, float otherwise)
{
    osg::Vec3f color;
    for (int i = 0; i < 3; ++i) color[i] = float(numberAt(object, key, i, otherwise));
    return color;
}

}  // namespace osgEnvLight::gltf
