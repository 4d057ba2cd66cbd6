// SPDX-License-Identifier: MIT
// Scenes, cameras and maps at the extremes: the list of systems.md section 4 as far as this frame reaches.
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <osg/MatrixTransform>

#include <gtest/gtest.h>

#include <limits>

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

osg::ref_ptr<osg::Group> makeModel()
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(makeQuad(osg::Vec3d(-2, -2, -0.7), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    group->addChild(makeSphere(osg::Vec3d(-0.8, 0, 0), 0.7, 64));
    group->addChild(makeSphere(osg::Vec3d(0.8, 0, 0), 0.7, 64));
    Material::setLambert(*group->getChild(0)->getOrCreateStateSet(), osg::Vec3f(0.5f, 0.5f, 0.5f));
    Material::setPhong(*group->getChild(1)->getOrCreateStateSet(), osg::Vec3f(0.4f, 0.2f, 0.2f), osg::Vec3f(0.4f, 0.4f, 0.4f),
                       80.0f);
    Material::setCookTorrance(*group->getChild(2)->getOrCreateStateSet(), osg::Vec3f(0.9f, 0.7f, 0.3f), 1.0f, 0.3f);
    return group;
}

osg::ref_ptr<osg::Image> skyMap()
{
    return makeMap(128, 64, [](const osg::Vec3d& d) {
        const double sky = d.z() > 0 ? 1.0 : 0.2;
        return osg::Vec3d(0.8, 0.9, 1.0) * sky + osg::Vec3d(1, 0.9, 0.7) * (d * osg::Vec3d(0.6, -0.48, 0.64) > 0.98 ? 40.0 : 0.0);
    });
}

// The scene moved and scaled, seen from the same place relative to it.
Picture renderMoved(SceneRenderer& renderer, double scale, const osg::Vec3d& offset)
{
    osg::ref_ptr<LitScene> lit = makeLit(skyMap().get());
    osg::ref_ptr<osg::MatrixTransform> transform =
        new osg::MatrixTransform(osg::Matrixd::scale(scale, scale, scale) * osg::Matrixd::translate(offset));
    transform->addChild(makeModel());
    lit->addChild(transform);
    renderer.viewer().getCamera()->setProjectionMatrixAsPerspective(40, 1, 0.1 * scale, 100 * scale);
    renderer.viewer().getCamera()->setViewMatrixAsLookAt(osg::Vec3d(0.6, -4, 1.6) * scale + offset, offset, osg::Vec3d(0, 0, 1));
    return renderer.render(lit, 2);
}

}  // namespace

TEST(Scenes, ScaleAndPlaceDoNotMatter)  // systems.md extremes 95, 96
{
    SceneRenderer renderer(64, 64);
    const Picture expected = renderMoved(renderer, 1.0, osg::Vec3d());
    // A few pixels at outlines and a few rays may fall on the other side of a rounding: in the mean 1e-3 of the radiance.
    for (double scale : {1e-6, 1e-3, 1e3, 1e6})
        EXPECT_LT(rootMeanSquare(expected, renderMoved(renderer, scale, osg::Vec3d())), 2e-3) << "scale " << scale;
    for (double offset : {1e4, 1e6})
        EXPECT_LT(rootMeanSquare(expected, renderMoved(renderer, 1.0, osg::Vec3d(offset, -offset, offset))), 2e-3)
            << "offset " << offset;
}

TEST(Scenes, BlackMapShowsEmissionOnly)  // 1
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(0.0).get());
    lit->addChild(makeModel());
    const Picture p = renderer.render(lit, 2);
    for (float f : p.rgba) EXPECT_TRUE(f == 0.0f || f == 1.0f);  // alpha
    const osgEnvLight::Plan plan = lit->plan();
    EXPECT_FALSE(plan.runs("diffuse") || plan.runs("specular") || plan.runs("occlusion"));
    EXPECT_NE(std::string::npos, plan.explain().find("the map is black"));
}

TEST(Scenes, TinyAndStrangeMapsAreLegal)  // 3, 4, 6, 7, 8
{
    SceneRenderer renderer(32, 32);
    NotifyCatcher notify;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const auto& [w, h] : {std::pair(1, 1), std::pair(2, 1), std::pair(4, 2), std::pair(1, 8), std::pair(9, 1)})
        for (float value : {1.0f, 65504.0f, 1e30f, 1e-40f, nan, -1e-6f}) {
            osg::ref_ptr<osg::Image> map = new osg::Image;
            map->allocateImage(w, h, 1, GL_RGB, GL_FLOAT);
            std::fill_n(reinterpret_cast<float*>(map->data()), 3 * w * h, value);
            osg::ref_ptr<LitScene> lit = makeLit(map.get());
            lit->addChild(makeModel());
            const Picture p = renderer.render(lit, 1);
            EXPECT_TRUE(p.finite()) << w << "x" << h << " of " << value;
        }
    EXPECT_EQ(std::string::npos, notify.text().find("OpenGL"));
}

