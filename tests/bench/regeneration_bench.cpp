// SPDX-License-Identifier: MIT
// What a change of the map costs, part by part, on one core.
#include <SceneRenderer.h>

#include <osgEnvLight/BuiltinMaps>
#include "lights/MapTextures.h"

#include <benchmark/benchmark.h>

using namespace osgEnvLight;

namespace
{

// A map of that width; not smooth, so that no list is trivial.
osg::ref_ptr<osg::Image> makeSource(int width)
{
    return makeMap(width, width / 2, [](const osg::Vec3d& d) {
        const double l = 0.2 + std::pow(std::max(d * osg::Vec3d(0.6, 0.0, 0.8), 0.0), 50.0) * 100.0 +
                         0.1 * std::sin(20.0 * d.x()) * std::sin(17.0 * d.y());
        return osg::Vec3d(l, 0.9 * l, 0.7 * l);
    });
}

osg::ref_ptr<const RadianceMap> makeRadiance(int width)
{
    std::string error;
    osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap(makeSource(width).get());
    return map->radiance(error);
}

void sanitise(benchmark::State& state)
{
    osg::ref_ptr<osg::Image> image = makeSource(int(state.range(0)));
    osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap(image.get());
    std::string error;
    for (auto _ : state) {
        image->dirty();
        benchmark::DoNotOptimize(map->radiance(error));
    }
}

void harmonics(benchmark::State& state)
{
    std::string error;
    osg::ref_ptr<osg::Image> image = makeSource(int(state.range(0)));
    osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap(image.get());
    for (auto _ : state) {
        state.PauseTiming();
        image->dirty();
        osg::ref_ptr<const RadianceMap> radiance = map->radiance(error);
        state.ResumeTiming();
        benchmark::DoNotOptimize(radiance->harmonics());
    }
}

void lights(benchmark::State& state)
{
    const osg::ref_ptr<const RadianceMap> radiance = makeRadiance(int(state.range(0)));
    radiance->harmonics();
    const osg::ref_ptr<const LightSampler> sampler = LightSampler::create("auto");
    for (auto _ : state) benchmark::DoNotOptimize(sampler->sample(*radiance, unsigned(state.range(1))));
}

void pyramid(benchmark::State& state)
{
    const osg::ref_ptr<const RadianceMap> radiance = makeRadiance(int(state.range(0)));
    for (auto _ : state) {
        osg::ref_ptr<MapTextures> textures = new MapTextures(radiance.get());
        benchmark::DoNotOptimize(textures->pyramid());
    }
}

void everything(benchmark::State& state)
{
    osg::ref_ptr<osg::Image> image = makeSource(int(state.range(0)));
    osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap(image.get());
    std::string error;
    size_t bytes = 0;
    for (auto _ : state) {
        image->dirty();
        osg::ref_ptr<const RadianceMap> radiance = map->radiance(error);
        osg::ref_ptr<MapTextures> textures = new MapTextures(radiance.get());
        textures->carrier();
        textures->diffuseLights();
        textures->occlusionLights(1024);
        textures->pyramid();
        textures->latlong();
        bytes = textures->bytes();
    }
    state.counters["texture_MB"] = double(bytes) / 1048576.0;
}

}  // namespace

BENCHMARK(sanitise)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);
BENCHMARK(harmonics)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);
BENCHMARK(lights)->Args({1024, 128})->Args({1024, 1024})->Args({4096, 128})->Args({4096, 1024})->Unit(benchmark::kMillisecond);
BENCHMARK(pyramid)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);
BENCHMARK(everything)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);
