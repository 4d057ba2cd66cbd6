// SPDX-License-Identifier: MIT
#include "ExrImage.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <locale>
#include <new>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfThreading.h>

#include <osg/Texture>

#include "ExrGuard.h"

namespace osgEnvLight
{
namespace
{

[[noreturn]] void fail(const std::string& what)
{
    throw std::runtime_error(what);
}

/** The whole stream, or an error from its first four bytes on: an endless stream of something else is not read. */
std::vector<char> readAll(std::istream& in)
{
    constexpr char magic[4] = {0x76, 0x2f, 0x31, 0x01};
    std::vector<char> data(sizeof magic);
    in.read(data.data(), sizeof magic);
    if (in.gcount() == 0) fail("it is empty or cannot be read, expected an OpenEXR file");
    if (in.gcount() < 4 || !std::equal(data.begin(), data.end(), magic))
        fail("it does not start with 76 2f 31 01, expected an OpenEXR file");
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

/** Which channels of the file make the image. */
struct Selection {
    struct Channel {
        const char* name;
        int component;
    };
    std::vector<Channel> channels;
    int components = 0;
    bool grey = false;    // one channel stands for R, G and B
    bool chroma = false;  // Y RY BY
};

std::string channelNames(const Imf::ChannelList& list)
{
    constexpr int most = 16;
    std::string names;
    int count = 0;
    for (auto c = list.begin(); c != list.end() && count < most; ++c, ++count)
        names += std::string(count == 0 ? "" : " ") + c.name();
    return count == most ? names + " ..." : names;
}

Selection select(const Imf::ChannelList& list)
{
    const auto has = [&list](const char* name) { return list.findChannel(name) != nullptr; };
    Selection selection;
    const bool alpha = has("A");
    if (has("R") && has("G") && has("B")) {
        selection.channels = {{"R", 0}, {"G", 1}, {"B", 2}};
        selection.components = alpha ? 4 : 3;
    } else if (has("Y")) {
        selection.channels = {{"Y", 0}};
        selection.chroma = has("RY") && has("BY");
        selection.grey = !selection.chroma;
        selection.components = alpha ? 4 : selection.chroma ? 3 : 1;
    } else {
        fail("its channels are " + channelNames(list) + ", expected R G B, Y, or Y RY BY, each with or without A");
    }
    if (alpha) selection.channels.push_back({"A", 3});
    return selection;
}

void checkSampling(const Imf::ChannelList& list, const Selection& selection)
{
    const auto check = [&list](const char* name, int expected) {
        const Imf::Channel& c = list[name];
        if (c.xSampling != expected || c.ySampling != expected)
            fail("its channel " + std::string(name) + " is sampled " + std::to_string(c.xSampling) + " x " +
                 std::to_string(c.ySampling) + ", expected " + std::to_string(expected) + " x " + std::to_string(expected));
    };
    for (const Selection::Channel& channel : selection.channels) check(channel.name, 1);
    if (!selection.chroma) return;
    check("RY", 2);
    check("BY", 2);
}

/** The image under construction: rows of the data window go where they lie in the display window. */
class Canvas
{
  public:
    Canvas(const Imf::Header& header, int components)
        : data_(header.dataWindow()), display_(header.displayWindow()), components_(components), image_(new osg::Image)
    {
        const GLenum format = components == 1 ? GL_LUMINANCE : components == 3 ? GL_RGB : GL_RGBA;
        const GLint internal = components == 1 ? GL_LUMINANCE32F_ARB : components == 3 ? GL_RGB32F_ARB : GL_RGBA32F_ARB;
        image_->allocateImage(display_.max.x - display_.min.x + 1, display_.max.y - display_.min.y + 1, 1, format, GL_FLOAT);
        image_->setInternalTextureFormat(internal);
        if (firstRow() != display_.min.y || lastRow() != display_.max.y || firstColumn() != display_.min.x ||
            lastColumn() != display_.max.x)
            std::memset(image_->data(), 0, image_->getTotalSizeInBytes());
    }

    /** The rows of the data window that are seen; none when first is greater than last. */
    int firstRow() const { return std::max(data_.min.y, display_.min.y); }
    int lastRow() const { return std::min(data_.max.y, display_.max.y); }

    /** `row` has the data window's width. */
    void put(const float* row, int y)
    {
        if (firstColumn() > lastColumn()) return;
        const auto offset = static_cast<std::size_t>(firstColumn() - data_.min.x) * static_cast<std::size_t>(components_);
        const auto count = static_cast<std::size_t>(lastColumn() - firstColumn() + 1) * static_cast<std::size_t>(components_);
        unsigned char* to =
            image_->data(static_cast<unsigned>(firstColumn() - display_.min.x), static_cast<unsigned>(display_.max.y - y));
        std::memcpy(to, row + offset, count * sizeof(float));
    }

    osg::ref_ptr<osg::Image> image() const { return image_; }

  private:
    int firstColumn() const { return std::max(data_.min.x, display_.min.x); }
    int lastColumn() const { return std::min(data_.max.x, display_.max.x); }

    Imath::Box2i data_;
    Imath::Box2i display_;
    int components_;
    osg::ref_ptr<osg::Image> image_;
};

void readPlain(Imf::MultiPartInputFile& file, const Selection& selection, Canvas& canvas)
{
    // Enough rows for any chunk, so that OpenEXR's threads, where the host lets it have some, find work.
    constexpr int block = 256;
    Imf::InputPart part(file, 0);
    const Imath::Box2i window = part.header().dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const auto components = static_cast<std::size_t>(selection.components);
    const std::size_t stride = width * components;
    std::vector<float> rows(stride * static_cast<std::size_t>(std::clamp(canvas.lastRow() - canvas.firstRow() + 1, 0, block)));
    for (int y = canvas.firstRow(); y <= canvas.lastRow(); y += block) {
        const int last = std::min(y + block - 1, canvas.lastRow());
        Imf::FrameBuffer target;
        for (const Selection::Channel& channel : selection.channels)
            target.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, rows.data() + channel.component, {window.min.x, y},
                                                         static_cast<int64_t>(width), last - y + 1, components * sizeof(float),
                                                         stride * sizeof(float)));
        part.setFrameBuffer(target);
        part.readPixels(y, last);
        for (int i = y; i <= last; ++i) {
            float* row = rows.data() + static_cast<std::size_t>(i - y) * stride;
            if (selection.grey && components == 4)
                for (std::size_t x = 0; x < stride; x += 4) row[x + 1] = row[x + 2] = row[x];
            canvas.put(row, i);
        }
    }
}

void readChroma(Imf::IStream& stream, const Selection& selection, Canvas& canvas)
{
    stream.seekg(0);
    Imf::RgbaInputFile file(stream);
    const Imath::Box2i window = file.dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const auto components = static_cast<std::size_t>(selection.components);
    std::vector<Imf::Rgba> pixels(width);
    std::vector<float> row(width * components);
    file.setFrameBuffer(pixels.data() - window.min.x, 1, 0);
    for (int y = canvas.firstRow(); y <= canvas.lastRow(); ++y) {
        file.readPixels(y);
        for (std::size_t x = 0; x < width; ++x) {
            const Imf::Rgba& p = pixels[x];
            const float rgba[4] = {p.r, p.g, p.b, p.a};
            std::copy_n(rgba, components, row.begin() + static_cast<std::ptrdiff_t>(x * components));
        }
        canvas.put(row.data(), y);
    }
}

osg::ref_ptr<osg::Image> read(std::istream& in)
{
    const std::vector<char> data = readAll(in);
    exr::HeaderWalk(data).check();
    exr::MemoryStream stream(data);
    // Threads as the host has set them; no search for chunks of a broken file, which would give half an image.
    Imf::MultiPartInputFile file(stream, Imf::globalThreadCount(), false);
    const Imf::Header& header = file.header(0);
    if (header.type() != Imf::SCANLINEIMAGE && header.type() != Imf::TILEDIMAGE)
        fail("its first part is of type \"" + header.type() + "\", expected scanlineimage or tiledimage");
    const Selection selection = select(header.channels());
    checkSampling(header.channels(), selection);
    exr::checkSizes(header, selection.components, data.size());

    Canvas canvas(header, selection.components);
    if (selection.chroma)
        readChroma(stream, selection, canvas);
    else
        readPlain(file, selection, canvas);
    return canvas.image();
}

/** OpenEXR's message without its "Cannot read image file "stream"." in front, in one line. */
std::string reason(const std::string& what)
{
    const std::string prefix = std::string("\"") + exr::MemoryStream::kName + "\". ";
    const std::size_t end = what.rfind(prefix);
    std::string text = end == std::string::npos ? what : what.substr(end + prefix.size());
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32) c = '?';
    return text;
}

