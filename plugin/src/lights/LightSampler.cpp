// SPDX-License-Identifier: MIT
#include <osgEnvLight/LightSampler>
#include <osgEnvLight/Settings>

#include "lights/AutoSampler.h"
#include "lights/InverseCdfSampler.h"
#include "lights/MedianCutSampler.h"
#include "lights/PenroseSampler.h"
#include "lights/SplitSampler.h"
#include "lights/StructuredSampler.h"

namespace osgEnvLight
{

namespace
{

template <class Sampler>
osg::ref_ptr<const LightSampler> make()
{
    return new Sampler;
}

using Create = osg::ref_ptr<const LightSampler> (*)();
// In the order of Settings::lightSamplerNames().
const Create creators[] = {make<AutoSampler>,       make<SplitSampler>,   make<MedianCutSampler>,
                           make<StructuredSampler>, make<PenroseSampler>, make<InverseCdfSampler>};

}  // namespace

const std::vector<const char*>& LightSampler::names()
{
    return Settings::lightSamplerNames();
}

osg::ref_ptr<const LightSampler> LightSampler::create(const std::string& name)
{
    for (size_t i = 0; i < names().size(); ++i)
        if (name == names()[i]) return creators[i]();
    return nullptr;
}

LightList LightSampler::sample(const RadianceMap& map, unsigned count, const Options& options) const
{
    if (!(map.meanOfChannels() > 0.0) || count == 0) return {};
    LightList lights = place(map, count, options);
    if (exactFlux()) scaleToFlux(lights, map.flux);
    if (options.weights == Options::WEIGHTS_ON || (options.weights == Options::WEIGHTS_AUTO && weighted()))
        matchHarmonics(lights, map);
    return lights;
}

void scaleToFlux(LightList& lights, const osg::Vec3d& flux)
{
    osg::Vec3d sum;
    for (const DirectionalLight& l : lights) sum += l.flux;
    for (DirectionalLight& l : lights)
        for (int i = 0; i < 3; ++i)
            if (sum[i] > 0.0) l.flux[i] *= flux[i] / sum[i];
}

}  // namespace osgEnvLight
