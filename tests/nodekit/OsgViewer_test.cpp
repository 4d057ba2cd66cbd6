// SPDX-License-Identifier: MIT
// The stock osgviewer, as Debian ships it, in a window: real models under real maps, by the plugin path alone. Its picture
// is the one that envlight-render draws.
#include <VirtualDisplay.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace OsgViewer_test
{

namespace
{

const std::string models = "/usr/share/assimp/models/";
const std::string maps = "/usr/share/blender/datafiles/studiolights/world/";
const int width = 320;
const int height = 240;

struct Case {
    const char* model;
    const char* map;  // of blender-data; "" = the built-in sky
};

const Case cases[] = {
    {"OBJ/spider.obj", "courtyard.exr"},
    {"OBJ/spider.obj", "studio.exr"},
    {"OBJ/spider.obj", "sunset.exr"},
    {"OBJ/WusonOBJ.obj", "sunset.exr"},
    {"OBJ/cube_with_vertexcolors.obj", ""},
    {"OBJ/regr01.obj", "courtyard.exr"},
    {"PLY/Wuson.ply", "studio.exr"},
    {"PLY/float-color.ply", "sunset.exr"},
    {"STL/Spider_binary.stl", "courtyard.exr"},
    {"3DS/fels.3ds", "sunset.exr"},
    {"3DS/cube_with_specular_texture.3DS", "courtyard.exr"},
    {"AC/SphereWithLight.ac", "studio.exr"},
    {"LWO/LWO2/sphere_with_mat_gloss_10pc.lwo", "courtyard.exr"},
    {"X/test_cube_text.x", "sunset.exr"},
};

class OsgViewer : public testing::Test
{
  protected:
    OsgViewer() : _display(800, 600) {}

    void SetUp() override
    {
        if (!_display.running()) GTEST_SKIP() << "no Xvfb";
        if (std::system("command -v osgviewer >/dev/null")) GTEST_SKIP() << "no osgviewer";
        if (!std::filesystem::exists(models)) GTEST_SKIP() << "no assimp-testmodels";
        if (!std::filesystem::exists(maps)) GTEST_SKIP() << "no blender-data";
    }

    // The window's picture, and what the program said.
    Screen show(const std::string& file, std::string& log, std::vector<std::string> options = {},
                std::vector<std::string> environment = {})
    {
        const TemporaryFolder folder;
        std::vector<std::string> command = {"osgviewer", "--window", "0", "0", std::to_string(width), std::to_string(height),
                                            file};
        command.insert(command.end(), options.begin(), options.end());
        Screen screen;
        {
            environment.push_back("DISPLAY=" + _display.name());
            BackgroundProgram viewer(command, folder.file("log"), environment);
            screen = _display.waitForPicture(width, height, 120);
        }
        log = readFile(folder.file("log"));
        return screen;
    }

    VirtualDisplay _display;
};

// The picture that envlight-render draws, rows from the top.
Screen render(const std::string& model, const std::string& map)
{
    const TemporaryFolder folder;
    std::vector<std::string> command = {
        std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-render", model, "-o", folder.file("p.png"), "--size",
        std::to_string(width) + "x" + std::to_string(height)};
    if (!map.empty()) command.insert(command.end(), {"--env", map});
    const Outcome o = runProgram(command);
    EXPECT_EQ(0, o.status) << o.err;
    const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(folder.file("p.png"));
    Screen s{width, height, {}};
    for (int y = 0; image && y < height; ++y) {
        const unsigned char* row = image->data(0, unsigned(height - 1 - y));
        s.rgb.insert(s.rgb.end(), row, row + 3 * width);
    }
    return s;
}

double meanDifference(const Screen& a, const Screen& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(int(a.rgb[i]) - int(b.rgb[i]));
    return sum / double(a.rgb.size());
}

}  // namespace

TEST_F(OsgViewer, ShowsRealModelsUnderRealMapsAsEnvlightRenderDoes)
{
    for (const Case& c : cases) {
        SCOPED_TRACE(std::string(c.model) + " under " + c.map);
        const std::string model = models + c.model;
        const std::string map = *c.map ? maps + c.map : "";
        std::string log;
        const Screen window = show(map.empty() ? model + ".envlight" : model + ".(" + map + ").envlight", log);
        ASSERT_FALSE(window.rgb.empty()) << "no picture; osgviewer said: " << log;
        const Screen expected = render(model, map);
        ASSERT_EQ(window.rgb.size(), expected.rgb.size());
        EXPECT_LE(meanDifference(window, expected), 2.0);  // of 255, as asked; both round to 8 bits after the same dither
        EXPECT_EQ(std::string::npos, log.find("osgEnvLight")) << log;
        EXPECT_EQ(std::string::npos, log.find("OpenGL error")) << log;
        // A dark corner of the map is dark in both; a pixel that failed is black in the window alone.
        for (size_t i = 0; i < window.rgb.size(); i += 3) {
            const int sum = window.rgb[i] + window.rgb[i + 1] + window.rgb[i + 2];
            if (expected.rgb[i] + expected.rgb[i + 1] + expected.rgb[i + 2] < 12) continue;
            ASSERT_GT(sum, 0) << "a black pixel: " << (i / 3) % width << ", " << (i / 3) / width;
        }
    }
}

// Its optimizer has images given away as soon as they are uploaded, which it does before the first cull.
TEST_F(OsgViewer, ABlendedCardOutsideTheTransparentBinStaysTransparent)
{
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    const auto add = [&](double y, const osg::Vec4& color) {
        osg::ref_ptr<osg::Geometry> quad =
            osg::createTexturedQuadGeometry(osg::Vec3(-1, float(y), -1), osg::Vec3(2, 0, 0), osg::Vec3(0, 0, 2));
        osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
        colors->push_back(color);
        quad->setColorArray(colors, osg::Array::BIND_OVERALL);
        osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->addDrawable(quad);
        scene->addChild(geode);
        return geode;
    };
    add(0.5, osg::Vec4(0.8f, 0.1f, 0.1f, 1));
    const osg::ref_ptr<osg::Geode> card = add(0.0, osg::Vec4(1, 1, 1, 1));
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(64, 64, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned y = 0; y < 64; ++y)
        for (unsigned x = 0; x < 64; ++x) {
            const bool inside = std::hypot(x - 31.5, y - 31.5) < 16.0;
            *reinterpret_cast<osg::Vec4ub*>(image->data(x, y)) = osg::Vec4ub(20, 200, 40, inside ? 255 : 0);
        }
    image->setFileName("card.rgba");
    card->getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D(image));
    card->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    const TemporaryFolder folder;
    const std::string model = folder.file("card.osgb");
    ASSERT_TRUE(osgDB::writeNodeFile(*scene, model, new osgDB::Options("WriteImageHint=IncludeData")));
    std::string log;
    const Screen window = show(model + ".envlight", log);
    ASSERT_FALSE(window.rgb.empty()) << log;
    const auto at = [&](int x, int y) { return &window.rgb[3 * size_t(y * width + x)]; };
    EXPECT_GT(at(width / 2, height / 2)[1], 2 * at(width / 2, height / 2)[0]) << "the disc";
    EXPECT_GT(at(width / 2, height / 2 - 55)[0], 2 * at(width / 2, height / 2 - 55)[1]) << "the wall through the card";
}

