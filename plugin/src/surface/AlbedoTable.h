/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Limits.h"

#include <osgEnvLight/Export>

#include <array>
#include <cstdint>

#include <osg/Image>

namespace osgEnvLight
{

const int albedoSide = 32;
const int albedoBlocks = limits::ALBEDO_BLOCKS + limits::ANISOTROPY_BLOCKS;
const double albedoUnit = 2e-5;

using AlbedoTable = std::array<uint16_t, 3 * albedoBlocks * albedoSide * albedoSide>;

/** What albedoTableImage() has in its red, green and blue, in multiples of albedoUnit, block after block: plugin/tables. */
extern OSGENVLIGHT_EXPORT const AlbedoTable albedoTable;

/** Directional albedo of the lobes of microfacets, of one bounce, with Schlick's Fresnel: A F0 + B in the red and green of an RGB
 * 32F texture, and in its blue what edges of metals take, over edgeLoss() (lib/fresnel.glsl); 32 x 32 over (roughness, sqrt(cos
 * of the view angle)), both from 0 to 1 at texel centres, for GGX; beside it the same for Beckmann's and for Blinn's
 * distribution. Bilinear error <= .4 % (specular.md 7). Made at the first call and shared from then on.
 * @param anisotropic  with nine more blocks, for GGX's normals with two alphas: the roughness is that along the view's azimuth,
 *                     and a block's is that across it, from 0 to 1. Beside the exact albedo at azimuths between the alphas'
 *                     own directions it errs by 1 % (rms; 5 % at most, where the alphas are 1 and .01). */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Image> albedoTableImage(bool anisotropic = false);

}  // namespace osgEnvLight
