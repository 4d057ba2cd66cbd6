// SPDX-License-Identifier: MIT
// envlight-tradeoff from the outside: what it writes, what it refuses, and what an interruption leaves.
#include <osgEnvLight/Settings>

#include <osg/Geode>
#include <osg/ShapeDrawable>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "Browser.h"
#include "Process.h"
#include "Sweeps.h"

using nlohmann::json;

namespace
{

const std::string program = std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-tradeoff";

// Small enough for a software renderer: a box on a plate.
std::string writeScene(const TemporaryFolder& folder)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(0, 0, 0.5f), 1.0f)));
    geode->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(0, 0, -0.05f), 6.0f, 6.0f, 0.1f)));
    const std::string name = folder.file("box.osgt");
    EXPECT_TRUE(osgDB::writeNodeFile(*geode, name));
    return name;
}

std::vector<std::string> command(const std::string& scene, const std::string& output, const std::vector<std::string>& more = {})
{
    std::vector<std::string> words = {program, scene, "--env", "studio", "--size", "48x36", "--quick", "--reference-error",
                                      ".05"};
    words.insert(words.end(), {"--eye", "4,-5,3", "--target", "0,0,0.4", "-o", output});
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

json readJson(const std::string& name)
{
    return json::parse(readFile(name), nullptr, false);
}

void expectRefused(const std::vector<std::string>& words, int status, const std::string& message)
{
    const Outcome o = runProgram(words);
    EXPECT_EQ(o.status, status) << o.err;
    EXPECT_NE(o.err.find(message), std::string::npos) << o.err;
    EXPECT_EQ(o.err.find("envlight-tradeoff: "), 0u) << o.err;
}

class TradeoffProgram : public testing::Test
{
  protected:
    void SetUp() override
    {
        if (!std::filesystem::exists(program)) GTEST_SKIP() << "not built";
    }
};

}  // namespace

TEST_F(TradeoffProgram, MeasuresAndReports)
{
    const TemporaryFolder folder;
    const std::string output = folder.file("re port");
    const Outcome o = runProgram(command(writeScene(folder), output,
                                         {"--only", "low,no occlusion,atlasLights", "--sweep", "atlasLights=64,256",
                                          "--target-error", ".5", "--target-ms", ".001"}));
    ASSERT_EQ(o.status, 0) << o.err;
    const json j = readJson(output + "/tradeoff.json");
    ASSERT_FALSE(j.is_discarded());
    std::vector<std::string> names;
    for (const json& p : j["points"]) {
        names.push_back(p["sweep"].get<std::string>() + " " + p["value"].get<std::string>());
        EXPECT_GT(p["milliseconds"]["median"].get<double>(), 0.0);
        EXPECT_GE(p["beauty"]["tRMSE"].get<double>(), 0.0);
        EXPECT_TRUE(p["terms"].contains("occlusion"));
        EXPECT_FALSE(p["passes"].empty());
    }
    EXPECT_EQ(names, (std::vector<std::string>{"preset default", "preset low", "preset no occlusion", "atlasLights 64",
                                               "atlasLights 256"}));
    // A box on a plate: without its shadow on the plate the picture is farther from the truth.
    EXPECT_GT(j["points"][2]["beauty"]["tRMSE"], j["points"][0]["beauty"]["tRMSE"]);
    // The default value was not timed twice.
    EXPECT_EQ(j["points"][4]["milliseconds"], j["points"][0]["milliseconds"]);
    EXPECT_NE(o.out.find("Cheapest within an error of 50\u00a0%"), std::string::npos) << o.out;
    EXPECT_NE(o.out.find("none was found"), std::string::npos) << o.out;
    EXPECT_NE(readFile(output + "/index.html").find("envlight-tradeoff"), std::string::npos);
    EXPECT_FALSE(readFile(output + "/tradeoff.csv").empty());
    if (browserCommand().empty()) GTEST_SKIP() << "no Chromium";
    const Findings found = probePages(folder.file(""), {"re port"}, {1200},
                                      "return {images: [...document.querySelectorAll('img')].map((i) => i.naturalWidth)};");
    EXPECT_TRUE(found.console.empty()) << found.console[0];
    const json& images = found.pages.at({"re port", 1200})["images"];
    EXPECT_EQ(images.size(), 2u + 4u * 3u);  // the slider's, and of beauty and three terms ours, reference, difference
    for (const json& width : images) EXPECT_EQ(width, 48);
}

