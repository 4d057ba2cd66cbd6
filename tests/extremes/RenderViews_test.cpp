// SPDX-License-Identifier: MIT
// Many pictures by one envlight-render: from a list of cameras, of a turn, by jobs that share them and start again.
#include <Process.h>

#include <osgDB/ReadFile>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace RenderViews_test
{

namespace
{

// Unlike from every side.
const char* const wedge = R"(v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
v -1 -1 1
f 4 3 2 1
f 1 2 5
f 2 3 5
f 3 4 5
f 4 1 5
)";

class RenderViews : public testing::Test
{
  protected:
    Outcome run(const std::string& output, std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), {program, model});
        arguments.insert(arguments.end(), {"--size", "24x24", "--set", "regeneration=immediate", "-o", folder.file(output)});
        return runProgram(arguments);
    }

    std::string picture(const std::string& name) const { return readFile(folder.file(name)); }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder.file(name)); }

    const std::string program = std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-render";
    TemporaryFolder folder;
    const std::string model = folder.write("wedge.obj", wedge);
    const std::vector<std::string> view = {"--eye", "0,-5,2", "--target", "0,0,0.3", "--fovy", "30"};
};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

}  // namespace

TEST_F(RenderViews, OfATurnAreThoseOfCamerasAroundTheScene)
{
    ASSERT_EQ(0, run("turn.png", with(view, {"--turntable", "4"})).status);
    ASSERT_EQ(0, run("one.png", view).status);
    EXPECT_EQ(picture("one.png"), picture("turn-0001.png"));
    const std::string cameras = folder.write("cameras.json", R"([{"eye": [0, -5, 2], "target": [0, 0, 0.3], "fovy": 30},
        {"eye": [5, 0, 2], "target": [0, 0, 0.3], "fovy": 30}, {"eye": [0, 5, 2], "target": [0, 0, 0.3], "fovy": 30}])");
    ASSERT_EQ(0, run("camera.png", {"--cameras", cameras}).status);
    for (const char* number : {"-0001.png", "-0002.png", "-0003.png"}) {
        EXPECT_FALSE(picture("turn" + std::string(number)).empty());
        EXPECT_EQ(picture("turn" + std::string(number)), picture("camera" + std::string(number))) << number;
    }
    EXPECT_NE(picture("turn-0001.png"), picture("turn-0002.png"));
    EXPECT_TRUE(exists("turn-0004.png"));
    EXPECT_FALSE(exists("turn-0005.png"));
    EXPECT_FALSE(exists("turn.png"));
}

TEST_F(RenderViews, AreSharedByJobsThatStartAgain)
{
    ASSERT_EQ(0, run("turn.png", with(view, {"--turntable", "4", "--part", "2/2"})).status);
    EXPECT_FALSE(exists("turn-0001.png"));
    EXPECT_FALSE(exists("turn-0003.png"));
    const std::string second = picture("turn-0002.png");
    EXPECT_FALSE(second.empty());
    folder.write("turn-0004.png", "another's");
    ASSERT_EQ(0, run("turn.png", with(view, {"--turntable", "4", "--resume"})).status);
    EXPECT_FALSE(picture("turn-0001.png").empty());
    EXPECT_EQ("another's", picture("turn-0004.png"));
    ASSERT_EQ(0, run("turn.png", with(view, {"--turntable", "4"})).status);
    EXPECT_EQ(second, picture("turn-0002.png"));
    EXPECT_NE("another's", picture("turn-0004.png"));
    for (const auto& file : std::filesystem::directory_iterator(folder.file("")))
        EXPECT_EQ(std::string::npos, file.path().string().find(".part")) << file.path();
}

TEST_F(RenderViews, AreAsBrightAsTheMap)
{
    const auto radiance = [&](const std::string& name, const std::string& intensity) {
        EXPECT_EQ(0, run(name, with(view, {"--env-intensity", intensity})).status);
        return osgDB::readRefImageFile(folder.file(name));
    };
    const osg::ref_ptr<osg::Image> one = radiance("one.exr", "1"), three = radiance("three.exr", "3");
    ASSERT_TRUE(one && three);
    double least = 1e9, most = 0.0;
    for (unsigned y = 0; y < 24; ++y)
        for (unsigned x = 0; x < 24; ++x) {
            const double ratio = double(three->getColor(x, y).g()) / double(one->getColor(x, y).g());
            least = std::min(least, ratio);
            most = std::max(most, ratio);
        }
    EXPECT_NEAR(3.0, least, 0.03);  // files hold halves
    EXPECT_NEAR(3.0, most, 0.03);
}

