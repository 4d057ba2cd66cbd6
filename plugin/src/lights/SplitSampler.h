/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>

namespace osgEnvLight
{

/** k-d regions of the map, the one with the largest flux times root of its spread divided next at half its flux, each a
 * light at its flux centroid; then weights. Borders are real numbers, so the count is always exact (sampling.md 3).*/
class OSGENVLIGHT_EXPORT SplitSampler : public LightSampler
{
  public:
    const char* name() const override { return "split"; }

  protected:
    ~SplitSampler() override = default;
    LightList place(const RadianceMap& map, unsigned count, const Options& options) const override;
    bool weighted() const override { return true; }
};

}  // namespace osgEnvLight
