/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>

namespace osgEnvLight
{

/** A golden-ratio lattice, shifted by the seed, through the exact inverse CDF of the map's flux (mean of the channels)
 * over solid angle, texel by texel in double: unbiased, each light the texel's colour times flux / N.
 * The lattice's error is half of Sobol points' and a third of random ones' (sampling.md 2).*/
class OSGENVLIGHT_EXPORT InverseCdfSampler : public LightSampler
{
  public:
    const char* name() const override { return "inverse-cdf"; }

  protected:
    ~InverseCdfSampler() override = default;
    LightList place(const RadianceMap& map, unsigned count, const Options& options) const override;
    bool exactFlux() const override { return false; }
};

}  // namespace osgEnvLight
