/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/DirectionalLight>
#include <osgEnvLight/Export>

#include <osg/Texture2D>

namespace osgEnvLight
{

/** Side of the octahedral map of irradiance from that many lights, without its border. Each light has a kink at its horizon, which
 * bilinear filtering rounds off: few lights need small texels, among many the kinks drown. */
OSGENVLIGHT_EXPORT unsigned irradianceSide(size_t lights);

/** Irradiance over pi by the normal, times scale: an octahedral map with a border of one texel, bilinear. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Texture2D> irradianceTexture(const LightList& lights, double scale);

}  // namespace osgEnvLight
