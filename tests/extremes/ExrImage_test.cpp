// SPDX-License-Identifier: MIT
// The OpenEXR reader against files that OpenEXR's own writers made, the writer against OpenEXR's own reader, and both against
// damage.
#include "ExrImage.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "ImageResult.h"

#include <gtest/gtest.h>

#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include "ExrFiles.h"

namespace
{

using namespace exrfiles;

ImageResult decodeExr(const std::string& text)
{
    std::istringstream in(text);
    ImageResult result{"test.exr", nullptr, ""};
    result.image = osgEnvLight::readExr(in, result.file, result.error);
    return result;
}

void expectExrError(const std::string& text, const std::string& part)
{
    expectError(decodeExr(text), part);
}

const float* at(const osg::Image& image, int x, int fromTop)
{
    return reinterpret_cast<const float*>(image.data(static_cast<unsigned>(x), static_cast<unsigned>(image.t() - 1 - fromTop)));
}

/** Every pixel of the display window holds the pattern of `names`, in this order, inside the data window, and 0 outside. */
void expectPattern(const std::string& text, const Names& names, Box2i data = {V2i(0, 0), V2i(6, 4)}, V2i origin = {0, 0},
                   V2i size = {7, 5}, bool whole = false, double relative = 0.0)
{
    const ImageResult result = decodeExr(text);
    ASSERT_TRUE(result.image.valid()) << result.error;
    const osg::Image& image = *result.image;
    ASSERT_EQ(V2i(image.s(), image.t()), size);
    const std::size_t count = names.size();
    ASSERT_EQ(image.getPixelFormat(), GLenum(count == 1 ? GL_LUMINANCE : count == 3 ? GL_RGB : GL_RGBA));
    ASSERT_EQ(image.getDataType(), GLenum(GL_FLOAT));
    EXPECT_EQ(image.getInternalTextureFormat(), count == 1 ? 0x8818 : count == 3 ? 0x8815 : 0x8814);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (std::size_t c = 0; c < count; ++c) {
                const V2i p = origin + V2i(x, y);
                float expected = data.intersects(p) ? pattern(names[c], p.x, p.y) : 0.0f;
                if (whole) expected = std::floor(expected);
                ASSERT_NEAR(at(image, x, y)[c], expected, relative * expected) << x << " " << y << " " << names[c];
            }
}

const Names kRgb = {"R", "G", "B"}, kRgba = {"R", "G", "B", "A"}, kGrey = {"Y"};

TEST(ExrImage, EveryTypeAndCompression)
{
    for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c)
        for (const Imf::PixelType type : {Imf::UINT, Imf::HALF, Imf::FLOAT}) {
            SCOPED_TRACE("compression " + std::to_string(c) + ", type " + std::to_string(type));
            // B44 and DWA promise no bound; on this smooth ramp 5 % tells a decoded picture from a shuffled one.
            const bool lossy = c >= Imf::B44_COMPRESSION;
            for (const Names& names : {kRgb, kRgba, kGrey})
                expectPattern(scanlines(makeHeader(names, type, static_cast<Imf::Compression>(c))), names, {V2i(0, 0), V2i(6, 4)},
                              {0, 0}, {7, 5}, type == Imf::UINT, lossy ? 0.05 : 0.0);
        }
}

TEST(ExrImage, ChannelsByName)
{
    expectPattern(scanlines(makeHeader({"A", "Y"})), {"Y", "Y", "Y", "A"});
    expectPattern(scanlines(makeHeader({"Y", "R", "G", "B", "Z", "diffuse.R", "id"})), kRgb);
    expectExrError(scanlines(makeHeader({"R"})), "its channels are R, expected R G B, Y");
    expectExrError(scanlines(makeHeader({"layer.R", "layer.G", "layer.B"})),
                   "its channels are layer.B layer.G layer.R, expected");
    expectExrError(scanlines(makeHeader({"R", "G", "A"})), "A G R");
    expectExrError(scanlines(makeHeader({"RY", "BY"})), "BY RY");
    const Box2i even(V2i(0, 0), V2i(7, 3));
    for (const char* channel : {"G", "A", "RY"}) {
        Imf::Header header = makeHeader({"R", "G", "B", "A"}, Imf::HALF, Imf::ZIP_COMPRESSION, even, even);
        if (channel[1] != 0) header = makeHeader({"Y", "BY"}, Imf::HALF, Imf::ZIP_COMPRESSION, even, even);
        header.channels().insert(channel, Imf::Channel(Imf::HALF, 4, 2));
        expectExrError(scanlines(header), "channel " + std::string(channel) + " is sampled 4 x 2, expected");
    }
}

