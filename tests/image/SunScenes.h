// SPDX-License-Identifier: MIT
// Scenes under a sun of which a picture shows what is seen.
#pragma once

#include "environment/DominantLight.h"

#include <SceneRenderer.h>

#include <algorithm>
#include <cmath>

namespace sunscenes
{

const double degree = osg::PI / 180.0;

// A sun of that radius [degrees] with the rest of the map at that radiance.
inline osg::ref_ptr<osg::Image> sunMap(osg::Vec3d direction, double radius, double sky = 0.0, double sun = 1000.0)
{
    direction.normalize();
    return makeMap(1024, 512, [=](const osg::Vec3d& d) {
        const double level = d * direction > std::cos(radius * degree) ? sun : sky;
        return osg::Vec3d(level, level, level);
    });
}

// Its visibility alone is seen: nothing else lights the scene.
inline osg::ref_ptr<osgEnvLight::LitScene> sunny(const osg::Vec3d& direction, double radius = 1.5)
{
    osg::ref_ptr<osgEnvLight::LitScene> lit = makeLit(sunMap(direction, radius).get());
    lit->getSettings()->suns = osgEnvLight::Settings::SUNS_AUTO;
    lit->getSettings()->view = osgEnvLight::Settings::VISIBILITY;
    lit->getSettings()->regeneration = osgEnvLight::Settings::IMMEDIATE;
    return lit;
}

inline osgEnvLight::DominantLight sunOf(osgEnvLight::LitScene& lit)
{
    std::string error;
    return osgEnvLight::splitSuns(*lit.getEnvironmentMap()->radiance(error), 8).suns.at(0);
}

// From above, north up: that many units of the world from side to side.
inline void lookDown(SceneRenderer& renderer, const osg::Vec3d& center, double width, double height = 50.0)
{
    renderer.lookAt(center + osg::Vec3d(0, 0, height), center, osg::Vec3d(0, 1, 0));
    const double half = 0.5 * width;
    renderer.viewer().getCamera()->setProjectionMatrixAsOrtho(-half, half, -half, half, 0.1 * height, 10.0 * height);
}

// Where along the picture's middle rows the visibility passes that level [pixels], rising or falling.
inline double crossing(const Picture& p, double level)
{
    std::vector<double> row(size_t(p.width), 0.0);
    for (int x = 0; x < p.width; ++x)
        for (int y = p.height / 2 - 8; y < p.height / 2 + 8; ++y) row[size_t(x)] += p.color(x, y)[0] / 16.0;
    for (size_t x = 1; x < row.size(); ++x)
        if ((row[x - 1] < level) != (row[x] < level)) return double(x) - 0.5 + (level - row[x - 1]) / (row[x] - row[x - 1]);
    return -1.0;
}

}  // namespace sunscenes
