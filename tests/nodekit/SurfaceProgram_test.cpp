// SPDX-License-Identifier: MIT
// Surfaces whose vertices a function of the application's moves: lit and shadowed as if they had been moved before.
#include <SceneRenderer.h>

#include <osgEnvLight/SurfaceProgram>

#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace SurfaceProgram_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;
using osgEnvLight::SurfaceProgram;

namespace
{

const char* const lifts = R"(
uniform float lift;
void envlightVertex(inout vec4 vertex, inout vec3 normal) { vertex.z += lift; }
)";

// All have one bound, so that their shadow maps are as fine.
osg::ref_ptr<osg::Geode> box(const osg::Vec3d& place = osg::Vec3d())
{
    const osg::ref_ptr<osg::Geode> geode = makeBox(place - osg::Vec3d(0.5, 0.5, 0), place + osg::Vec3d(0.5, 0.5, 0.4));
    for (unsigned i = 0; i < geode->getNumDrawables(); ++i)
        geode->getDrawable(i)->setInitialBound(osg::BoundingBox(-3, -3, -1, 3, 3, 3));
    return geode;
}

osg::ref_ptr<osg::Geode> moved(const char* source, osg::ref_ptr<osg::Geode> geode)
{
    geode->getOrCreateStateSet()->setAttributeAndModes(SurfaceProgram::create(source));
    return geode;
}

// On a floor, below a map with a sun.
osg::ref_ptr<LitScene> sceneOf(osg::Node* node)
{
    const auto sky = [](const osg::Vec3d& d) {
        const double sun = d * osg::Vec3d(0.6, 0.0, 0.8);
        return osg::Vec3d(1, 1, 1) * (sun > 0.995 ? 60.0 : d.z() > 0.0 ? 0.5 : 0.1);
    };
    const osg::ref_ptr<LitScene> lit = makeLit(makeMap(256, 128, sky).get());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->addChild(makeQuad(osg::Vec3d(-3, -3, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 6, 0)));
    lit->addChild(node);
    return lit;
}

double difference(const Picture& a, const Picture& b)
{
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) sum += std::abs(double(a.color(x, y)[0]) - double(b.color(x, y)[0]));
    return sum / (a.width * a.height);
}

}  // namespace

class SurfacePrograms : public testing::Test
{
  protected:
    SurfacePrograms() { renderer.lookAt(osg::Vec3d(1, -6, 5), osg::Vec3d(0, 0, 0.5)); }

    Picture draw(LitScene* scene)
    {
        const Picture p = renderer.render(scene, 3);
        EXPECT_EQ(0u, scene->plan().surfaces.forward);
        return p;
    }

    SceneRenderer renderer{96, 96};
    const double rounding = 2e-4;  // of two matrix products: pixels at edges, of which some are the other surface's
};

TEST_F(SurfacePrograms, LightAndShadowAreThoseOfMovedVertices)
{
    NotifyCatcher notify;
    const osg::ref_ptr<osg::Geode> geode = moved(lifts, box());
    geode->getOrCreateStateSet()->addUniform(new osg::Uniform("lift", 1.0f));
    const osg::ref_ptr<LitScene> scene = sceneOf(geode);
    const Picture truth = draw(sceneOf(box(osg::Vec3d(0, 0, 1))));
    EXPECT_GT(difference(draw(sceneOf(box())), truth), 0.01);
    EXPECT_LT(difference(draw(scene), truth), rounding);
    EXPECT_EQ("", notify.text());
    // Its uniform moves it, and its shadow.
    geode->getStateSet()->getUniform("lift")->set(0.0f);
    EXPECT_LT(difference(draw(scene), draw(sceneOf(box()))), rounding);
}