TEST(ExrImage, LuminanceAndChroma)
{
    for (const Imf::RgbaChannels channels : {Imf::WRITE_YC, Imf::WRITE_YCA}) {
        const Box2i data(V2i(-2, 2), V2i(5, 7)), display(V2i(0, 0), V2i(7, 9));
        std::vector<Imf::Rgba> pixels;
        for (int y = 2; y <= 7; ++y)
            for (int x = -2; x <= 5; ++x) pixels.emplace_back(float(y), 0.5f * float(y), 0.25f * float(y), 0.75f);
        Sink sink;
        {
            Imf::RgbaOutputFile file(sink, Imf::Header(display, data), channels);
            file.setYCRounding(10, 10);  // all the digits of half
            file.setFrameBuffer(pixels.data() + 2 - 8 * 2, 1, 8);
            file.writePixels(6);
        }
        const ImageResult result = decodeExr(sink.text());
        ASSERT_TRUE(result.image.valid()) << result.error;
        ASSERT_EQ(result.image->getPixelFormat(), GLenum(channels == Imf::WRITE_YC ? GL_RGB : GL_RGBA));
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 8; ++x) {
                const bool inside = data.intersects(V2i(x, y));
                // The ratio of the channels is constant and so is chroma, which the subsampling then keeps: what remains is
                // rounding to half (2^-11 each) of luminance, two chromas and the result, with weights that divide by 0.07.
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(at(*result.image, x, y)[c], inside ? std::ldexp(y, -c) : 0.0, 0.02 * y) << x << " " << y;
                if (channels == Imf::WRITE_YCA) {
                    EXPECT_EQ(at(*result.image, x, y)[3], inside ? 0.75f : 0.0f);
                }
            }
    }
}

TEST(ExrImage, TilesOfEveryModeAndOrder)
{
    const Imf::Header header = makeHeader(kRgba, Imf::FLOAT);
    for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS})
        for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y, Imf::RANDOM_Y}) {
            SCOPED_TRACE("mode " + std::to_string(mode) + ", order " + std::to_string(order));
            expectPattern(tiles(header, mode, order), kRgba);
        }
    Imf::Header decreasing = makeHeader(kRgb);
    decreasing.lineOrder() = Imf::DECREASING_Y;
    expectPattern(scanlines(decreasing), kRgb);
}

TEST(ExrImage, DataWindowInDisplayWindow)
{
    const Box2i display(V2i(-3, 5), V2i(8, 13));
    const Box2i datas[] = {{V2i(-3, 5), V2i(8, 13)},  {V2i(0, 7), V2i(2, 8)},    {V2i(-9, -1), V2i(0, 7)},
                           {V2i(6, 11), V2i(20, 20)}, {V2i(-10, 0), V2i(15, 6)}, {V2i(9, 5), V2i(12, 13)},
                           {V2i(-3, 14), V2i(8, 15)}, {V2i(-9, -9), V2i(-8, -8)}};
    for (const Box2i& data : datas) {
        SCOPED_TRACE(std::to_string(data.min.x) + " " + std::to_string(data.min.y));
        const Imf::Header header = makeHeader(kRgb, Imf::FLOAT, Imf::ZIP_COMPRESSION, data, display);
        expectPattern(scanlines(header), kRgb, data, display.min, {12, 9});
        expectPattern(tiles(header, Imf::MIPMAP_LEVELS), kRgb, data, display.min, {12, 9});
    }
    // More rows than are read at a time.
    const Box2i tall(V2i(0, -300), V2i(1, 400));
    expectPattern(scanlines(makeHeader(kGrey, Imf::FLOAT, Imf::PIZ_COMPRESSION, tall, tall)), kGrey, tall, tall.min, {2, 701});
}

