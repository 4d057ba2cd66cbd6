// SPDX-License-Identifier: MIT
// What tests of the sky shadow atlas share.
#pragma once

#include <Oracles.h>
#include <SceneRenderer.h>

#include <gtest/gtest.h>

namespace atlasscenes
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

inline osg::ref_ptr<LitScene> atlasScene()
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->view = Settings::VISIBILITY;
    lit->getSettings()->visibility = Settings::VISIBILITY_ATLAS;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    return lit;
}

// Visibility along a stretch of a row through the picture of a world point: the mean of all cells' groups.
inline double visibilityBeside(SceneRenderer& renderer, const Picture& p, const osg::Vec3d& point)
{
    const int row = int(renderer.pixelOf(point).y());
    double sum = 0.0;
    for (int x = p.width / 2 - 8; x < p.width / 2 + 8; ++x) sum += double(p.color(x, row)[0]) / 16.0;
    return sum;
}

// What a wall of height 1 along x hides of an even sky, beside it, mean of six turns of the map. One turn errs by 4 % at a = 1,
// where few of the 256 lights are low enough to meet the wall (measured, standard deviation over turns); the mean by 1.7 %.
// frames: of each picture
inline void expectWallWithinThreePercent(SceneRenderer& renderer, LitScene& lit, int frames = 1)
{
    lit.addChild(makeQuad(osg::Vec3d(-8, -4, 0), osg::Vec3d(16, 0, 0), osg::Vec3d(0, 8, 0)));
    lit.addChild(makeBox(osg::Vec3d(-8, 0, 0), osg::Vec3d(8, 2, 1)));
    renderer.lookAt(osg::Vec3d(0, -9, 9), osg::Vec3d(0, 0, 0), osg::Vec3d(0, 0, 1), 30.0);
    const int turns = 6;
    const double distances[] = {0.1, 0.5, 1.0};
    double occluded[3] = {};
    for (int turn = 0; turn < turns; ++turn) {
        lit.getEnvironmentMap()->setRotation(360.0 * turn / turns);
        const Picture p = renderer.render(&lit, frames);
        for (int i = 0; i < 3; ++i) occluded[i] += (1.0 - visibilityBeside(renderer, p, osg::Vec3d(0, -distances[i], 0))) / turns;
    }
    for (int i = 0; i < 3; ++i) {
        const double expected = testmaths::oracle::verticalRectangle(distances[i], 8.0, 1.0);
        EXPECT_NEAR(occluded[i] / expected, 1.0, 0.03) << "distance " << distances[i];
    }
}

}  // namespace atlasscenes
