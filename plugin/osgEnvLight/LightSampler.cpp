// SPDX-License-Identifier: MIT
#include <osgEnvLight/LightSampler>

#include <osgEnvLight/AutoSampler>
#include <osgEnvLight/InverseCdfSampler>
#include <osgEnvLight/MedianCutSampler>
#include <osgEnvLight/PenroseSampler>
#include <osgEnvLight/SplitSampler>
#include <osgEnvLight/StructuredSampler>

namespace osgEnvLight
{

namespace
{

struct Entry {
    const char* name;
    osg::ref_ptr<const LightSampler> (*create)();
};

template <class Sampler>
osg::ref_ptr<const LightSampler> make()
{
    return new Sampler;
}

const Entry entries[] = {
    {"auto", make<AutoSampler>},
    {"split", make<SplitSampler>},
    {"median-cut", make<MedianCutSampler>},
    {"structured", make<StructuredSampler>},
    {"penrose", make<PenroseSampler>},
    {"inverse-cdf", make<InverseCdfSampler>},
};

}  // namespace

const std::vector<const char*>& LightSampler::names()
{
    static const std::vector<const char*> all = [] {
        std::vector<const char*> list;
        for (const Entry& e : entries) list.push_back(e.name);
        return list;
    }();
    return all;
}

osg::ref_ptr<const LightSampler> LightSampler::create(const std::string& name)
{
    for (const Entry& e : entries)
        if (name == e.name) return e.create();
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