class MemoryOutput : public Imf::OStream
{
  public:
    MemoryOutput() : Imf::OStream(exr::MemoryStream::kName) {}

    void write(const char c[], int n) override
    {
        const std::size_t end = position_ + static_cast<std::size_t>(n);
        if (end > data_.size()) data_.resize(end);
        std::copy_n(c, n, data_.begin() + static_cast<std::ptrdiff_t>(position_));
        position_ = end;
    }

    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }

    const std::vector<char>& data() const { return data_; }

  private:
    std::vector<char> data_;
    std::size_t position_ = 0;
};

std::string hex(GLenum value)
{
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << "0x" << std::hex << value;
    return text.str();
}

std::vector<const char*> channelsOf(const osg::Image& image)
{
    switch (image.getPixelFormat()) {
        case GL_LUMINANCE:
            return {"Y"};
        case GL_RGB:
            return {"R", "G", "B"};
        case GL_RGBA:
            return {"R", "G", "B", "A"};
        default:
            fail("the image's pixel format is " + hex(image.getPixelFormat()) + ", expected GL_RGB, GL_RGBA or GL_LUMINANCE");
    }
}

/** A row of the image, counted from the top, as floats. */
void fetchRow(const osg::Image& image, int fromTop, std::vector<float>& row)
{
    const int index = image.getOrigin() == osg::Image::TOP_LEFT ? fromTop : image.t() - 1 - fromTop;
    const unsigned char* bytes = image.data(0, static_cast<unsigned>(index));
    if (image.getDataType() == GL_FLOAT) {
        std::memcpy(row.data(), bytes, row.size() * sizeof(float));
    } else if (image.getDataType() == GL_HALF_FLOAT) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            std::uint16_t bits = 0;
            std::memcpy(&bits, bytes + i * sizeof bits, sizeof bits);
            half value;
            value.setBits(bits);
            row[i] = value;
        }
    } else {
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<float>(bytes[i]) / 255.0f;
    }
}

