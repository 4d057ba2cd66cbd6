// SPDX-License-Identifier: MIT
// The Radiance reader against pictures encoded here by hand, byte by byte, and against every kind of damage.
#include "environment/RadianceHdr.h"

#include <array>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "ImageResult.h"

#include <gtest/gtest.h>

namespace
{

using Rgbe = std::array<std::uint8_t, 4>;

ImageResult decodeHdr(const std::string& text)
{
    std::istringstream in(text);
    ImageResult result{"test.hdr", nullptr, ""};
    result.image = osgEnvLight::readRadianceHdr(in, result.file, result.error);
    return result;
}

void expectHdrError(const std::string& text, const std::string& part)
{
    expectError(decodeHdr(text), part);
}

const float* at(const ImageResult& result, int x, int fromTop)
{
    const auto row = static_cast<unsigned>(result.image->t() - 1 - fromTop);
    return reinterpret_cast<const float*>(result.image->data(static_cast<unsigned>(x), row));
}

void expectPixel(const ImageResult& result, int x, int fromTop, const Rgbe& stored)
{
    const float* rgb = at(result, x, fromTop);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(rgb[i], stored[3] == 0 ? 0.0f : std::ldexp(static_cast<float>(stored[i]), stored[3] - 136))
            << "x " << x << ", y " << fromTop << ", component " << i;
}

std::string bytes(std::initializer_list<int> values)
{
    std::string text;
    for (const int value : values) text += static_cast<char>(value);
    return text;
}

std::string bytes(const Rgbe& p)
{
    return bytes({p[0], p[1], p[2], p[3]});
}

using Scanline = std::vector<Rgbe>;
using Encoder = std::function<std::string(const Scanline&)>;

std::string flat(const Scanline& scanline)
{
    std::string text;
    for (const Rgbe& pixel : scanline) text += bytes(pixel);
    return text;
}

/** Every pixel that equals the one before it becomes a repeat count of one. */
std::string oldRuns(const Scanline& scanline)
{
    std::string text;
    for (std::size_t i = 0; i < scanline.size(); ++i) {
        const bool repeat = i % 2 == 1 && scanline[i] == scanline[i - 1];
        text += repeat ? bytes({1, 1, 1, 1}) : bytes(scanline[i]);
    }
    return text;
}

/** Each component as one literal of three, a run where the fourth and fifth are equal, and literals of one. */
std::string newRuns(const Scanline& scanline)
{
    std::string text = bytes({2, 2, static_cast<int>(scanline.size() / 256), static_cast<int>(scanline.size() % 256)});
    for (std::size_t c = 0; c < 4; ++c) {
        text += bytes({3, scanline[0][c], scanline[1][c], scanline[2][c]});
        std::size_t i = 3;
        if (scanline[3][c] == scanline[4][c]) {
            text += bytes({128 + 2, scanline[3][c]});
            i = 5;
        }
        for (; i < scanline.size(); ++i) text += bytes({1, scanline[i][c]});
    }
    return text;
}

constexpr int kWidth = 9;
constexpr int kHeight = 8;

/** No two pixels alike, except that the fourth and fifth of a row, or of a column, share some components. */
Rgbe pixelOf(int x, int fromTop)
{
    return {static_cast<std::uint8_t>(128 + x), static_cast<std::uint8_t>(70 + fromTop),
            static_cast<std::uint8_t>(10 * x + fromTop), static_cast<std::uint8_t>(126 + (x + fromTop) % 4)};
}

struct Orientation {
    const char* text;
    bool columns;
    int (*x)(int scanline, int i);
    int (*fromTop)(int scanline, int i);
};

constexpr int kRight = kWidth - 1, kBottom = kHeight - 1;
const Orientation kOrientations[] = {
    {"-Y 8 +X 9", false, [](int, int i) { return i; }, [](int s, int) { return s; }},
    {"-Y 8 -X 9", false, [](int, int i) { return kRight - i; }, [](int s, int) { return s; }},
    {"+Y 8 +X 9", false, [](int, int i) { return i; }, [](int s, int) { return kBottom - s; }},
    {"+Y 8 -X 9", false, [](int, int i) { return kRight - i; }, [](int s, int) { return kBottom - s; }},
    {"+X 9 -Y 8", true, [](int s, int) { return s; }, [](int, int i) { return i; }},
    {"-X 9 -Y 8", true, [](int s, int) { return kRight - s; }, [](int, int i) { return i; }},
    {"+X 9 +Y 8", true, [](int s, int) { return s; }, [](int, int i) { return kBottom - i; }},
    {"-X 9 +Y 8", true, [](int s, int) { return kRight - s; }, [](int, int i) { return kBottom - i; }},
};

std::string encode(const Orientation& orientation, const Encoder& encoder)
{
    std::string text = std::string("#?RADIANCE\n# made by a test\nFORMAT=32-bit_rle_rgbe\n\n") + orientation.text + "\n";
    for (int s = 0; s < (orientation.columns ? kWidth : kHeight); ++s) {
        Scanline scanline;
        for (int i = 0; i < (orientation.columns ? kHeight : kWidth); ++i)
            scanline.push_back(pixelOf(orientation.x(s, i), orientation.fromTop(s, i)));
        text += encoder(scanline);
    }
    return text;
}

/** A file of one scanline. */
std::string oneLine(const std::string& variables, int width, const std::string& pixels)
{
    return "#?RADIANCE\n" + variables + "\n-Y 1 +X " + std::to_string(width) + "\n" + pixels;
}

TEST(RadianceHdr, EveryOrientationInEveryEncoding)
{
    for (const Orientation& orientation : kOrientations)
        for (const Encoder& encoder : {Encoder(flat), Encoder(oldRuns), Encoder(newRuns)}) {
            SCOPED_TRACE(orientation.text);
            const ImageResult result = decodeHdr(encode(orientation, encoder));
            ASSERT_TRUE(result.image.valid()) << result.error;
            ASSERT_EQ(result.image->s(), kWidth);
            ASSERT_EQ(result.image->t(), kHeight);
            EXPECT_EQ(result.image->getPixelFormat(), GLenum(GL_RGB));
            EXPECT_EQ(result.image->getDataType(), GLenum(GL_FLOAT));
            for (int y = 0; y < kHeight; ++y)
                for (int x = 0; x < kWidth; ++x) expectPixel(result, x, y, pixelOf(x, y));
        }
}

TEST(RadianceHdr, ExtremesOfTheExponent)
{
    const Scanline pixels = {{255, 255, 255, 255}, {200, 100, 50, 0}, {1, 0, 3, 1}, {128, 64, 32, 129}};
    const ImageResult result = decodeHdr(oneLine("", 4, flat(pixels)));
    ASSERT_TRUE(result.image.valid()) << result.error;
    for (int x = 0; x < 4; ++x) expectPixel(result, x, 0, pixels[static_cast<std::size_t>(x)]);
    const float red[] = {255.0f * 0x1p119f, 0.0f, 0x1p-135f, 1.0f};  // the third is subnormal
    for (int x = 0; x < 4; ++x) EXPECT_EQ(at(result, x, 0)[0], red[x]);
}

TEST(RadianceHdr, OldRepeatCountsOfOneAndSeveralBytes)
{
    const Rgbe a = {150, 20, 30, 128}, b = {160, 40, 50, 129};
    const std::string pixels = bytes(a) + bytes({1, 1, 1, 44, 1, 1, 1, 1}) +  // 44 + 1 * 256
                               bytes(b) + bytes({1, 1, 1, 2}) +               // a count after a pixel starts anew
                               bytes(a) + bytes({1, 1, 1, 0});                // a count of zero is none
    const ImageResult result = decodeHdr(oneLine("", 305, pixels));
    ASSERT_TRUE(result.image.valid()) << result.error;
    for (int x = 0; x < 305; ++x) expectPixel(result, x, 0, x > 300 && x < 304 ? b : a);

    const ImageResult wide = decodeHdr(oneLine("", 65536, bytes(a) + bytes({1, 1, 1, 255, 1, 1, 1, 255})));
    ASSERT_TRUE(wide.image.valid()) << wide.error;
    for (const int x : {0, 1, 256, 65535}) expectPixel(wide, x, 0, a);
}

TEST(RadianceHdr, LongestNewRunsAndLiterals)
{
    std::string pixels = bytes({2, 2, 1, 44});  // 300 = 127 + 128 + 45
    Scanline expected(300);
    for (std::size_t c = 0; c < 4; ++c) {
        pixels += bytes({128 + 127, 7 + static_cast<int>(c)}) + bytes({128});
        for (std::size_t i = 0; i < 300; ++i) expected[i][c] = static_cast<std::uint8_t>(i < 127 ? 7 + c : i < 255 ? i : 9);
        for (int i = 127; i < 255; ++i) pixels += bytes({i});
        pixels += bytes({128 + 45, 9});
    }
    const ImageResult result = decodeHdr(oneLine("", 300, pixels));
    ASSERT_TRUE(result.image.valid()) << result.error;
    for (int x = 0; x < 300; ++x) expectPixel(result, x, 0, expected[static_cast<std::size_t>(x)]);
}

TEST(RadianceHdr, ExposureAndColourCorrectionAreDividedOut)
{
    const std::string pixel = bytes({128, 64, 32, 129});  // 1, 1/2, 1/4
    const ImageResult result =
        decodeHdr(oneLine("EXPOSURE=2.5e0\r\nEXPOSURE = +4\nCOLORCORR= 1 2\t0.5\nVIEW=EXPOSURE\nCOLORCORR=1 1 1\n", 1, pixel));
    ASSERT_TRUE(result.image.valid()) << result.error;
    EXPECT_EQ(at(result, 0, 0)[0], 0.1f);
    EXPECT_EQ(at(result, 0, 0)[1], 0.025f);
    EXPECT_EQ(at(result, 0, 0)[2], 0.05f);

    const ImageResult bright = decodeHdr(oneLine("EXPOSURE=1e-30\n", 1, bytes({255, 255, 255, 255})));
    ASSERT_TRUE(bright.image.valid()) << bright.error;
    EXPECT_EQ(at(bright, 0, 0)[0], std::numeric_limits<float>::max()) << "beyond float: the largest, not infinity";
}

TEST(RadianceHdr, AnExposureOfZeroIsNone)
{
    for (const char* value : {"0", "0.0", "0.000000e+00"}) {
        const ImageResult result =
            decodeHdr(oneLine(std::string("EXPOSURE=") + value + "\nEXPOSURE=2\n", 1, bytes({128, 64, 32, 129})));
        ASSERT_TRUE(result.image.valid()) << value << ": " << result.error;
        EXPECT_EQ(at(result, 0, 0)[0], 0.5f) << value;
    }
}

/** CIE XYZ of a linear Rec.709 colour, from nothing but the chromaticities in ITU-R BT.709. */
std::array<double, 3> xyzOf(const float* rgb)
{
    const double xy[4][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};
    double column[4][3];
    for (int i = 0; i < 4; ++i) {
        column[i][0] = xy[i][0] / xy[i][1];
        column[i][1] = 1.0;
        column[i][2] = (1.0 - xy[i][0] - xy[i][1]) / xy[i][1];
    }
    const auto det = [](const double* a, const double* b, const double* c) {
        return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1]);
    };
    const double all = det(column[0], column[1], column[2]);
    const double luminance[3] = {det(column[3], column[1], column[2]) / all, det(column[0], column[3], column[2]) / all,
                                 det(column[0], column[1], column[3]) / all};
    std::array<double, 3> xyz{};
    for (std::size_t k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) xyz[k] += luminance[i] * rgb[i] * column[i][k];
    return xyz;
}

