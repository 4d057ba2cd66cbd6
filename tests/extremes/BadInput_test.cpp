// SPDX-License-Identifier: MIT
// Bad input: one message that names the file and the key or pixel, the right exit status, no crash, no picture.
#include <Process.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace
{

const std::string render = std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-render";

const char* const cube = R"(v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
f 1 2 3 4
)";

std::string hdr(int width, int height, const std::string& pixels)
{
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n" + pixels;
}

// Messages of ours: OSG's own plugins may warn beside them.
size_t messages(const std::string& text)
{
    size_t n = 0;
    for (size_t at = text.find("envlight-render: "); at != std::string::npos; at = text.find("envlight-render: ", at + 1)) ++n;
    return n;
}

}  // namespace

class BadInput : public testing::Test
{
  protected:
    BadInput() : model(folder.write("model.obj", cube)), picture(folder.file("out.png")) {}

    Outcome run(std::vector<std::string> arguments, const std::vector<std::string>& environment = {})
    {
        arguments.insert(arguments.begin(), render);
        arguments.insert(arguments.end(), {"-o", picture, "--size", "16x16"});
        return runProgram(arguments, environment);
    }

    // Fails with that status and one message that holds all the words; writes nothing.
    void expectError(const Outcome& o, int status, const std::vector<std::string>& words)
    {
        EXPECT_EQ(status, o.status) << o.err;
        EXPECT_EQ(1u, messages(o.err)) << o.err;
        for (const std::string& w : words) EXPECT_NE(std::string::npos, o.err.find(w)) << "'" << w << "' in: " << o.err;
        EXPECT_FALSE(std::filesystem::exists(picture));
    }

    TemporaryFolder folder;
    std::string model;
    std::string picture;
};

TEST_F(BadInput, Maps)
{
    const std::string texel(4, '\x80');
    std::filesystem::create_directory(folder.file("folder.hdr"));
    std::filesystem::create_directory(folder.file("folder.exr"));
    struct Case {
        std::string file;
        std::string content;  // "" = leave as it is
        std::vector<std::string> words;
    };
    const Case cases[] = {
        {"missing.hdr", "", {"missing.hdr"}},
        {"missing.exr", "", {"missing.exr"}},
        {"folder.hdr", "", {"folder.hdr", "not a file"}},
        {"folder.exr", "", {"folder.exr"}},
        {"garbage.hdr", "this is no picture at all", {"garbage.hdr"}},
        {"garbage.exr", "this is no picture at all", {"garbage.exr"}},
        {"truncated.hdr", hdr(4, 2, texel), {"truncated.hdr"}},
        {"nothing.hdr", hdr(0, 0, ""), {"nothing.hdr", "0"}},
        {"shape.hdr", hdr(3, 2, texel + texel + texel + texel + texel + texel), {"shape.hdr", "3x2", "twice as wide"}},
        {"square.hdr", hdr(2, 2, texel + texel + texel + texel), {"square.hdr", "2x2", "angular", "octahedral"}},
        {"unknown.xyz", "?", {"unknown.xyz"}},
    };
    for (const Case& c : cases) {
        if (!c.content.empty()) folder.write(c.file, c.content);
        SCOPED_TRACE(c.file);
        expectError(run({model, "--env", folder.file(c.file)}), 1, c.words);
    }
    for (const char* empty : {"empty.hdr", "empty.exr", "empty.png"}) {
        folder.write(empty, "");
        expectError(run({model, "--env", folder.file(empty)}), 1, {empty, "is empty (0 bytes)"});
    }
}

