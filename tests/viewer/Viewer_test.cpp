// SPDX-License-Identifier: MIT
// envlight-viewer as its users have it: a window, keys, the pointer, files dropped.
#include "ViewerWindow.h"

#include <KeyTable.h>

#include <osgEnvLight/Settings>

#include <osg/CameraView>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>

using osgEnvLight::Settings;

namespace
{

const std::string program = std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-viewer";

class Viewer : public testing::Test
{
  protected:
    void SetUp() override
    {
        if (!ViewerWindow::isPossible()) GTEST_SKIP() << "no Xvfb or no xdotool";
        ASSERT_TRUE(osgDB::writeNodeFile(*new osg::ShapeDrawable(new osg::Box), box()));
    }

    std::string box() const { return _folder.file("box.osgt"); }

    // The least that is lit.
    std::unique_ptr<ViewerWindow> open(std::vector<std::string> arguments)
    {
        for (const char* setting : {"atlasLights=16", "atlasSize=32", "bounce=off", "sunShadowSize=64", "accumulateSize=32"})
            arguments.insert(arguments.end(), {"--set", setting});
        auto viewer = std::make_unique<ViewerWindow>(arguments);
        if (!viewer->opens()) ADD_FAILURE() << "no window: " << viewer->log();
        return viewer;
    }

    const TemporaryFolder _folder;
};

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

// The value of an option in a command; "" without.
std::string option(const std::string& command, const std::string& name)
{
    std::smatch match;
    return std::regex_search(command, match, std::regex("--" + name + "[= ](\\S+)")) ? match[1].str() : "";
}

double rotation(ViewerWindow& viewer)
{
    return std::atof(option(viewer.command(), "env-rotation").c_str());
}

// Pixels of a part of the screens that differ visibly.
int differing(const Screen& a, const Screen& b, int fromX, int toX)
{
    int count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = fromX; x < toX; ++x) {
            const size_t at = 3 * size_t(y * a.width + x);
            int largest = 0;
            for (size_t k = at; k < at + 3; ++k) largest = std::max(largest, std::abs(int(a.rgb[k]) - int(b.rgb[k])));
            count += largest > 16;
        }
    return count;
}

// What xdotool calls a key of the list.
std::string keyName(const KeyBinding& row)
{
    if (row.control) return std::string("ctrl+") + char(row.key);
    switch (row.key) {
        case '+':
            return "plus";
        case '-':
            return "minus";
        case '[':
            return "bracketleft";
        case ']':
            return "bracketright";
        default:
            return row.label;
    }
}

std::string keyOf(Action action, double value = 0.0)
{
    for (const KeyBinding& row : keyTable())
        if (row.action == action && row.value == value) return keyName(row);
    return "";
}

// What a copied command renders with more options, to that file.
std::string render(const std::string& command, const std::string& options, const std::string& file)
{
    const std::string shortened = command.substr(0, command.rfind(" -o "));
    const Outcome o =
        runProgram({"bash", "-c", std::string(ENVLIGHT_BINARY_DIR) + "/bin/" + shortened + options + " -o " + file});
    EXPECT_EQ(0, o.status) << o.err;
    return file;
}

// Of two pictures' colours, over the second one's sum; 1e9 if they can't be compared.
double relativeDifference(const std::string& fileA, const std::string& fileB)
{
    const osg::ref_ptr<osg::Image> a = osgDB::readRefImageFile(fileA), b = osgDB::readRefImageFile(fileB);
    if (!a || !b || a->s() != b->s() || a->t() != b->t()) return 1e9;
    double sum = 0.0, scale = 0.0;
    for (int y = 0; y < a->t(); ++y)
        for (int x = 0; x < a->s(); ++x) {
            const osg::Vec4 ca = a->getColor(unsigned(x), unsigned(y)), cb = b->getColor(unsigned(x), unsigned(y));
            for (unsigned k = 0; k < 3; ++k) {
                sum += std::abs(double(ca[k] - cb[k]));
                scale += double(cb[k]);
            }
        }
    return sum / scale;
}

}  // namespace

