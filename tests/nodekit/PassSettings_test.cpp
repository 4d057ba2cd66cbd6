// SPDX-License-Identifier: MIT
// The settings that shaders read as uniforms: each pass gets those of the groups that it asks for, and no others.
#include "frame/FrameContext.h"
#include "frame/FrameGraph.h"

#include <SceneRenderer.h>
#include <ShaderFolder.h>

#include <osgEnvLight/AreaLight>
#include <osgEnvLight/Material>
#include <osgEnvLight/SurfaceProgram>

#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/Material>
#include <osg/Program>
#include <osgUtil/CullVisitor>

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <regex>
#include <set>

namespace PassSettings_test
{

using osgEnvLight::FrameContext;
using osgEnvLight::LitScene;
using osgEnvLight::PassBuilder;
using osgEnvLight::Requirement;
using osgEnvLight::Settings;
using osgEnvLight::ShaderLibrary;

namespace
{

using Names = std::set<std::string>;
using StateSets = std::vector<osg::ref_ptr<const osg::StateSet>>;

// Draws a share of the filter's width as emission.
class FilterWidthPass : public osgEnvLight::RenderPass
{
  public:
    explicit FilterWidthPass(bool asks) : _asks(asks) {}

    const char* name() const override { return "filterwidth"; }
    Requirement require(const FrameContext&) const override { return {true, "for the test"}; }
    void setup(PassBuilder& b, FrameContext&) override
    {
        if (_asks) b.settings<osgEnvLight::FilterSettings>();
        b.addTo(b.find("emission"));
    }

  private:
    const bool _asks;
};

// Keeps the state sets of all that its views draw, from the outermost on.
class WatchedScene : public LitScene
{
  public:
    void addPasses(osgEnvLight::FrameGraph& graph) override
    {
        if (pass) graph.add(pass);
    }
    void traverse(osg::NodeVisitor& nv) override
    {
        LitScene::traverse(nv);
        auto* cv = dynamic_cast<osgUtil::CullVisitor*>(&nv);
        if (cv) keep(*cv->getCurrentRenderBin()->getStage());
    }

    osg::ref_ptr<osgEnvLight::RenderPass> pass;
    std::set<StateSets> drawn;

