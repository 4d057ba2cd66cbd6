// SPDX-License-Identifier: MIT
// envlight-lights from the outside: counts, fluxes and directions of what it writes, its pictures and its errors.
#include <osgEnvLight/LightFile>

#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "Maps.h"
#include "Process.h"

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::EnvironmentMap;
using osgEnvLight::LightFile;
using osgEnvLight::RadianceMap;

namespace
{

const std::string program = std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-lights";

osg::ref_ptr<const RadianceMap> load(const std::string& name)
{
    osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap;
    std::string error;
    EXPECT_TRUE(map->load(name, nullptr, error)) << error;
    return map->radiance(error);
}

// Radiance times solid angle over the texels, with the tests' own solid angle.
osg::Vec3d integral(const RadianceMap& map)
{
    osg::Vec3d sum;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const float* t = map.texel(x, y);
            sum += osg::Vec3d(t[0], t[1], t[2]) * texelSolidAngle(y, map.width, map.height);
        }
    return sum;
}

osg::Vec3d fluxOf(const LightFile& file)
{
    osg::Vec3d sum;
    for (const auto& l : file.lights) sum += l.flux;
    for (const auto& s : file.suns) sum += s.flux;
    return sum;
}

void expectChannelsNear(const osg::Vec3d& a, const osg::Vec3d& b, double relative)
{
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], relative * std::abs(b[c])) << "channel " << c;
}

std::string withoutTime(const std::string& text)
{
    const size_t at = text.find("\"milliseconds\"");
    return text.substr(0, at) + text.substr(text.find('\n', at));
}

// The picture's pixel there, by the convention written out a second time.
osg::Vec4 colorAt(const osg::Image& picture, const osg::Vec3d& d)
{
    const double u = 0.5 - std::atan2(d.y(), d.x()) / (2.0 * pi);
    const double v = std::acos(std::clamp(d.z(), -1.0, 1.0)) / pi;
    const int x = std::min(int(u * picture.s()), picture.s() - 1);
    const int y = std::min(int(v * picture.t()), picture.t() - 1);
    return picture.getColor(unsigned(x), unsigned(picture.t() - 1 - y));
}

}  // namespace

class LightsProgram : public testing::Test
{
  protected:
    LightsProgram() : list(folder.file("out.json")), picture(folder.file("out.png")) {}

    Outcome run(const std::vector<std::string>& arguments)
    {
        std::vector<std::string> command = {program};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return runProgram(command);
    }

    LightFile lightsOf(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.end(), {"-o", list});
        const Outcome o = run(arguments);
        EXPECT_EQ(0, o.status) << o.err;
        LightFile file;
        std::string error;
        EXPECT_TRUE(osgEnvLight::readLightFile(list, file, error)) << error;
        return file;
    }

    nlohmann::json stats() const { return nlohmann::json::parse(readFile(list))["stats"]; }

    // A map that the built-in ones do not stand for, as a file.
    std::string writeMap(const std::string& name, int width, int height, const Radiance& radiance)
    {
        const auto result =
            osgDB::Registry::instance()->writeImage(*makeMap(width, height, radiance), folder.file(name), nullptr);
        EXPECT_TRUE(const_cast<osgDB::ReaderWriter::WriteResult&>(result).success());
        return folder.file(name);
    }

    // A lamp of 4 degrees' radius, which is cut as a sun, in a coloured gradient.
    std::string lampMap()
    {
        const vec3 lamp = glsl::normalize(vec3(1.0, 2.0, 2.0));
        return writeMap("lamp.exr", 128, 64, [lamp](const vec3& d) {
            return glsl::dot(d, lamp) > std::cos(4.0 * pi / 180.0) ? vec3(200.0, 150.0, 100.0)
                                                                   : vec3(1.0 + d.x, 1.0 + d.y, 1.0 + d.z) * 0.3;
        });
    }

    void expectError(const std::vector<std::string>& arguments, int status, const std::vector<std::string>& words)
    {
        const Outcome o = run(arguments);
        EXPECT_EQ(status, o.status) << o.err;
        EXPECT_EQ(0u, o.err.find("envlight-lights: ")) << o.err;
        EXPECT_EQ(o.err.size() - 1, o.err.find('\n')) << o.err;
        for (const std::string& w : words) EXPECT_NE(std::string::npos, o.err.find(w)) << "'" << w << "' in: " << o.err;
        EXPECT_FALSE(std::filesystem::exists(list));
        EXPECT_FALSE(std::filesystem::exists(picture));
    }

    TemporaryFolder folder;
    std::string list;
    std::string picture;
};