TEST_F(Viewer, ShowsAModelItsKeysAndItsPanel)
{
    const auto viewer = open({box()});
    EXPECT_EQ("box.osgt - envlight-viewer", viewer->title());
    ViewerWindow::waitUntil([] { return false; }, 6);  // the first message goes, the light settles
    viewer->key("h");
    const Screen list = viewer->stillScreen();
    viewer->key("h");
    const Screen bare = viewer->stillScreen();
    viewer->key("Tab");
    const Screen panel = viewer->stillScreen();
    EXPECT_GT(differing(bare, list, 0, 160), 5000);
    EXPECT_GT(differing(bare, panel, 200, 320), 5000);
    EXPECT_LT(differing(bare, panel, 0, 160), 500) << "it covers less than half";
    EXPECT_EQ("", viewer->log());
}

TEST_F(Viewer, EveryViewAndPresetHasItsKey)
{
    const auto viewer = open({box()});
    const Settings::Property& view = *Settings::find("view");
    for (const KeyBinding& row : keyTable()) {
        if (row.action != Action::VIEW || row.value == 0.0) continue;
        viewer->key(keyName(row));
        EXPECT_TRUE(contains(viewer->command(), std::string(" --set view=") + view.choices[size_t(row.value)])) << row.purpose;
    }
    viewer->key(keyOf(Action::NEXT_VIEW));
    EXPECT_TRUE(contains(viewer->command(), std::string(" --set view=") + view.choices[10]));
    viewer->key(keyOf(Action::VIEW, 0));
    EXPECT_FALSE(contains(viewer->command(), " --set view="));
    for (const KeyBinding& row : keyTable()) {
        if (row.action != Action::PRESET) continue;
        const Settings::Preset& preset = Settings::presets()[size_t(row.value)];
        viewer->key(keyName(row));
        const std::string command = viewer->command();
        for (const auto& [name, value] : preset.values)
            EXPECT_TRUE(contains(command, std::string(" --set ") + name + "=" + value)) << preset.name << ": " << command;
    }
}

TEST_F(Viewer, SettingsAreChangedUndoneAndRedone)
{
    const auto viewer = open({box()});
    const auto shows = [&](const std::string& setting) { return contains(viewer->command(), " --set " + setting); };
    viewer->key(keyOf(Action::EXPOSURE, 0.5));
    EXPECT_TRUE(shows("exposure=0.5"));
    viewer->key(keyOf(Action::BACKGROUND));
    EXPECT_TRUE(shows("background=off"));
    viewer->key(keyOf(Action::CONVERGE));
    EXPECT_TRUE(shows("accumulate=on"));
    viewer->key(keyOf(Action::GROUND));
    EXPECT_TRUE(shows("ground=shadows"));
    viewer->key("ctrl+z");
    EXPECT_FALSE(shows("ground=shadows"));
    viewer->key("ctrl+z");
    EXPECT_FALSE(shows("accumulate=on"));
    viewer->key("ctrl+z");
    EXPECT_FALSE(shows("background=off"));
    EXPECT_TRUE(shows("exposure=0.5"));
    viewer->key("ctrl+y");
    EXPECT_TRUE(shows("background=off"));
    viewer->key(keyOf(Action::EXPOSURE, -0.5));
    EXPECT_FALSE(shows("exposure="));
    viewer->key("ctrl+y");
    EXPECT_FALSE(shows("accumulate=on")) << "nothing to redo after a change";
    viewer->act({"key", "a", "b", "ctrl+z"});  // of which one frame may know
    EXPECT_TRUE(shows("accumulate=on"));
    EXPECT_TRUE(shows("background=off"));
}

TEST_F(Viewer, APulledPointerOrbitsAndWithShiftTurnsTheMap)
{
    const auto viewer = open({box()});
    const std::string start = viewer->command();
    EXPECT_EQ("0", option(start, "env-rotation"));
    viewer->drag("shift", 80, 120, 240, 130);
    const std::string turned = viewer->command();
    EXPECT_EQ("-90", option(turned, "env-rotation")) << "half of the window's width";
    EXPECT_EQ(option(start, "eye"), option(turned, "eye"));
    viewer->key("ctrl+z");
    EXPECT_EQ("0", option(viewer->command(), "env-rotation")) << "one step";
    viewer->drag("", 80, 120, 240, 130);
    const std::string orbited = viewer->command();
    EXPECT_EQ("0", option(orbited, "env-rotation"));
    EXPECT_NE(option(start, "eye"), option(orbited, "eye"));
    viewer->key("space");
    EXPECT_EQ(option(start, "eye"), option(viewer->command(), "eye"));
    viewer->act({"click", "4"});
    EXPECT_NE(option(start, "eye"), option(viewer->command(), "eye")) << "the wheel";
    viewer->key(keyOf(Action::TURN_MAP, 15));
    EXPECT_EQ("15", option(viewer->command(), "env-rotation"));
}