TEST(RadianceHdr, XyzBecomesRec709)
{
    for (const Rgbe stored :
         {Rgbe{243, 255, 255, 128}, Rgbe{40, 80, 20, 140}, Rgbe{200, 100, 30, 100}, Rgbe{128, 128, 128, 255}}) {
        const ImageResult result = decodeHdr(oneLine("FORMAT=32-bit_rle_xyze\n", 1, bytes(stored)));
        ASSERT_TRUE(result.image.valid()) << result.error;
        const std::array<double, 3> xyz = xyzOf(at(result, 0, 0));
        const double largest = std::ldexp(255.0, stored[3] - 136);
        // Published matrices differ in the fourth digit, as their white point is rounded.
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(xyz[i], std::ldexp(stored[i], stored[3] - 136), 5e-4 * largest);
    }
}

TEST(RadianceHdr, HeadersThatAreRefused)
{
    const auto resolution = [](const std::string& text) { return "#?RGBE\n\n" + text + "\n" + std::string(64, 'a'); };
    expectHdrError("", "empty");
    expectHdrError("#", "#?");
    expectHdrError("garbage", "#?");
    expectHdrError(std::string(1000, '\0'), "#?");
    expectHdrError("#?RADIANCE", "header ends early");
    expectHdrError("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "header ends early");
    expectHdrError("#?RADIANCE\n\n-Y 1 +X 1", "header ends early");
    expectHdrError("#?RADIANCE\nFORMAT=64-bit\n\n-Y 1 +X 1\nabcd", "FORMAT is \"64-bit\"");
    for (const char* value : {"", "abc", "-1", "nan", "inf", "1e999", "1,5", "1 2", "1e-300", "0x10"})
        expectHdrError(oneLine(std::string("EXPOSURE=") + value + "\n", 1, "abcd"), "EXPOSURE");
    for (const char* value : {"1 2", "0 0 0"})
        expectHdrError(oneLine(std::string("COLORCORR=") + value + "\n", 1, "abcd"), "COLORCORR");
    for (const char* text :
         {"-Y 0 +X 4", "-Y -2 +X 4", "-Y 4 +X", "-Y 1.5 +X 4", "-Y 99999999999999999999 +X 1", "-Y 65537 +X 1"})
        expectHdrError(resolution(text), "expected a whole number from 1 to 65536");
    for (const char* text : {"-Y 4 -Y 4", "-Z 4 +X 4", "4 4", "", "Y 4 X 4", "-Y 1 +X 1 junk"})
        expectHdrError(resolution(text), "resolution");
}

TEST(RadianceHdr, ClaimsThatTheDataCannotHoldAreRefusedBeforeAllocation)
{
    expectHdrError("#?RADIANCE\n\n-Y 100000 +X 100000\nabcd", "from 1 to 65536");
    expectHdrError("#?RADIANCE\n\n-Y 65536 +X 65536\nabcd", "2^28");
    for (const char* text : {"-Y 16384 +X 16384", "-Y 65536 +X 4096", "+X 32767 -Y 8000", "-Y 4096 +X 65536"})
        expectHdrError(std::string("#?RADIANCE\n\n") + text + "\n" + std::string(1000, 'a'),
                       "the data ends in or before scanline");
}

TEST(RadianceHdr, DamagedScanlinesAreNamed)
{
    const std::string two = "#?RADIANCE\n\n-Y 2 +X 8\n", line = bytes({2, 2, 0, 8, 136, 1, 136, 2, 136, 3, 136, 4});
    ASSERT_TRUE(decodeHdr(two + line + line).image.valid());
    const std::string more(64, '\x88');
    const std::string where = "scanline 1 of 2: ";
    expectHdrError(two + line + bytes({2, 2, 0, 9}) + more, where + "it claims 9 pixels, expected 8");
    expectHdrError(two + line + bytes({2, 2, 0, 8, 137, 1}) + more, where + "a run of 9 values, expected 1 to 8");
    expectHdrError(two + line + bytes({2, 2, 0, 8, 9}) + more, where + "a run of 9 values");
    expectHdrError(two + line + bytes({2, 2, 0, 8, 0}) + more, where + "a run of 0 values");
    expectHdrError(two + line + bytes({1, 1, 1, 3}) + more, where + "a repeat count first");
    expectHdrError(two + line + bytes({9, 9, 9, 9, 1, 1, 1, 8}) + more, where + "a run of 8 pixels, expected at most 7");
    expectHdrError(two + line + bytes({9, 9, 9, 9, 1, 1, 1, 0, 1, 1, 1, 1}) + more, where + "a run of 256 pixels");
    std::string shifts = bytes({9, 9, 9, 9});
    for (int i = 0; i < 5; ++i) shifts += bytes({1, 1, 1, 0});
    expectHdrError(two + line + shifts + more, where + "a repeat count of more than 32 bits");
    expectHdrError(two + line + line.substr(0, 11), where + "the data ends");
}

TEST(RadianceHdr, EveryTruncationIsAnError)
{
    for (const Encoder& encoder : {Encoder(flat), Encoder(oldRuns), Encoder(newRuns)}) {
        const std::string whole = encode(kOrientations[0], encoder);
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const ImageResult result = decodeHdr(whole.substr(0, size));
            expectImageOrError(result);
            ASSERT_FALSE(result.image.valid()) << size << " of " << whole.size();
            const bool inPixels = size >= whole.find("+X 9\n") + 5;
            EXPECT_EQ(result.error.find("scanline ") != std::string::npos, inPixels) << result.error;
        }
    }
}

