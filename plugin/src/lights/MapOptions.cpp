// SPDX-License-Identifier: MIT
#include "lights/MapOptions.h"

#include <tuple>

namespace osgEnvLight
{

MapOptions::MapOptions() : MapOptions(*osg::ref_ptr<const Settings>(new Settings)) {}

MapOptions::MapOptions(const Settings& s, const std::shared_ptr<const LightList>& lights)
    : given(lights),
      sampler(s.lightSampler),
      deal(s.lightDeal == Settings::DEALT_RANDOM ? DEAL_RANDOM : DEAL_MOMENTS),
      suns(s.suns),
      diffuseCarrier(s.diffuseCarrier),
      diffuseLights(unsigned(s.diffuseLights)),
      diffuseError(double(s.diffuseError) / 100.0)
{
    sampling.floor = double(s.lightFloor);
    sampling.weights = SampleOptions::Weights(s.lightWeights);
}

bool MapOptions::sameLists(const MapOptions& o) const
{
    return std::tie(given, sampler, sampling.floor, sampling.weights, deal, suns) ==
           std::tie(o.given, o.sampler, o.sampling.floor, o.sampling.weights, o.deal, o.suns);
}

bool MapOptions::sameCarrier(const MapOptions& o) const
{
    return sameLists(o) &&
           std::tie(diffuseCarrier, diffuseLights, diffuseError) == std::tie(o.diffuseCarrier, o.diffuseLights, o.diffuseError);
}

}  // namespace osgEnvLight