  private:
    void keep(osgUtil::RenderBin& bin)
    {
        for (const osgUtil::StateGraph* graph : bin.getStateGraphList()) {
            StateSets states;
            for (; graph; graph = graph->_parent)
                if (graph->getStateSet()) states.insert(states.begin(), graph->getStateSet());
            drawn.insert(states);
        }
        for (const auto& [number, below] : bin.getRenderBinList()) keep(*below);
        if (auto* stage = dynamic_cast<osgUtil::RenderStage*>(&bin))
            for (const auto& [order, before] : stage->getPreRenderList()) keep(*before);
    }
};

struct Found {
    Names programs;                        // that draw
    Names read;                            // settings that they read
    std::map<std::string, Names> missing;  // those that none of a draw's state sets has, by program
};

Found settingsOf(const std::set<StateSets>& drawn, osg::State& state)
{
    Found found;
    for (const StateSets& states : drawn) {
        state.popAllStateSets();
        state.apply();  // or a program that differs by its defines alone would stay the former one
        for (const auto& s : states) state.pushStateSet(s.get());
        state.apply();
        const osg::Program::PerContextProgram* program = state.getLastAppliedProgramObject();
        if (!program) continue;
        const std::string name = program->getProgram()->getName().substr(std::strlen("osgEnvLight "));
        found.programs.insert(name);
        for (const Settings::Property& p : Settings::table()) {
            if (program->getUniformLocation(osg::Uniform::getNameID(p.name)) < 0) continue;
            found.read.insert(p.name);
            const bool has = std::any_of(states.begin(), states.end(), [&](const auto& s) { return s->getUniform(p.name); });
            if (!has) found.missing[name].insert(p.name);
        }
    }
    state.popAllStateSets();
    state.apply();
    return found;
}

constexpr unsigned coatedBox = 1, farBox = 2;  // children's numbers; a moved ball and the glass are the next

// Of all that passes are there for, with part of the scene far away.
osg::ref_ptr<WatchedScene> makeScene()
{
    osg::ref_ptr<WatchedScene> lit = new WatchedScene;
    Settings& s = *lit->getSettings();
    s.regeneration = Settings::IMMEDIATE;
    s.sceneLights = Settings::SCENE_LIGHTS_ON;  // the viewer's
    s.atlasLights = s.accumulateLights = 16;
    s.atlasSize = s.accumulateSize = 16;
    s.sunShadowSize = 64;
    s.bounceProbes = fewestProbes;
    s.bounceNear = Settings::NEAR_ON;
    const osg::ref_ptr<osg::Geode> phong = makeSphere(osg::Vec3d(-0.5, 0, 0), 0.5, 16);
    osgEnvLight::Material::setPhong(*phong->getOrCreateStateSet(), osg::Vec3f(), osg::Vec3f(0.5f, 0.5f, 0.5f), 20.0f);
    lit->addChild(phong);
    const osg::ref_ptr<osg::Geode> coated = makeBox(osg::Vec3d(0, -0.5, -0.5), osg::Vec3d(1, 0.5, 0.5));
    osgEnvLight::Material::setCookTorrance(*coated->getOrCreateStateSet(), osg::Vec3f(0.5f, 0.5f, 0.5f), 0.0f, 0.5f);
    osgEnvLight::Material::setCoat(*coated->getOrCreateStateSet(), 1.0f);
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
    place->addChild(coated);
    lit->addChild(place);
    lit->addChild(makeBox(osg::Vec3d(999, 0, 0), osg::Vec3d(1000, 1, 1)));  // farBox
    const osg::ref_ptr<osg::Geode> moved = makeSphere(osg::Vec3d(0, 0, 0.6), 0.1, 8);
    moved->getOrCreateStateSet()->setAttributeAndModes(
        osgEnvLight::SurfaceProgram::create("void envlightVertex(inout vec4 vertex, inout vec3 normal) {}"));
    lit->addChild(moved);
    const osg::ref_ptr<osg::Geode> glass = makeQuad(osg::Vec3d(-0.5, -1, -0.5), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 0, 1));
    const osg::ref_ptr<osg::Material> clear = new osg::Material;
    clear->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 0.5f));
    glass->getOrCreateStateSet()->setAttribute(clear);
    glass->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    lit->addChild(glass);
    for (int i = 0; i < 9; ++i) lit->addChild(new osgEnvLight::AreaLight);  // so many that cuts through a tree of them are taken
    const osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
    lamp->getLight()->setLightNum(1);
    lit->addChild(lamp);
    lit->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    return lit;
}

// Not in a state graph: what the shadow maps draw with, and the bounces.
const Names ofShadowMaps = {"pass/caster.frag", "pass/caster.vert", "pass/emittermap.frag", "pass/midpoint.frag",
                            "pass/sunmap.frag"};
const Names ofBounces = {"pass/pointnear.frag", "pass/pointradiance.frag", "pass/probeharmonics.frag", "pass/probes.frag",
                          "pass/surfacecells.frag"};

// Of a test of their own.
const Names ofCaustics = {"pass/caustics.frag", "pass/reflectivemap.frag", "pass/virtuallights.frag"};

}  // namespace

