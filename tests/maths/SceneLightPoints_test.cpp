// SPDX-License-Identifier: MIT
// Where the shadow maps of the application's lights stand, and that they show what they must.
#include "shadow/SceneLightPoints.h"

#include <Maths.h>

#include <gtest/gtest.h>

#include <cmath>

namespace SceneLightPoints_test
{

using osgEnvLight::EmitterPoint;
using osgEnvLight::SceneLight;
using osgEnvLight::SceneLightFaces;

namespace
{

const osg::BoundingBoxd casters(-1, -2, -3, 4, 5, 6);

SceneLight lightAt(const osg::Vec4f& position, double cutoff = 180.0)
{
    SceneLight light;
    light.number = 3;
    light.color = osg::Vec3f(1, 2, 3);
    light.position = position;
    light.spot = osg::Vec4f(0, 0.6f, 0.8f, cutoff > 90.0 ? -2.0f : float(std::cos(osg::DegreesToRadians(cutoff))));
    return light;
}

// Whether the map's widest window shows what lies in that direction.
bool shows(const EmitterPoint& point, const osg::Vec3d& direction)
{
    const glsl::mat3 frame = glsl::frameAround(glsl::vec3(point.normal.x(), point.normal.y(), point.normal.z()));
    const glsl::vec3 d = glsl::transpose(frame) * glsl::vec3(direction.x(), direction.y(), direction.z());
    return d.z > 0.0 && std::max(std::abs(d.x), std::abs(d.y)) <= point.tangent * d.z * (1.0 + 1e-9);
}

std::vector<EmitterPoint> pointsOf(const SceneLight& light, SceneLightFaces& faces,
                                   const osg::Matrixd& worldFromEye = osg::Matrixd())
{
    return osgEnvLight::sceneLightPoints({light}, worldFromEye, casters, faces);
}

}  // namespace

TEST(SceneLightPoints, APointLightSeesEveryDirectionOnce)
{
    SceneLightFaces faces;
    const std::vector<EmitterPoint> points = pointsOf(lightAt(osg::Vec4f(1, 2, 3, 1)), faces, osg::Matrixd::translate(10, 0, 0));
    ASSERT_EQ(6u, points.size());
    EXPECT_EQ(std::make_pair(0u, 6u), faces[3]);
    testmaths::Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const glsl::vec3 d = random.direction();
        const int face = glsl::cubeFace(d);
        for (int k = 0; k < 6; ++k) EXPECT_EQ(k == face, shows(points[size_t(k)], osg::Vec3d(d.x, d.y, d.z))) << i << " " << k;
    }
    for (const EmitterPoint& p : points) EXPECT_EQ(osg::Vec3d(11, 2, 3), p.position);
}

TEST(SceneLightPoints, ASpotsMapShowsItsConeAndNoMore)
{
    for (double cutoff : {0.0, 1.0, 20.0, 60.0}) {
        SceneLightFaces faces;
        const std::vector<EmitterPoint> points = pointsOf(lightAt(osg::Vec4f(0, 0, 0, 1), cutoff), faces);
        ASSERT_EQ(1u, points.size());
        EXPECT_EQ(1u, faces[3].second);
        EXPECT_NEAR(std::max(std::tan(osg::DegreesToRadians(cutoff)), 1e-3), points[0].tangent, 1e-6);
        EXPECT_LT((points[0].normal - osg::Vec3d(0, 0.6, 0.8)).length(), 1e-7);
    }
    SceneLightFaces faces;
    EXPECT_EQ(6u, pointsOf(lightAt(osg::Vec4f(0, 0, 0, 1), 70.0), faces).size());
    EXPECT_EQ(6u, pointsOf(lightAt(osg::Vec4f(0, 0, 0, 1), 90.0), faces).size());
}

