/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>

namespace osgEnvLight
{

/** The region with the largest flux is cut next across its longer side in solid angle, at the border between texels that
 * is nearest to half its flux; each region a light at its flux centroid [Debevec 2005; Viriyothai, Debevec 2009]. Fewer
 * lights than asked for when fewer texels are lit.*/
class OSGENVLIGHT_EXPORT MedianCutSampler : public LightSampler
{
  public:
    const char* name() const override { return "median-cut"; }

  protected:
    ~MedianCutSampler() override = default;
    LightList place(const RadianceMap& map, unsigned count, const Options& options) const override;
};

}  // namespace osgEnvLight