TEST_F(LightsProgram, AsManyLightsAsAskedForAndTheMapsFlux)
{
    struct Case {
        std::string map;
        unsigned count;
        const char* suns;
    };
    const Case cases[] = {{"sky", 1, "off"}, {"sky", 1009, "off"}, {lampMap(), 100, "off"}, {lampMap(), 32, "auto"}};
    for (const Case& c : cases) {
        const osg::Vec3d whole = integral(*load(c.map));
        for (const char* sampler : {"auto", "split", "median-cut", "inverse-cdf"}) {
            SCOPED_TRACE(c.map + " " + sampler + " " + std::to_string(c.count) + " " + c.suns);
            const LightFile file = lightsOf({c.map, "--sampler", sampler, "--count", std::to_string(c.count), "--suns", c.suns});
            EXPECT_EQ(c.count, file.lights.size());
            EXPECT_EQ(c.suns == std::string("auto") ? 1u : 0u, file.suns.size());
            EXPECT_EQ(c.map, file.map);
            EXPECT_EQ(sampler, file.sampler);
            const osg::Vec3d flux = fluxOf(file);
            // Points estimate the channels, and have their sum.
            EXPECT_NEAR(1.0, (flux[0] + flux[1] + flux[2]) / (whole[0] + whole[1] + whole[2]), 1e-6);
            if (sampler != std::string("inverse-cdf")) expectChannelsNear(flux, whole, 1e-6);
        }
    }
    const LightFile weighted =
        lightsOf({lampMap(), "--sampler", "inverse-cdf", "--weights", "on", "--seed", "7", "--floor", "0.2"});
    EXPECT_EQ(7u, weighted.seed);
    expectChannelsNear(fluxOf(weighted), integral(*load(lampMap())), 1e-6);
}

TEST_F(LightsProgram, StatsSayWhatTheListIsLike)
{
    lightsOf({"sky", "--count", "100", "--rotation", "30"});
    const nlohmann::json s = stats();
    EXPECT_EQ(100, s["requested"]);
    EXPECT_EQ(100, s["count"]);
    EXPECT_EQ(0, s["dropped"]);
    EXPECT_EQ(nlohmann::json({1024, 512}), s["mapSize"]);
    EXPECT_EQ(30.0, s["rotationDeg"]);
    EXPECT_GT(s["milliseconds"], 0.0);
    EXPECT_GT(s["irradianceError"], 0.0);
    EXPECT_LT(s["irradianceError"], 0.005);
    EXPECT_LT(s["fluxError"], 1e-6);
    EXPECT_EQ(0, s["notFiniteTexels"]);
    EXPECT_EQ(0, s["negativeTexels"]);
    EXPECT_FALSE(s.contains("black"));
    const osg::ref_ptr<const RadianceMap> map = load("sky");
    EXPECT_EQ(map->maximum, s["maximumRadiance"]);
    EXPECT_NEAR(map->mean, s["meanRadiance"], 1e-9);
    const double few = s["irradianceError"];
    lightsOf({"sky", "--count", "8", "--suns", "off"});
    EXPECT_GT(stats()["irradianceError"], few);
}

