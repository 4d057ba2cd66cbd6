// SPDX-License-Identifier: MIT
#include "environment/RadianceHdr.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <osg/Texture>

namespace osgEnvLight
{
namespace
{

using Rgbe = std::array<std::uint8_t, 4>;

constexpr int kMaxSide = 65536;
constexpr std::int64_t kMaxPixels = std::int64_t(1) << 28;

[[noreturn]] void fail(const std::string& what)
{
    throw std::runtime_error(what);
}

/** Text from a file, made fit for a one-line message: shortened, and without control characters. */
std::string quoted(std::string_view text)
{
    std::string shown(text.substr(0, 60));
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < 32) c = '?';
    return "\"" + shown + "\"";
}

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view space = " \t\r";
    const std::size_t first = text.find_first_not_of(space);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(space) - first + 1);
}

/** Takes the word before the next white space off the front of `text`. */
std::string_view nextWord(std::string_view& text)
{
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    text.remove_prefix(word.size());
    return word;
}

/** A factor of EXPOSURE or COLORCORR. std::from_chars knows no locale. */
double parseFactor(std::string_view word, std::string_view key)
{
    const bool exposure = key == "EXPOSURE";
    const std::string_view digits = word.substr(word.substr(0, 1) == "+" ? 1 : 0);
    double value = 0.0;
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool number = status == std::errc() && end == digits.data() + digits.size() && std::isfinite(value);
    if (!number || value < 0.0 || (value == 0.0 && !exposure))
        fail(std::string(key) + " is " + quoted(word) + ", expected a positive number");
    // FreeImage writes an exposure of 0 where it knows none.
    return value == 0.0 ? 1.0 : value;
}

struct Header {
    bool xyz = false;
    std::array<double, 3> correction{1.0, 1.0, 1.0};  // stored value = correction * radiance
    int width = 0;
    int height = 0;
    bool columns = false;  // a "scanline" is a column of the picture
    bool rightToLeft = false;
    bool bottomUp = false;

    int scanlines() const { return columns ? width : height; }
    int scanlineLength() const { return columns ? height : width; }
};

class Bytes
{
  public:
    explicit Bytes(const std::vector<char>& data) : data_(data) {}

    std::size_t left() const { return data_.size() - position_; }

    std::uint8_t next()
    {
        if (left() == 0) fail("the data ends");
        return static_cast<std::uint8_t>(data_[position_++]);
    }

    Rgbe nextPixel()
    {
        if (left() < 4) fail("the data ends");
        const auto* p = reinterpret_cast<const std::uint8_t*>(data_.data()) + position_;
        position_ += 4;
        return {p[0], p[1], p[2], p[3]};
    }

    /** The four bytes ahead, without taking them; zeros where there are fewer. */
    Rgbe peekPixel() const
    {
        Rgbe pixel{};
        for (std::size_t i = 0; i < 4 && i < left(); ++i) pixel[i] = static_cast<std::uint8_t>(data_[position_ + i]);
        return pixel;
    }

    std::string_view nextLine()
    {
        const std::string_view rest(data_.data() + position_, left());
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos) fail("the header ends early, expected an empty line and the resolution");
        position_ += end + 1;
        return trimmed(rest.substr(0, end));
    }

  private:
    const std::vector<char>& data_;
    std::size_t position_ = 0;
};

void parseFormat(std::string_view value, Header& header)
{
    header.xyz = value == "32-bit_rle_xyze";
    if (!header.xyz && value != "32-bit_rle_rgbe")
        fail("FORMAT is " + quoted(value) + ", expected 32-bit_rle_rgbe or 32-bit_rle_xyze");
}

void parseCorrection(std::string_view value, std::string_view key, Header& header)
{
    const bool exposure = key == "EXPOSURE";
    const double all = exposure ? parseFactor(nextWord(value), key) : 1.0;
    for (double& factor : header.correction) {
        factor *= exposure ? all : parseFactor(nextWord(value), key);
        if (factor < 1e-30 || factor > 1e30) fail("the product of all " + std::string(key) + " lines is beyond 1e-30 to 1e30");
    }
    if (!trimmed(value).empty()) fail(std::string(key) + " has too many numbers: " + quoted(value));
}

void parseVariables(Bytes& bytes, Header& header)
{
    for (std::string_view line = bytes.nextLine(); !line.empty(); line = bytes.nextLine()) {
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos || line[0] == '#') continue;
        const std::string_view key = trimmed(line.substr(0, equals));
        const std::string_view value = trimmed(line.substr(equals + 1));
        if (key == "FORMAT") parseFormat(value, header);
        if (key == "EXPOSURE" || key == "COLORCORR") parseCorrection(value, key, header);
    }
}

