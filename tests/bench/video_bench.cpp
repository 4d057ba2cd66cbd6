// SPDX-License-Identifier: MIT
// A map that changes 30 times a second: the frames' times, and how long a state takes until it lights the scene.
#include <SceneRenderer.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <thread>

using namespace osgEnvLight;
using Clock = std::chrono::steady_clock;

namespace
{

double seconds(Clock::time_point since)
{
    return std::chrono::duration<double>(Clock::now() - since).count();
}

// A sky with a lamp that moves; the same array of pixels each time.
void paint(osg::Image& image, double time)
{
    const osg::Vec3d lamp(std::cos(time), std::sin(time) * 0.8, 0.6);
    const int width = image.s();
    const int height = image.t();
    for (int y = 0; y < height; ++y) {
        const double theta = osg::PI * (y + 0.5) / height;
        float* t = reinterpret_cast<float*>(image.data(0, unsigned(height - 1 - y)));
        for (int x = 0; x < width; ++x, t += 3) {
            const double phi = 2.0 * osg::PI * (0.5 - (x + 0.5) / width);
            const osg::Vec3d d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            const double l = (d.z() > 0.0 ? 0.6 : 0.1) + (d * lamp > 0.97 * lamp.length() ? 20.0 : 0.0);
            t[0] = t[1] = t[2] = float(l);
        }
    }
    image.dirty();
}

// Milliseconds of the frames of about four seconds; the map is painted between them, out of the measurement.
void play(benchmark::State& state)
{
    const int width = int(state.range(0));
    const bool changing = state.range(1) != 0;
    SceneRenderer renderer(128, 128);
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, width / 2, 1, GL_RGB, GL_FLOAT);
    paint(*image, 0.0);
    osg::ref_ptr<LitScene> lit = makeLit(image.get());
    lit->addChild(makeSphere(osg::Vec3d(), 1.0));
    lit->getSettings()->regeneration = state.range(2) ? Settings::IMMEDIATE : Settings::BACKGROUND;
    renderer.time(lit, 5);
    std::vector<double> frames;
    for (auto _ : state) {
        auto last = Clock::now();
        for (const auto start = last; seconds(start) < 4.0;) {
            if (changing && seconds(last) > 1.0 / 30.0) {
                last = Clock::now();
                paint(*image, seconds(start));
            }
            frames.push_back(renderer.time(lit, 1)[0]);
        }
    }
    std::sort(frames.begin(), frames.end());
    state.counters["median_ms"] = frames[frames.size() / 2];
    state.counters["p99_ms"] = frames[frames.size() * 99 / 100];
    state.counters["worst_ms"] = frames.back();
    state.counters["worst_over_median"] = frames.back() / frames[frames.size() / 2];
    state.counters["frames"] = double(frames.size());
}

// From dirty() to the first frame that shows it, with nothing else to do between.
void latency(benchmark::State& state)
{
    SceneRenderer renderer(16, 16);
    osg::ref_ptr<osg::Image> image = new osg::Image;
    const int width = int(state.range(0));
    image->allocateImage(width, width / 2, 1, GL_RGB, GL_FLOAT);
    paint(*image, 0.0);
    osg::ref_ptr<LitScene> lit = makeLit(image.get());
    lit->addChild(makeSphere(osg::Vec3d(), 1.0));
    renderer.time(lit, 5);
    double time = 0.0;
    for (auto _ : state) {
        state.PauseTiming();
        paint(*image, time += 0.02);
        state.ResumeTiming();
        do {
            renderer.time(lit, 1);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        } while (lit->regenerating());
        renderer.time(lit, 1);
    }
}

}  // namespace

BENCHMARK(play)
    ->ArgNames({"width", "changing", "immediate"})
    ->Args({1024, 0, 0})
    ->Args({512, 1, 0})
    ->Args({1024, 1, 0})
    ->Args({1024, 1, 1})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(latency)->Arg(512)->Arg(1024)->Arg(2048)->Arg(4096)->UseRealTime()->Unit(benchmark::kMillisecond);
