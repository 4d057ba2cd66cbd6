/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>
#include "lights/LightTexels.h"
#include "lights/PenroseTable.h"

namespace osgEnvLight
{

/** Points of a Penrose tiling over the latitude-longitude image, thinned by importance [Ostromoukhov, Donohue, Jodoin 2004];
 * see choosePenrosePoints(). Where the paper gives every point the same share of the flux, here each gets that of the texels
 * nearest to it, stands at their flux centroid, and no two lie in one texel; then a density of radiance^(3/4) serves best.
 * Geometric mean of U at 128 lights over eight real maps, step by step: .037 equal shares, .010 nearest flux, .008 one in a
 * texel, .0022 centroid, .0015 density.
 *
 * On blocks of texels, at most 512 columns. Fewer lights than asked for when fewer blocks are lit.*/
class OSGENVLIGHT_EXPORT PenroseSampler : public LightSampler
{
  public:
    const char* name() const override { return "penrose"; }

    /** The paper's list, for comparison: every point the same share of the flux, at its place on the tile. */
    static LightList equalShares(const LightTexels& texels, unsigned count, const PenroseTable& table);
    /** What place() returns, with any table. */
    static LightList nearestFlux(const LightTexels& texels, unsigned count, const PenroseTable& table);

  protected:
    ~PenroseSampler() override = default;
    LightList place(const RadianceMap& map, unsigned count, const Options& options) const override;
};

}  // namespace osgEnvLight
