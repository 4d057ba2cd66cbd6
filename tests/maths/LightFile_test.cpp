// SPDX-License-Identifier: MIT
// Light lists as files: every bit comes back, rigs written by hand are taken, faults are named by file and key.
#include <gtest/gtest.h>

#include <osgEnvLight/LightFile>

#include <cmath>
#include <filesystem>
#include <limits>
#include <locale>
#include <sstream>

#include "Maths.h"
#include "Process.h"

namespace LightFile_test
{

using osgEnvLight::LightFile;

namespace
{

bool read(const std::string& text, LightFile& file, std::string& error)
{
    std::istringstream in(text);
    return osgEnvLight::readLights(in, "rig.json", file, error);
}

LightFile readGood(const std::string& text)
{
    LightFile file;
    std::string error;
    EXPECT_TRUE(read(text, file, error)) << error;
    EXPECT_EQ("", error);
    return file;
}

// Fluxes of every magnitude, directions as unit as normalize() makes them.
LightFile randomFile(unsigned count)
{
    testmaths::Random random(3);
    LightFile file;
    file.map = "Karten/\"süd\" 日本.exr";
    file.sampler = "auto";
    file.seed = 4294967295u;
    file.residual = "süd.residual.exr";
    const auto direction = [&random] {
        const glsl::vec3 d = random.direction();
        return osg::Vec3d(d.x, d.y, d.z);
    };
    const auto flux = [&random] {
        osg::Vec3d f;
        for (int i = 0; i < 3; ++i) f[i] = std::pow(10.0, random.uniform(-300.0, 300.0));
        return f;
    };
    for (unsigned i = 0; i < count; ++i) file.lights.push_back({direction(), flux()});
    for (unsigned i = 0; i < 9; ++i) file.suns.push_back({direction(), flux(), random.uniform(0.0, 0.1)});
    return file;
}

void expectSame(const LightFile& a, const LightFile& b)
{
    EXPECT_EQ(a.map, b.map);
    EXPECT_EQ(a.sampler, b.sampler);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.residual, b.residual);
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (size_t i = 0; i < a.lights.size(); ++i) {
        EXPECT_EQ(a.lights[i].direction, b.lights[i].direction);
        EXPECT_EQ(a.lights[i].flux, b.lights[i].flux);
    }
    ASSERT_EQ(a.suns.size(), b.suns.size());
    for (size_t i = 0; i < a.suns.size(); ++i) {
        EXPECT_EQ(a.suns[i].direction, b.suns[i].direction);
        EXPECT_EQ(a.suns[i].flux, b.suns[i].flux);
        EXPECT_DOUBLE_EQ(a.suns[i].radius, b.suns[i].radius);
    }
}

// As in Germany: 1.234,5.
struct German : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

class GlobalLocale
{
  public:
    explicit GlobalLocale(const std::locale& locale) : _former(std::locale::global(locale)) {}
    ~GlobalLocale() { std::locale::global(_former); }

  private:
    std::locale _former;
};

}  // namespace

TEST(LightFile, EveryBitComesBack)
{
    const LightFile file = randomFile(1000);
    expectSame(file, readGood(osgEnvLight::writeLights(file, "{\"count\": 1000}")));
}

TEST(LightFile, ExtremeNumbersComeBack)
{
    const double most = std::numeric_limits<double>::max();
    const double least = std::numeric_limits<double>::denorm_min();
    LightFile file;
    file.lights.push_back({osg::Vec3d(0, 0, -1), osg::Vec3d(most, least, 0)});
    file.lights.push_back({osg::Vec3d(-0.0, 1, least), osg::Vec3d(0.1, 1.0 / 3.0, 1e23)});
    expectSame(file, readGood(osgEnvLight::writeLights(file)));
}

TEST(LightFile, AnEmptyListIsAList)
{
    expectSame(LightFile(), readGood(osgEnvLight::writeLights(LightFile())));
    EXPECT_TRUE(readGood("{\"lights\": []}").lights.empty());
    EXPECT_TRUE(readGood("{\"suns\": []}").suns.empty());
}

