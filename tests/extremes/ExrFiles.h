// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>

/** OpenEXR files in memory for the tests, by OpenEXR's own writers. Values of the pattern are exact in half, so that every
 * lossless path must give them back exactly. */
namespace exrfiles
{

using Imath::Box2i;
using Imath::V2i;
using Names = std::vector<std::string>;

class Sink : public Imf::OStream
{
  public:
    Sink() : Imf::OStream("sink") {}
    void write(const char c[], int n) override { out_.write(c, n); }
    uint64_t tellp() override { return static_cast<uint64_t>(out_.tellp()); }
    void seekp(uint64_t position) override { out_.seekp(static_cast<std::streamoff>(position)); }
    std::string text() const { return out_.str(); }

  private:
    std::ostringstream out_;
};

class Source : public Imf::IStream
{
  public:
    explicit Source(const std::string& text) : Imf::IStream("source"), in_(text) {}
    bool read(char c[], int n) override { return static_cast<bool>(in_.read(c, n)) && in_.peek() != EOF; }
    uint64_t tellg() override { return static_cast<uint64_t>(in_.tellg()); }
    void seekg(uint64_t position) override { in_.clear(), in_.seekg(static_cast<std::streamoff>(position)); }

  private:
    std::istringstream in_;
};

/** The value of a channel at a pixel of the display window's coordinates, which may be negative. */
inline float pattern(const std::string& channel, int x, int y)
{
    return static_cast<float>(64 + x + 16 * y) + static_cast<float>(channel[0] % 8) / 8.0f;
}

/** A frame buffer of one type that holds the pattern for all channels and the whole data window. */
class Plane
{
  public:
    explicit Plane(const Imf::Header& header) : window_(header.dataWindow())
    {
        const auto width = static_cast<std::size_t>(window_.max.x - window_.min.x + 1);
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
            const Imf::Channel& channel = c.channel();
            auto& cells = storage_.emplace_back();
            for (int y = window_.min.y; y <= window_.max.y; y += channel.ySampling)
                for (int x = window_.min.x; x <= window_.max.x; x += channel.xSampling)
                    cells.push_back(cell(channel.type, pattern(c.name(), x, y)));
            const std::size_t row = width / static_cast<std::size_t>(channel.xSampling) * 4;
            buffer_.insert(c.name(), Imf::Slice::Make(channel.type, cells.data(), window_.min, int64_t(width), int64_t(1),
                                                      size_t(4), row, channel.xSampling, channel.ySampling));
        }
    }

    const Imf::FrameBuffer& buffer() const { return buffer_; }
    int rows() const { return window_.max.y - window_.min.y + 1; }

  private:
    static std::uint32_t cell(Imf::PixelType type, float value)
    {
        std::uint32_t bits = type == Imf::UINT ? static_cast<std::uint32_t>(value) : type == Imf::HALF ? half(value).bits() : 0u;
        if (type == Imf::FLOAT) std::memcpy(&bits, &value, sizeof bits);
        return bits;
    }

    Box2i window_;
    std::vector<std::vector<std::uint32_t>> storage_;
    Imf::FrameBuffer buffer_;
};

inline Imf::Header makeHeader(const Names& names, Imf::PixelType type = Imf::HALF,
                              Imf::Compression compression = Imf::ZIP_COMPRESSION, Box2i data = {V2i(0, 0), V2i(6, 4)},
                              Box2i display = {V2i(0, 0), V2i(6, 4)})
{
    Imf::Header header(display, data);
    header.compression() = compression;
    for (const std::string& name : names) header.channels().insert(name, Imf::Channel(type));
    return header;
}

inline std::string scanlines(const Imf::Header& header)
{
    Sink sink;
    {
        const Plane plane(header);
        Imf::OutputFile file(sink, header);
        file.setFrameBuffer(plane.buffer());
        file.writePixels(plane.rows());
    }
    return sink.text();
}

inline std::string tiles(Imf::Header header, Imf::LevelMode mode, Imf::LineOrder order = Imf::INCREASING_Y)
{
    header.setTileDescription(Imf::TileDescription(4, 3, mode));
    header.lineOrder() = order;
    Sink sink;
    {
        const Plane plane(header);
        Imf::TiledOutputFile file(sink, header);
        file.setFrameBuffer(plane.buffer());
        for (int y = 0; y < file.numYLevels(); ++y)
            for (int x = 0; x < file.numXLevels(); ++x)
                if (file.isValidLevel(x, y))
                    for (int row = file.numYTiles(y); row-- > 0;) file.writeTiles(0, file.numXTiles(x) - 1, row, row, x, y);
    }
    return sink.text();
}

}  // namespace exrfiles
