// SPDX-License-Identifier: MIT
// The sky shadow atlas against closed forms.
#include <Oracles.h>
#include <SceneRenderer.h>

#include <gtest/gtest.h>

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

osg::ref_ptr<LitScene> atlasScene()
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->view = Settings::VISIBILITY;
    lit->getSettings()->visibility = Settings::VISIBILITY_ATLAS;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    return lit;
}

// Visibility along a stretch of a row through the picture of a world point: the mean of all cells' groups.
double visibilityBeside(SceneRenderer& renderer, const Picture& p, const osg::Vec3d& point)
{
    const int row = int(renderer.pixelOf(point).y());
    double sum = 0.0;
    for (int x = p.width / 2 - 8; x < p.width / 2 + 8; ++x) sum += double(p.color(x, row)[0]) / 16.0;
    return sum;
}

}  // namespace

// One turn of the map against the scene errs by 4 % at a = 1, where few of the 256 lights are low enough to meet the wall
// (measured, standard deviation over turns); the mean of six by 1.7 %.
TEST(Atlas, WallWithinThreePercent)
{
    SceneRenderer renderer(384, 384);
    osg::ref_ptr<LitScene> lit = atlasScene();
    lit->addChild(makeQuad(osg::Vec3d(-8, -4, 0), osg::Vec3d(16, 0, 0), osg::Vec3d(0, 8, 0)));
    lit->addChild(makeBox(osg::Vec3d(-8, 0, 0), osg::Vec3d(8, 2, 1)));
    renderer.lookAt(osg::Vec3d(0, -9, 9), osg::Vec3d(0, 0, 0), osg::Vec3d(0, 0, 1), 30.0);
    const int turns = 6;
    const double distances[] = {0.1, 0.5, 1.0};
    double occluded[3] = {};
    for (int turn = 0; turn < turns; ++turn) {
        lit->getEnvironmentMap()->setRotation(360.0 * turn / turns);
        const Picture p = renderer.render(lit);
        for (int i = 0; i < 3; ++i) occluded[i] += (1.0 - visibilityBeside(renderer, p, osg::Vec3d(0, -distances[i], 0))) / turns;
    }
    for (int i = 0; i < 3; ++i) {
        const double expected = testmaths::oracle::verticalRectangle(distances[i], 8.0, 1.0);
        EXPECT_NEAR(occluded[i] / expected, 1.0, 0.03) << "distance " << distances[i];
    }
}

// Heights are told apart by 5e-5 of the scene's size, texels on a plane at 89 degrees by more: there a light in 500 is lost.
TEST(Atlas, ThickPlanesSeeEverythingAtEveryScale)
{
    SceneRenderer renderer(96, 96);
    for (double scale : {1e-6, 1.0, 1e6})
        for (double tilt : {0.0, 30.0, 60.0, 80.0, 89.0}) {
            osg::ref_ptr<LitScene> lit = atlasScene();
            lit->addChild(makeBox(osg::Vec3d(-1, -1, -0.1) * scale, osg::Vec3d(1, 1, 0) * scale));
            const double t = osg::DegreesToRadians(tilt);
            renderer.lookAt(osg::Vec3d(0, -std::sin(t), std::cos(t)) * (2.0 * scale), osg::Vec3d(), osg::Vec3d(0, 1, 0.001));
            const Statistics s = ofGeometry(renderer.render(lit));
            EXPECT_GT(s.mean, 0.9995) << "scale " << scale << ", tilt " << tilt;
            EXPECT_GT(s.least, 0.995) << "scale " << scale << ", tilt " << tilt;
        }
}

TEST(Atlas, SheetsDontShadeThemselves)
{
    SceneRenderer renderer(96, 96);
    const double texel = 2.0 * 5.7 / 128.0;  // of the floor's diagonal
    for (double thickness : {0.0, 0.05, 0.6, 2.2}) {
        osg::ref_ptr<LitScene> lit = atlasScene();
        lit->addChild(makeQuad(osg::Vec3d(-4, -4, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0)));
        if (thickness > 0.0)
            lit->addChild(makeBox(osg::Vec3d(-1, -1, 1 - thickness * texel), osg::Vec3d(1, 1, 1)));
        else
            lit->addChild(makeQuad(osg::Vec3d(-1, -1, 1), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0)));
        renderer.lookAt(osg::Vec3d(0, -3, 5), osg::Vec3d(0, 0, 1), osg::Vec3d(0, 1, 0), 15.0);
        EXPECT_GT(ofGeometry(renderer.render(lit)).mean, 0.999) << "thickness " << thickness << " texels";
    }
}