TEST_F(TradeoffProgram, SaysWhatTheErrorIs)
{
    // A roof over the plate, out of the picture: the screen can't know of it, nor of its shadow where the sun has no map.
    const TemporaryFolder folder;
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(0, 0, -0.05f), 6.0f, 6.0f, 0.1f)));
    geode->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(0, 0, 3.0f), 6.0f, 6.0f, 0.1f)));
    const std::string scene = folder.file("roof.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*geode, scene));
    const Outcome o = runProgram({program,
                                  scene,
                                  "--env",
                                  "sky",
                                  "--size",
                                  "48x36",
                                  "--quick",
                                  "--only",
                                  "default",
                                  "--reference-error",
                                  ".03",
                                  "--set",
                                  "visibility=screen",
                                  "--set",
                                  "suns=off",
                                  "--eye",
                                  "0,-2.8,1.5",
                                  "--target",
                                  "0,0,0",
                                  "--fovy",
                                  "30",
                                  "-o",
                                  folder.file("report")});
    ASSERT_EQ(o.status, 0) << o.err;
    const json j = readJson(folder.file("report") + "/tradeoff.json");
    for (const char* term : {"beauty", "occlusion"}) {
        SCOPED_TRACE(term);
        const std::string sentence = j["terms"][term]["sentence"];
        EXPECT_NE(sentence.find("of the squared error is occlusion by objects outside the view"), std::string::npos) << sentence;
        // Nothing else is wrong there; the reference's own noise is a hundredth.
        EXPECT_GT(j["terms"][term]["shares"]["occlusion by objects outside the view"], 0.9);
    }
}

TEST_F(TradeoffProgram, RefusesWhatItDoesNotKnow)
{
    const TemporaryFolder folder;
    const std::string scene = writeScene(folder);
    const std::string output = folder.file("report");
    expectRefused(command(scene, output, {"--sweep", "occlusionLights"}), 2, "expected name=value,value,...");
    expectRefused(command(scene, output, {"--sweep", "occlusionLights=64,,128"}), 2, "a value is missing");
    expectRefused(command(scene, output, {"--sweep", "sparkle=1"}), 2, "no setting is named 'sparkle'");
    expectRefused(command(scene, output, {"--sweep", "occlusionSteps=0"}), 2, "'occlusionSteps' is '0', expected");
    expectRefused(command(scene, output, {"--only", "sparkle"}), 2, "'sparkle'");
    expectRefused(command(scene, output, {"--target-ms", "-1"}), 2, "--target-ms");
    EXPECT_FALSE(std::filesystem::exists(output));
    expectRefused(command(scene, "/proc/report"), 1, "/proc/report");
    expectRefused(command(folder.file("missing.obj"), output), 1, "missing.obj");
}