TEST(RadianceHdr, EveryDamagedByteGivesAnImageOrAnError)
{
    for (const Encoder& encoder : {Encoder(oldRuns), Encoder(newRuns)}) {
        const std::string whole = encode(kOrientations[0], encoder);
        int refused = 0;
        for (std::size_t i = 0; i < whole.size(); ++i)
            for (int value = 0; value < 256; value += 3) {
                std::string damaged = whole;
                damaged[i] = static_cast<char>(value);
                const ImageResult result = decodeHdr(damaged);
                expectImageOrError(result);
                refused += result.image ? 0 : 1;
            }
        EXPECT_GT(refused, 0);
    }
}

/** A stream that can neither seek nor tell, as a pipe. */
class Pipe : public std::streambuf
{
  public:
    explicit Pipe(std::string text) : text_(std::move(text)) {}

  private:
    int_type underflow() override
    {
        if (next_ == text_.size()) return traits_type::eof();
        setg(&text_[next_], &text_[next_], &text_[next_] + 1);
        return traits_type::to_int_type(text_[next_++]);
    }

    std::string text_;
    std::size_t next_ = 0;
};

TEST(RadianceHdr, AnyStreamWillDo)
{
    Pipe pipe(encode(kOrientations[0], newRuns));
    std::istream in(&pipe);
    std::string error = "old";
    const osg::ref_ptr<osg::Image> image = osgEnvLight::readRadianceHdr(in, "", error);
    EXPECT_TRUE(image.valid());
    EXPECT_EQ(error, "");

    std::ifstream directory(std::filesystem::temp_directory_path(), std::ios::binary);
    EXPECT_FALSE(osgEnvLight::readRadianceHdr(directory, "", error).valid());
    EXPECT_EQ(error, "stream: it is empty or cannot be read, expected a Radiance picture");
}

TEST(RadianceHdr, NumbersIgnoreTheLocale)
{
    class Comma : public std::numpunct<char>
    {
        char do_decimal_point() const override { return ','; }
    };
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
    const std::string saved = std::setlocale(LC_ALL, nullptr);
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
        if (std::setlocale(LC_ALL, name)) break;
    const ImageResult result = decodeHdr(oneLine("EXPOSURE=2.5\n", 1, bytes({128, 64, 32, 129})));
    std::setlocale(LC_ALL, saved.c_str());
    std::locale::global(before);
    ASSERT_TRUE(result.image.valid()) << result.error;
    EXPECT_EQ(at(result, 0, 0)[0], 0.4f);
}

}  // namespace
