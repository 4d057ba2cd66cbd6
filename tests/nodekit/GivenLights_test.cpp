// SPDX-License-Identifier: MIT
// Lights that the application gives in place of a sampler's.
#include <gtest/gtest.h>

#include <osgEnvLight/LightFile>
#include <osgEnvLight/Material>
#include <osgEnvLight/SceneDescription>

#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <filesystem>
#include <fstream>
#include <set>

#include "SceneRenderer.h"

namespace GivenLights_test
{

using osgEnvLight::LightList;
using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

class Folder
{
  public:
    Folder() : _path(std::filesystem::temp_directory_path() / ("envlight_given_" + std::to_string(getpid())))
    {
        std::filesystem::create_directories(_path);
    }
    ~Folder() { std::filesystem::remove_all(_path); }
    std::string write(const std::string& name, const std::string& text) const
    {
        std::ofstream(_path / name) << text;
        return (_path / name).string();
    }
    std::string file(const std::string& name) const { return (_path / name).string(); }

  private:
    std::filesystem::path _path;
};

// A white floor seen from above.
osg::ref_ptr<LitScene> floorUnder(osg::Image* map)
{
    osg::ref_ptr<LitScene> lit = makeLit(map);
    lit->addChild(makeQuad(osg::Vec3d(-1, -1, 0), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0)));
    osgEnvLight::Material::setLambert(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    lit->getSettings()->occlusion = false;
    return lit;
}

}  // namespace

TEST(GivenLights, LightDInPlaceOfTheMaps)
{
    SceneRenderer renderer(32, 32);
    renderer.lookAt(osg::Vec3d(0, 0, 3), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    osg::ref_ptr<LitScene> lit = floorUnder(constantMap(1.0).get());
    EXPECT_NEAR(renderer.render(lit, 2).color(16, 16)[0], 1.0, 0.005);
    auto lights = std::make_shared<LightList>();
    lights->push_back({osg::Vec3d(0, 0.6, 0.8), osg::Vec3d(3, 2, 1)});
    lights->push_back({osg::Vec3d(0, 0, -1), osg::Vec3d(100, 100, 100)});  // from below
    lit->getEnvironmentMap()->setLights(lights);
    const osg::Vec3d given = renderer.render(lit, 1).color(16, 16);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(given[k], 0.8 * (3 - k) / osg::PI, 2e-3) << k;
    EXPECT_EQ(lit->plan().diffuseLights, 2u);
    EXPECT_NE(lit->plan().explain().find("the application's own"), std::string::npos);
    lit->getSettings()->occlusion = true;
    renderer.render(lit, 1);
    EXPECT_EQ(lit->plan().occlusionLights, 16u);
    lit->getSettings()->occlusion = false;
    lit->getEnvironmentMap()->setLights(std::make_shared<LightList>());
    EXPECT_EQ(renderer.render(lit, 1).color(16, 16)[0], 0.0);
    lit->getEnvironmentMap()->setLights(nullptr);
    EXPECT_NEAR(renderer.render(lit, 1).color(16, 16)[0], 1.0, 0.005);
}

TEST(GivenLights, AnotherListOfEqualLengthIsShown)
{
    SceneRenderer renderer(32, 32);
    renderer.lookAt(osg::Vec3d(0, 0, 3), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    osg::ref_ptr<LitScene> lit = floorUnder(constantMap(1.0).get());
    for (const bool occlusion : {false, true}) {
        lit->getSettings()->occlusion = occlusion;  // whose list is in another texture
        for (const osg::Vec3d& flux : {osg::Vec3d(3, 0, 0), osg::Vec3d(0, 3, 0), osg::Vec3d(0, 0, 3)}) {
            auto lights = std::make_shared<LightList>();
            lights->push_back({osg::Vec3d(0, 0, 1), flux});
            lit->getEnvironmentMap()->setLights(lights);
            const osg::Vec3d color = renderer.render(lit, 1).color(16, 16);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(color[k], flux[k] / osg::PI, 2e-3) << k;
        }
    }
}

// Lists of one length that differ by what samples them: each has an error of D of its own.
TEST(GivenLights, AnotherSamplerIsShown)
{
    SceneRenderer renderer(32, 32);
    renderer.lookAt(osg::Vec3d(0, 0, 3), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    osg::ref_ptr<LitScene> lit = floorUnder(makeMap(64, 32, sixDirectionColor));
    std::string error;
    for (const auto& [name, value] : {std::pair("diffuseCarrier", "lights"), {"diffuseLights", "16"}, {"lightWeights", "off"}})
        ASSERT_TRUE(lit->getSettings()->set(name, value, error)) << error;
    std::set<double> shown;
    for (const char* sampler : {"median-cut", "inverse-cdf", "structured"}) {
        ASSERT_TRUE(lit->getSettings()->set("lightSampler", sampler, error)) << error;
        shown.insert(renderer.render(lit, 1).color(16, 16)[0]);
    }
    EXPECT_EQ(shown.size(), 3u);
}

TEST(GivenLights, FromASceneDescriptionAndASavedFile)
{
    const Folder folder;
    folder.write("rig.json", R"({"lights": [{"direction": [0, 0, 2], "flux": [3, 3, 3]}],
                                 "suns": [{"direction": [0, 0, 1], "flux": [1, 1, 1], "radiusDeg": 0.5}]})");
    osgDB::writeNodeFile(*makeQuad(osg::Vec3d(-1, -1, 0), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0)), folder.file("floor.osgt"));
    const std::string scene = folder.write("scene.envlight", R"({"model": "floor.osgt", "environment": {"lights": "rig.json"}})");
    osgEnvLight::SceneDescription description;
    std::string error;
    ASSERT_TRUE(description.readFile(scene, nullptr, error)) << error;
    osg::ref_ptr<LitScene> lit = description.build(nullptr, error);
    ASSERT_TRUE(lit) << error;
    ASSERT_TRUE(lit->getEnvironmentMap()->getLights());
    EXPECT_EQ(lit->getEnvironmentMap()->getLights()->size(), 2u);
    ASSERT_TRUE(osgDB::writeNodeFile(*lit, folder.file("saved.osgt")));
    const osg::ref_ptr<osg::Node> again = osgDB::readRefNodeFile(folder.file("saved.osgt"));
    const auto* read = dynamic_cast<LitScene*>(again.get());
    ASSERT_TRUE(read);
    ASSERT_TRUE(read->getEnvironmentMap()->getLights());
    EXPECT_EQ(read->getEnvironmentMap()->getLights()->size(), 2u);
}

TEST(GivenLights, AFaultNamesTheFileAndTheKey)
{
    const Folder folder;
    const std::string rig = folder.write("rig.json", R"({"lights": [{"direction": [0, 0, 0], "flux": [3, 3, 3]}]})");
    osg::ref_ptr<osgEnvLight::EnvironmentMap> map = new osgEnvLight::EnvironmentMap;
    std::string error;
    EXPECT_FALSE(map->loadLights(rig, nullptr, error));
    EXPECT_NE(error.find("rig.json"), std::string::npos) << error;
    EXPECT_NE(error.find("lights[0].direction"), std::string::npos) << error;
    EXPECT_FALSE(map->getLights());
    EXPECT_FALSE(map->loadLights(folder.file("none.json"), nullptr, error));
    EXPECT_NE(error.find("no such file"), std::string::npos) << error;
}

}  // namespace GivenLights_test
