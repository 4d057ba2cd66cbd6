// SPDX-License-Identifier: MIT
// Area lights that show an image, as screens do.
#include <Halves.h>

#include "AreaLightScene.h"

namespace AreaPictures_test
{

using osgEnvLight::AreaLight;
using osgEnvLight::Material;
using osgEnvLight::Settings;

class AreaPictures : public AreaLightScene
{
};

// A lamp over a box on a floor, moved and scaled, seen from the same place relative to it.
// A screen whose halves are red and blue is as good as two lamps, with and without the shadow of a pole.
TEST_F(AreaPictures, AreAsTheirParts)
{
    const auto add = [&](double x, double width, const osg::Vec3f& radiance) {
        const osg::ref_ptr<AreaLight> light = new AreaLight;
        light->setRectangle(osg::Vec3d(x, 0, height), osg::Vec3d(width, 0, 0), osg::Vec3d(0, -0.5, 0));
        light->setRadiance(radiance);
        light->setVisible(false);
        lit->addChild(light);
        return light;
    };
    lit->addChild(makeBox(osg::Vec3d(0.3, -0.1, 0), osg::Vec3d(0.5, 0.1, 0.8)));
    // As many points for the one as for both together.
    lit->getSettings()->areaPoints = 256;
    for (const bool shadows : {true, false}) {
        lit->getSettings()->occlusion = shadows;
        const osg::ref_ptr<AreaLight> left = add(-0.5, 0.5, osg::Vec3f(3, 0, 0)), right = add(0.5, 0.5, osg::Vec3f(0, 0, 3));
        const Picture expected = renderer.render(lit, 2);
        lit->removeChild(left);
        lit->removeChild(right);
        const osg::ref_ptr<AreaLight> whole = add(0.0, 1.0, osg::Vec3f(3, 3, 3));
        EXPECT_GT(rootMeanSquare(renderer.render(lit, 2), expected), 0.1);  // white
        whole->setImage(makeHalves());
        const Picture picture = renderer.render(lit, 2);
        EXPECT_TRUE(picture.finite());
        // Without shadows the colours are by 16 samples of each surface's half space.
        EXPECT_LT(rootMeanSquare(picture, expected), (shadows ? 0.012 : 0.04)) << shadows;
        lit->removeChild(whole);
    }
}

TEST_F(AreaPictures, FollowTheirImage)
{
    const osg::ref_ptr<osg::Image> image = makeHalves();
    const osg::ref_ptr<AreaLight> light = makeRectangle();
    light->setVisible(true);
    light->setImage(image);
    lit->addChild(light);
    const Picture before = renderer.render(lit, 4);
    EXPECT_EQ(before.rgba, renderer.render(lit, 1).rgba);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(0));
    image->dirty();
    EXPECT_EQ(osg::Vec3d(), middle(1));  // a black video frame
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(255));
    image->dirty();
    const osg::Vec3d white = middle(1);
    light->setImage(nullptr);
    const osg::Vec3d even = middle(1);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(even[k], white[k], exact * even[k]) << k;
    EXPECT_GT(even[2], 0.1);
}

// A mirror on the floor shows the picture with the left to the left, and its upper edge far away.
TEST_F(AreaPictures, AreReflected)
{
    const osg::ref_ptr<osg::Geode> mirror = makeQuad(osg::Vec3d(-4, -4, 0.01), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0));
    Material::setCookTorrance(*mirror->getOrCreateStateSet(), osg::Vec3f(1, 1, 1), 1.0f, 0.05f);
    lit->addChild(mirror);
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setRectangle(osg::Vec3d(0, 2, 2), osg::Vec3d(1.5, 0, 0), osg::Vec3d(0, 0, 1));
    light->setImage(makeHalves());
    light->setRadiance(osg::Vec3f(3, 3, 3));
    lit->addChild(light);
    lit->getSettings()->reflections = Settings::REFLECTIONS_MAP;
    const Picture p = renderer.render(lit, 2);
    // Where the eye at (0, -6, 6) sees the middles of the halves: the mirror image is at z = -2.
    for (const double x : {-0.75, 0.75}) {
        const osg::Vec3d eye(0, -6, 6), image(x, 2, -2), there = eye + (image - eye) * (6.0 / 8.0);
        const osg::Vec3d c = at(p, there);
        EXPECT_NEAR(3.0, c[x < 0.0 ? 0 : 2], 0.15) << x;
        EXPECT_LT(c[x < 0.0 ? 2 : 0], 0.05) << x;
        EXPECT_LT(c[1], 0.05) << x;
        // And the light itself.
        EXPECT_NEAR(3.0, at(p, osg::Vec3d(x, 2, 1.1))[x < 0.0 ? 0 : 2], 0.02) << x;
    }
}

}  // namespace AreaPictures_test
