// SPDX-License-Identifier: MIT
// The frame graph: a pass of a user's own, which passes are dropped, what their times are.
#include "base/Limits.h"
#include "frame/FrameContext.h"
#include "frame/FrameGraph.h"

#include <SceneRenderer.h>
#include <ShaderFolder.h>

#include <osgEnvLight/Material>

#include <gtest/gtest.h>

namespace FrameGraph_test
{

using osgEnvLight::FrameContext;
using osgEnvLight::FrameGraph;
using osgEnvLight::LitScene;
using osgEnvLight::PassBuilder;
using osgEnvLight::Requirement;
using osgEnvLight::Settings;
using osgEnvLight::TextureId;

namespace
{

// Adds a constant to what surfaces emit.
class GlowPass : public osgEnvLight::RenderPass
{
  public:
    explicit GlowPass(const osg::Vec3f& glow) : _glow(new osg::Uniform("glow", glow)) {}

    const char* name() const override { return "glow"; }
    Requirement require(const FrameContext& c) const override
    {
        Requirement glow;
        return glow.unless(c.facts.surfaces.deferred == 0, "nothing to glow").because("for the test");
    }
    void setup(PassBuilder& b, FrameContext&) override
    {
        b.readGBuffer();
        b.uniform(_glow.get());
        b.addTo(b.find("emission"));
    }

  private:
    osg::ref_ptr<osg::Uniform> _glow;
};

// Draws 1 into a texture at the pixels of a mark, and if not told otherwise at those of lower marks. The others get a given
// value.
class MarkedPass : public osgEnvLight::RenderPass
{
  public:
    MarkedPass(float mark, float elsewhere, bool only = false) : _mark(mark), _elsewhere(elsewhere), _only(only) {}

    const char* name() const override { return "marked"; }
    Requirement require(const FrameContext&) const override { return {true, "for the test"}; }
    void setup(PassBuilder& b, FrameContext&) override
    {
        const TextureId marks = b.find("pixel marks");
        _only ? b.drawOnly(marks, _mark) : b.drawMarked(marks, _mark);
        b.write(b.create("marked texture"), {_elsewhere, _elsewhere, _elsewhere, 1});
    }

  private:
    const float _mark;
    const float _elsewhere;
    const bool _only;
};

// Adds 1 to it for the passes after this one.
class LaterPass : public osgEnvLight::RenderPass
{
  public:
    const char* name() const override { return "later"; }
    Requirement require(const FrameContext&) const override { return {true, "for the test"}; }
    void setup(PassBuilder& b, FrameContext&) override { b.addLaterTo(b.find("marked texture")); }
};

// Shows that texture, or a quarter of it.
class ShowMarkedPass : public osgEnvLight::RenderPass
{
  public:
    explicit ShowMarkedPass(const char* name = "showmarked") : _name(name) {}

    const char* name() const override { return _name; }
    Requirement require(const FrameContext&) const override { return {true, "for the test"}; }
    void setup(PassBuilder& b, FrameContext&) override
    {
        b.read(b.find("marked texture"), "markedMap");
        b.addTo(b.find("emission"));
    }

  private:
    const char* const _name;
};

// Draws into a texture that nobody reads.
class UnreadPass : public osgEnvLight::RenderPass
{
  public:
    const char* name() const override { return "unread"; }
    Requirement require(const FrameContext&) const override { return {true, "for the test"}; }
    void setup(PassBuilder& b, FrameContext&) override { b.write(b.create("unread texture")); }
};

// Reads more than OpenGL has units for, or what nobody makes.
class GreedyPass : public osgEnvLight::RenderPass
{
  public:
    explicit GreedyPass(bool many) : _many(many) {}

    const char* name() const override { return "greedy"; }
    Requirement require(const FrameContext&) const override { return {true, "for the test"}; }
    void setup(PassBuilder& b, FrameContext&) override
    {
        for (int i = 0; _many && i < 17; ++i) b.read("albedo", "map" + std::to_string(i));
        if (!_many) b.read(b.find("no such texture"), "missingMap");
        b.write(b.create("greedy texture"));
        b.drawAlways();
    }