TEST_F(SurfacePrograms, InstancesAreDrawnAndCastShadows)
{
    const osg::ref_ptr<osg::Geode> geode = moved(R"(#version 330 compatibility
uniform sampler2D places;
void envlightVertex(inout vec4 vertex, inout vec3 normal) { vertex.xyz += 4.0 * texelFetch(places, ivec2(gl_InstanceID, 0), 0).xyz - 2.0; }
)",
                                                 box());
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 1, 1, GL_RGB, GL_FLOAT);
    const osg::Vec3f places[] = {osg::Vec3f(-1, 0, 0), osg::Vec3f(1, 0, 0.5f)};
    for (unsigned i = 0; i < 2; ++i) *reinterpret_cast<osg::Vec3f*>(image->data(i)) = (places[i] + osg::Vec3f(2, 2, 2)) * 0.25f;
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setInternalFormat(GL_RGB32F_ARB);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    geode->getOrCreateStateSet()->setTextureAttribute(1, texture);
    geode->getOrCreateStateSet()->addUniform(new osg::Uniform("places", 1));
    for (unsigned i = 0; i < geode->getNumDrawables(); ++i)
        for (const auto& set : geode->getDrawable(i)->asGeometry()->getPrimitiveSetList()) set->setNumInstances(2);
    const osg::ref_ptr<osg::Group> pair = new osg::Group;
    for (const osg::Vec3f& p : places) pair->addChild(box(p));
    EXPECT_LT(difference(draw(sceneOf(geode)), draw(sceneOf(pair))), rounding);
}

TEST_F(SurfacePrograms, MaterialsAreWhatTheyAreWithoutOne)
{
    const auto painted = [](osg::ref_ptr<osg::Geode> geode) {
        const osg::ref_ptr<osg::Material> material = new osg::Material;
        material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0.9f, 0.2f, 0.1f, 1));
        material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.3f, 0.3f, 0.3f, 1));
        material->setShininess(osg::Material::FRONT_AND_BACK, 60.0f);
        geode->getOrCreateStateSet()->setAttributeAndModes(material.get());
        return geode;
    };
    const osg::ref_ptr<osg::Geode> own = painted(moved("void envlightVertex(inout vec4 vertex, inout vec3 normal) {}", box()));
    EXPECT_LT(difference(draw(sceneOf(own)), draw(sceneOf(painted(box())))), rounding);
}

TEST_F(SurfacePrograms, BlendedOnesAreLitAfterTheComposite)
{
    const auto glass = [](osg::ref_ptr<osg::Geode> geode) {
        const osg::ref_ptr<osg::Material> material = new osg::Material;
        material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0.9f, 0.2f, 0.1f, 0.5f));
        geode->getOrCreateStateSet()->setAttributeAndModes(material.get());
        geode->getStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        geode->getStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        return geode;
    };
    const osg::ref_ptr<osg::Geode> own = glass(moved(lifts, box()));
    own->getStateSet()->addUniform(new osg::Uniform("lift", 1.0f));
    const osg::ref_ptr<LitScene> scene = sceneOf(own);
    const Picture found = renderer.render(scene, 3);
    EXPECT_EQ(1u, scene->plan().surfaces.litForward);
    EXPECT_LT(difference(found, renderer.render(sceneOf(glass(box(osg::Vec3d(0, 0, 1)))), 3)), 5 * rounding);
}

// Half of its texels are holes, for the eye and for light.
TEST_F(SurfacePrograms, HolesAreHolesOfItsShadow)
{
    const auto perforated = [](osg::ref_ptr<osg::Geode> geode) {
        const osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
        for (unsigned i = 0; i < 2; ++i)
            *reinterpret_cast<osg::Vec4ub*>(image->data(i)) = osg::Vec4ub(255, 255, 255, i == 0 ? 0 : 255);
        const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
        texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
        texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
        const osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array;
        for (const osg::Vec2& p : {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)}) st->push_back(p);
        geode->getDrawable(0)->asGeometry()->setTexCoordArray(0, st);
        geode->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
        geode->getStateSet()->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
        return geode;
    };
    const auto sheet = [](double z) {
        const osg::ref_ptr<osg::Geode> geode = makeQuad(osg::Vec3d(-1, -1, z), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0));
        geode->getDrawable(0)->setInitialBound(osg::BoundingBox(-3, -3, -1, 3, 3, 3));
        return geode;
    };
    const osg::ref_ptr<osg::Geode> own = perforated(moved(lifts, sheet(0.2)));
    own->getStateSet()->addUniform(new osg::Uniform("lift", 0.8f));
    const Picture found = draw(sceneOf(own));
    EXPECT_LT(difference(found, draw(sceneOf(perforated(sheet(1.0))))), rounding);
    EXPECT_GT(difference(found, draw(sceneOf(sheet(1.0)))), 0.01);
}

