// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfPartType.h>
#include <ImfTileDescriptionAttribute.h>

/** What stands between a hostile file and OpenEXR: the library believes sizes that a file claims, and its own limits
 * (Imf::Header::setMaxImageSize) belong to the whole process, hence to the host. */
namespace osgEnvLight::exr
{

/** A file in memory, so that a claim can be held against the bytes that are there, and any std::istream will do. */
class MemoryStream : public Imf::IStream
{
  public:
    explicit MemoryStream(const std::vector<char>& data) : Imf::IStream(kName), data_(data) {}

    bool read(char c[], int n) override
    {
        const std::size_t count = static_cast<std::size_t>(std::max(n, 0));
        if (position_ > data_.size() || count > data_.size() - position_) throw std::runtime_error("the file ends early");
        std::memcpy(c, data_.data() + position_, count);
        position_ += count;
        return position_ < data_.size();
    }

    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }

    /** What OpenEXR calls the stream in its messages; the caller knows the name of the file. */
    static constexpr const char* kName = "stream";

  private:
    const std::vector<char>& data_;
    std::size_t position_ = 0;
};

/** Walks over the headers as OpenEXR will, and throws std::runtime_error where an attribute's size is not what its type
 * needs or exceeds the file: OpenEXR allocates what the size says before it reads. */
class HeaderWalk
{
  public:
    explicit HeaderWalk(const std::vector<char>& data) : data_(data.data(), data.size()) {}

    void check()
    {
        constexpr std::uint32_t multipart = 0x1000;
        take(4);
        const std::uint32_t version = number();
        if ((version & 0xff) != 2) fail("its version is " + std::to_string(version & 0xff) + ", expected 2");
        while (attributes() > 0 && (version & multipart) != 0) {
        }
    }

  private:
    [[noreturn]] static void fail(const std::string& what) { throw std::runtime_error(what); }

    std::string_view take(std::size_t size)
    {
        if (size > data_.size() - position_) fail("the file ends within its header");
        position_ += size;
        return data_.substr(position_ - size, size);
    }

    std::uint32_t number()
    {
        const std::string_view bytes = take(4);
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
        return value;
    }

    std::string text()
    {
        constexpr std::size_t longest = 255;
        const std::size_t size = data_.substr(position_, longest + 1).find('\0');
        if (size == std::string_view::npos) fail("the header has a name without an end, expected at most 255 characters");
        const std::string_view found = take(size + 1);
        return std::string(found.substr(0, size));
    }

    /** One header; returns how many attributes it has. */
    int attributes()
    {
        for (int count = 0;; ++count) {
            const std::string name = text();
            if (name.empty()) return count;
            const std::string type = text();
            const std::size_t size = number();
            const std::size_t start = position_;
            if (type == "chlist")
                channelList();
            else
                take(bytesRead(type, size));
            if (position_ - start != size)
                fail("attribute \"" + name + "\" of type \"" + type + "\" has " + std::to_string(size) + " bytes, expected " +
                     std::to_string(position_ - start));
        }
    }

    void channelList()
    {
        constexpr std::size_t channel = 16;
        while (!text().empty()) take(channel);
    }

    /** How many bytes OpenEXR 3.1 reads for an attribute of this type that claims `size`. */
    static std::size_t bytesRead(const std::string& type, std::size_t size)
    {
        static const std::map<std::string, std::size_t> fixed = {{"box2i", 16},
                                                                 {"box2f", 16},
                                                                 {"chromaticities", 32},
                                                                 {"compression", 1},
                                                                 {"deepImageState", 1},
                                                                 {"double", 8},
                                                                 {"envmap", 1},
                                                                 {"float", 4},
                                                                 {"int", 4},
                                                                 {"keycode", 28},
                                                                 {"lineOrder", 1},
                                                                 {"m33f", 36},
                                                                 {"m33d", 72},
                                                                 {"m44f", 64},
                                                                 {"m44d", 128},
                                                                 {"rational", 8},
                                                                 {"tiledesc", 9},
                                                                 {"timecode", 8},
                                                                 {"v2i", 8},
                                                                 {"v2f", 8},
                                                                 {"v2d", 16},
                                                                 {"v3i", 12},
                                                                 {"v3f", 12},
                                                                 {"v3d", 24}};
        if (type == "idmanifest") fail("it has an attribute of type \"idmanifest\", whose length OpenEXR 3.1 misreads");
        if (type == "floatvector") return size / 4 * 4;
        const auto known = fixed.find(type);
        return known == fixed.end() ? size : known->second;
    }

