// SPDX-License-Identifier: MIT
// The reference lit by osg::LightSource: closed forms of lights without size, their shadows, and their light along paths.
#include <osg/LightSource>

#include "Lamps.h"
#include "Maths.h"

namespace PointLights_test
{

using osgEnvLight::Material;

namespace
{

osg::ref_ptr<osg::LightSource> lightAt(const osg::Vec4& position, float red = 1.0f)
{
    const osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setLightNum(2);
    source->getLight()->setPosition(position);
    source->getLight()->setDiffuse(osg::Vec4(red, 0.5f, 0.25f, 1));
    return source;
}

osg::ref_ptr<osg::Group> switchedOn(const std::vector<osg::ref_ptr<osg::Node>>& nodes)
{
    const osg::ref_ptr<osg::Group> scene = together(nodes);
    scene->getOrCreateStateSet()->setMode(GL_LIGHT2, osg::StateAttribute::ON);
    return scene;
}

// Of the floor at a point, from above.
double shownAt(osg::Node& scene, double x, double y)
{
    const Traced view = parallelView(scene, osg::Vec3d(x, y, 9), osg::Vec3d(0, 0, -1), 1e-3, 2);
    return estimateOf(view.render(night, options(ReferenceOptions::MIS, ReferenceOptions::DIRECT, 4)), Layer::BEAUTY).value;
}

const double exact = 1e-5;  // floats of the scene and of the picture

}  // namespace

TEST(ReferencePointLights, AFloorIsColourTimesCosineOverAttenuation)
{
    const osg::Vec3d lamp(0.3, -0.2, 1.5);
    const auto source = lightAt(osg::Vec4(osg::Vec3(lamp), 1), 3.0f);
    osg::Light& light = *source->getLight();
    light.setConstantAttenuation(0.5f);
    light.setLinearAttenuation(0.2f);
    light.setQuadraticAttenuation(0.1f);
    const auto scene = switchedOn({whiteFloor(2.0), source});
    for (const auto& [x, y] : {std::pair(0.3, -0.2), std::pair(-1.0, 0.4), std::pair(1.5, 1.5)}) {
        const double d = (lamp - osg::Vec3d(x, y, 0)).length();
        EXPECT_NEAR(3.0 * lamp[2] / d / (0.5 + 0.2 * d + 0.1 * d * d), shownAt(*scene, x, y), 3 * exact) << x;
    }
    light.setSpotCutoff(30.0f);
    light.setSpotExponent(2.0f);
    light.setDirection(osg::Vec3(0, 0, -1));
    const double d = (lamp - osg::Vec3d(0.9, -0.2, 0)).length(), c = lamp[2] / d;
    EXPECT_NEAR(3.0 * c / (0.5 + 0.2 * d + 0.1 * d * d) * c * c, shownAt(*scene, 0.9, -0.2), 3 * exact);
    EXPECT_EQ(0.0, shownAt(*scene, 1.3, -0.2)) << "beyond the cone";
    scene->getStateSet()->setMode(GL_LIGHT2, osg::StateAttribute::OFF);
    EXPECT_EQ(0.0, shownAt(*scene, 0.3, -0.2)) << "switched off";
}

TEST(ReferencePointLights, BodiesShadeTheFloorAndNotTheLightBeyondIt)
{
    osg::Vec3d to(0.6, 0, 0.8);
    const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(0, 0, 1), 0.25, 64);
    const auto sun = switchedOn({whiteFloor(3.0), ball, lightAt(osg::Vec4(osg::Vec3(to), 0))});
    EXPECT_EQ(0.0, shownAt(*sun, -0.75, 0)) << "the ball's shadow";
    EXPECT_NEAR(0.8, shownAt(*sun, 0.75, 0), exact);
    const auto below = switchedOn({whiteFloor(3.0), ball, lightAt(osg::Vec4(0.9f, 0, 0.4f, 1))});
    EXPECT_NEAR(0.4 / std::hypot(0.4, 0.3), shownAt(*below, 0.6, 0), exact) << "the ball is beyond the lamp";
}

// A lamp in the middle of a hollow ball: rho / (1 - rho) of what it sends.
TEST(ReferencePointLights, AHollowBallIsItsGeometricSeries)
{
    const double albedo = 0.5;
    const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(), 1.0, 96);
    Material::setLambert(*ball->getOrCreateStateSet(), osg::Vec3f(1, 1, 1) * float(albedo));
    const auto scene = switchedOn({ball, lightAt(osg::Vec4(0, 0, 0, 1))});
    const Traced view = perspectiveView(*scene, osg::Vec3d(0.3, 0, 0), osg::Vec3d(0, 0.9, 0.1), 16);
    const Estimate e = estimateOf(view.render(night, options(ReferenceOptions::MIS, ReferenceOptions::FULL, 256)), Layer::BEAUTY);
    EXPECT_NEAR(albedo / (1.0 - albedo), e.value, 4.0 * e.error + 3e-3);  // facets: cosines of 1/96 of half a turn
}

}  // namespace PointLights_test
