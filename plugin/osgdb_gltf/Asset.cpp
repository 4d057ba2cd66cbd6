// SPDX-License-Identifier: MIT
#include "Asset.h"

#include "Schema.h"
#include "Uri.h"

#include "base/JsonValue.h"

#include <cstring>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace osgEnvLight::gltf
{

namespace
{

using nlohmann::json;

constexpr std::uint64_t largestImageFile = std::uint64_t(1) << 30;

/** The parts of a .glb file; of a .gltf file only its text. */
struct Container {
    std::string text;
    Bytes binary;
    bool hasBinary = false;
};

std::uint32_t word(const Bytes& bytes, std::size_t at)
{
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | bytes[at + i];
    return value;
}

/** https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html#glb-file-format-specification */
Container openContainer(const Bytes& bytes, const std::string& name)
{
    constexpr std::size_t header = 12;
    constexpr std::uint32_t jsonChunk = 0x4E4F534A;
    constexpr std::uint32_t binaryChunk = 0x004E4942;
    const auto fail = [&](const std::string& what) { throw std::runtime_error(name + ": " + what); };
    if (bytes.empty()) fail("it is empty or cannot be read, expected a glTF file");

    Container container;
    if (bytes.size() < 4 || std::memcmp(bytes.data(), "glTF", 4) != 0) {
        container.text.assign(bytes.begin(), bytes.end());
        if (container.text.rfind("version https://git-lfs", 0) == 0)
            fail("it is the pointer of a file that Git LFS has not fetched, expected a glTF file");
        return container;
    }
    if (bytes.size() < header) fail("the file ends within its header, expected 12 bytes");
    if (word(bytes, 4) != 2) fail("binary glTF of version " + std::to_string(word(bytes, 4)) + ", expected 2");
    const std::size_t length = word(bytes, 8);
    if (length > bytes.size())
        fail("its header says " + std::to_string(length) + " bytes, found " + std::to_string(bytes.size()));
    bool hasText = false;
    for (std::size_t at = header; at + 8 <= length;) {
        const std::size_t size = word(bytes, at);
        const std::uint32_t type = word(bytes, at + 4);
        at += 8;
        if (size > length - at)
            fail("a chunk of " + std::to_string(size) + " bytes, found " + std::to_string(length - at) + " after its header");
        const auto chunk = bytes.begin() + std::ptrdiff_t(at);
        if (type == jsonChunk && !hasText) container.text.assign(chunk, chunk + std::ptrdiff_t(size));
        if (type == binaryChunk && !container.hasBinary) container.binary.assign(chunk, chunk + std::ptrdiff_t(size));
        hasText = hasText || type == jsonChunk;
        container.hasBinary = container.hasBinary || type == binaryChunk;
        at += size;
    }
    if (!hasText) fail("no JSON chunk, expected one after the header");
    return container;
}

/** What tinygltf makes of the document without what it would load. */
tinygltf::Model parseStructure(json document, const std::string& name)
{
    for (const char* key : {"buffers", "images", "cameras"}) document.erase(key);
    const std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() > std::numeric_limits<unsigned>::max()) throw std::runtime_error(name + ": more than 4 GiB of JSON");
    tinygltf::Model model;
    tinygltf::TinyGLTF library;
    std::string error;
    std::string warning;
    if (!library.LoadASCIIFromString(&model, &error, &warning, text.c_str(), unsigned(text.size()), "",
                                     tinygltf::REQUIRE_VERSION))
        throw std::runtime_error(name + ": " + error.substr(0, error.find('\n')));
    return model;
}

void readBuffers(Asset& asset, const json& document, Container& container)
{
    const auto list = document.find("buffers");
    if (list == document.end()) return;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const json& buffer = (*list)[i];
        const std::string path = element("buffers", i);
        const std::uint64_t length = buffer["byteLength"].get<std::uint64_t>();
        tinygltf::Buffer& result = asset.model.buffers.emplace_back();
        if (buffer.contains("uri")) {
            try {
                result.data = readUri(buffer["uri"].get<std::string>(), asset.files, length, length);
            } catch (const std::runtime_error& e) {
                asset.fail(path + ".uri", std::to_string(length) + " bytes in a data URI or a file at a relative path", e.what());
            }
        } else {
            if (i > 0 || !container.hasBinary) asset.fail(path, "a URI", "none");
            if (length > container.binary.size())
                asset.fail(path + ".byteLength",
                           "at most the " + std::to_string(container.binary.size()) + " bytes of the binary chunk",
                           std::to_string(length));
            result.data = std::move(container.binary);
            result.data.resize(length);
        }
    }
}

void listImages(Asset& asset, const json& document)
{
    const auto list = document.find("images");
    if (list == document.end()) return;
    for (const json& image : *list) {
        asset.views.push_back(image.value("bufferView", -1));
        asset.uris.push_back(image.value("uri", std::string()));
    }
}

void listCameras(Asset& asset, const json& document)
{
    const auto list = document.find("cameras");
    if (list == document.end()) return;
    for (const json& camera : *list) {
        double yfov = 0.0;
        if (camera["type"] == "perspective") {
            const std::string path = element("cameras", asset.cameras.size());
            if (!camera.contains("perspective")) asset.fail(path + ".perspective", "an object", "nothing");
            yfov = camera["perspective"]["yfov"].get<double>();
        }
        asset.cameras.push_back({camera.value("name", std::string()), yfov});
    }
}

}  // namespace

void Asset::fail(const std::string& path, const std::string& expected, const std::string& found) const
{
    throw std::runtime_error(name + ": key '" + path + "': expected " + expected + ", found " + found);
}

Asset::Range Asset::view(int index) const
{
    const tinygltf::BufferView& v = model.bufferViews[std::size_t(index)];
    const Bytes& buffer = model.buffers[std::size_t(v.buffer)].data;
    // The schema bounds both terms far below 2^64.
    if (v.byteOffset + v.byteLength > buffer.size())
        fail(element("bufferViews", std::size_t(index)),
             "a view within the " + std::to_string(buffer.size()) + " bytes of its buffer",
             std::to_string(v.byteLength) + " bytes at " + std::to_string(v.byteOffset));
    return {buffer.data() + v.byteOffset, v.byteLength};
}

Bytes Asset::image(int index) const
{
    const std::size_t i = std::size_t(index);
    const std::string path = element("images", i);
    if (views[i] >= 0 && !uris[i].empty()) fail(path, "either a uri or a bufferView", "both");
    if (views[i] >= 0) {
        const Range range = view(views[i]);
        return Bytes(range.data, range.data + range.size);
    }
    try {
        return readUri(uris[i], files, 0, largestImageFile);
    } catch (const std::runtime_error& e) {
        fail(path + ".uri", "an image in a data URI or a file at a relative path", e.what());
    }
}

std::uint64_t Asset::bufferBytes() const
{
    std::uint64_t sum = 0;
    for (const tinygltf::Buffer& buffer : model.buffers) sum += buffer.data.size();
    return sum;
}

std::string element(const std::string& list, std::size_t index)
{
    return list + "[" + std::to_string(index) + "]";
}

Asset readAsset(std::istream& in, const std::string& name, const osgDB::Options* options)
{
    const Bytes bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    Container container = openContainer(bytes, name);
    std::istringstream text(std::move(container.text));
    const json document = parseJson(text, name);
    checkSchema(document, name);

    Asset asset;
    asset.name = name;
    asset.files = options;
    asset.model = parseStructure(document, name);
    readBuffers(asset, document, container);
    listImages(asset, document);
    listCameras(asset, document);
    return asset;
}

}  // namespace osgEnvLight::gltf
