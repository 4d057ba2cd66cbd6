// SPDX-License-Identifier: MIT
// What is seen of area lights themselves.
#include <SceneRenderer.h>

#include <osgEnvLight/AreaLight>

#include <osg/MatrixTransform>

#include <gtest/gtest.h>

namespace LampSurface_test
{

using osgEnvLight::AreaLight;
using osgEnvLight::Settings;

namespace
{

// A lamp at height 1, looked at from below and from above.
class LampSurface : public testing::Test
{
  protected:
    LampSurface()
    {
        transform->addChild(lamp);
        lit->addChild(transform);
    }

    osg::Vec3d seen(double height)
    {
        renderer.lookAt(osg::Vec3d(0, 0, height), osg::Vec3d(0, 0, 1), osg::Vec3d(0, 1, 0), 20.0);
        return renderer.render(lit, 2).color(16, 16);
    }

    void expectSeen(const osg::Vec3d& below, const osg::Vec3d& above, const std::string& what)
    {
        const osg::Vec3d fromBelow = seen(0.0), fromAbove = seen(2.0);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(below[k], fromBelow[k], 2e-3) << what;
            EXPECT_NEAR(above[k], fromAbove[k], 2e-3) << what;
        }
    }

    SceneRenderer renderer{32, 32};
    const osg::ref_ptr<osgEnvLight::LitScene> lit = makeLit(constantMap(4.0).get());
    const osg::ref_ptr<AreaLight> lamp = new AreaLight;
    const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform;
    const osg::Vec3d radiance{0.5, 1.0, 0.25}, black;
};

}  // namespace

TEST_F(LampSurface, IsItsRadianceOnTheLitSide)
{
    lamp->setRadiance(osg::Vec3f(radiance));
    lamp->setDisc(osg::Vec3d(0, 0, 1), osg::Vec3d(0, 0, 1), 0.5);
    expectSeen(black, radiance, "facing up");
    transform->setMatrix(osg::Matrixd::scale(1, 1, -1) * osg::Matrixd::translate(0, 0, 2));
    expectSeen(radiance, black, "in a mirror");
    lamp->setTwoSided(true);
    expectSeen(radiance, radiance, "both sides");
    lamp->setVisible(false);
    expectSeen(osg::Vec3d(4, 4, 4), osg::Vec3d(4, 4, 4), "invisible");
}

TEST_F(LampSurface, IsItsFluxOverItsAreaInTheWorld)
{
    lamp->setSphere(osg::Vec3d(), 0.1);
    lamp->setFlux(osg::Vec3f(radiance * (4.0 * osg::PI * osg::PI * 0.04)));
    transform->setMatrix(osg::Matrixd::scale(2, 2, 2) * osg::Matrixd::translate(0, 0, 1));
    expectSeen(radiance, radiance, "sphere");
}

// What the host types as a colour is shown as it is, whatever the map's exposure: not so a radiance.
TEST_F(LampSurface, IsAsBrightAsAMapOfItsRadiance)
{
    lit->getSettings()->output = Settings::DISPLAY;
    lamp->setSphere(osg::Vec3d(0, 0, 1), 0.2);
    lamp->setRadiance(osg::Vec3f(4, 4, 4));
    for (const auto colors : {Settings::COLORS_SRGB, Settings::COLORS_LINEAR}) {
        lit->getSettings()->materialColors = colors;
        lamp->setVisible(true);
        const osg::Vec3d color = seen(0.0);
        lamp->setVisible(false);
        const osg::Vec3d map = seen(0.0);
        EXPECT_GT(map[0], 0.1);
        EXPECT_LT(map[0], 0.95);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(map[k], color[k], 2e-3) << colors;
    }
}

}  // namespace LampSurface_test