TEST(ExrImage, FirstOfSeveralParts)
{
    std::vector<Imf::Header> headers = {makeHeader(kRgb), makeHeader({"Z"}, Imf::FLOAT)};
    for (std::size_t i = 0; i < 2; ++i) {
        headers[i].setName("part" + std::to_string(i));
        headers[i].setType(Imf::SCANLINEIMAGE);
    }
    const auto write = [&headers] {
        Sink sink;
        {
            Imf::MultiPartOutputFile file(sink, headers.data(), 2);
            for (int i = 1; i >= 0; --i) {
                const Plane plane(headers[static_cast<std::size_t>(i)]);
                Imf::OutputPart part(file, i);
                part.setFrameBuffer(plane.buffer());
                part.writePixels(plane.rows());
            }
        }
        return sink.text();
    };
    expectPattern(write(), kRgb);
    std::swap(headers[0], headers[1]);
    expectExrError(write(), "its channels are Z");
}

TEST(ExrImage, DeepDataIsRefused)
{
    Imf::Header header = makeHeader(kRgba, Imf::HALF, Imf::ZIPS_COMPRESSION);
    header.setType(Imf::DEEPSCANLINE);
    Sink sink;
    {
        std::vector<unsigned> counts(35, 0);
        std::vector<void*> samples(35, nullptr);
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 28));
        for (const std::string& name : kRgba)
            buffer.insert(name, Imf::DeepSlice(Imf::HALF, reinterpret_cast<char*>(samples.data()), 8, 56, 2));
        Imf::DeepScanLineOutputFile file(sink, header);
        file.setFrameBuffer(buffer);
        file.writePixels(5);
    }
    expectExrError(sink.text(), "of type \"deepscanline\", expected scanlineimage or tiledimage");
}

/** `text` with the bytes of the value of an attribute replaced, or of its size when `inSize`. */
std::string patched(std::string text, const std::string& nameAndType, const std::vector<std::int32_t>& values,
                    bool inSize = false)
{
    const std::size_t found = text.find(nameAndType);
    if (found == std::string::npos) throw std::logic_error("no such attribute");
    std::size_t at = found + nameAndType.size() + (inSize ? 0 : 4);
    for (const std::int32_t value : values)
        for (int shift = 0; shift < 32; shift += 8) text[at++] = static_cast<char>(static_cast<std::uint32_t>(value) >> shift);
    return text;
}

TEST(ExrImage, ClaimsThatTheFileCannotHoldAreRefusedBeforeAllocation)
{
    const std::string data("dataWindow\0box2i\0", 17), display("displayWindow\0box2i\0", 20), tile("tiles\0tiledesc\0", 15);
    for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c) {
        const std::string file = scanlines(makeHeader(kRgba, Imf::FLOAT, static_cast<Imf::Compression>(c)));
        // Some of these OpenEXR refuses first, as it misses the end of a table of so many chunks.
        for (const int side : {100000, 65536, 30000, 16384})
            expectExrError(patched(patched(file, data, {0, 0, side - 1, side - 1}), display, {0, 0, side - 1, side - 1}),
                           "test.exr: ");
        // DWA's limit is so far off that its decoder gets to say that the data ends.
        expectExrError(patched(file, data, {0, 0, 30000, 4}), c < Imf::DWAA_COMPRESSION ? "can hold" : "test.exr: ");
        expectExrError(patched(file, display, {0, 0, 99999, 99999}),
                       "display window of 100000 x 100000 pixels, expected 1 to 65536");
        expectExrError(patched(file, display, {0, 0, 32767, 16383}), "expected less than 2^32 bytes");
        expectExrError(patched(file, display, {0, 0, 8191, 8191}), "at most 64 times as many pixels");
    }
    const std::string tiled = tiles(makeHeader(kRgb), Imf::ONE_LEVEL);
    for (const int side : {0, 1 << 15, 1 << 30, -1}) expectExrError(patched(tiled, tile, {side, side}), "test.exr: ");
    expectExrError(patched(tiled, tile, {1 << 13, 1 << 13}), "expected tiles no larger than the image");
    for (const std::vector<std::int32_t>& window : {std::vector{0, 0, -1, -1}, {5, 0, 4, 4}, {-2147483647, 0, 2147483647, 1}})
        for (const std::string& name : {data, display}) expectExrError(patched(tiled, name, window), "window");
}

