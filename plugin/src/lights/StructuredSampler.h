/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>

namespace osgEnvLight
{

/** Structured importance sampling [Agarwal, Ramamoorthi, Belongie, Jensen 2003]: six strata of radiance at multiples of its
 * deviation; each gets lights by the importance of its connected components, flux * min(solid angle, .01 sr)^(1/4); they are
 * spread from the brightest stratum down, each at the texel farthest from those before [Hochbaum, Shmoys 1985]. A texel's
 * flux goes to the nearest light of its stratum, and the light to the flux centroid: three times as exact as the chosen
 * texel (sampling.md 2).
 *
 * On blocks of texels, at most 512 columns. Fewer lights than asked for when fewer blocks are lit.*/
class OSGENVLIGHT_EXPORT StructuredSampler : public LightSampler
{
  public:
    const char* name() const override { return "structured"; }

  protected:
    ~StructuredSampler() override = default;
    LightList place(const RadianceMap& map, unsigned count, const Options& options) const override;
};

/** Whole shares of count in proportion to the weights by the largest remainder, none above its capacity; what goes beyond
 * one is shared among the others. Sums to count, or to all capacities if that is less.*/
OSGENVLIGHT_EXPORT std::vector<size_t> apportion(size_t count, const std::vector<double>& weights,
                                                 const std::vector<size_t>& capacities);

}  // namespace osgEnvLight
