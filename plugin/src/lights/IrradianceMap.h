/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/DirectionalLight>
#include <osgEnvLight/Export>

#include <osg/Texture2D>

namespace osgEnvLight
{

/** Side of the octahedral map of irradiance from that many lights, without its border. Irradiance has a kink at the horizon of each
 * light. Bilinear filtering rounds it off, so few strong lights need small texels; many weak ones do not. */
OSGENVLIGHT_EXPORT unsigned irradianceSide(size_t lights);

/** Irradiance over pi by the normal, times scale: an octahedral map with a border of one texel, bilinear. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Texture2D> irradianceTexture(const LightList& lights, double scale);

}  // namespace osgEnvLight
