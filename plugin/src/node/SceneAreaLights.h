/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/AreaLight>

#include "base/JsonValue.h"

#include <osg/ref_ptr>

#include <vector>

namespace osgEnvLight
{

/** A scene description's "lights". Throws std::runtime_error in words that name the key. */
std::vector<osg::ref_ptr<AreaLight>> readAreaLights(const JsonValue& list);

}  // namespace osgEnvLight