TEST_F(TradeoffProgram, NothingToMeasure)
{
    const TemporaryFolder folder;
    const std::string empty = folder.file("empty.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*osg::ref_ptr<osg::Group>(new osg::Group), empty));
    expectRefused(command(empty, folder.file("report")), 1, "no surface");
    std::vector<std::string> away = command(writeScene(folder), folder.file("report"));
    *(std::find(away.begin(), away.end(), "--target") + 1) = "8,-10,6";
    expectRefused(away, 1, "no surface is in the view");
}

TEST_F(TradeoffProgram, AFailureLeavesAnEarlierReport)
{
    const TemporaryFolder folder;
    const std::string scene = writeScene(folder), output = folder.file("report");
    std::filesystem::create_directory(output);
    std::ofstream(output + "/index.html") << "earlier";
    expectRefused(command(folder.file("missing.obj"), output), 1, "missing.obj");
    std::vector<std::string> away = command(scene, output);
    *(std::find(away.begin(), away.end(), "--target") + 1) = "8,-10,6";
    expectRefused(away, 1, "no surface is in the view");
    EXPECT_EQ(readFile(output + "/index.html"), "earlier");
    const std::filesystem::directory_iterator files(output);
    EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST_F(TradeoffProgram, CameraInsideAWall)
{
    const TemporaryFolder folder;
    std::vector<std::string> inside = command(writeScene(folder), folder.file("report"), {"--only", "default"});
    *(std::find(inside.begin(), inside.end(), "--eye") + 1) = "0,0,0.5";
    *(std::find(inside.begin(), inside.end(), "--target") + 1) = "1,0,0.5";
    const Outcome o = runProgram(inside);
    EXPECT_EQ(o.status, 0) << o.err;
    const json j = readJson(folder.file("report") + "/tradeoff.json");
    ASSERT_EQ(j["points"].size(), 1u);
    EXPECT_FALSE(j["points"][0]["failed"].get<bool>());
}

TEST_F(TradeoffProgram, AnInterruptionKeepsWhatThereIs)
{
    const TemporaryFolder folder;
    const std::string output = folder.file("report");
    // Shown when the first setting is measured and many are left.
    const Outcome o = interruptProgram(command(writeScene(folder), output), "preset low", SIGTERM);
    EXPECT_EQ(o.status, 1) << o.err;
    EXPECT_NE(o.err.find("interrupted"), std::string::npos) << o.err;
    const json j = readJson(output + "/tradeoff.json");
    ASSERT_FALSE(j.is_discarded());
    EXPECT_TRUE(j["interrupted"].get<bool>());
    EXPECT_NE(readFile(output + "/index.html").find("Interrupted after"), std::string::npos);
}

TEST(Sweeps, EveryDefaultIsASettingsValue)
{
    // Each candidate differs from the defaults in what it names, and its settings are valid together.
    tradeoff::Selection all;
    const osg::ref_ptr<osgEnvLight::Settings> base = new osgEnvLight::Settings;
    const osg::ref_ptr<osgEnvLight::Settings> settings = new osgEnvLight::Settings;
    int different = 0;
    for (const tradeoff::Candidate& c : tradeoff::candidates(all)) {
        SCOPED_TRACE(c.sweep + " " + c.value);
        tradeoff::Texts changed;
        apply(c, *base, *settings, changed);
        std::string error;
        EXPECT_TRUE(settings->valid(error)) << error;
        if (!changed.empty()) ++different;
        for (const auto& [name, value] : c.settings)
            EXPECT_EQ(value, osgEnvLight::Settings::find(name)->getString(*settings)) << name;
    }
    EXPECT_GT(different, 40);
    tradeoff::Selection quick;
    quick.quick = true;
    quick.specular = false;
    const std::vector<tradeoff::Candidate> few = tradeoff::candidates(quick);
    EXPECT_LT(few.size(), tradeoff::candidates(all).size() / 2);
    for (const tradeoff::Candidate& c : few) EXPECT_NE(c.sweep, "specularSamples");
}

// Or the light from surface to surface would be a preset's error.
TEST(Sweeps, PresetsAddNoBounceToDirectLight)
{
    tradeoff::Selection direct, full;
    full.full = true;
    const auto namesBounce = [](const tradeoff::Selection& selection) {
        for (const tradeoff::Candidate& c : tradeoff::candidates(selection))
            for (const auto& [name, value] : c.settings)
                if (name == "bounce" || name == "reflections") return true;
        return false;
    };
    EXPECT_FALSE(namesBounce(direct));
    EXPECT_TRUE(namesBounce(full));
}

TEST(Sweeps, AreMeasuredInTurnFromTheirEnds)
{
    std::vector<tradeoff::Candidate> all;
    for (const char* value : {"default", "fine"}) all.push_back({"preset", value, 0.0, {}});
    for (const char* value : {"1", "2", "4", "8", "16"}) all.push_back({"nearTaps", value, 0.0, {}});
    for (const char* value : {"3", "6"}) all.push_back({"nearRadius", value, 0.0, {}});
    std::string order;
    for (size_t i : tradeoff::measuringOrder(all)) order += all[i].value + " ";
    EXPECT_EQ(order, "default fine 1 3 16 6 4 2 8 ");
    EXPECT_TRUE(tradeoff::measuringOrder({}).empty());

    // None is left out, none is measured twice.
    const std::vector<tradeoff::Candidate> full = tradeoff::candidates(tradeoff::Selection());
    std::vector<size_t> sorted = tradeoff::measuringOrder(full);
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted.size(), full.size());
    for (size_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], i);
}
