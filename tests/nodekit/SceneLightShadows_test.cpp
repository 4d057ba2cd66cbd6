// SPDX-License-Identifier: MIT
// Shadows of lights of osg::LightSource nodes, against closed forms.
#include "LampScene.h"

#include <osg/MatrixTransform>

#include <cmath>
#include <limits>

namespace SceneLightShadows_test
{

using namespace lampscene;

class SceneLightShadows : public LampScene
{
};

// A ball between light and screen: the shadow is where the ray to the light meets it. Its edge is three texels of the light's map
// wide, .02 on the screen, and the ball's facets are .0005 deep.
TEST_F(SceneLightShadows, ABlockedLightIsDark)
{
    const osg::Vec3d ball(0.5, -1.0, -0.1), axis(-0.6, 0.8, 0.0), lamp(1.6, -2.4, 0.2), sun(0.8, -0.9, 0.2);
    const double radius = 0.4, cutoffs[] = {180.0, 40.0, 80.0, 180.0};
    lit->addChild(makeSphere(ball, radius, 64));
    for (int kind = 0; kind < 4; ++kind) {  // point, spot, wide spot, directional
        const bool directional = kind == 3;
        const osg::ref_ptr<osg::LightSource> light =
            makeLight(1, directional ? osg::Vec4(osg::Vec3(sun), 0) : osg::Vec4(osg::Vec3(lamp), 1));
        light->getLight()->setDirection(osg::Vec3(axis));
        light->getLight()->setSpotCutoff(float(cutoffs[kind]));
        root->insertChild(kind % 2 ? 1 : 0, light);  // after the node in the graph, and before
        const Picture p = render();
        int dark = 0, bright = 0;
        for (int x = 1; x < size; ++x)
            for (int y = 1; y < size; ++y) {
                const osg::Vec3d on = pointAt(x, y);
                osg::Vec3d ofEye = osg::Vec3d(0, -4, 0) - on, to = directional ? sun : lamp - on;
                ofEye.normalize();
                to.normalize();
                const double passes = ((ball - on) ^ to).length();
                const bool isHidden = ((ball - on) ^ ofEye).length() < 1.2 * radius;
                const bool isOutside = -(to * axis) < std::cos(osg::DegreesToRadians(cutoffs[kind] - 0.5));
                if (isHidden || isOutside || std::abs(passes - radius) < 0.03) continue;
                ++(passes < radius ? dark : bright);
                EXPECT_NEAR(p.color(x, y)[0], passes < radius ? 0.0 : -to[1], exact) << kind << " " << x << " " << y;
            }
        EXPECT_GT(dark, 100) << kind;
        EXPECT_GT(bright, 1000) << kind;
        EXPECT_TRUE(lit->plan().runs("scenelightmaps"));
        lit->getSettings()->sceneLightShadows = false;
        EXPECT_FALSE(render().rgba == p.rgba);
        EXPECT_EQ("off, sceneLightShadows is off", reasonOf(*lit, "scenelightmaps"));
        lit->getSettings()->sceneLightShadows = true;
        root->removeChild(light);
    }
}

TEST_F(SceneLightShadows, ThoseThatAreNowhereAreLeftOut)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::infinity();
    for (const osg::Vec4& position : {osg::Vec4(nan, 0, 0, 1), osg::Vec4(0, -huge, 0, 1), osg::Vec4(0, nan, 0, 0),
                                      osg::Vec4(0, 0, 0, 0), osg::Vec4(0, -2, 0, nan)}) {
        const osg::ref_ptr<osg::LightSource> light = makeLight(1, position);
        root->insertChild(0, light);
        const Picture p = render();
        EXPECT_TRUE(p.finite()) << position[0] << " " << position[1];
        EXPECT_EQ(0.0, p.color(32, 32)[0]) << position[0] << " " << position[1];
        root->removeChild(light);
    }
}

TEST_F(SceneLightShadows, AShadowFollowsTheLightAndTheCaster)
{
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    const osg::ref_ptr<osg::MatrixTransform> ball = new osg::MatrixTransform, lamp = new osg::MatrixTransform;
    ball->addChild(makeSphere(osg::Vec3d(0.5, -1.0, -0.1), 0.3, 32));
    lamp->addChild(makeLight(1, osg::Vec4(1.6f, -2.4f, 0.2f, 1)));
    lit->addChild(ball);
    lit->addChild(lamp);
    const osg::Matrix elsewhere = osg::Matrix::translate(-0.4, 0.2, 0.3);
    const Picture first = render();
    ball->setMatrix(elsewhere);
    const Picture ballMoved = render();
    lamp->setMatrix(elsewhere);
    const Picture bothMoved = render();
    lit->getSettings()->sceneLightMapSize = 256;  // all maps anew
    render();
    lit->getSettings()->sceneLightMapSize = 512;
    EXPECT_LE(largestDifference(bothMoved, render()), exact);  // their origin is another
    ball->setMatrix(osg::Matrix());
    lamp->setMatrix(osg::Matrix());
    EXPECT_EQ(first.rgba, render().rgba);
    EXPECT_FALSE(first.rgba == ballMoved.rgba);
    EXPECT_FALSE(ballMoved.rgba == bothMoved.rgba);
}

TEST_F(SceneLightShadows, AddedAndRemovedLeaveMemoryAsItWas)
{
    lit->addChild(makeSphere(osg::Vec3d(0.5, -1.0, -0.1), 0.3, 32));
    render();
    const size_t before = lit->textureBytes();
    for (int i = 0; i < 20; ++i) {
        const osg::ref_ptr<osg::LightSource> light = makeLight(1 + i % 7, osg::Vec4(1.6f, -2.4f, 0.2f, float(i % 3 > 0)));
        if (i % 3 == 1) light->getLight()->setSpotCutoff(30.0f);
        lit->addChild(light);
        render();
        EXPECT_GT(lit->textureBytes(), before);
        lit->removeChild(light);
        render();
        EXPECT_EQ(before, lit->textureBytes()) << i;
    }
}

}  // namespace SceneLightShadows_test