TEST_F(LightsProgram, RotationTurnsTheDirections)
{
    const LightFile a = lightsOf({lampMap(), "--count", "16"});
    const LightFile b = lightsOf({lampMap(), "--count", "16", "--rotation", "90"});
    ASSERT_EQ(a.lights.size(), b.lights.size());
    const auto turned = [](const osg::Vec3d& d) { return osg::Vec3d(-d.y(), d.x(), d.z()); };
    for (size_t i = 0; i < a.lights.size(); ++i) {
        EXPECT_LT((turned(a.lights[i].direction) - b.lights[i].direction).length(), 1e-15);
        EXPECT_EQ(a.lights[i].flux, b.lights[i].flux);
    }
    ASSERT_EQ(1u, b.suns.size());
    EXPECT_LT((turned(a.suns[0].direction) - b.suns[0].direction).length(), 1e-15);
}

TEST_F(LightsProgram, TheSameAgain)
{
    lightsOf({"studio", "-o", picture});
    const std::string firstList = readFile(list);
    const std::string firstPicture = readFile(picture);
    lightsOf({"studio", "-o", picture});
    EXPECT_EQ(withoutTime(firstList), withoutTime(readFile(list)));
    EXPECT_EQ(firstPicture, readFile(picture));
}

TEST_F(LightsProgram, TheResidualAndTheSunsAreTheMap)
{
    const LightFile file = lightsOf({"sky"});
    ASSERT_EQ("out.residual.exr", file.residual);
    const osg::ref_ptr<const RadianceMap> residual = load(folder.file(file.residual));
    LightFile suns = file;
    suns.lights.clear();
    const osg::Vec3d whole = integral(*load("sky"));
    expectChannelsNear(integral(*residual) + fluxOf(suns), whole, 1e-6);
    // The sun as BuiltinMaps has it, 45 degrees high.
    EXPECT_NEAR(std::sqrt(0.5), file.suns[0].direction.z(), 0.005);

    std::filesystem::remove(folder.file(file.residual));
    EXPECT_EQ("", lightsOf({lampMap(), "--suns", "0"}).residual);
    EXPECT_FALSE(std::filesystem::exists(folder.file("out.residual.exr")));
}

TEST_F(LightsProgram, PicturesHaveDotsWhereTheLightsAre)
{
    const std::string map = writeMap("green.exr", 64, 32, [](const vec3& d) { return vec3(0.2, 1.0, 0.2) * (1.0 + 0.5 * d.x); });
    // A dot has its light's colour as bright as can be, which the exposed map does not reach.
    const auto isFill = [](const osg::Vec4& c) { return c.g() == 1.0f && std::abs(c.r() - 0.4845f) < 0.01f && c.r() == c.b(); };
    for (const char* rotation : {"0", "77"}) {
        const LightFile file = lightsOf({map, "--count", "40", "--rotation", rotation, "-o", picture});
        const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(picture);
        ASSERT_TRUE(image);
        EXPECT_EQ(1024, image->s());
        EXPECT_EQ(512, image->t());
        for (const auto& l : file.lights) EXPECT_TRUE(isFill(colorAt(*image, l.direction)));
        int fill = 0;
        int outline = 0;
        for (int y = 0; y < image->t(); ++y)
            for (int x = 0; x < image->s(); ++x) {
                const osg::Vec4 c = image->getColor(unsigned(x), unsigned(y));
                fill += isFill(c);
                outline += c.r() > 0.8f;
            }
        EXPECT_GT(fill, 0.01 * 1024 * 512);
        EXPECT_LT(fill, 0.10 * 1024 * 512);
        EXPECT_GT(outline, 1000);
    }
}

TEST_F(LightsProgram, PicturesOfAwkwardMaps)
{
    const Radiance even = [](const vec3&) { return vec3(1e-30, 2e-30, 1e-30); };
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 1), std::pair(6, 3), std::pair(1030, 515)}) {
        const std::string name = std::to_string(width) + ".exr";
        const Outcome o = run({writeMap(name, width, height, even), "--count", "100", "-o", picture});
        EXPECT_EQ(0, o.status) << o.err;
        const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(picture);
        ASSERT_TRUE(image);
        EXPECT_GE(image->s(), 1024);
        EXPECT_EQ(image->s() / 2, image->t());
    }
}