TEST_F(Viewer, StepsThroughTheCamerasOfTheModel)
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(new osg::ShapeDrawable(new osg::Box));
    for (const double height : {5.0, 8.0}) {
        osg::ref_ptr<osg::CameraView> camera = new osg::CameraView;
        camera->setPosition(osg::Vec3d(0, 0, height));
        camera->setFieldOfView(5.0 * height);
        root->addChild(camera);
    }
    const std::string file = _folder.file("cameras.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*root, file));
    const auto viewer = open({file});
    const auto expectCamera = [&](double height, const char* when) {
        const std::string command = viewer->command();
        double x = 1.0, y = 1.0, z = 1.0;
        ASSERT_EQ(3, std::sscanf(option(command, "eye").c_str(), "%lf,%lf,%lf", &x, &y, &z)) << command;
        EXPECT_NEAR(0.0, std::hypot(x, y), 1e-4) << when;
        EXPECT_NEAR(height, z, 1e-4) << when;
        EXPECT_NEAR(5.0 * height, std::atof(option(command, "fovy").c_str()), 1e-3) << when;
    };
    expectCamera(5.0, "the first one is home");
    viewer->key(keyOf(Action::NEXT_CAMERA));
    viewer->key(keyOf(Action::NEXT_CAMERA));
    expectCamera(8.0, "the second one");
    viewer->key("space");
    expectCamera(5.0, "home again");
    viewer->key(keyOf(Action::NEXT_CAMERA));
    expectCamera(5.0, "around to the first one");
}

TEST_F(Viewer, ASliderOfThePanelIsOneStepToUndo)
{
    const auto viewer = open({box()});
    viewer->key("Tab");
    double turned = 0.0;
    for (int y = 10; turned == 0.0 && y < 120; y += 12) {  // until it is found
        viewer->drag("", 200, y, 240, y);
        viewer->act({"mousemove", "60", "120"});
        viewer->stillScreen();  // the panel takes its events one a frame, and the key that asks comes at once
        turned = rotation(*viewer);
    }
    EXPECT_NE(0.0, turned);
    viewer->key("ctrl+z");
    EXPECT_EQ(0.0, rotation(*viewer));
}

TEST_F(Viewer, PicturesAreThoseOfTheCommandThatItCopies)
{
    const auto viewer = open({box(), "studio"});
    viewer->key(keyOf(Action::EXPOSURE, 0.5));
    viewer->key("F2");
    viewer->key("F3");
    ASSERT_TRUE(viewer->waitForFile("box-1.png"));
    ASSERT_TRUE(viewer->waitForFile("box-1.exr"));
    const std::string command = viewer->command();
    EXPECT_TRUE(contains(command, " --env studio ")) << command;
    for (const std::string extension : {"png", "exr"}) {
        const std::string rendered = render(command, "", _folder.file("rendered." + extension));
        EXPECT_LT(relativeDifference(viewer->file("box-1." + extension), rendered), 0.01) << extension;
    }
    viewer->key("F2");
    EXPECT_TRUE(viewer->waitForFile("box-2.png"));
}

// The picture of radiance is as good as what is shown.
TEST_F(Viewer, RadianceOfAConvergedViewIsConverged)
{
    const auto viewer = open({box(), "--set", "accumulate=on", "--set", "accumulateFrames=24"});
    ViewerWindow::waitUntil([] { return false; }, 6);
    viewer->key("F3");
    ASSERT_TRUE(viewer->waitForFile("box-1.exr"));
    const std::string command = viewer->command();
    const std::string converged = render(command, " --frames 24", _folder.file("converged.exr"));
    const std::string first = render(command, " --frames 1", _folder.file("first.exr"));
    EXPECT_LT(relativeDifference(viewer->file("box-1.exr"), converged), 0.3 * relativeDifference(first, converged));
}