int parseSide(std::string_view word)
{
    int side = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), side);
    const bool number = end == word.data() + word.size() && !word.empty() && status != std::errc::invalid_argument;
    if (!number || status != std::errc() || side < 1 || side > kMaxSide)
        fail("the resolution has " + quoted(word) + ", expected a whole number from 1 to " + std::to_string(kMaxSide));
    return side;
}

void parseResolution(std::string_view line, Header& header)
{
    std::string_view rest = line;
    for (int axis = 0; axis < 2; ++axis) {
        const std::string_view word = nextWord(rest);
        const bool known = word == "-Y" || word == "+Y" || word == "-X" || word == "+X";
        const bool isX = known && word[1] == 'X';
        if (!known || (isX ? header.width : header.height) != 0)
            fail("the resolution is " + quoted(line) + ", expected the form \"-Y height +X width\"");
        (isX ? header.width : header.height) = parseSide(nextWord(rest));
        (isX ? header.rightToLeft : header.bottomUp) = isX ? word[0] == '-' : word[0] == '+';
        if (axis == 0) header.columns = isX;
    }
    if (!trimmed(rest).empty()) fail("the resolution is " + quoted(line) + ", expected nothing after the second number");
    if (std::int64_t(header.width) * header.height > kMaxPixels)
        fail("the resolution is " + quoted(line) + ", expected at most 2^28 pixels");
}

bool mayBeNewRunLength(int length)
{
    return length >= 8 && length <= 32767;
}

/** The fewest bytes in which any scanline of this length can be written. */
std::int64_t leastBytes(int length)
{
    std::int64_t least = std::int64_t(length) * 4;
    // Old runs: a pixel, then repeat counts of 8 bits more each.
    std::int64_t old = 4;
    for (std::int64_t covered = 1, unit = 255; covered < length; covered += unit, unit *= 256) old += 4;
    least = std::min(least, old);
    // New runs: four marker bytes, then two bytes for at most 127 values of one component.
    if (mayBeNewRunLength(length)) least = std::min<std::int64_t>(least, 4 + 4 * 2 * ((length + 126) / 127));
    return least;
}

Header parseHeader(Bytes& bytes)
{
    Header header;
    bytes.nextLine();
    parseVariables(bytes, header);
    parseResolution(bytes.nextLine(), header);
    // Before any memory for the pixels is asked for.
    const std::int64_t least = leastBytes(header.scanlineLength());
    const auto left = static_cast<std::int64_t>(bytes.left());
    if (left / least < header.scanlines())
        fail("the data ends in or before scanline " + std::to_string(left / least) + " of " + std::to_string(header.scanlines()) +
             ": " + std::to_string(left) + " bytes are there, expected " + std::to_string(least * header.scanlines()) +
             " or more");
    return header;
}

void readNewRunLength(Bytes& bytes, std::vector<Rgbe>& scanline)
{
    for (std::size_t component = 0; component < 4; ++component) {
        for (std::size_t i = 0; i < scanline.size();) {
            const std::size_t code = bytes.next();
            const bool run = code > 128;
            const std::size_t count = run ? code - 128 : code;
            if (count == 0 || count > scanline.size() - i)
                fail("a run of " + std::to_string(count) + " values, expected 1 to " + std::to_string(scanline.size() - i));
            const std::uint8_t value = run ? bytes.next() : std::uint8_t(0);
            for (const std::size_t end = i + count; i < end; ++i) scanline[i][component] = run ? value : bytes.next();
        }
    }
}

/** Flat pixels, among which (1, 1, 1, n) repeats the pixel before it n times; in a row of such, each n weighs 256 times more. */
void readFlatOrOldRunLength(Bytes& bytes, std::vector<Rgbe>& scanline)
{
    unsigned shift = 0;
    for (std::size_t i = 0; i < scanline.size();) {
        const Rgbe pixel = bytes.nextPixel();
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            scanline[i++] = pixel;
            shift = 0;
            continue;
        }
        if (i == 0) fail("a repeat count first, expected a pixel to repeat");
        if (shift > 24) fail("a repeat count of more than 32 bits");
        const std::size_t count = std::size_t(pixel[3]) << shift;
        if (count > scanline.size() - i)
            fail("a run of " + std::to_string(count) + " pixels, expected at most " + std::to_string(scanline.size() - i));
        const Rgbe last = scanline[i - 1];
        std::fill_n(scanline.begin() + static_cast<std::ptrdiff_t>(i), count, last);
        i += count;
        shift += 8;
    }
}

