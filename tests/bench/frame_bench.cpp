// SPDX-License-Identifier: MIT
// What a frame costs: milliseconds of each pass at 512 x 512, against plain OSG drawing the same model in the same run,
// over the number of triangles. Least of the frames: the machine may be shared.
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <benchmark/benchmark.h>

#include <algorithm>

using osgEnvLight::LitScene;
using osgEnvLight::Material;

namespace
{

const int size = 512;
const int frames = 12;

// Sixteen spheres on a plane, with together about that many triangles; a quarter of them metal, a quarter Phong.
osg::ref_ptr<osg::Group> makeModel(int triangles)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(makeQuad(osg::Vec3d(-5, -5, -0.9), osg::Vec3d(10, 0, 0), osg::Vec3d(0, 10, 0)));
    const int segments = int(std::sqrt(triangles / 16.0));
    for (int i = 0; i < 16; ++i) {
        osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(-3 + 2 * (i % 4), -3 + 2 * (i / 4), 0), 0.9, segments);
        osg::StateSet& s = *sphere->getOrCreateStateSet();
        if (i % 4 == 0) Material::setCookTorrance(s, osg::Vec3f(0.9f, 0.7f, 0.3f), 1.0f, 0.3f);
        if (i % 4 == 1) Material::setPhong(s, osg::Vec3f(0.4f, 0.1f, 0.1f), osg::Vec3f(0.3f, 0.3f, 0.3f), 60.0f);
        group->addChild(sphere);
    }
    return group;
}

double least(std::vector<double> v)
{
    return *std::min_element(v.begin() + 3, v.end());  // the first frames compile and upload
}

void setUp(SceneRenderer& renderer)
{
    renderer.lookAt(osg::Vec3d(1, -11, 7), osg::Vec3d(0, 0, -0.5), osg::Vec3d(0, 0, 1), 35.0);
}

void frame(benchmark::State& state)
{
    SceneRenderer renderer(size, size);
    setUp(renderer);
    osg::ref_ptr<osg::Group> model = makeModel(int(state.range(0)));
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->addChild(model);
    lit->setTimed(true);
    for (auto _ : state) {
        const double plain = least(renderer.time(model, frames));
        do renderer.time(lit, 1);
        while (lit->regenerating());  // shadow maps are drawn some a frame
        const double whole = least(renderer.time(lit, frames));
        state.SetIterationTime(whole * 1e-3);
        state.counters["plain_ms"] = plain;
        state.counters["ratio"] = whole / plain;
        for (const auto& t : lit->passTimes()) state.counters[t.pass + "_ms"] = t.gpu;
        state.counters["texture_MB"] = double(lit->textureBytes()) / 1048576.0;
    }
}

void emptyFrame(benchmark::State& state)
{
    SceneRenderer renderer(size, size);
    setUp(renderer);
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