  private:
    const bool _many;
};

class WithPasses : public LitScene
{
  public:
    using LitScene::LitScene;
    void addPasses(FrameGraph& graph) override
    {
        for (const auto& pass : passes) graph.add(pass);
    }
    std::vector<osg::ref_ptr<osgEnvLight::RenderPass>> passes;
};

// Of these passes.
void addShaders(ShaderFolder& folder)
{
    const std::string one = "layout(location = 0) out vec4 one;\nvoid main() { one = vec4(1.0); }\n";
    const std::string marked = "uniform sampler2D markedMap;\nlayout(location = 0) out vec4 emission;\n";
    folder.add("glow",
               "#include \"pass/gbuffer.glsl\"\nuniform vec3 glow;\nlayout(location = 0) out vec4 emission;\n"
               "void main() { emission = isBackground(ivec2(gl_FragCoord.xy)) ? vec4(0.0) : vec4(glow, 0.0); }\n");
    folder.add("unread", "void main() { this does not compile; }\n");
    folder.add("marked", one);
    folder.add("later", one);
    folder.add("showmarked", marked + "void main() { emission = texelFetch(markedMap, ivec2(gl_FragCoord.xy), 0); }\n");
    folder.add("showlater", marked + "void main() { emission = 0.25 * texelFetch(markedMap, ivec2(gl_FragCoord.xy), 0); }\n");
}

osg::ref_ptr<WithPasses> makeScene()
{
    osg::ref_ptr<WithPasses> lit = new WithPasses(constantMap(1.0).get());
    lit->getSettings()->bounceProbes = fewestProbes;
    Settings& s = *lit->getSettings();
    s.output = Settings::LINEAR;
    s.regeneration = Settings::IMMEDIATE;  // or a thread says when probes take memory
    s.atlasLights = 16;
    s.atlasSize = 64;
    lit->addChild(makeSphere(osg::Vec3d(), 1.0, 32));
    return lit;
}

class FrameGraphTest : public testing::Test
{
  protected:
    FrameGraphTest() : renderer(32, 32)
    {
        addShaders(folder);
        renderer.lookAt(osg::Vec3d(0, -6, 0), osg::Vec3d());
    }