// A floor without thickness is hit by its own texels where lights graze it: three texels of slack leave .2 % [occlusion.md 3.1].
TEST(Atlas, FloorsAreLitByGrazingLights)
{
    SceneRenderer renderer(96, 96);
    osg::ref_ptr<LitScene> lit = atlasScene();
    lit->addChild(makeQuad(osg::Vec3d(-4, -4, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0)));
    lit->addChild(makeBox(osg::Vec3d(3.9, 3.9, 0), osg::Vec3d(4, 4, 3)));  // a corner post hides .0004 of the light
    renderer.lookAt(osg::Vec3d(0, -3, 5), osg::Vec3d(), osg::Vec3d(0, 1, 0), 15.0);
    const Statistics s = ofGeometry(renderer.render(lit));
    EXPECT_GT(s.mean, 0.996);
    EXPECT_GT(s.least, 0.98);
}

TEST(Atlas, AClosedRoomIsBlackInside)
{
    SceneRenderer renderer(96, 96);
    osg::ref_ptr<LitScene> lit = atlasScene();
    // Walls of a tenth of the room: two texels of the maps.
    for (int axis = 0; axis < 3; ++axis)
        for (double side : {-1.0, 1.0}) {
            osg::Vec3d low(-1.2, -1.2, -1.2), high(1.2, 1.2, 1.2);
            low[axis] = side > 0.0 ? 1.0 : -1.2;
            high[axis] = side > 0.0 ? 1.2 : -1.0;
            lit->addChild(makeBox(low, high));
        }
    renderer.lookAt(osg::Vec3d(0.7, -0.8, 0.6), osg::Vec3d(-0.3, 0.4, -0.2), osg::Vec3d(0, 0, 1), 90.0);
    const Picture p = renderer.render(lit);
    double most = 0.0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) most = std::max(most, double(p.color(x, y)[0]));
    EXPECT_EQ(0.0, most);
}

TEST(Atlas, OccludersOutOfTheViewOcclude)
{
    SceneRenderer renderer(96, 96);
    osg::ref_ptr<LitScene> lit = atlasScene();
    lit->addChild(makeQuad(osg::Vec3d(-1, -1, 0), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0)));
    lit->addChild(makeQuad(osg::Vec3d(-4, -4, 3), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0)));
    renderer.lookAt(osg::Vec3d(0, -1, 1), osg::Vec3d(), osg::Vec3d(0, 0, 1), 20.0);
    const Picture p = renderer.render(lit);
    // A square of half side 4 at height 3, from below its middle: 4 corners of [systems.md 1.7].
    const double x = 4.0 / 3.0, d = std::sqrt(1.0 + x * x);
    const double hidden = 4.0 * (x / d * std::atan(x / d)) / osg::PI;
    EXPECT_NEAR(1.0 - ofGeometry(p).mean, hidden, 0.03);
}

TEST(Atlas, StandingStillDrawsNoMapAgain)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<LitScene> lit = atlasScene();
    lit->addChild(makeQuad(osg::Vec3d(-1, -1, 0), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0)));
    lit->addChild(makeBox(osg::Vec3d(-0.2, -0.2, 0), osg::Vec3d(0.2, 0.2, 0.5)));
    renderer.lookAt(osg::Vec3d(2, -3, 3), osg::Vec3d());
    const Picture first = renderer.render(lit);
    const Picture second = renderer.render(lit);
    EXPECT_EQ(0.0, largestDifference(first, second));
    // A moving camera neither: a surface keeps its light.
    renderer.lookAt(osg::Vec3d(-3, -2, 3), osg::Vec3d());
    renderer.render(lit);
    renderer.lookAt(osg::Vec3d(2, -3, 3), osg::Vec3d());
    EXPECT_EQ(0.0, largestDifference(first, renderer.render(lit)));
}
