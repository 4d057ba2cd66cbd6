// SPDX-License-Identifier: MIT
// A shader that does not compile is reported once, by file and line, and the host goes on showing the scene unlit.
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

namespace Shaders_test
{

using osgEnvLight::LitScene;

namespace
{

class Overrides
{
  public:
    Overrides() : _folder(testing::TempDir() + "envlight_shaders")
    {
        for (const char* f : {"", "/lib", "/pass"}) mkdir((_folder + f).c_str(), 0700);
        setenv("ENVLIGHT_SHADER_PATH", _folder.c_str(), 1);
    }
    ~Overrides()
    {
        for (const std::string& f : _files) remove(f.c_str());
        unsetenv("ENVLIGHT_SHADER_PATH");
    }
    void write(const std::string& name, const std::string& text)
    {
        _files.push_back(_folder + "/" + name);
        std::ofstream(_files.back()) << text;
    }

  private:
    std::string _folder;
    std::vector<std::string> _files;
};

size_t occurrences(const std::string& text, const std::string& word)
{
    size_t n = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

}  // namespace

TEST(Shaders, AnErrorNamesTheRealFileAndLineAndTheSceneStaysUnlit)
{
    Overrides overrides;
    SceneRenderer renderer(48, 48);
    osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(), 1.0);
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    plain->addChild(sphere);
    const Picture unlit = renderer.render(plain, 2);

    overrides.write("lib/sh.glsl", "// a line\nvec3 shIrradiance9(vec3 c[18], vec3 n) { return undeclared; }\n");
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->addChild(sphere);
    renderer.render(lit, 3);
    EXPECT_EQ(unlit.rgba, renderer.render(lit, 1).rgba);
    EXPECT_NE(std::string::npos, notify.text().find("lib/sh.glsl:2")) << notify.text();
    EXPECT_EQ(1u, occurrences(notify.text(), "osgEnvLight: ")) << notify.text();

    lit->getSettings()->bounce = osgEnvLight::Settings::BOUNCE_MEAN;  // the probes need more of that file
    overrides.write("lib/sh.glsl", "vec3 shIrradiance9(vec3 c[18], vec3 n) { return vec3(0.25, 0.5, 0.75); }\n");
    lit->reloadShaders();
    EXPECT_NEAR(renderer.render(lit, 2).color(24, 24)[2] / renderer.render(lit, 1).color(24, 24)[0], 3.0, 0.02);
}

// As engines on top of OSG do: State then rewrites the names of built-in attributes and matrices in every shader.
TEST(Shaders, AHostThatRenamesWhatIsBuiltInShowsTheSamePicture)
{
    const osg::ref_ptr<osg::Image> map = lopsidedMap();
    Picture pictures[2];
    for (const bool renames : {false, true}) {
        SceneRenderer renderer(64, 64);
        renderer.lookAt(osg::Vec3d(0, -4, 1), osg::Vec3d());
        renderer.state().setUseVertexAttributeAliasing(renames);
        renderer.state().setUseModelViewAndProjectionUniforms(renames);
        const osg::ref_ptr<LitScene> lit = makeLit(map.get());
        lit->addChild(makeSphere(osg::Vec3d(-0.5, 0, 0), 0.8));
        // Not vertex colours: without an array of them an aliased attribute is black.
        osgEnvLight::Material::setLambert(*lit->getOrCreateStateSet(), osg::Vec3f(0.8f, 0.6f, 0.4f));
        const osg::ref_ptr<osg::Geode> pane = makeQuad(osg::Vec3d(-1, -1, -1), osg::Vec3d(1.5, 0, 0), osg::Vec3d(0, 0, 2));
        pane->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        pane->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        lit->addChild(pane);
        pictures[renames] = renderer.render(lit, 3);
        EXPECT_EQ(1u, lit->plan().surfaces.litForward);
    }
    EXPECT_GT(ofGeometry(pictures[0]).mean, 0.1);
    EXPECT_LE(rootMeanSquare(pictures[0], pictures[1]), 0.01);
}

TEST(Shaders, AMissingIncludeIsOneMessage)
{
    Overrides overrides;
    overrides.write("pass/diffuse.frag", "#version 330 compatibility\n#include \"lib/nowhere.glsl\"\nvoid main() {}\n");
    NotifyCatcher notify;
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->addChild(makeSphere(osg::Vec3d(), 1.0));
    renderer.render(lit, 3);
    EXPECT_NE(std::string::npos, notify.text().find("pass/diffuse.frag:2: no shader text named 'lib/nowhere.glsl'"))
        << notify.text();
    EXPECT_EQ(1u, occurrences(notify.text(), "osgEnvLight: "));
}

}  // namespace Shaders_test
