// SPDX-License-Identifier: MIT
// Pairs of primary and shadow ray per second: direct light by the cosine, points spread over the pixels, on an untextured
// Lambert model, under a map. The best of the runs, and the processor time of all threads: the machine may be shared.
#include <SceneRenderer.h>

#include <reference/Reference>

#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>

using namespace osgEnvLight;

namespace
{

// Sixteen spheres on a plane with together about that many triangles, which fill the picture.
osg::ref_ptr<osg::Group> makeModel(int triangles)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(makeQuad(osg::Vec3d(-50, -50, -0.9), osg::Vec3d(100, 0, 0), osg::Vec3d(0, 100, 0)));
    const int segments = int(std::sqrt(triangles / 16.0));
    for (int i = 0; i < 16; ++i) group->addChild(makeSphere(osg::Vec3d(-3 + 2 * (i % 4), -3 + 2 * (i / 4), 0), 0.9, segments));
    return group;
}

void pairs(benchmark::State& state)
{
    const int size = 512;
    const osg::ref_ptr<osg::Group> model = makeModel(int(state.range(0)));
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setViewport(0, 0, size, size);
    camera->setViewMatrixAsLookAt(osg::Vec3d(1, -11, 7), osg::Vec3d(0, 0, -0.5), osg::Vec3d(0, 0, 1));
    camera->setProjectionMatrixAsPerspective(35.0, 1.0, 1.0, 1e4);
    const TriangleScene triangles = flattenScene(*model, *camera);
    const RayScene rays(triangles);
    const RayCamera rayCamera(camera->getViewMatrix(), camera->getProjectionMatrix(), size, size, 0.0);
    osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap;
    std::string error;
    map->load("sky", nullptr, error);
    const osg::ref_ptr<const RadianceMap> radiance = map->radiance(error);
    const MapEnvironment environment(*radiance, 0.0, 1.0);
    const Reference reference(rays, rayCamera, environment);
    ReferenceOptions options;
    options.antialias = true;
    options.samples = options.pass = 16;
    double best = 0.0, traced = 0.0, processor = 1e9;
    for (auto _ : state) {
        const std::clock_t start = std::clock();
        const ReferenceResult result = reference.render(options, {});
        const double count = double(size) * size * options.samples;
        processor = std::min(processor, double(std::clock() - start) / CLOCKS_PER_SEC / count);
        best = std::max(best, count / result.seconds);
        traced = std::max(traced, double(result.rays) / result.seconds);
        state.SetIterationTime(result.seconds);
        ++options.seed;
    }
    state.counters["pairs/s"] = best;
    state.counters["cpu_ns/pair"] = 1e9 * processor;
    state.counters["shadow_rays/s"] = traced;
    state.counters["triangles"] = double(triangles.triangles);
}

}  // namespace

BENCHMARK(pairs)->Arg(1000)->Arg(100000)->Arg(1000000)->UseManualTime()->Iterations(8)->Unit(benchmark::kMillisecond);