TEST_F(RenderViews, WhatIsWrongIsNamed)
{
    struct Case {
        std::vector<std::string> arguments;
        int status;
        std::string words;
    };
    const std::string empty = folder.write("empty.json", "[]");
    const std::string bad = folder.write("bad.json", R"([{"eye": [0, -1, 0], "target": [0, 0, 0]}, {"eye": [0, 0, 1]}])");
    for (const Case& c : {Case{{"--turntable", "0"}, 2, "--turntable"},
                          Case{{"--turntable", "3", "--part", "3/2"}, 2, "--part is '3/2', expected K/N with K from 1 to N"},
                          Case{{"--turntable", "3", "--part", "1/2x"}, 2, "--part is '1/2x'"},
                          Case{{"--turntable", "3", "--cameras", bad}, 2, "exclude each other"},
                          Case{with(view, {"--cameras", bad}), 2, "--cameras excludes --camera and --eye"},
                          Case{{"--cameras", empty}, 1, "a list of cameras"},
                          Case{{"--cameras", bad}, 1, "key '[1]': expected an object with eye and target"},
                          Case{{"--cameras", "nowhere.json"}, 1, "nowhere.json: can't be read"}}) {
        const Outcome o = run("p.png", c.arguments);
        EXPECT_EQ(c.status, o.status) << o.err;
        EXPECT_NE(std::string::npos, o.err.find(c.words)) << "'" << c.words << "' in: " << o.err;
        EXPECT_FALSE(exists("p-0001.png"));
    }
}

TEST_F(RenderViews, InterruptedAStillViewKeepsWhatThereIs)
{
    const std::string out = folder.file("still.exr");
    const Outcome o =
        interruptProgram(with({program, model, "--size", "24x24", "--frames", "60000", "-o", out}, view), "[2-9] frames");
    EXPECT_EQ(1, o.status);
    EXPECT_NE(std::string::npos, o.err.find("interrupted; " + out + " holds what ")) << o.err;
    const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(out);
    ASSERT_TRUE(image.valid());
    EXPECT_EQ(24, image->s());
}

// What --resume finds is whole.
TEST_F(RenderViews, InterruptedATurnLeavesNoHalfPicture)
{
    const std::string out = folder.file("turn.exr");
    const Outcome o = interruptProgram(
        with({program, model, "--size", "24x24", "--frames", "60000", "--turntable", "3", "-o", out}, view), "[2-9] frames");
    EXPECT_EQ(1, o.status);
    EXPECT_NE(std::string::npos, o.err.find("interrupted before " + folder.file("turn-0001.exr"))) << o.err;
    EXPECT_FALSE(exists("turn-0001.exr"));
}

// A picture to lay over another: what covers the background, in its own colours, and a veil where its shadow falls.
TEST_F(RenderViews, WithoutABackgroundIsTransparent)
{
    const std::vector<std::string> command =
        with(with({program, model}, view), {"--set", "ground=shadows", "--set", "antialias=off", "--size", "64x64"});
    const auto render = [&](const std::string& name, const std::string& background) {
        const Outcome o = runProgram(with(command, {"--set", "background=" + background, "-o", folder.file(name)}));
        EXPECT_EQ(0, o.status) << o.err;
        return osgDB::readRefImageFile(folder.file(name));
    };
    const osg::ref_ptr<osg::Image> cut = render("cut.png", "off"), whole = render("whole.png", "on");
    ASSERT_TRUE(cut && whole);
    EXPECT_FALSE(whole->isImageTranslucent());
    int covered = 0, veiled = 0, clear = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const osg::Vec4 c = cut->getColor(unsigned(x), unsigned(y)), w = whole->getColor(unsigned(x), unsigned(y));
            if (c.a() == 0.0f) ++clear;
            if (c.a() > 0.3f && c.a() < 1.0f) {
                ++veiled;
                EXPECT_LT(c.r() + c.g() + c.b(), 0.03f) << x << ", " << y;
            }
            if (c.a() < 1.0f) continue;
            ++covered;
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(c[k], w[k], 1.5 / 255.0) << x << ", " << y;
        }
    EXPECT_GT(covered, 150);
    EXPECT_GT(veiled, 20);
    EXPECT_GT(clear, 1000);
}

}  // namespace RenderViews_test
