// SPDX-License-Identifier: MIT
// Environment maps for the tests, from functions of the direction. The convention is written out here a second time, so
// that lib/latlong.glsl is not its own judge.
#pragma once

#include <osgEnvLight/EnvironmentMap>

#include <functional>

#include "Maths.h"

namespace testmaths
{

using Radiance = std::function<glsl::vec3(const glsl::vec3&)>;

/** Direction of the centre of texel (x, y), y from the top: top row +Z, centre +X, columns clockwise from above. */
glsl::vec3 texelDirection(int x, int y, int width, int height);

/** dphi (cos top - cos bottom). */
double texelSolidAngle(int y, int width, int height);

/** RGB float, row 0 at the bottom; each texel the radiance at its centre. */
osg::ref_ptr<osg::Image> makeMap(int width, int height, const Radiance& radiance);

/** The three floats of texel (x, y), y from the top, of such an image. */
float* texelOf(osg::Image& image, int x, int y);

/** The sanitised map of an image that must serve. Throws otherwise. */
osg::ref_ptr<const osgEnvLight::RadianceMap> radianceOf(const osg::ref_ptr<osg::Image>& image);

/** Irradiance about each normal, by the sum over all texels. */
std::vector<glsl::vec3> irradiance(const osgEnvLight::RadianceMap& map, const std::vector<glsl::vec3>& normals);

}  // namespace testmaths