void checkWritable(const osg::Image& image)
{
    if (image.data() == nullptr || image.s() < 1 || image.t() < 1 || image.r() != 1)
        fail("the image is " + std::to_string(image.s()) + " x " + std::to_string(image.t()) + " x " + std::to_string(image.r()) +
             (image.data() == nullptr ? " without data" : "") + ", expected two dimensions with data");
    const GLenum type = image.getDataType();
    if (type != GL_FLOAT && type != GL_HALF_FLOAT && type != GL_UNSIGNED_BYTE)
        fail("the image's data type is " + hex(type) + ", expected GL_FLOAT, GL_HALF_FLOAT or GL_UNSIGNED_BYTE");
}

void write(const osg::Image& image, std::ostream& out, bool asHalf)
{
    checkWritable(image);
    const std::vector<const char*> names = channelsOf(image);
    const auto width = static_cast<std::size_t>(image.s());
    Imf::Header header(image.s(), image.t());
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const char* name : names) header.channels().insert(name, Imf::Channel(asHalf ? Imf::HALF : Imf::FLOAT));

    MemoryOutput memory;
    {
        Imf::OutputFile file(memory, header);
        std::vector<float> row(width * names.size());
        std::vector<half> halves(asHalf ? row.size() : 0);
        char* base = asHalf ? reinterpret_cast<char*>(halves.data()) : reinterpret_cast<char*>(row.data());
        const std::size_t size = asHalf ? sizeof(half) : sizeof(float);
        Imf::FrameBuffer source;
        for (std::size_t c = 0; c < names.size(); ++c)
            source.insert(names[c], Imf::Slice(asHalf ? Imf::HALF : Imf::FLOAT, base + c * size, names.size() * size, 0));
        file.setFrameBuffer(source);
        for (int y = 0; y < image.t(); ++y) {
            fetchRow(image, y, row);
            std::copy(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(halves.size()), halves.begin());
            file.writePixels(1);
        }
    }
    out.write(memory.data().data(), static_cast<std::streamsize>(memory.data().size()));
    out.flush();
    if (!out) fail("it cannot be written to its end");
}

/** Runs `task` and returns what went wrong in one line, empty when nothing did. */
template <class Task>
std::string guarded(Task&& task)
{
    try {
        task();
    } catch (const std::bad_alloc&) {
        return "not enough memory for the image";
    } catch (const std::exception& e) {
        return reason(e.what());
    } catch (...) {
        return "OpenEXR failed without a reason";
    }
    return {};
}

}  // namespace

osg::ref_ptr<osg::Image> readExr(std::istream& in, const std::string& name, std::string& error)
{
    osg::ref_ptr<osg::Image> image;
    error = guarded([&] { image = read(in); });
    if (!error.empty()) error = (name.empty() ? std::string("stream") : name) + ": " + error;
    return image;
}

bool writeExr(const osg::Image& image, std::ostream& out, bool half, std::string& error)
{
    error = guarded([&] { write(image, out, half); });
    return error.empty();
}

}  // namespace osgEnvLight