TEST(Scenes, OneTexelOf21StopsKeepsItsFlux)  // 4
{
    SceneRenderer renderer(33, 33);
    osg::ref_ptr<osg::Image> map = constantMap(0.0);
    // One texel towards +X of a 64 x 32 map: its light is a direction, so a plate facing it gets flux / pi.
    float* texel = reinterpret_cast<float*>(map->data(32, 16));
    for (int k = 0; k < 3; ++k) texel[k] = 2e6f;
    const double theta = osg::PI * 15.5 / 32;
    const double phi = -2.0 * osg::PI * 0.5 / 64;
    const osg::Vec3d d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    const double flux = 2e6 * std::sin(theta) * osg::PI / 32 * 2.0 * osg::PI / 64;
    osg::ref_ptr<LitScene> lit = makeLit(map.get());
    lit->getSettings()->diffuseCarrier = Settings::LIGHTS;
    osg::ref_ptr<osg::Geode> plate = makeQuad(osg::Vec3d(0, -1, -1), osg::Vec3d(0, 2, 0), osg::Vec3d(0, 0, 2));
    Material::setLambert(*plate->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    lit->addChild(plate);
    renderer.lookAt(osg::Vec3d(4, 0, 0), osg::Vec3d());
    EXPECT_NEAR(renderer.render(lit, 2).color(16, 16)[0] / (flux * d.x() / osg::PI), 1.0, 0.01);  // the texel is 5.6 degrees wide
}

TEST(Scenes, EmptySceneShowsTheMap)  // 58, 98
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(2.0).get());
    const Picture p = renderer.render(lit, 2);
    EXPECT_NEAR(p.color(16, 16)[0], 2.0, 0.002);
    EXPECT_EQ(0.0f, p.alpha(16, 16));
    EXPECT_FALSE(lit->plan().runs("diffuse"));
}

TEST(Scenes, OrthographicOffAxisAndInsideCamerasAreFiniteAndLit)  // 56, 58
{
    SceneRenderer renderer(48, 48);
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->addChild(makeModel());
    osg::Camera& camera = *renderer.viewer().getCamera();
    camera.setViewMatrixAsLookAt(osg::Vec3d(0, -4, 1), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    camera.setProjectionMatrixAsOrtho(-2, 2, -2, 2, 0.1, 20);
    for (int kind = 0; kind < 3; ++kind) {
        if (kind == 1) camera.setProjectionMatrixAsFrustum(-0.1, 0.3, -0.3, 0.1, 1, 20);
        if (kind == 2) renderer.lookAt(osg::Vec3d(-0.8, 0, 0), osg::Vec3d(-0.8, 1, 0));  // inside a sphere
        const Picture p = renderer.render(lit, 2);
        EXPECT_TRUE(p.finite());
        for (int y = 0; y < p.height; ++y)
            for (int x = 0; x < p.width; ++x) {
                EXPECT_GE(p.color(x, y)[0], 0.0);
                EXPECT_LE(p.color(x, y)[0], 1.02);  // the furnace bounds everything but the sampler's error
            }
    }
}

TEST(Scenes, HalfTheMapIsWhatTheCarriersAgreeOnAtAnyRotation)  // 11, 13
{
    SceneRenderer renderer(33, 33);
    const auto map = makeMap(128, 64, [](const osg::Vec3d& d) { return d.x() > 0 ? osg::Vec3d(1, 1, 1) : osg::Vec3d(); });
    osg::ref_ptr<LitScene> lit = makeLit(map.get());
    osg::ref_ptr<osg::Geode> plate = makeQuad(osg::Vec3d(-1, -1, 0), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0));
    Material::setLambert(*plate->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    lit->addChild(plate);
    renderer.lookAt(osg::Vec3d(0, 0, 4), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    for (double degrees : {0.0, 90.0, 179.9, 180.0, 359.0, 36000.0, -45.0, 1e6}) {
        lit->getEnvironmentMap()->setRotation(degrees);
        EXPECT_NEAR(renderer.render(lit, 1).color(16, 16)[0], 0.5, 0.005) << degrees;  // by symmetry, half a furnace
    }
}

TEST(Scenes, NonFiniteCamerasAndIntensitiesDoNotCrash)  // 102
{
    SceneRenderer renderer(16, 16);
    NotifyCatcher notify;
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->addChild(makeModel());
    lit->getEnvironmentMap()->setIntensity(std::numeric_limits<double>::quiet_NaN());
    renderer.render(lit, 2);
    EXPECT_NE(std::string::npos, notify.text().find("intensity"));
    lit->getEnvironmentMap()->setIntensity(1.0);
    EXPECT_NEAR(renderer.render(lit, 2).color(8, 12)[0], 1.0, 0.02);  // back: the background or white metal
}