TEST(LightFile, TheLocaleDoesNotMatter)
{
    LightFile file = randomFile(20);
    file.lights[0].flux.set(1234567.5, 0.5, 1e6);
    const std::string text = osgEnvLight::writeLights(file);
    const GlobalLocale german(std::locale(std::locale::classic(), new German));
    EXPECT_EQ(text, osgEnvLight::writeLights(file));
    expectSame(file, readGood(text));
}

TEST(LightFile, RigsWrittenByHand)
{
    const LightFile lamps = readGood(
        "{\"lights\": [{\"direction\": [0, 0, 5], \"flux\": [1, 2, 3]}, {\"flux\": [0, 0, 0], \"direction\": [3e200, -4e200, "
        "0]},\n"
        "             {\"direction\": [1e-200, 0, 0], \"flux\": [1, 1, 1]}]}");
    ASSERT_EQ(3u, lamps.lights.size());
    EXPECT_EQ(osg::Vec3d(0, 0, 1), lamps.lights[0].direction);
    EXPECT_EQ(osg::Vec3d(1, 2, 3), lamps.lights[0].flux);
    EXPECT_NEAR(0.6, lamps.lights[1].direction[0], 1e-15);
    EXPECT_NEAR(-0.8, lamps.lights[1].direction[1], 1e-15);
    EXPECT_EQ(osg::Vec3d(1, 0, 0), lamps.lights[2].direction);
    EXPECT_TRUE(lamps.suns.empty());

    const LightFile suns = readGood(
        "{\"suns\": [{\"direction\": [1, 1, 0], \"flux\": [9, 8, 7], \"radiusDeg\": 90}, {\"direction\": [0, 1, 0], \"flux\": "
        "[1, 1, 1]}]}");
    ASSERT_EQ(2u, suns.suns.size());
    EXPECT_DOUBLE_EQ(testmaths::pi / 2.0, suns.suns[0].radius);
    EXPECT_EQ(0.0, suns.suns[1].radius);
}