TEST_F(BadInput, SceneDescriptions)
{
    const std::string start = "{\"model\": \"model.obj\"";
    struct Case {
        std::string content;
        std::vector<std::string> words;
    };
    const Case cases[] = {
        {"", {"scene.envlight", "JSON"}},
        {"{\"model\": ", {"scene.envlight", "line 1"}},
        {"[1]", {"scene.envlight", "object"}},
        {std::string(200000, '['), {"scene.envlight", "64 levels"}},
        {"{\"model\": 1e999999}", {"scene.envlight", "JSON", "1e999999"}},
        {"{}", {"model"}},
        {"{\"model\": 3}", {"'model'", "string", "3"}},
        {"{\"model\": \"nowhere.obj\"}", {"nowhere.obj", "no such file"}},
        {start + ", \"modle\": 1}", {"'modle'", "models"}},
        {start + ", \"camera\": {\"eye\": [1, 2], \"target\": [0, 0, 0]}}", {"'camera.eye'", "three numbers"}},
        {start + ", \"camera\": {\"eye\": [1, 2, 3], \"target\": [1, 2, 3]}}", {"'camera'", "apart"}},
        {start + ", \"lights\": {}}", {"'lights'", "a list of lights"}},
        {start + ", \"lights\": [{\"shape\": \"cube\"}]}", {"'lights[0]'", "polygon", "cube"}},
        {start + ", \"lights\": [{\"shape\": \"disc\", \"center\": [0, 0, 0], \"normal\": [0, 0, 1], \"radiance\": [1, 1, 1]}]}",
         {"'lights[0].radius'", "greater than 0", "nothing"}},
        {start + ", \"lights\": [{\"shape\": \"rectangle\", \"center\": [0, 0, 0], \"u\": [1, 0, 0], \"v\": [0, 1, 0], "
                 "\"radiance\": [1, 1, 1], \"image\": \"nowhere.png\"}]}",
         {"'lights'", "nowhere.png", "no such file"}},
        {start + ", \"lights\": [{\"shape\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1, \"radiance\": [1, 1, 1], "
                 "\"image\": \"nowhere.png\"}]}",
         {"unknown key 'lights[0].image'", "radius"}},
        {start + ", \"lights\": [{\"shape\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1}]}",
         {"'lights[0]'", "either radiance or flux"}},
        {start + ", \"lights\": [{\"shape\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1, \"radiance\": [1, 1, -1]}]}",
         {"'lights[0].radiance'", "0..1e12", "-1"}},
        {start + ", \"lights\": [{\"shape\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1, \"flux\": [1, 1, 1], \"u\": 1}]}",
         {"unknown key 'lights[0].u'", "radius"}},
        {start + ", \"lights\": [{\"shape\": \"rectangle\", \"center\": [0, 0, 0], \"u\": [1, 0, 0], \"v\": [2, 0, 0], "
                 "\"radiance\": [1, 1, 1]}]}",
         {"'lights[0]'", "has no area"}},
        {start + ", \"lights\": [{\"shape\": \"polygon\", \"vertices\": [[0, 0, 0], [2, 2, 0], [2, 0, 0], [0, 1, 0]], "
                 "\"radiance\": [1, 1, 1]}]}",
         {"'lights[0]'", "edges that cross"}},
        {start + ", \"lights\": [{\"shape\": \"polygon\", \"vertices\": [[0, 0, 0], [1, 1, 0]], \"radiance\": [1, 1, 1]}]}",
         {"'lights[0].vertices'", "3 to 32 points"}},
        {start + ", \"environment\": {\"map\": \"nowhere.exr\"}}", {"environment.map", "nowhere.exr"}},
        {start + ", \"environment\": {\"layout\": \"cylinder\"}}",
         {"'environment.layout'", "latlong", "mirror-ball", "cylinder"}},
        {start + ", \"environment\": {\"layout\": 3}}", {"'environment.layout'", "string"}},
        {start + ", \"environment\": {\"map\": \"two.hdr\", \"layout\": \"strip\"}}",
         {"environment.map", "two.hdr", "2x1", "6NxN"}},
        {start + ", \"environment\": {\"intensity\": -1}}", {"'environment.intensity'", "-1"}},
        {start + ", \"settings\": {\"specularSamples\": 0}}", {"specularSamples", "1..1024"}},
        {start + ", \"settings\": {\"specularSample\": 4}}", {"specularSample", "specularSamples"}},
        {start + ", \"settings\": {\"combine\": \"multiply\"}}", {"combine", "ratio | subtract"}},
        {start + ", \"materials\": {\"gold\": {\"brdf\": \"shiny\"}}}", {"'materials.gold'", "cook-torrance"}},
        {start + ", \"materials\": {\"gold\": {\"brdf\": \"lambert\", \"roughness\": 1}}}", {"'materials.gold.roughness'"}},
        {start + ", \"materials\": {\"gold\": {\"brdf\": \"lambert\", \"diffuse\": [1, 2, 3]}}}",
         {"'materials.gold.diffuse'", "0..1"}},
        {start + ", \"materials\": {\"gold\": {\"brdf\": \"lambert\"}}}", {"gold", "no material"}},
        {start + ", \"materials\": {\"gold\": {\"brdf\": \"shadow-catcher\", \"diffuse\": [1, 1, 1]}}}",
         {"'materials.gold.diffuse'", "one of brdf"}},
        {start + ", \"materials\": {\"gold\": {\"brdf\": \"cook-torrance\", \"normals\": \"phong\"}}}",
         {"'materials.gold.normals'", "ggx", "beckmann", "phong"}},
        {start + ", \"materials\": {\"gold\": {\"brdf\": \"strauss\", \"smoothness\": 1.5}}}",
         {"'materials.gold.smoothness'", "0..1"}},
        {start + ", \"materials\": {\"gold\": {\"brdf\": \"blinn-phong\", \"diffuse\": [1, 1, 1], \"specular\": [1, 1, 1]}}}",
         {"'materials.gold'", "diffuse + specular"}},
        {start + ", \"lights\": [{}]}", {"'lights[0]'", "shape"}},
    };
    folder.write("two.hdr", hdr(2, 1, std::string(8, '\x80')));
    for (const Case& c : cases) {
        SCOPED_TRACE(c.content);
        expectError(run({folder.write("scene.envlight", c.content)}), 1, c.words);
    }
}

