// SPDX-License-Identifier: MIT
#pragma once

#include "TinyGltf.h"

#include <osg/LightSource>

namespace osgEnvLight::gltf
{

/** KHR_lights_punctual as an osg::LightSource, with this number, in the node's frame.
 *
 * Diffuse and specular are color times intensity / pi as display values: with osgEnvLight, where a white Lambert surface sends on
 * a light's colour times the cosine, lux and candela are irradiance and radiant intensity. Points and spots fall off with the
 * square of the distance; their range is left out. OpenGL's cone is cut at the outer angle and falls as a power of the cosine
 * that is 1/2 midway between the inner and the outer angle. */
osg::ref_ptr<osg::LightSource> makeLight(const tinygltf::Light& light, int number);

/** OpenGL has 8, of which viewers take number 0. */
constexpr int mostLights = 7;

}  // namespace osgEnvLight::gltf
