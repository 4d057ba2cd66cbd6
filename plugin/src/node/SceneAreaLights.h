/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/AreaLight>

#include "base/JsonValue.h"

#include <osg/ref_ptr>
#include <osgDB/Options>

#include <string>
#include <vector>

namespace osgEnvLight
{

/** A scene description's "lights". Images have their file names, but no pixels yet. Throws std::runtime_error in words that name
 * the key. */
std::vector<osg::ref_ptr<AreaLight>> readAreaLights(const JsonValue& list);

/** A copy of such a light with its image read, of which a video runs. Throws std::runtime_error in words that name the file.
 * @param file  of the scene description, for messages */
osg::ref_ptr<AreaLight> loadAreaLight(const AreaLight& light, const osgDB::Options* options, const std::string& file);

}  // namespace osgEnvLight