TEST(SceneLightPoints, ADirectionalLightSeesAllCastersFromAfar)
{
    SceneLightFaces faces;
    const osg::Vec3f to(0.36f, 0.48f, 0.8f);
    const std::vector<EmitterPoint> points = pointsOf(lightAt(osg::Vec4f(to, 0)), faces);
    ASSERT_EQ(1u, points.size());
    for (unsigned i = 0; i < 8; ++i) EXPECT_TRUE(shows(points[0], casters.corner(i) - points[0].position));
    // No ray is further off than .3 degrees.
    for (unsigned i = 0; i < 8; ++i) {
        osg::Vec3d ray = points[0].position - casters.corner(i);
        ray.normalize();
        EXPECT_LT((ray ^ osg::Vec3d(to)).length(), osg::DegreesToRadians(0.3));
    }
}

// As single precision before the eye does; what has moved by a thousandth of the casters' extent has moved.
TEST(SceneLightPoints, AViewThatMovesRoundsThem)
{
    const osg::Vec3d place(3.1, -2.7, 8.3), to(0.36, -0.48, 0.8), cone(0.1, 0.7, -0.4);
    const auto seenFrom = [&](const osg::Matrixd& worldFromEye, const osg::Vec3d& shift) {
        const osg::Matrixd eyeFromWorld = osg::Matrixd::inverse(worldFromEye);
        const osg::Vec3f lamp(osg::Vec3d(place + shift) * eyeFromWorld);
        osg::Vec3d direction = osg::Matrixd::transform3x3(osg::Vec3d(to + shift * 0.1), eyeFromWorld);
        direction.normalize();
        osg::Vec3d axis = osg::Matrixd::transform3x3(cone, eyeFromWorld);
        axis.normalize();
        SceneLight point = lightAt(osg::Vec4f(lamp, 1)), spot = lightAt(osg::Vec4f(lamp, 1), 30.0),
                   sun = lightAt(osg::Vec4f(osg::Vec3f(direction), 0));
        point.number = 0;
        sun.number = 1;
        spot.spot = osg::Vec4f(osg::Vec3f(axis), spot.spot[3]);
        SceneLightFaces faces;
        return osgEnvLight::sceneLightPoints({point, sun, spot}, worldFromEye, casters, faces);
    };
    const double extent = (casters._max - casters._min).length();
    const std::vector<EmitterPoint> first = seenFrom(osg::Matrixd::translate(0, -20, 5), osg::Vec3d());
    ASSERT_EQ(8u, first.size());
    testmaths::Random random(7);
    for (int i = 0; i < 500; ++i) {
        const glsl::vec3 axis = random.direction(), shift = random.direction();
        const osg::Vec3d eye(shift.x * 200.0, shift.y * 30.0, shift.z * 5.0);
        const osg::Matrixd view =
            osg::Matrixd::rotate(random.uniform(0.0, 6.0), axis.x, axis.y, axis.z) * osg::Matrixd::translate(eye);
        EXPECT_TRUE(osgEnvLight::areRounded(seenFrom(view, osg::Vec3d()), first, casters, eye)) << i;
        const osg::Vec3d far(shift.y * 1e-3 * extent, shift.z * 1e-3 * extent, shift.x * 1e-3 * extent);
        EXPECT_FALSE(osgEnvLight::areRounded(seenFrom(view, far), first, casters, eye)) << i;
    }
}

TEST(SceneLightPoints, TheViewsOwnLightHasNone)
{
    SceneLight head = lightAt(osg::Vec4f(0, 0, 1, 0)), lamp = lightAt(osg::Vec4f(0, 0, 0, 1), 30.0);
    head.number = 0;
    head.ofView = true;
    SceneLightFaces faces;
    EXPECT_EQ(1u, osgEnvLight::sceneLightPoints({head, lamp}, osg::Matrixd(), casters, faces).size());
    EXPECT_EQ(0u, faces[0].second);
    EXPECT_EQ(1u, faces[3].second);
}

}  // namespace SceneLightPoints_test
