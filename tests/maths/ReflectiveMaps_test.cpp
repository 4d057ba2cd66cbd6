// SPDX-License-Identifier: MIT
#include "indirect/ReflectiveMaps.h"

#include <gtest/gtest.h>

#include <cmath>

using osgEnvLight::ReflectedLight;
using osgEnvLight::ReflectiveMap;
using osgEnvLight::reflectiveMap;

namespace ReflectiveMaps_test
{

namespace
{

const osg::BoundingBoxd mirrors(100.0, -20.0, 3.0, 102.0, -19.0, 3.5);
const osg::Vec3d origin(90.0, 0.0, 0.0);

ReflectedLight lightAt(double x, double y, double z, double w)
{
    ReflectedLight light;
    light.position = osg::Vec4d(x, y, z, w);
    return light;
}

osg::Vec3d clipOf(const ReflectiveMap& map, const osg::Vec3d& place)
{
    const osg::Vec4d p = osg::Vec4d(place - origin, 1.0) * map.projection;
    return osg::Vec3d(p.x(), p.y(), p.z()) / p.w();
}

}  // namespace

// All of the mirrors lies in the map, and what is nearer to the light comes first.
TEST(ReflectiveMaps, ShowAllMirrors)
{
    for (const ReflectedLight& light : {lightAt(0, 0, 1, 0), lightAt(0.6, 0, 0.8, 0), lightAt(101, -15, 9, 1),
                                        lightAt(101, -19.5, 4.5, 1), lightAt(1e4, 0, 0, 1)}) {
        const ReflectiveMap map = reflectiveMap(light, mirrors, origin, 256);
        EXPECT_NEAR(1.0, map.axis.length(), 1e-12);
        for (unsigned i = 0; i < 8; ++i) {
            const osg::Vec3d clip = clipOf(map, mirrors.corner(i));
            for (int k = 0; k < 3; ++k) EXPECT_LE(std::abs(clip[k]), 1.0 + 1e-9) << light.position.x() << " " << i << " " << k;
            EXPECT_LT(clipOf(map, mirrors.corner(i) + map.axis * 1e-3).z(), clip.z());
        }
    }
}

// The texels' areas are those that the projection gives them.
TEST(ReflectiveMaps, TexelsHaveTheirArea)
{
    for (const ReflectedLight& light : {lightAt(0.6, 0, 0.8, 0), lightAt(101, -15, 9, 1)}) {
        const unsigned size = 64;
        const ReflectiveMap map = reflectiveMap(light, mirrors, origin, size);
        const osg::Vec3d middle = mirrors.center(),
                         any = std::abs(map.axis.z()) < 0.9 ? osg::Vec3d(0, 0, 1) : osg::Vec3d(1, 0, 0);
        osg::Vec3d u = map.axis ^ any;
        u.normalize();
        const osg::Vec3d v = map.axis ^ u, at = clipOf(map, middle);
        const double step = 1e-4;
        const osg::Vec3d du = (clipOf(map, middle + u * step) - at) / step, dv = (clipOf(map, middle + v * step) - at) / step;
        const double clipArea = 4.0 / (size * size), area = clipArea / std::abs(du.x() * dv.y() - du.y() * dv.x());
        const double square = light.position.w() > 0.0 ? (osg::Vec3d(101, -15, 9) - middle).length2() : 1.0;
        EXPECT_NEAR(map.texelArea * square, area, 1e-6 * area);
    }
}

// A light among the mirrors, one that is nowhere, and mirrors without extent give finite maps.
TEST(ReflectiveMaps, AreFinite)
{
    const osg::BoundingBoxd point(1, 1, 1, 1, 1, 1), plane(0, 0, 0, 1, 1, 0);
    for (const osg::BoundingBoxd& box : {mirrors, point, plane})
        for (const ReflectedLight& light :
             {lightAt(101, -19.5, 3.25, 1), lightAt(0, 0, 1, 0), lightAt(1, 0, 0, 0), lightAt(1, 1, 1, 1)}) {
            const ReflectiveMap map = reflectiveMap(light, box, origin, 32);
            for (int k = 0; k < 16; ++k) EXPECT_TRUE(std::isfinite(map.projection.ptr()[k])) << k;
            EXPECT_TRUE(std::isfinite(map.texelArea));
        }
}

}  // namespace ReflectiveMaps_test
