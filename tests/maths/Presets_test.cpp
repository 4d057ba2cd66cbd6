// SPDX-License-Identifier: MIT
// Values of Settings that go together.
#include <osgEnvLight/SceneDescription>
#include <osgEnvLight/Settings>

#include <gtest/gtest.h>

#include <sstream>

namespace Presets_test
{

using osgEnvLight::Settings;

TEST(Presets, EachSetsWhatItNamesAndLeavesTheRest)
{
    const osg::ref_ptr<Settings> usual = new Settings;
    for (const Settings::Preset& preset : Settings::presets()) {
        SCOPED_TRACE(preset.name);
        osg::ref_ptr<Settings> s = new Settings;
        s->exposure = 1.5f;
        std::string error;
        ASSERT_TRUE(s->setPreset(preset.name, error)) << error;
        EXPECT_TRUE(s->valid(error)) << error;
        EXPECT_EQ(s->exposure, 1.5f);
        for (const auto& [name, value] : preset.values) {
            ASSERT_NE(Settings::find(name), nullptr) << name;
            EXPECT_EQ(Settings::find(name)->getString(*s), value) << name;
            EXPECT_NE(Settings::find(name)->getString(*usual), value) << name << " is that by default";
        }
        // From any other back to the defaults.
        ASSERT_TRUE(s->set("preset", "default", error)) << error;
        s->exposure = usual->exposure;
        for (const Settings::Property& p : Settings::table()) EXPECT_EQ(p.get(*s), p.get(*usual)) << p.name;
    }
}

TEST(Presets, AnUnknownOneChangesNothingAndNamesTheOthers)
{
    osg::ref_ptr<Settings> s = new Settings;
    s->atlasLights = 48;
    std::string error;
    EXPECT_FALSE(s->set("preset", "ultra", error));
    EXPECT_EQ(error, "preset is 'ultra', expected low | default | high | interior");
    EXPECT_EQ(s->atlasLights, 48);
}

// Whatever the order of the keys.
TEST(Presets, OtherSettingsOfASceneAreOnTopOfItsPreset)
{
    std::istringstream file(R"({"model": "a.osgt", "settings": {"atlasLights": 96, "preset": "low"}})");
    osgEnvLight::SceneDescription scene;
    std::string error;
    ASSERT_TRUE(scene.read(file, "a.envlight", error)) << error;
    osg::ref_ptr<Settings> s = new Settings;
    for (const auto& [name, value] : scene.settings) ASSERT_TRUE(s->set(name, value, error)) << error;
    EXPECT_EQ(s->atlasLights, 96);
    EXPECT_EQ(s->specularMethod, Settings::SPECULAR_PREFILTERED);
}

}  // namespace Presets_test
