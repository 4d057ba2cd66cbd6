// SPDX-License-Identifier: MIT
#include "shadow/SceneLightPoints.h"

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double farOff = 100.0;  // where a directional light's map stands; the rays are .3 degrees off at the casters' edge

EmitterPoint mapAt(const SceneLight& light, const osg::Vec3d& position, const osg::Vec3d& along, double tangent)
{
    EmitterPoint point;
    point.position = position;
    point.normal = along;
    point.power = light.color;
    point.area = 1.0;
    point.tangent = tangent;
    return point;
}

std::vector<EmitterPoint> mapsOf(const SceneLight& light, const osg::Matrixd& worldFromEye, const osg::BoundingBoxd& casters)
{
    const osg::Vec3d place(light.position[0], light.position[1], light.position[2]);
    const auto inWorld = [&](const osg::Vec3d& direction) {
        osg::Vec3d d = osg::Matrixd::transform3x3(direction, worldFromEye);
        d.normalize();
        return d;
    };
    if (light.position[3] == 0.0f) {
        const osg::Vec3d to = inWorld(place);
        const double distance = farOff * (casters._max - casters._min).length();
        return {mapAt(light, casters.center() + to * distance, -to, glsl::EMITTER_MAP_TANGENT)};
    }
    const osg::Vec3d position = place * worldFromEye;
    const double cosine = light.spot[3];
    const double tangent = std::sqrt(std::max(1.0 - cosine * cosine, 0.0)) / std::max(cosine, 1e-9);
    if (cosine > 0.0 && tangent <= glsl::EMITTER_MAP_TANGENT)
        return {
            mapAt(light, position, inWorld(osg::Vec3d(light.spot[0], light.spot[1], light.spot[2])), std::max(tangent, 1e-3))};
    std::vector<EmitterPoint> cube;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            osg::Vec3d along;
            along[axis] = sign;
            cube.push_back(mapAt(light, position, along, 1.0));
        }
    return cube;
}

}  // namespace

std::vector<EmitterPoint> sceneLightPoints(const SceneLightList& lights, const osg::Matrixd& worldFromEye,
                                           const osg::BoundingBoxd& casters, SceneLightFaces& faces)
{
    std::vector<EmitterPoint> points;
    faces = {};
    for (const SceneLight& light : lights) {
        if (light.ofView) continue;
        const std::vector<EmitterPoint> maps = mapsOf(light, worldFromEye, casters);
        faces[light.number] = {unsigned(points.size()), unsigned(maps.size())};
        points.insert(points.end(), maps.begin(), maps.end());
    }
    return points;
}

bool areRounded(const std::vector<EmitterPoint>& points, const std::vector<EmitterPoint>& former,
                const osg::BoundingBoxd& casters, const osg::Vec3d& eye)
{
    const double share = 1e-6;  // floats before the eye have 6e-8 of their distance
    const double extent = (casters._max - casters._min).length();
    const auto same = [&](const EmitterPoint& a, const EmitterPoint& b) {
        return (a.position - b.position).length() <= share * (extent + (a.position - eye).length()) &&
               (a.normal - b.normal).length() <= share && a.power == b.power && a.tangent == b.tangent;
    };
    return std::equal(points.begin(), points.end(), former.begin(), former.end(), same);
}

}  // namespace osgEnvLight
