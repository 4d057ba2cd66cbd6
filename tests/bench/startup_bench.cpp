// SPDX-License-Identifier: MIT
// From the start of stock osgviewer to its first picture, with and without the lighting, on a display without a screen.
#include <VirtualDisplay.h>

#include <benchmark/benchmark.h>

#include <chrono>
#include <thread>

namespace
{

const char* const model = "/usr/share/assimp/models/OBJ/spider.obj";

double secondsToPicture(const std::string& file)
{
    const VirtualDisplay display(800, 600);
    const TemporaryFolder folder;
    const auto start = std::chrono::steady_clock::now();
    const BackgroundProgram viewer({"osgviewer", "--window", "0", "0", "512", "512", file}, folder.file("log"),
                                   {"DISPLAY=" + display.name()});
    for (int i = 0; i < 6000; ++i) {
        const Screen s = display.read(512, 512);
        for (size_t k = 3; k < s.rgb.size(); ++k)
            if (s.rgb[k] != s.rgb[k - 3]) return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return -1.0;
}

void startup(benchmark::State& state)
{
    for (auto _ : state) state.SetIterationTime(secondsToPicture(std::string(model) + (state.range(0) ? ".envlight" : "")));
}

}  // namespace

BENCHMARK(startup)->Arg(0)->Arg(1)->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);