TEST_F(LightsProgram, ABlackMapHasNoLights)
{
    const LightFile file = lightsOf({writeMap("black.exr", 8, 4, [](const vec3&) { return vec3(0.0); }), "-o", picture});
    EXPECT_TRUE(file.lights.empty());
    EXPECT_TRUE(file.suns.empty());
    EXPECT_EQ(true, stats()["black"]);
    EXPECT_EQ(128, stats()["dropped"]);
    EXPECT_TRUE(std::filesystem::exists(picture));
}

TEST_F(LightsProgram, BadArguments)
{
    expectError({"-o", list}, 2, {"MAP"});
    expectError({"sky"}, 2, {"--output"});
    expectError({"sky", "-o", list, "--sampler", "best"}, 2, {"--sampler", "'best'", "auto, split, median-cut", "inverse-cdf"});
    expectError({"sky", "-o", list, "--count", "0"}, 2, {"--count", "65536"});
    expectError({"sky", "-o", list, "--count", "65537"}, 2, {"--count", "65536"});
    expectError({"sky", "-o", list, "--suns", "many"}, 2, {"--suns", "'many'", "auto"});
    expectError({"sky", "-o", list, "--suns", "-1"}, 2, {"--suns", "'-1'"});
    expectError({"sky", "-o", list, "--weights", "yes"}, 2, {"--weights", "'yes'", "auto, on or off"});
    expectError({"sky", "-o", list, "--layout", "cylinder"}, 2, {"--layout", "'cylinder'", "vertical-cross"});
    expectError({"sky", "-o", list, "--floor", "-1"}, 2, {"--floor is -1", "0..1e+06"});
    expectError({"sky", "-o", list, "--floor", "nan"}, 2, {"--floor is nan"});
    expectError({"sky", "-o", list, "--rotation", "nan"}, 2, {"--rotation is nan"});
    expectError({"sky", "-o", list, "--seed", "-1"}, 2, {"--seed"});
    expectError({"sky", "-o", list, "--rotation", "north"}, 2, {"--rotation", "north"});
    expectError({"sky", "-o", list, "-o", folder.file("out.gif")}, 2, {"out.gif", ".json", ".png"});
}

TEST_F(LightsProgram, WhatFails)
{
    expectError({folder.file("none.exr"), "-o", list}, 1, {"none.exr", "no such file"});
    expectError({"studio", "-o", folder.file("none/out.json")}, 1, {"none/out.json", "can't be written"});
    expectError({lampMap(), "-o", folder.file("none/out.json")}, 1, {"none/out.residual.exr", "can't be written"});
    expectError({"studio", "--count", "1", "-o", folder.file("none/out.png")}, 1, {"none/out.png", "can't be written"});
    const std::string map = writeMap("map.residual.exr", 4, 2, [](const vec3&) { return vec3(1.0); });
    const std::string before = readFile(map);
    expectError({map, "-o", folder.file("map.json")}, 2, {"map.json", "write over the map"});
    EXPECT_EQ(before, readFile(map));
}

TEST_F(LightsProgram, NamesInAnyScript)
{
    std::filesystem::create_directory(folder.file("Lichter äöü 日本"));
    list = folder.file("Lichter äöü 日本/süd.json");
    const LightFile file = lightsOf({lampMap(), "--count", "3", "-o", folder.file("Lichter äöü 日本/süd.png")});
    EXPECT_EQ("süd.residual.exr", file.residual);
    EXPECT_TRUE(std::filesystem::exists(folder.file("Lichter äöü 日本/süd.residual.exr")));
    EXPECT_TRUE(std::filesystem::exists(folder.file("Lichter äöü 日本/süd.png")));
}