TEST(ExrImage, AttributeSizesAreCheckedBeforeAllocation)
{
    Imf::Header header = makeHeader(kRgb);
    header.insert("note", Imf::StringAttribute("text"));
    const std::string file = scanlines(header);
    expectPattern(file, kRgb);
    const std::string names[] = {std::string("note\0string\0", 12), std::string("channels\0chlist\0", 16),
                                 std::string("dataWindow\0box2i\0", 17), std::string("compression\0compression\0", 24)};
    // A string or an unknown type may have any size that the file has room for.
    for (const std::string& name : names)
        for (const std::int32_t size : {0x7fffffff, -1, 100000, 5, 0}) {
            if (name == names[0] && size >= 0 && size <= 5) continue;
            expectExrError(patched(file, name, {size}, true), "test.exr: ");
        }
}

TEST(ExrImage, EveryTruncationIsAnError)
{
    for (const std::string& whole :
         {scanlines(makeHeader(kRgb, Imf::HALF, Imf::PIZ_COMPRESSION)), tiles(makeHeader(kGrey), Imf::ONE_LEVEL)})
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const ImageResult result = decodeExr(whole.substr(0, size));
            expectImageOrError(result);
            ASSERT_FALSE(result.image.valid()) << size << " of " << whole.size();
        }
}

TEST(ExrImage, EveryDamagedByteGivesAnImageOrAnError)
{
    int refused = 0;
    for (const Imf::Compression compression :
         {Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::DWAA_COMPRESSION})
        for (const std::string& whole : {scanlines(makeHeader(kRgb, Imf::HALF, compression)),
                                         tiles(makeHeader(kGrey, Imf::FLOAT, compression), Imf::MIPMAP_LEVELS)})
            for (std::size_t i = 0; i < whole.size(); ++i)
                for (const int flip : {0x01, 0x10, 0x80, 0xff}) {
                    std::string damaged = whole;
                    damaged[i] = static_cast<char>(damaged[i] ^ flip);
                    const ImageResult result = decodeExr(damaged);
                    expectImageOrError(result);
                    refused += result.image ? 0 : 1;
                }
    EXPECT_GT(refused, 0);
}

TEST(ExrImage, AMissingChunkIsAnError)
{
    std::string file = scanlines(makeHeader(kRgb, Imf::HALF, Imf::NO_COMPRESSION));
    // The table of five offsets ends where its first entry points.
    std::size_t table = 0;
    std::uint64_t first = 0;
    for (; first != table + 40 && table + 48 < file.size();) std::memcpy(&first, &file[++table], sizeof first);
    ASSERT_EQ(first, table + 40);
    file.replace(table + 16, 8, 8, '\0');
    expectExrError(file, "missing");
}

TEST(ExrImage, NotAnExrFile)
{
    expectExrError("", "it is empty or cannot be read");
    for (const std::string& text :
         {std::string("v"), std::string("garbage"), std::string(5000, '\0'), std::string("#?RADIANCE\n")})
        expectExrError(text, "it does not start with 76 2f 31 01");
    std::ifstream directory(std::filesystem::temp_directory_path(), std::ios::binary);
    std::string error;
    EXPECT_FALSE(osgEnvLight::readExr(directory, "", error).valid());
    EXPECT_EQ(error, "stream: it is empty or cannot be read, expected an OpenEXR file");
}

TEST(ExrImage, AnyStreamAnyThreadAnyLocale)
{
    class Comma : public std::numpunct<char>
    {
        char do_decimal_point() const override { return ','; }
        std::string do_grouping() const override { return "\1"; }
    };
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
    expectExrError(patched(scanlines(makeHeader(kRgb)), std::string("displayWindow\0box2i\0", 20), {0, 0, 99999, 0}),
                   "of 100000 x 1 ");

    const std::string file = "before" + scanlines(makeHeader(kRgb, Imf::FLOAT, Imf::PIZ_COMPRESSION));
    std::vector<std::string> failures(4, "not run");
    std::vector<std::thread> threads;
    for (std::string& failure : failures)
        threads.emplace_back([&failure, &file] {
            failure.clear();
            for (int i = 0; i < 50 && failure.empty(); ++i) {
                std::istringstream in(file);
                in.ignore(6);  // the picture starts where the stream stands
                const osg::ref_ptr<osg::Image> image = osgEnvLight::readExr(in, "", failure);
                if (image && at(*image, 6, 4)[1] != pattern("G", 6, 4)) failure = "wrong value";
            }
        });
    for (std::thread& thread : threads) thread.join();
    for (const std::string& failure : failures) EXPECT_EQ(failure, "");
    std::locale::global(before);
}

}  // namespace
