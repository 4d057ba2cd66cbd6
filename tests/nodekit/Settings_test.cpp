// SPDX-License-Identifier: MIT
// Settings changed between the frames of one viewer.
#include <SceneRenderer.h>

#include <gtest/gtest.h>

namespace Settings_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

// A target that is freed and made again may get its predecessor's address, which OSG's State takes for the same texture.
TEST(SettingsOfAViewer, TermsSwitchedOffAndOnAgain)
{
    SceneRenderer renderer(64, 48);
    renderer.lookAt(osg::Vec3d(2, -4, 2), osg::Vec3d());
    const osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->addChild(makeBox(osg::Vec3d(-0.5, -0.5, 0.0), osg::Vec3d(0.5, 0.5, 1.0)));
    lit->addChild(makeQuad(osg::Vec3d(-3, -3, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 6, 0)));
    Settings& settings = *lit->getSettings();
    settings.regeneration = Settings::IMMEDIATE;
    const int lights = settings.occlusionLights;
    const Picture first = renderer.render(lit.get(), 2);
    for (int i = 0; i < 40; ++i) {
        // Other sizes in between, so that the freed addresses come back in many orders.
        settings.occlusion = false;
        settings.view = i % 2 ? Settings::OCCLUSION : Settings::BEAUTY;
        renderer.render(lit.get());
        settings.occlusion = true;
        settings.diffuse = i % 3 != 0;
        settings.occlusionLights = i % 2 ? 128 : 256;
        renderer.render(lit.get(), 1 + i % 3);
        settings.diffuse = true;
        settings.view = Settings::BEAUTY;
        settings.occlusionLights = lights;
        ASSERT_EQ(0.0, largestDifference(first, renderer.render(lit.get(), 2))) << "round " << i;
    }
}

}  // namespace Settings_test