TEST_F(BadInput, Arguments)
{
    expectError(run({}), 2, {"SCENE"});
    expectError(run({model, "--size", "0x5"}), 2, {"--size"});
    expectError(run({model, "--set", "nothing=1"}), 2, {"nothing"});
    expectError(run({model, "--set", "exposure=1000"}), 2, {"exposure", "-32..32"});
    expectError(run({model, "--set", "dither=1"}), 2, {"dither", "on | off"});
    expectError(run({model, "--term", "everything"}), 2, {"view", "beauty"});
    expectError(run({model, "--eye", "1,2,3"}), 2, {"--target"});
    expectError(run({model, "--eye", "1,2", "--target", "0,0,0"}), 2, {"--eye"});
    expectError(run({model, "--fovy", "200"}), 2, {"--fovy"});
    expectError(run({model, "--env-intensity", "-1"}), 2, {"--env-intensity"});
    expectError(run({model, "--env-layout", "cylinder"}), 2, {"--env-layout", "cylinder", "vertical-cross"});
    expectError(run({model, "--what"}), 2, {"--what"});
    expectError(run({folder.file("nowhere.obj")}), 1, {"nowhere.obj", "no such file"});
    expectError(run({model, "--camera", folder.file("nowhere.json")}), 1, {"nowhere.json"});
    picture = folder.file("out.gif");
    expectError(run({model}), 2, {"out.gif", ".exr", ".png"});
    picture = folder.file("no/such/folder/out.png");
    expectError(run({model}), 1, {"out.png"});
}

TEST_F(BadInput, NoDisplayDriverIsAClearError)
{
    // A driver that does not exist: EGL fails before anything is drawn.
    const Outcome o = run({model}, {"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json", "EGL_PLATFORM=surfaceless"});
    expectError(o, 1, {"no headless OpenGL", "EGL"});
}

TEST_F(BadInput, GoodInputInAwkwardPlaces)
{
    std::filesystem::create_directory(folder.file("mit Leerzeichen äöü 日本"));
    folder.write("mit Leerzeichen äöü 日本/modell.obj", cube);
    folder.write("mit Leerzeichen äöü 日本/karte.hdr", hdr(2, 1, std::string(8, '\x80')));
    folder.write("mit Leerzeichen äöü 日本/szene.envlight",
                 "{\"model\": \"modell.obj\", \"environment\": {\"map\": \"karte.hdr\", \"rotation\": 1.5}}");
    picture = folder.file("mit Leerzeichen äöü 日本/bild.png");
    for (const char* locale : {"LC_ALL=C", "LC_ALL=de_DE.UTF-8"}) {
        const Outcome o =
            run({folder.file("mit Leerzeichen äöü 日本/szene.envlight"), "--env-rotation", "12.5", "--set", "exposure=0.5"},
                {locale});
        EXPECT_EQ(0, o.status) << o.err;
        EXPECT_TRUE(std::filesystem::exists(picture));
        std::filesystem::remove(picture);
    }
}

TEST_F(BadInput, OneByOneAndNanFilledMapsAreLegal)
{
    folder.write("one.hdr", hdr(1, 1, std::string(4, '\x80')));
    EXPECT_EQ(0, run({model, "--env", folder.file("one.hdr")}).status);
    EXPECT_EQ(0, run({model, "--env", folder.file("one.hdr"), "--env-layout", "mirror-ball"}).status);
    folder.write("cross.hdr", hdr(3, 4, std::string(48, '\x80')));
    EXPECT_EQ(0, run({model, "--env", folder.file("cross.hdr")}).status);
    const std::string layout = "{\"model\": \"model.obj\", \"environment\": {\"map\": \"one.hdr\", \"layout\": \"octahedral\"}}";
    EXPECT_EQ(0, run({folder.write("scene.envlight", layout)}).status);
}
