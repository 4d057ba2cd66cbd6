/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>

#include <osg/Texture2D>

namespace osgEnvLight
{

/** Packs a light list into the grouped texture of seed 000, figure 3: RGBA 32F, 2 groups rows; row 2q holds the
 * directions of group q, row 2q + 1 its fluxes times scale. Rows are filled up with lights of flux 0.*/
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Texture2D> lightTexture(const LightList& lights, unsigned groups, double scale);

/** How a list is dealt to its 16 groups. */
enum LightDeal {
    DEAL_MOMENTS,  // Hilbert blocks, then swaps that even the groups' spherical harmonics (sampling.md 6)
    DEAL_RANDOM    // a shuffle [seed 000, 3.3]
};

/** The order in which light i of the result, a multiple of 16 of them, goes to group i % 16 so that each group is by
 * itself a good sample of the map: indices into the list, or -1 for a dark light that fills up.*/
OSGENVLIGHT_EXPORT std::vector<int> dealOrder(const LightList& lights, LightDeal deal = DEAL_MOMENTS);

/** The list in that order. */
OSGENVLIGHT_EXPORT LightList dealt(const LightList& lights, LightDeal deal = DEAL_MOMENTS);

}  // namespace osgEnvLight