TEST_F(Viewer, FilesAreDropped)
{
    const auto viewer = open({box()});
    const std::string other = _folder.file("other one.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*new osg::ShapeDrawable(new osg::Sphere), other));
    _folder.write("letter.txt", "hello\n");
    _folder.write("scene.envlight", R"({"models": ["box.osgt"], "environment": {"map": "studio"},
        "camera": {"eye": [7, 0, 0], "target": [0, 0, 0], "fovy": 10}})");
    const std::string before = viewer->command();
    const Screen bare = viewer->stillScreen();
    EXPECT_TRUE(viewer->drop(_folder.file("letter.txt")));
    EXPECT_TRUE(ViewerWindow::waitUntil([&] { return differing(bare, viewer->screen(), 0, 320) > 500; })) << "it says so";
    EXPECT_EQ(before, viewer->command());
    EXPECT_EQ("box.osgt - envlight-viewer", viewer->title());
    EXPECT_TRUE(viewer->drop(other));
    EXPECT_TRUE(ViewerWindow::waitUntil([&] { return viewer->title() == "other one.osgt - envlight-viewer"; }));
    EXPECT_TRUE(contains(viewer->command(), "'" + other + "'"));
    EXPECT_TRUE(viewer->drop(_folder.file("scene.envlight")));
    EXPECT_TRUE(ViewerWindow::waitUntil([&] { return viewer->title() == "scene.envlight - envlight-viewer"; }));
    EXPECT_EQ("7,0,0", option(viewer->command(), "eye"));
    EXPECT_NEAR(10.0, std::atof(option(viewer->command(), "fovy").c_str()), 1e-3);
    EXPECT_TRUE(viewer->drop(other));
    EXPECT_TRUE(ViewerWindow::waitUntil([&] { return viewer->title() == "other one.osgt - envlight-viewer"; }));
    EXPECT_EQ(option(before, "fovy"), option(viewer->command(), "fovy")) << "a model without a camera is seen as at the start";
    EXPECT_TRUE(viewer->running());
}

TEST_F(Viewer, AnEmptyWindowTakesAModel)
{
    const auto viewer = open({});
    EXPECT_EQ("envlight-viewer", viewer->title());
    viewer->drag("", 80, 120, 240, 130);
    EXPECT_EQ("", viewer->log());
    EXPECT_TRUE(viewer->drop(box()));
    EXPECT_TRUE(ViewerWindow::waitUntil([&] { return viewer->title() == "box.osgt - envlight-viewer"; }));
    EXPECT_TRUE(contains(viewer->command(), box()));
}

TEST_F(Viewer, AnySizeIsShownAndNoneIsNoFault)
{
    const auto viewer = open({box()});
    const auto resize = [&](const std::string& width, const std::string& height) {
        viewer->act({"search", "--name", "envlight-viewer", "windowsize", width, height});
    };
    resize("1", "1");
    EXPECT_TRUE(ViewerWindow::waitUntil([&] { return contains(viewer->command(), "--size 1x1"); }, 10));
    viewer->act({"search", "--name", "envlight-viewer", "windowunmap"});
    viewer->act({"search", "--name", "envlight-viewer", "windowmap"});
    viewer->act({"search", "--name", "envlight-viewer", "windowfocus"});
    resize("200", "100");
    EXPECT_TRUE(ViewerWindow::waitUntil([&] { return contains(viewer->command(), "--size 200x100"); }, 10));
    viewer->key("F2");
    ASSERT_TRUE(viewer->waitForFile("box-1.png"));
    const std::string rendered = render(viewer->command(), "", _folder.file("rendered.png"));
    EXPECT_LT(relativeDifference(viewer->file("box-1.png"), rendered), 0.01);
}

TEST_F(Viewer, EndsByItsKey)
{
    const auto viewer = open({box()});
    viewer->key("Escape");
    EXPECT_TRUE(ViewerWindow::waitUntil([&] { return !viewer->running(); }));
}

TEST_F(Viewer, BadArgumentsGetOneMessageAndNoWindow)
{
    const auto run = [&](const std::vector<std::string>& arguments) {
        std::vector<std::string> command = {"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", program};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const Outcome o = runProgram(command);
        EXPECT_EQ(1, std::count(o.err.begin(), o.err.end(), '\n')) << o.err;
        return std::to_string(o.status) + " " + o.err;
    };
    EXPECT_TRUE(contains(run({"missing.osgt"}), "1 envlight-viewer: missing.osgt"));
    EXPECT_TRUE(contains(run({box(), "missing.exr"}), "missing.exr"));
    EXPECT_TRUE(contains(run({box(), "--set", "exposure"}), "2 envlight-viewer: --set is 'exposure'"));
    EXPECT_TRUE(contains(run({"--size", "0x0"}), "2 envlight-viewer: --size is '0x0'"));
    EXPECT_TRUE(contains(run({box()}), "1 envlight-viewer: a display can't be had"));
}
