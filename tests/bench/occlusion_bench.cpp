// SPDX-License-Identifier: MIT
// The trade of the occlusion term: error against a wall's closed form over points per ray and over slices and taps,
// difference from 8192 lights over the number of lights, and the pass's time for each.
#include <SceneRenderer.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

const int size = 512;

osg::ref_ptr<LitScene> makeWall(osg::Image* map)
{
    osg::ref_ptr<LitScene> lit = makeLit(map);
    lit->addChild(makeQuad(osg::Vec3d(-30, -8, 0), osg::Vec3d(60, 0, 0), osg::Vec3d(0, 16, 0)));
    lit->addChild(makeBox(osg::Vec3d(-30, 0, 0), osg::Vec3d(30, 4, 1)));
    Settings& s = *lit->getSettings();
    s.visibility = Settings::VISIBILITY_SCREEN;
    s.view = Settings::VISIBILITY;
    s.occlusionRadius = float(4.0 / lit->getBound().radius());
    s.occlusionThickness = 1.0f;
    lit->setTimed(true);
    return lit;
}

double passTime(const LitScene& lit)
{
    for (const auto& t : lit.plan().passes)
        if (t.pass == "occlusion") return t.gpu;
    return -1.0;
}

double leastTime(SceneRenderer& renderer, LitScene& lit)
{
    double least = 1e30;
    for (int i = 0; i < 8; ++i) {
        renderer.render(&lit, 1);
        if (passTime(lit) >= 0.0) least = std::min(least, passTime(lit));
    }
    return least;
}

// Mean relative error of O at .1, .5 and 1 wall heights from the wall.
double wallError(SceneRenderer& renderer, LitScene& lit)
{
    const Picture p = renderer.render(&lit);
    double error = 0.0;
    for (double a : {0.1, 0.5, 1.0}) {
        const osg::Vec2d window = renderer.pixelOf(osg::Vec3d(0, -a, 0));
        double sum = 0.0;
        for (int x = size / 2 - 8; x < size / 2 + 8; ++x) sum += p.color(x, int(window.y()))[0] / 16.0;
        error += std::abs((1.0 - sum) / (0.5 * (1.0 - a / std::sqrt(a * a + 1.0))) - 1.0) / 3.0;
    }
    return error;
}

void measureWall(benchmark::State& state, const std::function<void(Settings&)>& set)
{
    SceneRenderer renderer(size, size);
    osg::ref_ptr<LitScene> lit = makeWall(constantMap(1.0).get());
    set(*lit->getSettings());
    renderer.lookAt(osg::Vec3d(0, -9, 9), osg::Vec3d(), osg::Vec3d(0, 0, 1), 40.0);
    for (auto _ : state) {
        state.SetIterationTime(leastTime(renderer, *lit) * 1e-3);
        state.counters["error_percent"] = 100.0 * wallError(renderer, *lit);
    }
}

void steps(benchmark::State& state)
{
    measureWall(state, [&](Settings& s) {
        s.occlusionMethod = Settings::RAY;
        s.occlusionSteps = int(state.range(0));
    });
}

void slices(benchmark::State& state)
{
    measureWall(state, [&](Settings& s) {
        s.occlusionMethod = Settings::SLICE;
        s.occlusionSlices = int(state.range(0));
        s.occlusionTaps = int(state.range(1));
    });
}

// Spheres on a plane under a sun and sky: shadows with a shape.
osg::ref_ptr<LitScene> makeSpheres()
{
    const auto map = makeMap(256, 128, [](const osg::Vec3d& d) {
        const double sky = d.z() > 0 ? 0.3 + 0.5 * d.z() : 0.1;
        return osg::Vec3d(sky, sky, sky) + osg::Vec3d(1, 1, 1) * 8.0 * std::exp(60.0 * (d * osg::Vec3d(0.48, -0.6, 0.64) - 1.0));
    });
    osg::ref_ptr<LitScene> lit = makeLit(map.get());
    lit->addChild(makeQuad(osg::Vec3d(-4, -4, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0)));
    for (int i = 0; i < 9; ++i) lit->addChild(makeSphere(osg::Vec3d(-2 + 2 * (i % 3), -2 + 2 * (i / 3), 0.6), 0.6));
    lit->getSettings()->view = Settings::VISIBILITY;
    lit->getSettings()->visibility = Settings::VISIBILITY_SCREEN;
    lit->setTimed(true);
    return lit;
}

void lights(benchmark::State& state)
{
    SceneRenderer renderer(size, size);
    osg::ref_ptr<LitScene> lit = makeSpheres();
    renderer.lookAt(osg::Vec3d(1, -8, 6), osg::Vec3d(), osg::Vec3d(0, 0, 1), 40.0);
    lit->getSettings()->occlusionLights = 8192;
    const Picture reference = renderer.render(lit);
    lit->getSettings()->occlusionLights = int(state.range(0));
    for (auto _ : state) {
        state.SetIterationTime(leastTime(renderer, *lit) * 1e-3);
        state.counters["difference_percent"] = 100.0 * rootMeanSquare(reference, renderer.render(lit));
    }
}

}  // namespace

BENCHMARK(steps)->RangeMultiplier(2)->Range(1, 64)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(slices)->ArgsProduct({{1, 2, 4}, {2, 4, 8, 16, 32}})->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(lights)
    ->Arg(100)
    ->Arg(200)
    ->Arg(256)
    ->Arg(400)
    ->Arg(512)
    ->Arg(1000)
    ->Arg(1024)
    ->Arg(2048)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