TEST(LightFile, FaultsAreNamedAndNothingIsHalfRead)
{
    struct Case {
        std::string text;
        std::string error;  // its end, after "rig.json: "
    };
    const auto light = [](const std::string& second) {
        return "{\"lights\": [{\"direction\": [0, 0, 1], \"flux\": [1, 1, 1]}, " + second + "]}";
    };
    const auto sun = [](const std::string& s) { return "{\"suns\": [" + s + "]}"; };
    const std::string keys = "map, sampler, seed, lights, suns, residual, stats";
    const Case cases[] = {
        {"",
         "not valid JSON at line 1, column 1: syntax error while parsing value - unexpected end of input; expected '[', '{', or "
         "a literal"},
        {"[1]", "the file: expected an object with lights or suns, found [1]"},
        {"{}", "the file: expected an object with lights or suns, found {}"},
        {"{\"lihgts\": []}", "unknown key 'lihgts'; expected one of " + keys},
        {"{\"lights\": {}}", "key 'lights': expected a list, found {}"},
        {"{\"suns\": 3}", "key 'suns': expected a list, found 3"},
        {"{\"lights\": [], \"map\": 3}", "key 'map': expected a string, found 3"},
        {"{\"lights\": [], \"sampler\": null}", "key 'sampler': expected a string, found null"},
        {"{\"lights\": [], \"residual\": []}", "key 'residual': expected a string, found []"},
        {"{\"lights\": [], \"seed\": -1}", "key 'seed': expected a whole number in 0..4294967295, found -1"},
        {"{\"lights\": [], \"seed\": 1.5}", "key 'seed': expected a whole number in 0..4294967295, found 1.5"},
        {"{\"lights\": [], \"seed\": 4294967296}", "key 'seed': expected a whole number in 0..4294967295, found 4294967296"},
        {"{\"lights\": [], \"stats\": 1}", "key 'stats': expected an object, found 1"},
        {light("7"), "key 'lights[1]': expected an object with direction and flux, found 7"},
        {light("{}"), "key 'lights[1]': expected an object with direction and flux, found {}"},
        {light("{\"direction\": [0, 0, 1]}"),
         "key 'lights[1]': expected an object with direction and flux, found {\"direction\":[0,0,1]}"},
        {light("{\"direction\": [0, 0, 1], \"flux\": [1, 1, 1], \"radiusDeg\": 1}"),
         "unknown key 'lights[1].radiusDeg'; expected one of direction, flux"},
        {light("{\"direction\": [0, 0, 0], \"flux\": [1, 1, 1]}"),
         "key 'lights[1].direction': expected a direction, of any length but zero, found [0,0,0]"},
        {light("{\"direction\": [0, 0], \"flux\": [1, 1, 1]}"), "key 'lights[1].direction': expected three numbers, found [0,0]"},
        {light("{\"direction\": [0, 0, null], \"flux\": [1, 1, 1]}"),
         "key 'lights[1].direction': expected three numbers, found [0,0,null]"},
        {light("{\"direction\": [0, 0, 1], \"flux\": 1}"), "key 'lights[1].flux': expected three numbers >= 0, found 1"},
        {light("{\"direction\": [0, 0, 1], \"flux\": [1, 1, 1, 1]}"),
         "key 'lights[1].flux': expected three numbers >= 0, found [1,1,1,1]"},
        {light("{\"direction\": [0, 0, 1], \"flux\": [1, -1, 1]}"),
         "key 'lights[1].flux': expected three numbers >= 0, found [1,-1,1]"},
        {light("{\"direction\": [0, 0, 1], \"flux\": [1, \"1\", 1]}"),
         "key 'lights[1].flux': expected three numbers >= 0, found [1,\"1\",1]"},
        {light("{\"direction\": [0, 0, 1], \"flux\": [1, 1e999, 1]}"), "not valid JSON: number overflow parsing '1e999'"},
        {sun("{\"direction\": [0, 0, 1], \"flux\": [1, 1, 1], \"radius\": 1}"),
         "unknown key 'suns[0].radius'; expected one of direction, flux, radiusDeg"},
        {sun("{\"direction\": [0, 0, 1], \"flux\": [1, 1, 1], \"radiusDeg\": -1}"),
         "key 'suns[0].radiusDeg': expected an angle in 0..90 degrees, found -1"},
        {sun("{\"direction\": [0, 0, 1]}"),
         "key 'suns[0]': expected an object with direction, flux and, if it is not a point, radiusDeg, found "
         "{\"direction\":[0,0,1]}"},
        {"{\"lights\": [], \"map\": \"\\\"" + std::string(200, '[') + "\", \"seed\": -1}",
         "key 'seed': expected a whole number in 0..4294967295, found -1"},
        {std::string(200, '['), "not valid: nested deeper than 64 levels"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.text);
        LightFile file = randomFile(2);
        std::string error;
        EXPECT_FALSE(read(c.text, file, error));
        EXPECT_EQ("rig.json: " + c.error, error);
        expectSame(randomFile(2), file);
    }
}

TEST(LightFile, MoreLightsThan65536AreRefused)
{
    LightFile file;
    file.lights.assign(65536, {osg::Vec3d(0, 0, 1), osg::Vec3d(1, 1, 1)});
    EXPECT_EQ(65536u, readGood(osgEnvLight::writeLights(file)).lights.size());
    file.lights.push_back(file.lights.front());
    std::string error;
    EXPECT_FALSE(read(osgEnvLight::writeLights(file), file, error));
    EXPECT_EQ("rig.json: key 'lights': expected at most 65536 lights, found 65537", error);
}

TEST(LightFile, FilesOfAnyName)
{
    const TemporaryFolder folder;
    const std::string name = folder.file("Lichter äöü 日本.json");
    const LightFile file = randomFile(5);
    std::string error;
    ASSERT_TRUE(osgEnvLight::writeLightFile(name, file, "{}", error)) << error;
    LightFile again;
    ASSERT_TRUE(osgEnvLight::readLightFile(name, again, error)) << error;
    expectSame(file, again);

    EXPECT_FALSE(osgEnvLight::writeLightFile(folder.file("none/rig.json"), file, "", error));
    EXPECT_EQ(folder.file("none/rig.json") + ": can't be written", error);
    EXPECT_FALSE(osgEnvLight::readLightFile(folder.file("none.json"), again, error));
    EXPECT_EQ(folder.file("none.json") + ": no such file", error);
    std::filesystem::create_directory(folder.file("folder.json"));
    EXPECT_FALSE(osgEnvLight::readLightFile(folder.file("folder.json"), again, error));
    EXPECT_EQ(folder.file("folder.json") + ": not a file", error);
}

}  // namespace LightFile_test