void readScanline(Bytes& bytes, std::vector<Rgbe>& scanline)
{
    const Rgbe marker = bytes.peekPixel();
    if (!mayBeNewRunLength(static_cast<int>(scanline.size())) || marker[0] != 2 || marker[1] != 2 || marker[2] > 127)
        return readFlatOrOldRunLength(bytes, scanline);
    const std::size_t length = bytes.nextPixel()[2] * std::size_t(256) + marker[3];
    if (length != scanline.size())
        fail("it claims " + std::to_string(length) + " pixels, expected " + std::to_string(scanline.size()));
    readNewRunLength(bytes, scanline);
}

class Decoder
{
  public:
    explicit Decoder(const Header& header) : xyz_(header.xyz), correction_(header.correction)
    {
        for (int exponent = 1; exponent < 256; ++exponent)
            scale_[static_cast<std::size_t>(exponent)] = std::ldexp(1.0, exponent - 136);
    }

    void decode(const Rgbe& pixel, float* rgb) const
    {
        // In double: a correction may lift a value beyond float, and infinities would make NaN of XYZ.
        Triple v{};
        for (std::size_t i = 0; i < 3; ++i) v[i] = pixel[i] * scale_[pixel[3]] / correction_[i];
        for (std::size_t i = 0; i < 3; ++i) rgb[i] = toFloat(xyz_ ? dot(kRec709[i], v) : v[i]);
    }

  private:
    using Triple = std::array<double, 3>;

    static double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

    static float toFloat(double value)
    {
        constexpr double most = std::numeric_limits<float>::max();
        return static_cast<float>(std::clamp(value, -most, most));
    }

    // CIE XYZ to linear Rec.709 with white D65 (ITU-R BT.709, IEC 61966-2-1).
    static constexpr std::array<Triple, 3> kRec709{{{3.2404541621, -1.5371385128, -0.4985314096},
                                                    {-0.9692660305, 1.8760108454, 0.0415560175},
                                                    {0.0556434310, -0.2040259135, 1.0572251882}}};
    bool xyz_;
    Triple correction_;
    std::array<double, 256> scale_{};
};

osg::ref_ptr<osg::Image> readPixels(Bytes& bytes, const Header& header)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(header.width, header.height, 1, GL_RGB, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGB32F_ARB);

    const Decoder decoder(header);
    std::vector<Rgbe> scanline(static_cast<std::size_t>(header.scanlineLength()));
    for (int s = 0; s < header.scanlines(); ++s) {
        try {
            readScanline(bytes, scanline);
        } catch (const std::runtime_error& e) {
            fail("scanline " + std::to_string(s) + " of " + std::to_string(header.scanlines()) + ": " + e.what());
        }
        for (int i = 0; i < header.scanlineLength(); ++i) {
            const int x = header.columns ? s : i;
            const int y = header.columns ? i : s;
            auto* rgb = reinterpret_cast<float*>(image->data(static_cast<unsigned>(header.rightToLeft ? header.width - 1 - x : x),
                                                             static_cast<unsigned>(header.bottomUp ? y : header.height - 1 - y)));
            decoder.decode(scanline[static_cast<std::size_t>(i)], rgb);
        }
    }
    return image;
}

/** The whole stream, or an error from its first two bytes on: an endless stream of something else is not read. */
std::vector<char> readAll(std::istream& in)
{
    std::vector<char> data(2);
    in.read(data.data(), 2);
    if (in.gcount() == 0) fail("it is empty or cannot be read, expected a Radiance picture");
    if (in.gcount() < 2 || data[0] != '#' || data[1] != '?') fail("it does not start with \"#?\", expected a Radiance picture");
    constexpr std::size_t block = 1 << 16;
    while (in) {
        const std::size_t size = data.size();
        data.resize(size + block);
        in.read(data.data() + size, block);
        data.resize(size + static_cast<std::size_t>(in.gcount()));
    }
    if (in.bad()) fail("it cannot be read to its end");
    return data;
}

}  // namespace

osg::ref_ptr<osg::Image> readRadianceHdr(std::istream& in, const std::string& name, std::string& error)
{
    const std::string prefix = (name.empty() ? std::string("stream") : name) + ": ";
    error.clear();
    try {
        const std::vector<char> data = readAll(in);
        Bytes bytes(data);
        const Header header = parseHeader(bytes);
        return readPixels(bytes, header);
    } catch (const std::bad_alloc&) {
        error = prefix + "not enough memory for the picture";
    } catch (const std::exception& e) {
        error = prefix + e.what();
    }
    return nullptr;
}

}  // namespace osgEnvLight