// As on a driver of 2009: the scene is what it is without the node, and one line says why.
TEST_F(OsgViewer, AnOldOpenGLShowsTheSceneUnlit)
{
    const std::string model = models + "OBJ/spider.obj";
    const std::vector<std::string> old = {"MESA_GL_VERSION_OVERRIDE=3.0", "MESA_GLSL_VERSION_OVERRIDE=130"};
    std::string log;
    const Screen plain = show(model, log, {}, old);
    const Screen lit = show(model + ".envlight", log, {}, old);
    ASSERT_FALSE(plain.rgb.empty());
    ASSERT_FALSE(lit.rgb.empty()) << log;
    EXPECT_LT(meanDifference(plain, lit), 0.001) << "3 pixels differ: the viewer's optimizer sees another graph";
    const std::string line = "osgEnvLight: the context has OpenGL 3.0 with GLSL 1.30, expected at least OpenGL 3.3";
    const size_t at = log.find(line);
    ASSERT_NE(std::string::npos, at) << log;
    EXPECT_EQ(std::string::npos, log.find("osgEnvLight:", at + 1)) << log;
}

// Who looks for a fault in an application turns the notify level up, and wants to find it among the lines.
TEST_F(OsgViewer, AtNotifyLevelInfoTheNodeAddsFewLinesAndNoShaderText)
{
    const auto print = [&](const std::string& file) {
        const Outcome o = runProgram({"osgviewer", "--SingleThreaded", "--window", "0", "0", "160", "120", file},
                                     {"DISPLAY=" + _display.name(), "OSG_NOTIFY_LEVEL=INFO", "OSG_RUN_FRAME_COUNT=12"});
        EXPECT_EQ(0, o.status) << o.err;
        return o.out + o.err;
    };
    const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
    // OSG's own line for each texture object: the passes' targets, maps and tables.
    const auto textures = [](const std::string& text) {
        std::ptrdiff_t count = 0;
        for (size_t at = 0; (at = text.find(" TextureObject, _numOfTextureObjects", at)) != std::string::npos; ++at) ++count;
        return count;
    };
    const std::string model = models + "OBJ/spider.obj";
    const std::string plain = print(model);
    const std::string lit = print(model + ".envlight");
    EXPECT_LT(textures(lit) - textures(plain), 50 + 12) << "50 in 12 frames: none is made again in each";
    EXPECT_LT(lines(lit) - textures(lit) - (lines(plain) - textures(plain)), 25) << "13, all of them OSG's";
    for (const char* word : {"#version", "void main", "Linking osg::Program", "Uniform \""})
        EXPECT_EQ(std::string::npos, lit.find(word)) << word;
}

TEST_F(OsgViewer, ShowsAPictureInOtherThreadingModelsAndInStereo)
{
    for (const std::vector<std::string>& options : {std::vector<std::string>{"--SingleThreaded"},
                                                    {"--CullThreadPerCameraDrawThreadPerContext"},
                                                    {"--stereo", "HORIZONTAL_SPLIT"}}) {
        std::string log;
        const Screen window = show(models + "OBJ/spider.obj.envlight", log, options);
        EXPECT_FALSE(window.rgb.empty()) << options[0] << ": " << log;
        EXPECT_EQ(std::string::npos, log.find("osgEnvLight")) << log;
        EXPECT_EQ(std::string::npos, log.find("OpenGL error")) << log;
    }
}

}  // namespace OsgViewer_test
