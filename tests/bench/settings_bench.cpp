// SPDX-License-Identifier: MIT
// The trade of each count in Settings: the time of its pass, and the difference of its term from that of the largest count,
// over the built-in studio. Radius and thickness of O are not here: what they err by only a ray-traced reference can say.
#include <SceneRenderer.h>

#include <osgEnvLight/BuiltinMaps>
#include <osgEnvLight/Material>

#include <benchmark/benchmark.h>

#include <algorithm>

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

struct Knob {
    const char* name;
    const char* pass;
    int view;
    int reference;
};

const Knob knobs[] = {{"diffuseLights", "diffuse", Settings::DIFFUSE, 8192},
                      {"specularSamples", "specular", Settings::SPECULAR, 1024},
                      {"filterCells", "filter", Settings::VISIBILITY, 0}};

osg::ref_ptr<LitScene> makeScene()
{
    osg::ref_ptr<LitScene> lit = makeLit(osgEnvLight::createBuiltinMap("studio").get());
    lit->addChild(makeQuad(osg::Vec3d(-4, -4, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0)));
    for (int i = 0; i < 9; ++i) {
        osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(-2 + 2 * (i % 3), -2 + 2 * (i / 3), 0.8), 0.8);
        osg::StateSet& s = *sphere->getOrCreateStateSet();
        if (i % 3 == 0) Material::setCookTorrance(s, osg::Vec3f(0.9f, 0.7f, 0.3f), 1.0f, 0.15f + 0.2f * float(i) / 3.0f);
        if (i % 3 == 1)
            Material::setPhong(s, osg::Vec3f(0.4f, 0.1f, 0.1f), osg::Vec3f(0.3f, 0.3f, 0.3f), 20.0f + 40.0f * float(i));
        lit->addChild(sphere);
    }
    lit->getSettings()->diffuseCarrier = Settings::LIGHTS;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->setTimed(true);
    return lit;
}

double mean(const Picture& p)
{
    double sum = 0.0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) sum += p.color(x, y)[1] / (p.width * p.height);
    return sum;
}

void sweep(benchmark::State& state)
{
    const Knob& knob = knobs[state.range(0)];
    SceneRenderer renderer(512, 512);
    renderer.lookAt(osg::Vec3d(1, -9, 6), osg::Vec3d(0, 0, 0.4), osg::Vec3d(0, 0, 1), 35.0);
    osg::ref_ptr<LitScene> lit = makeScene();
    std::string error;
    lit->getSettings()->view = knob.view;
    lit->getSettings()->visibility = Settings::VISIBILITY_SCREEN;
    if (knob.reference)
        lit->getSettings()->set(knob.name, double(knob.reference), error);
    else
        lit->getSettings()->occlusionLights = 8192;  // the filter has least to do
    const Picture reference = renderer.render(lit, 2);
    lit->getSettings()->occlusionLights = osg::ref_ptr<Settings>(new Settings)->occlusionLights;
    lit->getSettings()->set(knob.name, double(state.range(1)), error);
    double least = 1e30;
    for (auto _ : state) {
        for (int i = 0; i < 8; ++i) {
            renderer.render(lit);
            for (const auto& t : lit->plan().passes)
                if (t.pass == knob.pass && t.gpu >= 0.0 && i > 4) least = std::min(least, t.gpu);
        }
        state.SetIterationTime(least * 1e-3);
        state.counters["difference_percent"] = 100.0 * rootMeanSquare(reference, renderer.render(lit)) / mean(reference);
    }
    state.SetLabel(knob.name);
}

}  // namespace

BENCHMARK(sweep)
    ->ArgsProduct({{0}, {16, 32, 64, 128, 256, 512}})
    ->ArgsProduct({{1}, {1, 2, 4, 8, 16, 32, 64}})
    ->ArgsProduct({{2}, {1, 2, 3, 4}})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