TEST_F(SurfacePrograms, WithoutTheNodeALampAtTheEyeLightsIt)
{
    const osg::ref_ptr<osg::Geode> geode = moved(lifts, box());
    geode->getOrCreateStateSet()->addUniform(new osg::Uniform("lift", 1.0f));
    const Picture p = renderer.render(geode, 2);
    const osg::Vec2d above = renderer.pixelOf(osg::Vec3d(0, 0, 1.4));
    EXPECT_GT(p.color(int(above.x()), int(above.y()))[0], 0.4f);
    const osg::Vec2d below = renderer.pixelOf(osg::Vec3d(0, -0.5, 0.1));
    EXPECT_EQ(0.0f, p.color(int(below.x()), int(below.y()))[0]);
}

TEST_F(SurfacePrograms, StayWhatTheyAreInFiles)
{
    const osg::ref_ptr<osg::Geode> geode = moved(lifts, box());
    geode->getOrCreateStateSet()->addUniform(new osg::Uniform("lift", 1.0f));
    osgDB::ReaderWriter* format = osgDB::Registry::instance()->getReaderWriterForExtension("osgt");
    ASSERT_TRUE(format);
    std::stringstream file;
    ASSERT_TRUE(format->writeNode(*geode, file).success());
    const osg::ref_ptr<osg::Node> read = format->readNode(file).getNode();
    ASSERT_TRUE(read);
    const auto* program = static_cast<osg::Program*>(read->getStateSet()->getAttribute(osg::StateAttribute::PROGRAM));
    EXPECT_TRUE(SurfaceProgram::vertexShaderOf(*program));
    EXPECT_LT(difference(draw(sceneOf(read)), draw(sceneOf(box(osg::Vec3d(0, 0, 1))))), rounding);
}

TEST_F(SurfacePrograms, ThatStandStillConverge)
{
    const osg::ref_ptr<osg::Geode> geode = moved(lifts, box());
    geode->getOrCreateStateSet()->addUniform(new osg::Uniform("lift", 1.0f));
    const osg::ref_ptr<LitScene> scene = sceneOf(geode);
    scene->getSettings()->accumulate = true;
    scene->getSettings()->accumulateLights = 16;
    scene->getSettings()->accumulateSize = 32;
    renderer.render(scene, 12);
    EXPECT_GT(scene->average().frames, 2u);
    geode->getStateSet()->getUniform("lift")->set(0.5f);
    renderer.render(scene, 1);
    EXPECT_EQ(0u, scene->average().frames);
}

// osgViewer changes those uniforms in every frame, and no state set has them.
TEST_F(SurfacePrograms, ThatFollowTimeAreNeverStill)
{
    const osg::ref_ptr<osg::Geode> geode = moved(R"(
uniform uint osg_FrameNumber;
void envlightVertex(inout vec4 vertex, inout vec3 normal) { vertex.z += 0.001 * float(osg_FrameNumber); }
)",
                                                 box());
    const osg::ref_ptr<LitScene> scene = sceneOf(geode);
    scene->getSettings()->accumulate = true;
    renderer.render(scene, 12);
    EXPECT_EQ(0u, scene->average().frames);
}

}  // namespace SurfaceProgram_test
