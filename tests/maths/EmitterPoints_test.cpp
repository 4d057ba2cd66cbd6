// SPDX-License-Identifier: MIT
// The points that stand for area lights.
#include "shadow/EmitterPoints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Emitters.h"

namespace EmitterPoints_test
{

using osgEnvLight::AreaLight;
using osgEnvLight::Emitter;
using osgEnvLight::EmitterPoint;
using osgEnvLight::emitterPoints;

namespace
{

Emitter placed(const osg::ref_ptr<AreaLight>& light, double radiance)
{
    light->setRadiance(osg::Vec3f(float(radiance), float(radiance), float(radiance)));
    return ::placed(*light);
}

Emitter rectangle(const osg::Vec3d& center, double width, double height, double radiance, bool twoSided = false)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setRectangle(center, osg::Vec3d(0.5 * width, 0, 0), osg::Vec3d(0, 0.5 * height, 0));
    light->setTwoSided(twoSided);
    return placed(light, radiance);
}

Emitter sphere(const osg::Vec3d& center, double radius, double radiance)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setSphere(center, radius);
    return placed(light, radiance);
}

Emitter disc(double radius)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setDisc(osg::Vec3d(1, 2, 3), osg::Vec3d(0, 1, 0), radius);
    return placed(light, 1.0);
}

// An L of area 3.
Emitter corner()
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& v :
         {osg::Vec3(0, 0, 0), osg::Vec3(2, 0, 0), osg::Vec3(2, 1, 0), osg::Vec3(1, 1, 0), osg::Vec3(1, 2, 0), osg::Vec3(0, 2, 0)})
        vertices->push_back(v);
    osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setPolygon(*vertices);
    return placed(light, 1.0);
}

double power(const std::vector<EmitterPoint>& points)
{
    double sum = 0.0;
    for (const EmitterPoint& p : points) sum += p.power[0];
    return sum;
}

size_t near(const std::vector<EmitterPoint>& points, const osg::Vec3d& center, double radius)
{
    size_t count = 0;
    for (const EmitterPoint& p : points) count += (p.position - center).length() < radius ? 1 : 0;
    return count;
}

osg::Vec3d mean(const std::vector<EmitterPoint>& points)
{
    osg::Vec3d sum;
    for (const EmitterPoint& p : points) sum += p.position;
    return sum / double(points.size());
}

}  // namespace

TEST(EmitterPoints, TogetherSendWhatTheLightsSend)
{
    const std::vector<Emitter> lights = {rectangle(osg::Vec3d(), 2, 1, 3), sphere(osg::Vec3d(0, 0, 5), 0.5, 1), disc(0.7),
                                         corner()};
    double sum = 0.0;
    for (const Emitter& light : lights) sum += light.radiance[0] * light.area;
    for (unsigned count : {16u, 64u, 256u}) EXPECT_NEAR(sum, power(emitterPoints(lights, count)), 1e-9 * sum) << count;
}

TEST(EmitterPoints, AreDealtByFluxAndNoLightHasNone)
{
    const std::vector<Emitter> lights = {rectangle(osg::Vec3d(), 1, 1, 1), rectangle(osg::Vec3d(10, 0, 0), 1, 1, 3),
                                         rectangle(osg::Vec3d(20, 0, 0), 1, 1, 1e-6)};
    const std::vector<EmitterPoint> points = emitterPoints(lights, 64);
    ASSERT_EQ(64u, points.size());
    EXPECT_EQ(1u, near(points, osg::Vec3d(20, 0, 0), 1));
    // A quarter and three quarters of 61, beside the one that each has.
    EXPECT_NEAR(16.25, double(near(points, osg::Vec3d(), 1)), 1.0);
    EXPECT_NEAR(46.75, double(near(points, osg::Vec3d(10, 0, 0), 1)), 1.0);
}

TEST(EmitterPoints, LieOnTheLightSpreadEvenly)
{
    for (const Emitter& light : {rectangle(osg::Vec3d(4, 0, 1), 2, 3, 1), disc(0.7), corner()}) {
        const std::vector<EmitterPoint> points = emitterPoints({light}, 64);
        for (const EmitterPoint& p : points) {
            EXPECT_EQ(light.normal, p.normal);
            const double lift = (p.position - light.center) * light.normal;
            EXPECT_GT(lift, 0.0);
            EXPECT_LT(lift, 2e-4 * std::sqrt(light.area));
            EXPECT_DOUBLE_EQ(light.area / 64.0, p.area);
        }
        // The centre of mass: of the L its three squares'.
        const osg::Vec3d middle = light.shape == AreaLight::POLYGON ? osg::Vec3d(5.0 / 6.0, 5.0 / 6.0, 0.0) : light.center;
        EXPECT_LT((mean(points) - middle).length(), 0.02 * std::sqrt(light.area));
    }
    for (const EmitterPoint& p : emitterPoints({corner()}, 256)) EXPECT_FALSE(p.position.x() > 1.0 && p.position.y() > 1.0);
}

TEST(EmitterPoints, OfASphereSendToAllSides)
{
    const Emitter light = sphere(osg::Vec3d(1, 2, 3), 0.5, 1);
    const std::vector<EmitterPoint> points = emitterPoints({light}, 64);
    for (const EmitterPoint& p : points) EXPECT_LT((p.position - light.center - p.normal * 0.5).length(), 1e-3);
    EXPECT_LT((mean(points) - light.center).length(), 0.01);
}

TEST(EmitterPoints, OfALightOfTwoSidesSendToBoth)
{
    const std::vector<EmitterPoint> points = emitterPoints({rectangle(osg::Vec3d(), 1, 1, 1, true)}, 32);
    int front = 0;
    for (const EmitterPoint& p : points) {
        front += p.normal.z() > 0.0 ? 1 : 0;
        EXPECT_GT(p.position.z() * p.normal.z(), 0.0);
    }
    EXPECT_EQ(16, front);
    EXPECT_NEAR(2.0, power(points), 1e-12);
}

// A row of 1000 lamps, of which the right half is three times as bright: points stand for as much flux each, near to where it is.
TEST(EmitterPoints, OfMoreLightsThanPointsStandForNeighbours)
{
    std::vector<Emitter> lights;
    for (int i = 0; i < 1000; ++i) lights.push_back(rectangle(osg::Vec3d(i, 0, 0), 0.1, 0.1, i < 500 ? 1 : 3));
    const std::vector<EmitterPoint> points = emitterPoints(lights, 64);
    ASSERT_EQ(64u, points.size());
    double left = 0.0, all = 0.0;
    for (const EmitterPoint& p : points) {
        all += p.power[0];
        left += p.position.x() < 499.5 ? p.power[0] : 0.0;
        EXPECT_NEAR(20.0 / 64.0, p.power[0], 1e-12);
    }
    EXPECT_NEAR(20.0, all, 1e-9);
    EXPECT_NEAR(5.0, left, 20.0 / 64.0 + 1e-9);
}

TEST(EmitterPoints, OfNothingAreDark)
{
    EXPECT_EQ(0.0, power(emitterPoints({}, 16)));
    EXPECT_EQ(16u, emitterPoints({}, 16).size());
    EXPECT_EQ(0.0, power(emitterPoints({rectangle(osg::Vec3d(), 1, 1, 0)}, 16)));
}

}  // namespace EmitterPoints_test