    std::string_view data_;
    std::size_t position_ = 0;
};

/** The most bytes of pixels that one byte of a file can hold: runs of 128 in two bytes (RLE), deflate's limit of 1032 (ZIP;
 * times 4/3 for the byte that PXR24 drops), runs of 255 shorts in nine bits (PIZ), a 4 x 4 block of halves in three bytes
 * (B44A), and for DWA deflated 8 x 8 blocks of floats without detail. */
inline double mostPixelBytes(Imf::Compression compression)
{
    switch (compression) {
        case Imf::NO_COMPRESSION:
            return 1.0;
        case Imf::RLE_COMPRESSION:
            return 64.0;
        case Imf::B44_COMPRESSION:
        case Imf::B44A_COMPRESSION:
            return 12.0;
        case Imf::PIZ_COMPRESSION:
            return 512.0;
        case Imf::ZIPS_COMPRESSION:
        case Imf::ZIP_COMPRESSION:
            return 1032.0;
        case Imf::PXR24_COMPRESSION:
            return 1376.0;
        default:
            return 131072.0;
    }
}

inline std::string sizeText(const Imath::Box2i& window)
{
    const auto side = [](int low, int high) { return std::to_string(std::int64_t(high) - low + 1); };
    return side(window.min.x, window.max.x) + " x " + side(window.min.y, window.max.y);
}

/** Pixels of a window; 0 unless both sides are 1 to 65536. */
inline double area(const Imath::Box2i& window)
{
    constexpr std::int64_t longest = 65536;
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    return width < 1 || height < 1 || width > longest || height > longest ? 0.0 : double(width) * double(height);
}

/** Throws std::runtime_error unless the pixels that `header` describes can be in a file of `fileSize` bytes, and neither
 * the image of `components` floats a pixel nor OpenEXR's buffers for one chunk outgrow them beyond reason. */
inline void checkSizes(const Imf::Header& header, int components, std::size_t fileSize)
{
    const auto fail = [](const std::string& what) { throw std::runtime_error(what); };
    const Imath::Box2i& data = header.dataWindow();
    const Imath::Box2i& display = header.displayWindow();
    for (const Imath::Box2i* window : {&data, &display})
        if (area(*window) == 0.0)
            fail(std::string(window == &data ? "data" : "display") + " window of " + sizeText(*window) +
                 " pixels, expected 1 to 65536 a side");

    // osg::Image counts its bytes in 32 bits.
    if (area(display) * components * sizeof(float) >= 4294967296.0)
        fail("display window of " + sizeText(display) + " pixels, expected less than 2^32 bytes of image");
    // A frame around a crop is fine; gigabytes of nothing are not.
    if (area(display) > std::max(16777216.0, 64.0 * area(data)))
        fail("display window of " + sizeText(display) + " pixels around a data window of " + sizeText(data) +
             ", expected at most 64 times as many pixels");

    double pixelBytes = 0.0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        pixelBytes += (c.channel().type == Imf::HALF ? 2.0 : 4.0) / c.channel().xSampling / c.channel().ySampling;
    const double imageBytes = area(data) * pixelBytes;
    if (imageBytes > mostPixelBytes(header.compression()) * static_cast<double>(fileSize))
        fail("data window of " + sizeText(data) + " pixels, more than a file of " + std::to_string(fileSize) + " bytes can hold");

    // OpenEXR keeps a row of tiles, and whole tiles even where the image is smaller.
    if (header.hasTileDescription() && Imf::isTiled(header.type())) {
        const Imf::TileDescription& tile = header.tileDescription();
        const double row = std::max(double(tile.xSize), area(data) / (double(data.max.y) - data.min.y + 1.0));
        if (row * tile.ySize * pixelBytes > std::max(268435456.0, imageBytes))
            fail("tiles of " + std::to_string(tile.xSize) + " x " + std::to_string(tile.ySize) + " pixels for a data window of " +
                 sizeText(data) + ", expected tiles no larger than the image");
    }
}

}  // namespace osgEnvLight::exr
