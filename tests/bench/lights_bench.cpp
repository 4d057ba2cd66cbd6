// SPDX-License-Identifier: MIT
// Light lists on one core, part by part, on the study's courtyard at 1024 columns; its sky with a sun where that is not
// installed. Tables of 16384 columns (6 GB) only where the filter names them: --benchmark_filter=table/16384
#include "lights/DiffuseCarrier.h"
#include "environment/DominantLight.h"
#include "lights/LightClusters.h"

#include <benchmark/benchmark.h>

#include "StudyMaps.h"

using namespace osgEnvLight;

namespace
{

const RadianceMap& studyMap()
{
    static const osg::ref_ptr<const RadianceMap> map = [] {
        const std::vector<testmaths::StudyMap> real = testmaths::realMaps(1024);
        const auto made = testmaths::radianceOf(real.empty() ? testmaths::syntheticMaps(1024)[1].image : real[1].image);
        made->harmonics();
        return made;
    }();
    return *map;
}

int columnsFor(unsigned count)
{
    return int(std::max(512.0, 32.0 * std::sqrt(double(count))));
}

void sampler(benchmark::State& state)
{
    const char* name = LightSampler::names()[size_t(state.range(0))];
    const osg::ref_ptr<const LightSampler> made = LightSampler::create(name);
    const RadianceMap& map = studyMap();
    for (auto _ : state) benchmark::DoNotOptimize(made->sample(map, unsigned(state.range(1))));
    state.SetLabel(name);
}

void table(benchmark::State& state)
{
    const int width = int(state.range(0));
    if (width > 4096 && benchmark::GetBenchmarkFilter().find(std::to_string(width)) == std::string::npos) {
        state.SkipWithError("only where the filter names it");
        return;
    }
    const auto map = testmaths::radianceOf(testmaths::makeMap(width, width / 2, [](const glsl::vec3& d) {
        return glsl::vec3(0.2 + 0.1 * d.z + 100.0 * std::pow(std::max(d.x, 0.0), 50.0));
    }));
    for (auto _ : state) benchmark::DoNotOptimize(MomentTable(*map, 1024));
}

void divide(benchmark::State& state)
{
    const unsigned count = unsigned(state.range(0));
    const MomentTable made(studyMap(), columnsFor(count));
    for (auto _ : state) benchmark::DoNotOptimize(divideRegions(made, {wholeRegion(made)}, count, RegionRule()));
}

void cluster(benchmark::State& state)
{
    const unsigned count = unsigned(state.range(0));
    const MomentTable made(studyMap(), columnsFor(count));
    for (auto _ : state) {
        LightClusters clusters(made, count);
        clusters.refine(6);
        clusters.fillEmpty();
        benchmark::DoNotOptimize(clusters.lights());
    }
}

void weights(benchmark::State& state)
{
    SampleOptions options;
    options.weights = SampleOptions::WEIGHTS_OFF;
    const LightList list = LightSampler::create("split")->sample(studyMap(), unsigned(state.range(0)), options);
    for (auto _ : state) {
        LightList copy = list;
        matchHarmonics(copy, studyMap());
        benchmark::DoNotOptimize(copy);
    }
}

void suns(benchmark::State& state)
{
    const RadianceMap& map = studyMap();
    for (auto _ : state) benchmark::DoNotOptimize(splitSuns(map, 16));
}

void predict(benchmark::State& state)
{
    const RadianceMap& map = studyMap();
    for (auto _ : state) benchmark::DoNotOptimize(predictHarmonicsError(map));
}

// Up to lists of 128, which are made each time.
void carrier(benchmark::State& state)
{
    const RadianceMap& map = studyMap();
    LightList list;
    const auto lights = [&](unsigned count) -> const LightList& {
        list = LightSampler::create("auto")->sample(map, count);
        return list;
    };
    for (auto _ : state) benchmark::DoNotOptimize(chooseCarrier(map, 1e-9, 128, lights));
}

}  // namespace

BENCHMARK(sampler)
    ->ArgsProduct({{0}, {128, 1024, 8192}})
    ->ArgsProduct({{1, 2, 3, 4, 5}, {128, 1024, 8192, 65536}})
    ->ArgNames({"", "N"})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(table)->Arg(1024)->Arg(4096)->Arg(16384)->Unit(benchmark::kMillisecond);
BENCHMARK(divide)->Arg(128)->Arg(1024)->Arg(65536)->Unit(benchmark::kMillisecond);
BENCHMARK(cluster)->Arg(128)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(weights)->Arg(128)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(suns)->Unit(benchmark::kMillisecond);
BENCHMARK(predict)->Unit(benchmark::kMillisecond);
BENCHMARK(carrier)->Unit(benchmark::kMillisecond);