TEST(PassSettings, EveryPassHasThoseThatItsShaderReads)
{
    SceneRenderer renderer(24, 24);
    const osg::ref_ptr<WatchedScene> lit = makeScene();
    Settings& s = *lit->getSettings();
    renderer.render(lit.get(), 4);
    s.background = Settings::BACKGROUND_BLUR;
    s.accumulate = true;
    renderer.render(lit.get(), 12);
    s.accumulate = false;
    s.antialias = Settings::ANTIALIAS_TEMPORAL;
    renderer.render(lit.get(), 2);
    static_cast<osg::MatrixTransform&>(*lit->getChild(coatedBox)).setMatrix(osg::Matrixd::translate(0.1, 0, 0));
    renderer.render(lit.get(), 1);
    s.combine = Settings::SUBTRACT;
    s.output = Settings::LINEAR;
    for (s.view = Settings::DIFFUSE; s.view < Settings::NUM_VIEWS; ++s.view) renderer.render(lit.get(), 1);
    s.view = Settings::BEAUTY;
    s.visibility = Settings::VISIBILITY_SCREEN;
    for (s.occlusionMethod = Settings::SLICE; s.occlusionMethod <= Settings::BENT_NORMAL; ++s.occlusionMethod)
        renderer.render(lit.get(), 1);
    s.occlusionMethod = Settings::SLICE;
    s.visibility = Settings::VISIBILITY_AUTO;
    const int bounce = s.bounce;
    s.bounce = Settings::BOUNCE_MEAN;
    renderer.render(lit.get(), 1);
    s.bounce = bounce;
    s.accumulate = true;
    lit->removeChildren(farBox, 3);
    renderer.render(lit.get(), 12);

    const Found found = settingsOf(lit->drawn, renderer.state());
    for (const auto& [program, names] : found.missing)
        for (const std::string& name : names) ADD_FAILURE() << program << " reads " << name << ", whose group no pass asks for";
    for (const std::string& name : ShaderLibrary::names())
        if (name.size() > 5 && name.substr(name.size() - 5) == ".frag") {
            EXPECT_EQ(1u, ofShadowMaps.count(name) + ofBounces.count(name) + ofCaustics.count(name) + found.programs.count(name))
                << name;
        }
    // The atlas has its own: a still view's maps differ from the setting.
    for (const Settings::Property& p : Settings::table())
        EXPECT_EQ(p.uniform || std::string("atlasSize") == p.name, found.read.count(p.name) > 0) << p.name;
}

TEST(PassSettings, CausticsHaveThoseThatTheirShadersRead)
{
    SceneRenderer renderer(24, 24);
    const osg::ref_ptr<WatchedScene> lit = makeScene();
    lit->getSettings()->caustics = Settings::CAUSTICS_ON;
    renderer.render(lit.get(), 4);
    const Found found = settingsOf(lit->drawn, renderer.state());
    for (const auto& [program, names] : found.missing)
        for (const std::string& name : names) ADD_FAILURE() << program << " reads " << name << ", whose group no pass asks for";
    for (const char* name : {"pass/caustics.frag", "pass/virtuallights.frag"}) EXPECT_EQ(1u, found.programs.count(name)) << name;
}

TEST(PassSettings, ShadowMapsReadNone)
{
    const osg::ref_ptr<ShaderLibrary> library = new ShaderLibrary(nullptr);
    for (const std::string& name : ofShadowMaps) {
        const std::string text = library->expand(name).text;
        for (const Settings::Property& p : Settings::table())
            EXPECT_FALSE(std::regex_search(text, std::regex("\\buniform\\s+\\w+\\s+" + std::string(p.name) + "\\b")))
                << name << " reads " << p.name;
    }
}

TEST(PassSettings, AUsersPassAsksForThem)
{
    ShaderFolder folder;
    folder.add("filterwidth",
               "uniform int filterCells;\nlayout(location = 0) out vec4 emission;\n"
               "void main() { emission = vec4(vec3(filterCells) * 0.125, 0.0); }\n");
    for (const bool asks : {true, false}) {
        SceneRenderer renderer(24, 24);
        const osg::ref_ptr<WatchedScene> lit = makeScene();
        lit->pass = new FilterWidthPass(asks);
        lit->getSettings()->output = Settings::LINEAR;
        lit->getSettings()->exposureBase = Settings::EXPOSURE_NONE;
        lit->getSettings()->sceneLights = Settings::SCENE_LIGHTS_OFF;
        lit->getSettings()->view = Settings::EMISSION;
        for (const int cells : {2, 3}) {
            lit->getSettings()->filterCells = cells;
            const double emitted = renderer.render(lit.get(), 2).color(6, 12)[0];
            if (asks) {
                EXPECT_EQ(0.125 * cells, emitted);
            }
        }
        const Found found = settingsOf(lit->drawn, renderer.state());
        const std::map<std::string, Names> missing = {{"pass/filterwidth.frag", {"filterCells"}}};
        EXPECT_EQ(asks ? (std::map<std::string, Names>()) : missing, found.missing);
    }
}

}  // namespace PassSettings_test
