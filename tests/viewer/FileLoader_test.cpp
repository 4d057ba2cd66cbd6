// SPDX-License-Identifier: MIT
// What is dropped on envlight-viewer: models, lit scenes, maps, and what is none of these.
#include <FileLoader.h>
#include <PictureName.h>
#include <Process.h>

#include <osg/ShapeDrawable>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <filesystem>

using osgEnvLight::LitScene;

namespace
{

class Files : public testing::Test
{
  protected:
    Files()
    {
        osgDB::writeNodeFile(*new osg::ShapeDrawable(new osg::Box), _model);
        _folder.write("scene.envlight", R"({"models": ["box.osgt"], "environment": {"map": "studio", "rotation": 90},
            "camera": {"eye": [3, 0, 0], "target": [0, 0, 0]}, "settings": {"exposure": 1}})");
        osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(16, 8, 1, GL_RGB, GL_UNSIGNED_BYTE);
        osgDB::writeImageFile(*image, _folder.file("map.png"));
        image->allocateImage(7, 8, 1, GL_RGB, GL_UNSIGNED_BYTE);
        osgDB::writeImageFile(*image, _folder.file("narrow.png"));
        _lit->addChild(new osg::Group);
        _lit->getEnvironmentMap()->setRotation(15);
    }

    Loaded load(const std::string& name) { return (_last = loadFile(_folder.file(name), *_lit)).kind; }

    const TemporaryFolder _folder;
    const std::string _model = _folder.file("box.osgt");
    const osg::ref_ptr<LitScene> _lit = new LitScene;
    LoadedFile _last;
};

}  // namespace

TEST_F(Files, AModelReplacesTheScene)
{
    const osg::ref_ptr<osg::Node> former = _lit->getChild(0);
    EXPECT_EQ(Loaded::MODEL, load("box.osgt"));
    ASSERT_EQ(1u, _lit->getNumChildren());
    EXPECT_NE(former.get(), _lit->getChild(0));
    EXPECT_EQ(15, _lit->getEnvironmentMap()->getRotation());
}

TEST_F(Files, ALitSceneBringsItsMapSettingsAndView)
{
    EXPECT_EQ(Loaded::SCENE, load("scene.envlight")) << _last.error;
    EXPECT_EQ("studio", _lit->getEnvironmentMap()->getMap());
    EXPECT_EQ(90, _lit->getEnvironmentMap()->getRotation());
    EXPECT_EQ(1, _lit->getSettings()->exposure);
    ASSERT_TRUE(_last.homeView);
    EXPECT_EQ(3, _last.homeView->eye.x());
}

TEST_F(Files, AnImageReplacesTheMapAndKeepsItsRotation)
{
    const osg::ref_ptr<osgEnvLight::EnvironmentMap> former = _lit->getEnvironmentMap();
    EXPECT_EQ(Loaded::MAP, load("map.png")) << _last.error;
    EXPECT_NE(former.get(), _lit->getEnvironmentMap());
    EXPECT_EQ(15, _lit->getEnvironmentMap()->getRotation());
    EXPECT_EQ(1u, _lit->getNumChildren());
}

TEST_F(Files, WhatIsNoneOfTheseIsNamedAndChangesNothing)
{
    _folder.write("letter.txt", "hello\n");
    _folder.write("broken.envlight", "{");
    _folder.write("empty.hdr", "");
    const osg::ref_ptr<osg::Node> former = _lit->getChild(0);
    const osg::ref_ptr<osgEnvLight::EnvironmentMap> map = _lit->getEnvironmentMap();
    const std::pair<const char*, const char*> cases[] = {{"letter.txt", "neither a model nor an environment map"},
                                                         {"broken.envlight", "JSON"},
                                                         {"empty.hdr", "empty"},
                                                         {"narrow.png", "7x8"},
                                                         {"missing.osgt", "no such file"},
                                                         {".", "not a file"}};
    for (const auto& [name, reason] : cases) {
        SCOPED_TRACE(name);
        EXPECT_EQ(Loaded::NOTHING, load(name));
        EXPECT_NE(std::string::npos, _last.error.find(_folder.file(name))) << _last.error;
        EXPECT_NE(std::string::npos, _last.error.find(reason)) << _last.error;
        EXPECT_EQ(former.get(), _lit->getChild(0));
        EXPECT_EQ(map.get(), _lit->getEnvironmentMap());
    }
}

TEST_F(Files, PicturesOverwriteNothing)
{
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(_folder.file("."));
    EXPECT_EQ("chess-1.png", unusedName("some/chess.osgt.envlight", "png"));
    _folder.write("chess-1.png", "");
    EXPECT_EQ("chess-2.png", unusedName("some/chess.osgt.envlight", "png"));
    EXPECT_EQ("chess-1.exr", unusedName("chess.envlight", "exr"));
    EXPECT_EQ("envlight-1.png", unusedName("", "png"));
    std::filesystem::current_path(before);
}
