/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>

namespace osgEnvLight
{

/** The regions of SplitSampler, refined by spherical k-means over 16 micro cells a light, then weights (sampling.md 3): the
 * smallest errors known, with and without occluders. Lists of more than 4096 lights are split's.*/
class OSGENVLIGHT_EXPORT AutoSampler : public LightSampler
{
  public:
    /** Beyond, 4 cells a light and more leave k-means nothing to gain. */
    static constexpr unsigned largestRefined = 4096;

    const char* name() const override { return "auto"; }

  protected:
    ~AutoSampler() override = default;
    LightList place(const RadianceMap& map, unsigned count, const Options& options) const override;
    bool weighted() const override { return true; }
};

}  // namespace osgEnvLight
