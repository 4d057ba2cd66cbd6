// SPDX-License-Identifier: MIT
// envlight-reference from the outside: its pictures, headers, messages and exit status.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "Process.h"
#include "Traced.h"

namespace ReferenceProgram_test
{

namespace
{

const std::string program = std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-reference";

struct Exr {
    Picture picture;
    Picture variance;
    std::map<std::string, std::string> attributes;
};

void addSlices(Imf::FrameBuffer& buffer, const std::string& prefix, Picture& p, const char* names)
{
    for (size_t k = 0; names[k]; ++k)
        buffer.insert(prefix + names[k],
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(p.rgba.data() + k), 16, 16 * size_t(p.width)));
}

// By OpenEXR itself. Rows run downwards.
Exr readExr(const std::string& name)
{
    Imf::InputFile file(name.c_str());
    const Imf::Header& header = file.header();
    const auto box = header.dataWindow();
    Exr exr;
    exr.picture = exr.variance = Picture(box.max.x + 1, box.max.y + 1);
    Imf::FrameBuffer buffer;
    addSlices(buffer, "", exr.picture, "RGBA");
    if (header.channels().findChannel("variance.R")) addSlices(buffer, "variance.", exr.variance, "RGB");
    file.setFrameBuffer(buffer);
    file.readPixels(0, box.max.y);
    for (auto i = header.begin(); i != header.end(); ++i)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
            exr.attributes[i.name()] = text->value();
    return exr;
}

size_t linesIn(const std::string& text)
{
    return size_t(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

class ReferenceProgram : public testing::Test
{
  protected:
    ReferenceProgram() : model(folder.file("model.osgt")), out(folder.file("out.exr"))
    {
        osgDB::writeNodeFile(*together({makeQuad(osg::Vec3d(-2, -2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)),
                                        makeSphere(osg::Vec3d(0, 0, 0.8), 0.7, 32)}),
                             model);
    }

    Outcome run(std::vector<std::string> arguments, const std::vector<std::string>& environment = {})
    {
        arguments.insert(arguments.begin(), program);
        return runProgram(arguments, environment);
    }

    std::vector<std::string> small(const std::vector<std::string>& more) const
    {
        std::vector<std::string> a = {model,     "--env", "studio", "--size",   "24x16",
                                      "--quiet", "--eye", "1,-5,3", "--target", "0,0,0.5"};
        a.insert(a.end(), more.begin(), more.end());
        return a;
    }

    Exr render(const std::vector<std::string>& more)
    {
        std::vector<std::string> a = small(more);
        a.insert(a.end(), {"-o", out});
        const Outcome o = run(a);
        EXPECT_EQ(0, o.status) << o.err;
        EXPECT_EQ("", o.err);
        return o.status == 0 ? readExr(out) : Exr();
    }

    void expectError(const std::vector<std::string>& arguments, int status, const std::vector<std::string>& words)
    {
        const Outcome o = run(arguments);
        EXPECT_EQ(status, o.status) << o.err;
        EXPECT_EQ(0u, o.err.find("envlight-reference: ")) << o.err;
        EXPECT_EQ(1u, linesIn(o.err)) << o.err;
        for (const std::string& w : words) EXPECT_NE(std::string::npos, o.err.find(w)) << "'" << w << "' in: " << o.err;
        EXPECT_FALSE(std::filesystem::exists(out));
    }

    TemporaryFolder folder;
    std::string model;
    std::string out;
};

// Directions about the normal seldom meet small bright lights. Half the error is that of four times the samples; measured: .23.
TEST_F(ReferenceProgram, MeetsSmallBrightLightsUnlessToldOtherwise)
{
    const Exr plain = render({"--spp", "64"});
    const Exr cosine = render({"--spp", "64", "--estimator", "cosine"});
    EXPECT_EQ("mis", plain.attributes.at("estimator"));
    EXPECT_LT(std::stod(plain.attributes.at("relativeStandardError")),
              0.5 * std::stod(cosine.attributes.at("relativeStandardError")));
}

TEST_F(ReferenceProgram, BadArgumentsAreStatus2)
{
    expectError({}, 2, {});
    expectError({model}, 2, {"--output"});
    expectError(small({"-o", folder.file("out.tiff")}), 2, {".exr", "out.tiff"});
    expectError(small({"-o", out, "--estimator", "guess"}), 2, {"--estimator", "guess"});
    expectError(small({"-o", out, "--paths", "some"}), 2, {"--paths"});
    expectError(small({"-o", out, "--term", "light"}), 2, {"--term"});
    expectError(small({"-o", out, "--spp", "0"}), 2, {"--spp"});
    expectError(small({"-o", out, "--spp", "many"}), 2, {"--spp"});
    expectError(small({"-o", out, "--error", "-1"}), 2, {"--error"});
    expectError(small({"-o", out, "--pixel", "24,0"}), 2, {"--pixel"});
    expectError(small({"-o", out, "--pixel", "0,-1"}), 2, {"--pixel"});
    expectError(small({"-o", out, "--pixel", "3"}), 2, {"--pixel"});
    expectError(small({"-o", out, "--set", "nothing=1"}), 2, {"nothing"});
    expectError({model, "--size", "0x5", "-o", out}, 2, {"--size"});
    expectError({model, "--eye", "1,2,3", "-o", out}, 2, {"--target"});
}

TEST_F(ReferenceProgram, WhatIsMissingIsStatus1)
{
    expectError({folder.file("none.osgt"), "-o", out}, 1, {"none.osgt"});
    expectError({model, "--env", folder.file("none.hdr"), "-o", out}, 1, {"none.hdr"});
    expectError(small({"--lights", folder.file("none.json"), "-o", out}), 1, {"none.json"});
    expectError(small({"--spp", "1", "-o", folder.file("no/such/folder/out.exr")}), 1, {"out.exr"});
    expectError(small({"--spp", "1", "-o", folder.file("no/such/folder/out.png")}), 1, {"out.png"});
}

TEST_F(ReferenceProgram, FullDisksAreStatus1)
{
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    for (const char* name : {"full.exr", "full.png"}) {
        std::filesystem::create_symlink("/dev/full", folder.file(name));
        const Outcome o = run(small({"--spp", "4", "-o", folder.file(name)}));
        EXPECT_EQ(1, o.status) << name << o.err;
        EXPECT_NE(std::string::npos, o.err.find(name)) << o.err;
        EXPECT_TRUE(std::filesystem::exists("/dev/full"));
    }
}

TEST_F(ReferenceProgram, HeadersSayWhatWasDone)
{
    Exr exr = render({"--spp", "40", "--seed", "5", "--estimator", "mis", "--paths", "full"});
    EXPECT_EQ("40", exr.attributes["samplesPerPixel"]);
    EXPECT_EQ("5", exr.attributes["seed"]);
    EXPECT_EQ("mis", exr.attributes["estimator"]);
    EXPECT_EQ("full", exr.attributes["paths"]);
    EXPECT_EQ("complete", exr.attributes["state"]);
    EXPECT_EQ(24, exr.picture.width);
    EXPECT_EQ(16, exr.picture.height);
    EXPECT_TRUE(exr.picture.finite());
    const Exr again = render({"--spp", "40", "--seed", "5", "--estimator", "mis", "--paths", "full"});
    EXPECT_EQ(exr.picture.rgba, again.picture.rgba);  // whatever the threads did
    EXPECT_NE(exr.picture.rgba, render({"--spp", "40", "--seed", "6", "--estimator", "mis", "--paths", "full"}).picture.rgba);
}

TEST_F(ReferenceProgram, ErrorAskedForIsReachedAndStated)
{
    Exr exr = render({"--error", "0.02"});
    const double stated = std::stod(exr.attributes["relativeStandardError"]);
    EXPECT_LE(stated, 0.02);
    EXPECT_GT(stated, 0.005);
    // What is stated is what the layer of variances says: root mean square over geometry, over the mean there.
    double variance = 0.0, mean = 0.0, n = 0.0;
    for (size_t i = 0; i < exr.picture.pixels(); ++i)
        for (size_t k = 0; k < 3 && exr.picture.rgba[4 * i + 3] > 0.0f; ++k, ++n) {
            variance += double(exr.variance.rgba[4 * i + k]);
            mean += double(exr.picture.rgba[4 * i + k]);
        }
    EXPECT_NEAR(std::sqrt(variance / n) / (mean / n), stated, 1e-3 * stated);

    const Outcome o = run(small({"--error", "1e-5", "--spp", "200", "-o", out}));
    EXPECT_EQ(1, o.status);
    EXPECT_EQ(1u, linesIn(o.err)) << o.err;
    EXPECT_NE(std::string::npos, o.err.find("--error was not reached")) << o.err;
    EXPECT_EQ("200", readExr(out).attributes["samplesPerPixel"]);
}

// The display value .8, which OpenGL gives a surface without a material, as an albedo.
const float usual = float(std::pow((0.8 + 0.055) / 1.055, 2.4));

TEST_F(ReferenceProgram, EveryTerm)
{
    std::map<std::string, Picture> terms;
    for (const char* term : {"beauty", "diffuse", "specular", "occlusion", "visibility", "sun", "indirect", "emission", "albedo",
                             "normal", "depth"}) {
        Exr exr = render({"--term", term, "--spp", "32", "--paths", std::string(term) == "indirect" ? "full" : "direct"});
        EXPECT_EQ(term, exr.attributes["term"]);
        EXPECT_TRUE(exr.picture.finite()) << term;
        terms[term] = exr.picture;
    }
    const size_t at = 4 * (8 * 24 + 12);  // on the sphere
    EXPECT_NEAR(terms["beauty"].rgba[at], terms["diffuse"].rgba[at] + terms["specular"].rgba[at], 1e-5f);
    EXPECT_GT(terms["indirect"].rgba[4 * (12 * 24 + 12)], 0.0f);
    EXPECT_NEAR(terms["albedo"].rgba[at], usual, 1e-6f);
    EXPECT_GT(terms["depth"].rgba[at], 0.0f);
    EXPECT_GT(terms["visibility"].rgba[at], 0.5f);
    EXPECT_EQ(0.0f, terms["emission"].rgba[at]);
    double length = 0.0;
    for (size_t k = 0; k < 3; ++k) length += std::pow(2.0 * double(terms["normal"].rgba[at + k]) - 1.0, 2.0);
    EXPECT_NEAR(length, 1.0, 1e-5);
    const Outcome o = run(small({"--spp", "4", "-o", folder.file("out.png")}));
    EXPECT_EQ(0, o.status) << o.err;
    EXPECT_EQ(0u, readFile(folder.file("out.png")).find("\x89PNG"));
}

TEST_F(ReferenceProgram, ShowsADarkSceneAsBrightAsTheNodeDoes)
{
    const auto meanLevel = [&](const std::string& by, const std::string& base) {
        const std::string png = folder.file("dark.png");
        std::vector<std::string> a = small({"--env-intensity", "0.01", "--set", "exposureBase=" + base, "-o", png});
        if (by == program) a.insert(a.end(), {"--spp", "64"});
        if (by != program) a.erase(std::find(a.begin(), a.end(), "--quiet"));
        a.insert(a.begin(), by);
        const Outcome o = runProgram(a);
        EXPECT_EQ(0, o.status) << o.err;
        const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(png);
        if (!image) return 0.0;
        double sum = 0.0;
        for (int y = 0; y < image->t(); ++y)
            for (int x = 0; x < image->s(); ++x) sum += double(image->getColor(unsigned(x), unsigned(y)).g());
        return 255.0 * sum / (image->s() * image->t());
    };
    const std::string ours = std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-render";
    const double level = meanLevel(program, "picture");
    EXPECT_GT(level, 40.0);
    EXPECT_NEAR(level, meanLevel(ours, "picture"), 4.0);  // one frame beside full light transport
    EXPECT_LT(meanLevel(program, "map"), 20.0);
}

TEST_F(ReferenceProgram, PixelAndLights)
{
    const Exr pixel = render({"--pixel", "12,8"});
    EXPECT_EQ(1024, pixel.picture.width);
    EXPECT_EQ(512, pixel.picture.height);
    // Its integral over all directions is the pixel: rows of the picture are heights.
    double sum = 0.0;
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 1024; ++x)
            sum += double(pixel.picture.at(x, y)[0]) * std::sin(osg::PI * (y + 0.5) / 512) * 2.0 * osg::PI * osg::PI /
                   (512.0 * 1024.0);
    const Exr picture = render({"--spp", "4096", "--estimator", "mis"});
    const float* p = picture.picture.at(12, 8);
    EXPECT_NEAR(sum, double(*p), 4.0 * double(std::sqrt(*picture.variance.at(12, 8))) + 0.005 * sum);

    // One light from above of irradiance pi: a radiance of the albedo where nothing is in its way.
    const std::string lights =
        folder.write("lights.json", R"({"lights": [{"direction": [0, 0, 1], "flux": [3.14159265, 3.14159265, 3.14159265]}]})");
    const Exr lit = render({"--lights", lights, "--spp", "2"});
    EXPECT_NEAR(lit.picture.at(12, 14)[0], usual, 1e-4f);
    EXPECT_EQ(0.0f, lit.variance.at(12, 14)[0]);
}

TEST_F(ReferenceProgram, InterruptedItKeepsWhatThereIs)
{
    for (const int signal : {SIGINT, SIGTERM}) {  // a job scheduler sends SIGTERM
        const Outcome o = interruptProgram({program, model, "--env", "studio", "--size", "64x64", "--spp", "10000000", "-o", out},
                                           "[1-9]\\d* spp", signal);
        EXPECT_EQ(1, o.status);
        EXPECT_NE(std::string::npos, o.err.find("interrupted; " + out)) << o.err;
        EXPECT_EQ(2u, linesIn(o.err)) << o.err;  // after how many samples, and that
        Exr exr = readExr(out);
        EXPECT_EQ("interrupted", exr.attributes["state"]);
        EXPECT_GT(std::stol(exr.attributes["samplesPerPixel"]), 0);
        EXPECT_TRUE(exr.picture.finite());
        EXPECT_GT(exr.picture.at(32, 24)[3], 0.0f);  // the sphere
        std::filesystem::remove(out);
    }
}

TEST_F(ReferenceProgram, NothingToSeeIsTheBackground)
{
    const std::string empty = folder.file("empty.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*osg::ref_ptr<osg::Group>(new osg::Group), empty));
    const Outcome o = run({empty, "--env", "sky", "--size", "8x8", "--quiet", "-o", out});
    EXPECT_EQ(0, o.status) << o.err;
    EXPECT_NE(std::string::npos, o.err.find("no surface")) << o.err;
    const Exr exr = readExr(out);
    for (size_t i = 0; i < 64; ++i) EXPECT_EQ(0.0f, exr.picture.rgba[4 * i + 3]);
    EXPECT_GT(exr.picture.rgba[0], 0.0f);
}

TEST_F(ReferenceProgram, PathsInUtf8AndLocalesWithCommas)
{
    const std::string name = folder.file("Größe 模型.osgt"), picture = folder.file("Bild é.exr");
    std::filesystem::copy(model, name);
    const std::vector<std::string> locale = {"LC_ALL=de_DE.UTF-8", "LANG=de_DE.UTF-8"};
    Outcome o = run({name, "--env", "studio", "--size", "24x16", "--quiet", "--eye", "1.5,-5,3", "--target", "0,0,0.5", "--spp",
                     "32", "-o", picture},
                    locale);
    EXPECT_EQ(0, o.status) << o.err;
    Exr exr = readExr(picture);
    EXPECT_EQ(std::string::npos, exr.attributes["relativeStandardError"].find(','));
    o = run({name, "--env", "studio", "--size", "24x16", "--quiet", "--eye", "1.5,-5,3", "--target", "0,0,0.5", "--spp", "32",
             "-o", out});
    EXPECT_EQ(readExr(out).picture.rgba, exr.picture.rgba);
}

}  // namespace ReferenceProgram_test
