// SPDX-License-Identifier: MIT
// What a frame costs: milliseconds of each pass, against plain OSG drawing the same model in the same run, over the number of
// triangles and of pixels; against ambient occlusion in its place; and while shadow maps are drawn anew. Least of the frames:
// the machine may be shared.
#include <BenchModel.h>
#include <SceneRenderer.h>

#include <osg/MatrixTransform>

#include <benchmark/benchmark.h>

#include <algorithm>

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

const int size = 512;
const int frames = 12;
const int triangles = 100000;

double least(std::vector<double> v)
{
    return *std::min_element(v.begin() + 3, v.end());  // the first frames compile and upload
}

osg::ref_ptr<LitScene> makeLitModel(int count)
{
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->addChild(makeBenchModel(count));
    lit->setTimed(true);
    return lit;
}

// Until all shadow maps are drawn: milliseconds of each frame.
std::vector<double> settle(SceneRenderer& renderer, LitScene& lit)
{
    std::vector<double> times;
    do times.push_back(renderer.time(&lit, 1)[0]);
    while (lit.regenerating());
    return times;
}

void measure(benchmark::State& state, int width, int height, int count)
{
    SceneRenderer renderer(width, height);
    lookAtBenchModel(renderer);
    osg::ref_ptr<osg::Group> model = makeBenchModel(count);
    osg::ref_ptr<LitScene> lit = makeLitModel(count);
    Settings& s = *lit->getSettings();
    for (auto _ : state) {
        const double plain = least(renderer.time(model, frames));
        settle(renderer, *lit);
        const double whole = least(renderer.time(lit, frames));
        state.SetIterationTime(whole * 1e-3);
        state.counters["plain_ms"] = plain;
        state.counters["ratio"] = whole / plain;
        for (const auto& r : lit->plan().passes)
            if (r.gpu >= 0.0) state.counters[r.pass + "_ms"] = r.gpu;
        state.counters["texture_MB"] = double(lit->textureBytes()) / 1048576.0;
        // Ambient occlusion from the depth buffer, and all else the same.
        s.visibility = Settings::VISIBILITY_SCREEN;
        s.occlusionMethod = Settings::GTAO;
        const double ambient = least(renderer.time(lit, frames));
        state.counters["gtao_ms"] = ambient;
        state.counters["over_gtao"] = whole / ambient;
        s.visibility = Settings::VISIBILITY_AUTO;
        s.occlusionMethod = Settings::SLICE;
    }
}

void frame(benchmark::State& state)
{
    measure(state, size, size, int(state.range(0)));
}

void resolution(benchmark::State& state)
{
    measure(state, int(state.range(0)), int(state.range(1)), triangles);
}

// One body moves once: all maps are drawn anew, atlasUpdatesPerFrame in each frame.
void refresh(benchmark::State& state)
{
    SceneRenderer renderer(size, size);
    lookAtBenchModel(renderer);
    osg::ref_ptr<LitScene> lit = makeLitModel(int(state.range(0)));
    osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    mover->addChild(makeBox(osg::Vec3d(-0.2, -0.2, 1), osg::Vec3d(0.2, 0.2, 1.4)));
    lit->addChild(mover);
    lit->getSettings()->atlasUpdatesPerFrame = int(state.range(1));
    for (auto _ : state) {
        state.counters["fill_ms"] = settle(renderer, *lit)[0];
        const double steady = least(renderer.time(lit, frames));
        mover->setMatrix(osg::Matrixd::translate(0.5, 0, 0));
        std::vector<double> times = settle(renderer, *lit);
        state.counters["latency_frames"] = double(times.size());
        std::sort(times.begin(), times.end());
        state.SetIterationTime(times[times.size() / 2] * 1e-3);
        state.counters["worst_over_median"] = times.back() / times[times.size() / 2];
        state.counters["steady_ms"] = steady;
        state.counters["worst_over_steady"] = times.back() / steady;
    }
}

void emptyFrame(benchmark::State& state)
{
    SceneRenderer renderer(size, size);
    lookAtBenchModel(renderer);
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    osg::ref_ptr<LitScene> lit = new LitScene;
    for (auto _ : state) {
        const double without = least(renderer.time(plain, frames));
        const double with = least(renderer.time(lit, frames));
        state.SetIterationTime(with * 1e-3);
        state.counters["plain_ms"] = without;
        state.counters["ratio"] = with / without;
    }
}

}  // namespace

BENCHMARK(emptyFrame)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(frame)->Arg(10000)->Arg(100000)->Arg(1000000)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(resolution)
    ->Args({256, 256})
    ->Args({512, 512})
    ->Args({1280, 720})
    ->Args({1920, 1080})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(refresh)
    ->ArgsProduct({{10000, 100000, 1000000}, {8}})
    ->ArgsProduct({{100000}, {2, 32}})
    ->ArgNames({"triangles", "maps a frame"})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
