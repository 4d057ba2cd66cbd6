// SPDX-License-Identifier: MIT
// Light from surface to surface by the mean of what blocks the map (bounce=mean). How near it comes to full light transport is
// the image suite's to say.
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <gtest/gtest.h>

namespace Bounce_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

// Floor and wall, albedo 1, under a white sky.
osg::ref_ptr<LitScene> corner()
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->getSettings()->bounce = Settings::BOUNCE_MEAN;
    lit->addChild(makeQuad(osg::Vec3d(-2, -4, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-2, 0, -0.1), osg::Vec3d(2, 0.2, 4)));
    for (unsigned i = 0; i < 2; ++i)
        osgEnvLight::Material::setLambert(*lit->getChild(i)->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    return lit;
}

void lookIntoCorner(SceneRenderer& renderer)
{
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
}

double meanOf(const Picture& p)
{
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            if (!(p.alpha(x, y) > 0.5f)) continue;
            sum += double(p.color(x, y)[1]);
            ++count;
        }
    return sum / std::max(count, 1);
}

}  // namespace

// In a white furnace all that is blocked comes back from where it is blocked: with albedo 1 and every surface lit the same, full
// transport is 1 everywhere. Floor and wall are finite, and send away from each other what the picture takes for sent to each
// other, so that the series may end above it.
TEST(Bounce, BringsWhiteSurfacesNearerTheFurnace)
{
    SceneRenderer renderer(96, 96);
    osg::ref_ptr<LitScene> lit = corner();
    lookIntoCorner(renderer);
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    const double without = meanOf(renderer.render(lit));
    lit->getSettings()->bounce = Settings::BOUNCE_MEAN;
    const double with = meanOf(renderer.render(lit));
    EXPECT_LT(without, 0.9);
    EXPECT_NEAR(1.0, with, 0.25 * (1.0 - without));
}

TEST(Bounce, IsNothingWhereNothingIsBlocked)
{
    SceneRenderer renderer(96, 96);
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->view = Settings::BOUNCED;
    lit->addChild(makeBox(osg::Vec3d(-1, -1, -1), osg::Vec3d(1, 1, 1)));
    renderer.lookAt(osg::Vec3d(4, -5, 4), osg::Vec3d());
    const Picture p = renderer.render(lit);
    double most = 0.0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) most = std::max(most, double(p.color(x, y)[0]));
    EXPECT_LT(most, 0.01);  // texels at the edges, on a white box
}

TEST(Bounce, StillFramesAreTheSameToTheBit)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<LitScene> lit = corner();
    lookIntoCorner(renderer);
    const Picture first = renderer.render(lit);
    EXPECT_EQ(0.0, largestDifference(first, renderer.render(lit)));
}

TEST(Bounce, TheSmallestPicturesHaveIt)
{
    for (int size : {1, 2, 3, 31, 33}) {
        SceneRenderer renderer(size, size);
        osg::Camera& camera = *renderer.viewer().getCamera();
        camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
        osg::ref_ptr<LitScene> lit = corner();
        lookIntoCorner(renderer);
        const Picture p = renderer.render(lit);
        const double middle = p.color(size / 2, size / 2)[1];
        EXPECT_GT(middle, 0.5) << size;
        EXPECT_LT(middle, 1.5) << size;
    }
}

TEST(Bounce, ThePlanSaysWhyNot)
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = corner();
    lookIntoCorner(renderer);
    renderer.render(lit);
    EXPECT_TRUE(lit->plan().runs("bounce"));
    lit->getSettings()->visibility = Settings::VISIBILITY_SCREEN;
    const size_t with = lit->textureBytes();
    renderer.render(lit);
    EXPECT_FALSE(lit->plan().runs("bounce"));
    EXPECT_EQ("without the atlas nobody knows how much of the map a surface sees", lit->plan().reason("bounce"));
    EXPECT_LT(lit->textureBytes(), with);
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    renderer.render(lit);
    EXPECT_EQ("switched off", lit->plan().reason("bounce"));
}

}  // namespace Bounce_test
