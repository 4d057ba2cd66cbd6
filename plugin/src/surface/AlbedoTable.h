/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Texture2D>

namespace osgEnvLight
{

/** Directional albedo of the GGX lobe with Schlick's Fresnel: A F0 + B in the red and green of a 32 x 32 RG 32F texture
 * over (roughness, sqrt(cos of the view angle)), both from 0 to 1 at texel centres. Bilinear error <= .4 %
 * (specular.md 7). Made at the first call and shared from then on.*/
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Image> albedoTableImage();

}  // namespace osgEnvLight
