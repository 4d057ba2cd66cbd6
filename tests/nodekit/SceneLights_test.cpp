// SPDX-License-Identifier: MIT
// Lights of osg::LightSource nodes, against closed forms: under a black map they are all there is.
#include "LampScene.h"

#include <Maths.h>

#include <osg/MatrixTransform>

#include <gtest/gtest.h>

#include <cmath>

namespace SceneLights_test
{

using namespace lampscene;

namespace
{

double decoded(double x)
{
    return std::pow((x + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
}

std::string lightsReason(const LitScene& lit)
{
    return reasonOf(lit, "scenelights");
}

// Share of light from direction v that the lobe of f0 = 1 reflects, by quadrature.
double lobeAlbedo(const glsl::vec3& v, double alpha)
{
    const int n = 400;
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double z = (i + 0.5) / n;
            const double phi = 2.0 * osg::PI * (j + 0.5) / n;
            const double s = std::sqrt(1.0 - z * z);
            sum += glsl::ggxBrdf(v, glsl::vec3(s * std::cos(phi), s * std::sin(phi), z), alpha) * z;
        }
    return sum * 2.0 * osg::PI / (n * n);
}

}  // namespace

class SceneLights : public LampScene
{
};

TEST_F(SceneLights, ADirectionalLightOnWhiteIsItsColourTimesTheCosine)
{
    const osg::Vec3d to = [] {
        osg::Vec3d d(0.3, -0.8, 0.4);
        d.normalize();
        return d;
    }();
    for (int place = 0; place < 3; ++place) {  // before the node, behind it and below it in the graph
        const osg::ref_ptr<osg::LightSource> light = makeLight(3, osg::Vec4(osg::Vec3(to * 7.0), 0), osg::Vec4(1, 0.5f, 2, 1));
        if (place == 0) root->insertChild(0, light);
        if (place == 1) root->addChild(light);
        if (place == 2) lit->addChild(light);
        const Picture p = render();
        for (const osg::Vec2i& at : {osg::Vec2i(32, 32), osg::Vec2i(5, 50)}) {
            EXPECT_NEAR(p.color(at[0], at[1])[0], -to[1], exact) << place;
            EXPECT_NEAR(p.color(at[0], at[1])[1], decoded(0.5) * -to[1], exact) << place;
            EXPECT_NEAR(p.color(at[0], at[1])[2], 2.0 * -to[1], 5 * exact) << place;  // above 1 linear
        }
        EXPECT_EQ("1 light", lightsReason(*lit));
        root->removeChild(light);
        lit->removeChild(light);
    }
}

TEST_F(SceneLights, APointLightIsAttenuated)
{
    const osg::Vec3d at(0.4, -1.5, 0.2);
    const osg::ref_ptr<osg::LightSource> light = makeLight(1, osg::Vec4(osg::Vec3(), 1));
    light->getLight()->setConstantAttenuation(0.5f);
    light->getLight()->setLinearAttenuation(0.25f);
    light->getLight()->setQuadraticAttenuation(0.125f);
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrix::translate(at));
    place->addChild(light);
    root->insertChild(0, place);
    const Picture p = render();
    for (int x = 3; x < size; x += 11)
        for (int y = 5; y < size; y += 13) {
            const osg::Vec3d to = at - pointAt(x, y);
            const double d = to.length();
            EXPECT_NEAR(p.color(x, y)[0], -to[1] / d / (0.5 + 0.25 * d + 0.125 * d * d), exact) << x << " " << y;
        }
}

TEST_F(SceneLights, ASpotEndsAtItsCutoff)
{
    const osg::Vec3d at(0, -2, 0);
    const osg::ref_ptr<osg::LightSource> light = makeLight(7, osg::Vec4(osg::Vec3(at), 1));
    light->getLight()->setDirection(osg::Vec3(0, 1, 0));
    light->getLight()->setSpotCutoff(25.0f);
    light->getLight()->setSpotExponent(3.0f);
    root->insertChild(0, light);
    const Picture p = render();
    int inside = 0;
    for (int x = 1; x < size; x += 3) {
        osg::Vec3d to = at - pointAt(x, 32);
        to.normalize();
        const double angle = osg::RadiansToDegrees(std::acos(-to[1]));
        if (std::abs(angle - 25.0) < 1.0) continue;
        inside += angle < 25.0;
        EXPECT_NEAR(p.color(x, 32)[0], angle < 25.0 ? std::pow(-to[1], 4.0) : 0.0, exact) << x;  // exponent 3, and the cosine
    }
    EXPECT_GT(inside, 5);
}

TEST_F(SceneLights, AMetalsHighlightIsThatOfItsLobe)
{
    const float roughness = 0.5f;
    const glsl::vec3 f0(0.9, 0.6, 0.3);
    Material::setCookTorrance(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(0.9f, 0.6f, 0.3f), 1.0f, roughness);
    const osg::Vec3d at(0.5, -3, 1);
    root->insertChild(0, makeLight(2, osg::Vec4(osg::Vec3(at), 1), osg::Vec4(0.5f, 0.5f, 0.5f, 1)));
    const Picture p = render();
    for (const osg::Vec2i& pixel : {osg::Vec2i(32, 32), osg::Vec2i(36, 40), osg::Vec2i(50, 20), osg::Vec2i(8, 60)}) {
        const osg::Vec3d point = pointAt(pixel[0], pixel[1]);
        // The normal is -Y: a frame of x, z, -y.
        const auto local = [&](osg::Vec3d d) {
            d -= point;
            d.normalize();
            return glsl::vec3(d[0], d[2], -d[1]);
        };
        const glsl::vec3 v = local(osg::Vec3d(0, -4, 0));
        const glsl::vec3 l = local(at);
        const double e = lobeAlbedo(v, double(roughness * roughness));
        const double bend = 1.0 + 1.1 * (1.0 - e) * (1.0 - e);
        const glsl::vec3 fresnel = glsl::fresnelSchlick(f0, glm::dot(glm::normalize(v + l), v));
        for (int k = 0; k < 3; ++k) {
            const double energy = 1.0 + std::pow(f0[k], bend) * (1.0 / e - 1.0);
            const double expected =
                decoded(0.5) * osg::PI * l.z * energy * fresnel[k] * glsl::ggxBrdf(v, l, double(roughness * roughness));
            EXPECT_NEAR(p.color(pixel[0], pixel[1])[k], expected, 0.01 * expected + exact) << pixel[0] << " " << pixel[1];
        }
    }
}

TEST_F(SceneLights, ASmoothSurfaceShowsAHighlightOfSomeWidth)
{
    for (const float roughness : {0.0f, 0.1f}) {
        Material::setCookTorrance(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(1, 1, 1), 1.0f, roughness);
        root->removeChildren(1, root->getNumChildren() - 1);
        root->addChild(makeLight(2, osg::Vec4(0, -1, 0, 0), osg::Vec4(1000, 1000, 1000, 1)));
        const Picture p = render();
        EXPECT_TRUE(p.finite());
        EXPECT_LE(p.color(32, 32)[0], 32752.0);
        EXPECT_GT(p.color(32, 32)[0], 10.0);
    }
}

TEST_F(SceneLights, TransparentSurfacesAreLitAlike)
{
    const osg::Vec3d at(0.5, -3, 1);
    const osg::ref_ptr<osg::LightSource> light = makeLight(1, osg::Vec4(osg::Vec3(at), 1), osg::Vec4(0.7f, 0.7f, 0.7f, 1));
    light->getLight()->setLinearAttenuation(0.5f);
    root->insertChild(0, light);
    lit->addChild(makeSphere(osg::Vec3d(-0.3, -1.5, -0.2), 0.2, 32));
    osg::StateSet& s = *lit->getChild(0)->getOrCreateStateSet();
    for (const bool metal : {false, true}) {
        if (metal) Material::setCookTorrance(s, osg::Vec3f(0.9f, 0.6f, 0.3f), 1.0f, 0.5f);
        s.setMode(GL_BLEND, osg::StateAttribute::OFF);
        s.setRenderingHint(osg::StateSet::DEFAULT_BIN);
        const Picture opaque = render();
        EXPECT_EQ(0u, lit->plan().surfaces.forward);
        s.setMode(GL_BLEND, osg::StateAttribute::ON);
        s.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        const Picture forward = render();
        EXPECT_EQ(1u, lit->plan().surfaces.litForward);
        EXPECT_LE(largestDifference(opaque, forward), 3e-3) << metal;
        EXPECT_GT(opaque.color(32, 32)[0], 0.05) << metal;
    }
}

TEST_F(SceneLights, TheViewersOwnLightIsNotOneOfThem)
{
    root = new osg::Group;
    root->addChild(lit);
    lit->setTimed(true);
    lit->getEnvironmentMap()->setImage(lopsidedMap().get());
    lit->getSettings()->sceneLights = Settings::SCENE_LIGHTS_OFF;
    const Picture off = render();
    EXPECT_EQ("off, switched off", lightsReason(*lit));
    for (const auto mode : {osg::View::HEADLIGHT, osg::View::SKY_LIGHT, osg::View::NO_LIGHT}) {
        renderer.viewer().setLightingMode(mode);
        lit->getSettings()->sceneLights = Settings::SCENE_LIGHTS_AUTO;
        EXPECT_EQ(off.rgba, render().rgba);
        EXPECT_EQ("off, only the viewer's own light", lightsReason(*lit));
        for (const auto& r : lit->plan().passes) EXPECT_TRUE(r.pass != "scenelights" || r.cpu < 0.0);
        lit->getSettings()->sceneLights = Settings::SCENE_LIGHTS_ON;
        const bool brighter = render().color(32, 32)[0] > off.color(32, 32)[0] + 0.1;
        EXPECT_EQ(mode == osg::View::HEADLIGHT, brighter) << mode;  // the sky light is above, and the screen upright
    }
}

TEST_F(SceneLights, ThePictureWithoutThemComesBack)
{
    lit->getEnvironmentMap()->setImage(lopsidedMap().get());
    const Picture before = render();
    const osg::ref_ptr<osg::LightSource> light = makeLight(1, osg::Vec4(0, -1, 0, 0));
    for (const bool behind : {false, true}) {
        root->insertChild(behind ? 1 : 0, light);
        EXPECT_GT(render().color(32, 32)[0], before.color(32, 32)[0] + 0.9) << behind;
        root->removeChild(light);
        EXPECT_EQ(before.rgba, render().rgba) << behind;
        EXPECT_EQ("off, only the viewer's own light", lightsReason(*lit));
    }
}

TEST_F(SceneLights, OnlyThoseThatAreSwitchedOnCount)
{
    NotifyCatcher notify;
    const osg::ref_ptr<osg::LightSource> light = makeLight(1, osg::Vec4(0, -1, 0, 0));
    light->setStateSet(nullptr);
    light->getLight()->setName("lamp");
    root->insertChild(0, light);
    root->getStateSet()->removeMode(GL_LIGHT1);
    EXPECT_EQ(0.0, render().color(32, 32)[0]);
    EXPECT_EQ("", notify.text());
    lit->getChild(0)->getStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    EXPECT_NEAR(render().color(32, 32)[0], 1.0, exact);
    EXPECT_EQ("", notify.text());
    lit->addChild(makeSphere(osg::Vec3d(1, -1, 0), 0.2));
    render();
    render();
    EXPECT_NE(std::string::npos, notify.text().find("light 'lamp' is switched on for some"));
    EXPECT_EQ(1, std::count(notify.text().begin(), notify.text().end(), '\n')) << notify.text();
}

// A picture that has converged begins anew when a light moves, wherever its node is in the graph.
TEST_F(SceneLights, AStillViewFollowsThem)
{
    lit->getEnvironmentMap()->setImage(constantMap(0.5).get());
    lit->getSettings()->accumulate = true;
    lit->getSettings()->accumulateFrames = 2;
    lit->getSettings()->atlasLights = 16;
    for (const bool behind : {false, true}) {
        const osg::ref_ptr<osg::LightSource> light = makeLight(1, osg::Vec4(0, -1, 0, 0));
        root->insertChild(behind ? 1 : 0, light);
        const double before = renderer.render(root, 40).color(32, 32)[0];
        EXPECT_EQ(2u, lit->average().frames) << behind;
        EXPECT_NEAR(before, 1.5, 0.02) << behind;
        light->getLight()->setDiffuse(osg::Vec4(0, 0, 0, 1));
        EXPECT_NEAR(renderer.render(root, 40).color(32, 32)[0], 0.5, 0.02) << behind;
        root->removeChild(light);
    }
}

}  // namespace SceneLights_test
