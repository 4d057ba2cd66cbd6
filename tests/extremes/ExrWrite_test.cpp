// SPDX-License-Identifier: MIT
// The OpenEXR writer: against OpenEXR's own reader, and round trips through ours.
#include "ExrImage.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <ImfInputFile.h>

#include "ExrFiles.h"

namespace
{

using namespace exrfiles;

/** Width 3, so that rows of bytes are padded at the usual packing of 4. */
osg::ref_ptr<osg::Image> makeImage(GLenum format, GLenum type, int packing = 4)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(3, 2, 1, format, type, packing);
    std::memset(image->data(), 0xee, image->getTotalSizeInBytes());
    const unsigned count = osg::Image::computeNumComponents(format);
    for (unsigned y = 0; y < 2; ++y)
        for (unsigned i = 0; i < 3 * count; ++i) {
            const float value = 0.5f + static_cast<float>(y * 16 + i);
            const std::uint16_t bits = half(value).bits();
            unsigned char* row = image->data(0, y);
            if (type == GL_FLOAT) std::memcpy(row + i * sizeof value, &value, sizeof value);
            if (type == GL_HALF_FLOAT) std::memcpy(row + i * sizeof bits, &bits, sizeof bits);
            if (type == GL_UNSIGNED_BYTE) row[i] = static_cast<unsigned char>(y * 128 + i * 10);
        }
    return image;
}

float valueOf(GLenum type, unsigned y, unsigned i)
{
    return type == GL_UNSIGNED_BYTE ? static_cast<float>(y * 128 + i * 10) / 255.0f : 0.5f + static_cast<float>(y * 16 + i);
}

std::string write(const osg::Image& image, bool asHalf)
{
    std::ostringstream out;
    std::string error = "old";
    EXPECT_TRUE(osgEnvLight::writeExr(image, out, asHalf, error)) << error;
    EXPECT_EQ(error, "");
    return out.str();
}

osg::ref_ptr<osg::Image> read(const std::string& text)
{
    std::istringstream in(text);
    std::string error;
    osg::ref_ptr<osg::Image> image = osgEnvLight::readExr(in, "", error);
    EXPECT_EQ(error, "");
    return image;
}

TEST(ExrWrite, RoundTripOfEveryFormatAndType)
{
    for (const GLenum format : {GLenum(GL_LUMINANCE), GLenum(GL_RGB), GLenum(GL_RGBA)})
        for (const GLenum type : {GLenum(GL_FLOAT), GLenum(GL_HALF_FLOAT), GLenum(GL_UNSIGNED_BYTE)})
            for (const bool asHalf : {false, true}) {
                const osg::ref_ptr<osg::Image> image = read(write(*makeImage(format, type), asHalf));
                ASSERT_TRUE(image.valid());
                ASSERT_EQ(image->getPixelFormat(), format);
                for (unsigned y = 0; y < 2; ++y)
                    for (unsigned i = 0; i < 3 * osg::Image::computeNumComponents(format); ++i) {
                        const float value = valueOf(type, y, i);
                        EXPECT_EQ(reinterpret_cast<const float*>(image->data(0, y))[i],
                                  asHalf ? static_cast<float>(half(value)) : value);
                    }
            }
}

TEST(ExrWrite, OpenExrReadsTheTopRowFirst)
{
    for (const osg::Image::Origin origin : {osg::Image::BOTTOM_LEFT, osg::Image::TOP_LEFT}) {
        const osg::ref_ptr<osg::Image> image = makeImage(GL_RGB, GL_FLOAT);
        image->setOrigin(origin);
        Source source(write(*image, true));
        Imf::InputFile file(source);
        EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
        ASSERT_EQ(file.header().dataWindow(), Box2i(V2i(0, 0), V2i(2, 1)));
        EXPECT_EQ(file.header().channels()["G"].type, Imf::HALF);
        float green[2][3] = {};
        Imf::FrameBuffer target;
        target.insert("G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(green), sizeof(float), sizeof green[0]));
        file.setFrameBuffer(target);
        file.readPixels(0, 1);
        for (unsigned y = 0; y < 2; ++y)
            for (unsigned x = 0; x < 3; ++x)
                EXPECT_EQ(green[y][x], valueOf(GL_FLOAT, origin == osg::Image::TOP_LEFT ? y : 1 - y, 3 * x + 1));
    }
}

TEST(ExrWrite, FloatKeepsEveryValueAndHalfRounds)
{
    using Limits = std::numeric_limits<float>;
    const float values[18] = {Limits::quiet_NaN(),
                              Limits::infinity(),
                              -Limits::infinity(),
                              65504.0f,
                              65519.0f,
                              65520.0f,
                              1e30f,
                              Limits::max(),
                              Limits::denorm_min(),
                              1e-42f,
                              0x1p-24f,
                              -0.0f,
                              -1.5f,
                              0.1f,
                              65536.0f,
                              2049.0f,
                              1.0f,
                              0.0f};
    const osg::ref_ptr<osg::Image> image = makeImage(GL_RGB, GL_FLOAT);
    std::memcpy(image->data(), values, sizeof values);
    const osg::ref_ptr<osg::Image> floats = read(write(*image, false));
    ASSERT_TRUE(floats.valid());
    EXPECT_EQ(std::memcmp(floats->data(), values, sizeof values), 0);

    const osg::ref_ptr<osg::Image> halves = read(write(*image, true));
    ASSERT_TRUE(halves.valid());
    constexpr float inf = Limits::infinity();
    const float expected[18] = {0.0f, inf,      -inf,  65504.0f, 65504.0f,    inf, inf,     inf,  0.0f,
                                0.0f, 0x1p-24f, -0.0f, -1.5f,    0x1.998p-4f, inf, 2048.0f, 1.0f, 0.0f};
    const auto* found = reinterpret_cast<const float*>(halves->data());
    EXPECT_TRUE(std::isnan(found[0]));
    for (std::size_t i = 1; i < 18; ++i) EXPECT_EQ(found[i], expected[i]) << values[i];
}

TEST(ExrWrite, WhatCannotBeWrittenIsRefusedAndWritesNothing)
{
    osg::ref_ptr<osg::Image> solid = new osg::Image;
    solid->allocateImage(2, 2, 2, GL_RGB, GL_FLOAT);
    const struct {
        osg::ref_ptr<osg::Image> image;
        const char* part;
    } cases[] = {{new osg::Image, "0 x 0 x 0 without data, expected two dimensions"},
                 {solid, "2 x 2 x 2, expected two dimensions"},
                 {makeImage(GL_BGR, GL_FLOAT), "pixel format is 0x80e0, expected GL_RGB"},
                 {makeImage(GL_LUMINANCE_ALPHA, GL_FLOAT), "pixel format is 0x190a"},
                 {makeImage(GL_RGB, GL_UNSIGNED_SHORT), "data type is 0x1403, expected GL_FLOAT"}};
    for (const auto& c : cases) {
        std::ostringstream out;
        std::string error;
        EXPECT_FALSE(osgEnvLight::writeExr(*c.image, out, false, error));
        EXPECT_NE(error.find(c.part), std::string::npos) << error;
        EXPECT_EQ(out.str(), "");
    }
}

TEST(ExrWrite, AStreamThatFailsIsAnError)
{
    class Full : public std::streambuf
    {
    };
    Full full;
    std::ostream out(&full);
    std::string error;
    EXPECT_FALSE(osgEnvLight::writeExr(*makeImage(GL_RGB, GL_FLOAT), out, false, error));
    EXPECT_EQ(error, "it cannot be written to its end");
}

}  // namespace