    ShaderFolder folder;
    SceneRenderer renderer;
};

}  // namespace

TEST_F(FrameGraphTest, HasAPassOfTheUsers)
{
    osg::ref_ptr<WithPasses> plain = makeScene(), glowing = makeScene();
    const osg::Vec3d glow(0.5, 0.25, 0.125);  // which half floats hold
    glowing->passes.push_back(new GlowPass(osg::Vec3f(glow)));
    const Picture before = renderer.render(plain, 2), after = renderer.render(glowing, 2);
    const osg::Vec3d added = after.color(16, 16) - before.color(16, 16);
    // Half floats of sums up to 2 are 2^-10 apart; what glows also sends light on, here to nothing that it blocks.
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(added[k], glow[k], 1e-3) << k;
    EXPECT_EQ(before.color(0, 0), after.color(0, 0));
    EXPECT_TRUE(glowing->plan().runs("glow"));
    EXPECT_EQ("for the test", glowing->plan().reason("glow"));
}

// Surfaces, those of them with a lobe, and what the others have: emission is shown where there is a surface.
TEST_F(FrameGraphTest, DrawsMarkedPixels)
{
    const auto emitted = [&](bool glossy, float mark, float elsewhere, bool only = false) {
        osg::ref_ptr<WithPasses> lit = makeScene();
        lit->getSettings()->view = Settings::EMISSION;
        if (glossy)
            osgEnvLight::Material::setPhong(*lit->getOrCreateStateSet(), osg::Vec3f(), osg::Vec3f(0.5f, 0.5f, 0.5f), 20.0f);
        lit->passes = {new MarkedPass(mark, elsewhere, only), new ShowMarkedPass};
        return renderer.render(lit, 2).color(16, 16)[0];
    };
    using namespace osgEnvLight::limits;
    EXPECT_EQ(1.0, emitted(false, MARK_SURFACE, 0.25f));
    EXPECT_EQ(0.25, emitted(false, MARK_GLOSSY, 0.25f));
    EXPECT_EQ(1.0, emitted(true, MARK_GLOSSY, 0.25f));
    EXPECT_EQ(1.0, emitted(true, MARK_SURFACE, 0.25f));
    EXPECT_EQ(1.0, emitted(false, MARK_SURFACE, 0.25f, true));
    EXPECT_EQ(0.25, emitted(true, MARK_SURFACE, 0.25f, true));
    EXPECT_EQ(1.0, emitted(true, MARK_GLOSSY, 0.25f, true));
    EXPECT_EQ(0.25, emitted(true, MARK_TRACED, 0.25f, true));
}

// A reader before it reads what there was, one after it the sum.
TEST_F(FrameGraphTest, AddsLaterThanTheReadersBefore)
{
    osg::ref_ptr<WithPasses> lit = makeScene();
    lit->getSettings()->view = Settings::EMISSION;
    lit->passes = {new MarkedPass(osgEnvLight::limits::MARK_SURFACE, 0.0f), new ShowMarkedPass, new LaterPass,
                   new ShowMarkedPass("showlater")};
    EXPECT_EQ(1.0 + 0.25 * 2.0, renderer.render(lit, 2).color(16, 16)[0]);
}

TEST_F(FrameGraphTest, DropsWhatNobodyReads)
{
    osg::ref_ptr<WithPasses> lit = makeScene();
    const size_t plain = (renderer.render(lit, 2), lit->textureBytes());
    osg::ref_ptr<WithPasses> unread = makeScene();
    unread->passes.push_back(new UnreadPass);
    unread->setTimed(true);
    // Its shader would be an error, if it were made.
    EXPECT_GT(renderer.render(unread, 4).color(16, 16)[0], 0.0);
    EXPECT_EQ(plain, unread->textureBytes());
    for (const auto& r : unread->plan().passes) EXPECT_TRUE(r.pass != "unread" || r.cpu < 0.0);
}

TEST_F(FrameGraphTest, NamesWhatAPassMayNotRead)
{
    for (const bool many : {true, false}) {
        osg::ref_ptr<WithPasses> lit = makeScene();
        lit->passes.push_back(new GreedyPass(many));
        NotifyCatcher notices;
        renderer.render(lit, 1);
        const std::string text = notices.text();
        EXPECT_NE(std::string::npos, text.find("greedy reads")) << text;
        EXPECT_NE(std::string::npos, text.find(many ? "map16" : "missingMap")) << text;
    }
}

// Of one frame: a pass that is not drawn in it has no time.
TEST_F(FrameGraphTest, TimesAreOfOneFrame)
{
    osg::ref_ptr<WithPasses> lit = makeScene();
    lit->setTimed(true);
    renderer.render(lit, 3);
    bool drawn = false;
    for (int i = 0; i < 6; ++i) {
        lit->getSettings()->atlasLights = i % 2 ? 16 : 32;  // all maps anew
        renderer.render(lit, 1);
        for (const auto& r : lit->plan().passes) drawn = drawn || (r.pass == "atlas" && r.cpu > 0.0);
    }
    EXPECT_TRUE(drawn);
    for (int i = 0; i < 500 && lit->regenerating(); ++i) renderer.render(lit, 1);
    renderer.render(lit, 6);
    for (const auto& r : lit->plan().passes) {
        const bool draws = r.pass == "gbuffer" || r.pass == "pixelmarks" || r.pass == "background" || r.pass == "diffuse" ||
                           r.pass == "occlusion" || r.pass == "filterrows" || r.pass == "filter" || r.pass == "indirect" ||
                           r.pass == "resolve" || r.pass == "composite";
        EXPECT_EQ(draws, r.cpu > 0.0) << r.pass;
    }
}

TEST_F(FrameGraphTest, EveryPassIsInThePlan)
{
    osg::ref_ptr<WithPasses> lit = makeScene();
    renderer.render(lit, 1);
    for (const char* pass : {"background",      "gbuffer",     "pixelmarks",
                             "penumbrae",       "scenelights", "seen",
                             "atlas",           "stillmaps",   "suns",
                             "sunmap",          "sunshadow",   "sunfilter",
                             "diffuse",         "occlusion",   "filterrows",
                             "filter",          "specular",    "loberows",
                             "lobes",           "reflections", "reflectionfilter",
                             "bounce",          "bouncesum",   "links",
                             "points",          "bounces",     "indirect",
                             "resolve",         "accumulate",  "stillerror",
                             "display",         "composite",   "forward",
                             "areamaps",        "areashadow",  "arearows",
                             "areafilter",      "arealights",  "scenelightmaps",
                             "glossyocclusion", "sunquads",    "gather",
                             "gatherfilter",    "loberays",    "loberaylight",
                             "loberayfilter",   "temporal",    "motion",
                             "lighttotals",     "nearlight",   "nearlightfilter",
                             "guides",          "meter",       "adaptation"})
        EXPECT_NE("", lit->plan().reason(pass)) << pass;
}

}  // namespace FrameGraph_test
