// SPDX-License-Identifier: MIT
// Programs of the application's own that ask the environment for its light.
#include <SceneRenderer.h>

#include <osgEnvLight/LightShader>
#include <osgEnvLight/Material>

#include <osg/GLExtensions>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/Program>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <sstream>

namespace LightShader_test
{

using osgEnvLight::LightShader;
using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

const char* const vertexText = R"(#version 330 compatibility
out vec3 position;
out vec3 normal;
void main()
{
    position = vec3(gl_ModelViewMatrix * gl_Vertex);
    normal = 3.0 * gl_NormalMatrix * gl_Normal;
    gl_Position = ftransform();
}
)";

// With functions of names that the shader has, too.
const char* const fragmentText = R"(#version 330 compatibility
in vec3 position;
in vec3 normal;
uniform vec2 metalRough;
vec4 envlightLit(vec3 position, vec3 normal, vec4 baseColor, float metalness, float roughness);
float luminance(vec3 c) { return c.g; }
vec3 display(vec3 c, ivec2 p) { return c; }
void main()
{
    gl_FragColor = envlightLit(position, normal, vec4(display(vec3(0.8, luminance(vec3(0.5)), 0.2), ivec2(0)), 1.0),
                               metalRough.x, metalRough.y);
}
)";

osg::ref_ptr<osg::Geode> ball()
{
    return makeSphere(osg::Vec3d(0, 0, 0.9), 0.8, 96);
}

osg::ref_ptr<osg::Geode> programmedBall(float metalness, float roughness)
{
    const osg::ref_ptr<osg::Geode> geode = ball();
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, vertexText));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragmentText));
    program->addShader(LightShader::create());
    osg::StateSet& s = *geode->getOrCreateStateSet();
    s.setAttribute(program);
    s.addUniform(new osg::Uniform("metalRough", osg::Vec2f(metalness, roughness)));
    return geode;
}

osg::ref_ptr<osg::Geode> ordinaryBall(float metalness, float roughness)
{
    const osg::ref_ptr<osg::Geode> geode = ball();
    Material::setCookTorrance(*geode->getOrCreateStateSet(), osg::Vec3f(0.8f, 0.5f, 0.2f), metalness, roughness);
    return geode;
}

// On a floor, under light from one side; a board keeps some of it away.
osg::ref_ptr<LitScene> sceneWith(const osg::ref_ptr<osg::Node>& ball)
{
    const osg::ref_ptr<LitScene> lit = makeLit(lopsidedMap().get());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->addChild(makeBox(osg::Vec3d(-3, -3, -0.2), osg::Vec3d(3, 3, 0)));
    lit->addChild(makeBox(osg::Vec3d(-1.4, -1, 0), osg::Vec3d(-1.2, 1, 2)));
    lit->addChild(ball);
    return lit;
}

class LightShaders : public testing::Test
{
  protected:
    LightShaders() : renderer(64, 64) { renderer.lookAt(osg::Vec3d(0, -5, 2), osg::Vec3d(0, 0, 0.9)); }

    SceneRenderer renderer;
};

// As osgEarth's: of a program's type, and no osg::Program. It counts how often it was applied.
class ForeignProgram : public osg::StateAttribute
{
  public:
    ForeignProgram() = default;
    ForeignProgram(const ForeignProgram& o, const osg::CopyOp& copyop) : osg::StateAttribute(o, copyop) {}
    META_StateAttribute(LightShader_test, ForeignProgram,
                        osg::StateAttribute::PROGRAM) int compare(const osg::StateAttribute& other) const override
    {
        return this == &other ? 0 : 1;
    }
    void apply(osg::State& state) const override
    {
        state.get<osg::GLExtensions>()->glUseProgram(0);
        state.setLastAppliedProgramObject(nullptr);
        ++applied;
    }

    mutable int applied = 0;
};

}  // namespace

// On a matt layer it is the same function of the same maps: measured 1.0 % apart, by O's filter. A metal's lobe is one look-up,
// and shows the mean radiance of what blocks the map where the material shows the scene: 9 %.
TEST_F(LightShaders, LightAsMaterialsDo)
{
    NotifyCatcher notify;
    for (const bool metal : {false, true}) {
        const float metalness = metal ? 1.0f : 0.0f, roughness = metal ? 0.4f : 1.0f;
        const osg::ref_ptr<LitScene> lit = sceneWith(programmedBall(metalness, roughness));
        const Picture programmed = renderer.render(lit, 3);
        EXPECT_EQ(1u, lit->plan().surfaces.litForward);
        const Picture ordinary = renderer.render(sceneWith(ordinaryBall(metalness, roughness)), 3);
        double sum = 0.0, difference = 0.0;
        for (int y = 26; y < 40; ++y)
            for (int x = 26; x < 40; ++x)
                for (int k = 0; k < 3; ++k) {
                    sum += double(ordinary.color(x, y)[k]);
                    difference += std::abs(double(programmed.color(x, y)[k] - ordinary.color(x, y)[k]));
                }
        EXPECT_GT(sum, 10.0);
        EXPECT_LT(difference / sum, metal ? 0.12 : 0.02);
    }
    EXPECT_EQ("", notify.text());
}

// A LitScene that is gone leaves the program to itself.
TEST_F(LightShaders, AreALampAtTheEyeWithoutALitScene)
{
    NotifyCatcher notify;
    const osg::ref_ptr<osg::Node> ball = programmedBall(0.0f, 0.5f);
    const osg::ref_ptr<osg::Group> plain = new osg::Group;
    plain->addChild(ball);
    const Picture before = renderer.render(plain, 2);
    EXPECT_NEAR(1.0, before.color(32, 32)[0], 0.2);  // .8 linear, shown, facing the eye
    renderer.render(sceneWith(ball), 3);
    EXPECT_EQ(before.rgba, renderer.render(plain, 2).rgba);
    EXPECT_EQ("", notify.text());
}

TEST(ForeignPrograms, AreDrawnAsWithoutUs)
{
    SceneRenderer renderer(32, 32);
    const osg::ref_ptr<ForeignProgram> program = new ForeignProgram;
    const osg::ref_ptr<osg::Geode> geode = ball();
    geode->getOrCreateStateSet()->setAttributeAndModes(program);
    const osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->accumulate = true;
    lit->getSettings()->accumulateLights = 16;
    lit->getSettings()->accumulateSize = 32;
    lit->addChild(geode);
    lit->addChild(makeQuad(osg::Vec3d(-2, -2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    renderer.lookAt(osg::Vec3d(0, -4, 2), osg::Vec3d());
    renderer.render(lit, 12);
    EXPECT_EQ(1u, lit->plan().surfaces.forward);
    EXPECT_GT(program->applied, 0);
}

TEST_F(LightShaders, AreKnownAgainFromAFile)
{
    std::stringstream file;
    osgDB::ReaderWriter* osgb = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
    ASSERT_TRUE(osgb);
    ASSERT_TRUE(osgb->writeNode(*programmedBall(0.0f, 1.0f), file).success());
    const osg::ref_ptr<osg::Node> read = osgb->readNode(file).getNode();
    ASSERT_TRUE(read);
    const osg::ref_ptr<LitScene> lit = sceneWith(read);
    renderer.render(lit, 3);
    EXPECT_EQ(1u, lit->plan().surfaces.litForward);
    const osg::ref_ptr<osg::Shader> other = new osg::Shader(osg::Shader::FRAGMENT);
    EXPECT_FALSE(LightShader::isOne(*other));
}

}  // namespace LightShader_test
