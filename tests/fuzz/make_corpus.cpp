// SPDX-License-Identifier: MIT
// Writes a few small valid files of every kind into FOLDER/exr, FOLDER/hdr, FOLDER/json and FOLDER/gltf, for the fuzzers to start
// from.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfTiledOutputFile.h>

namespace
{

namespace fs = std::filesystem;

constexpr int kWidth = 18;
constexpr int kHeight = 12;

Imf::Header headerOf(const std::vector<std::string>& names, Imf::PixelType type, Imf::Compression compression)
{
    Imf::Header header(kWidth, kHeight);
    header.compression() = compression;
    for (const std::string& name : names) header.channels().insert(name, Imf::Channel(type));
    return header;
}

/** All channels of `header` from one plane of four bytes a pixel: only that it decodes matters. */
Imf::FrameBuffer sourceOf(const Imf::Header& header)
{
    static std::vector<float> plane = [] {
        std::vector<float> p(kWidth * kHeight);
        for (std::size_t i = 0; i < p.size(); ++i) p[i] = 1.0f + std::sin(0.1f * static_cast<float>(i));
        return p;
    }();
    Imf::FrameBuffer source;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        source.insert(c.name(), Imf::Slice(c.channel().type, reinterpret_cast<char*>(plane.data()), 4, 4 * kWidth));
    return source;
}

void writeScanlines(const fs::path& path, const Imf::Header& header)
{
    Imf::OutputFile file(path.string().c_str(), header);
    file.setFrameBuffer(sourceOf(header));
    file.writePixels(kHeight);
}

void writeTiles(const fs::path& path, Imf::Header header, Imf::LevelMode mode)
{
    header.setTileDescription(Imf::TileDescription(4, 4, mode));
    Imf::TiledOutputFile file(path.string().c_str(), header);
    file.setFrameBuffer(sourceOf(header));
    for (int y = 0; y < file.numYLevels(); ++y)
        for (int x = 0; x < file.numXLevels(); ++x)
            if (file.isValidLevel(x, y)) file.writeTiles(0, file.numXTiles(x) - 1, 0, file.numYTiles(y) - 1, x, y);
}

void writeParts(const fs::path& path)
{
    std::vector<Imf::Header> headers(2, headerOf({"B", "G", "R"}, Imf::HALF, Imf::ZIP_COMPRESSION));
    for (std::size_t i = 0; i < headers.size(); ++i) {
        headers[i].setName("part" + std::to_string(i));
        headers[i].setType(Imf::SCANLINEIMAGE);
    }
    Imf::MultiPartOutputFile file(path.string().c_str(), headers.data(), static_cast<int>(headers.size()));
    for (int i = 0; i < static_cast<int>(headers.size()); ++i) {
        Imf::OutputPart part(file, i);
        part.setFrameBuffer(sourceOf(headers[0]));
        part.writePixels(kHeight);
    }
}

void writeChroma(const fs::path& path)
{
    const std::vector<Imf::Rgba> pixels(kWidth * kHeight, Imf::Rgba(1.0f, 0.5f, 0.25f, 1.0f));
    Imf::RgbaOutputFile file(path.string().c_str(), Imf::Header(kWidth, kHeight), Imf::WRITE_YCA);
    file.setFrameBuffer(pixels.data(), 1, kWidth);
    file.writePixels(kHeight);
}

void writeExrs(const fs::path& folder)
{
    for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c) {
        const auto compression = static_cast<Imf::Compression>(c);
        writeScanlines(folder / ("half" + std::to_string(c) + ".exr"), headerOf({"A", "B", "G", "R"}, Imf::HALF, compression));
        writeScanlines(folder / ("float" + std::to_string(c) + ".exr"), headerOf({"B", "G", "R"}, Imf::FLOAT, compression));
    }
    writeScanlines(folder / "uint.exr", headerOf({"Y", "Z"}, Imf::UINT, Imf::ZIP_COMPRESSION));
    writeTiles(folder / "tiles.exr", headerOf({"B", "G", "R"}, Imf::HALF, Imf::PIZ_COMPRESSION), Imf::ONE_LEVEL);
    writeTiles(folder / "mipmap.exr", headerOf({"B", "G", "R"}, Imf::FLOAT, Imf::NO_COMPRESSION), Imf::MIPMAP_LEVELS);
    writeTiles(folder / "ripmap.exr", headerOf({"Y"}, Imf::HALF, Imf::ZIP_COMPRESSION), Imf::RIPMAP_LEVELS);
    writeParts(folder / "parts.exr");
    writeChroma(folder / "chroma.exr");
}

void writeHdr(const fs::path& path, const std::string& header, const std::string& pixels)
{
    std::ofstream out(path, std::ios::binary);
    out << "#?RADIANCE\n" << header << "\n" << pixels;
}

void writeHdrs(const fs::path& folder)
{
    writeHdr(folder / "flat.hdr", "FORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n",
             "-Y 1 +X 3\nabc\x80"
             "def\x81"
             "ghi\x82");
    writeHdr(folder / "old.hdr", "COLORCORR= 1 2 .5\n",
             "+X 1 -Y 5\nabc\x80"
             "\x01\x01\x01\x04");
    writeHdr(folder / "new.hdr", "FORMAT=32-bit_rle_xyze\n",
             std::string("+Y 1 -X 8\n\x02\x02\0\x08", 14) +
                 "\x88"
                 "a\x88"
                 "b\x08"
                 "abcdefgh\x88\x80");
}

void writeJsons(const fs::path& folder)
{
    std::ofstream(folder / "scene.json") << R"({
        "models": ["a.obj", "b.osgt"],
        "environment": {"map": "sky", "rotation": 30.5, "intensity": 2, "strict": true},
        "camera": {"eye": [4, -6, 3], "target": [0, 0, 1], "up": [0, 0, 1], "fovy": 40},
        "materials": {"gold": {"brdf": "cook-torrance", "baseColor": [1, 0.77, 0.34], "metalness": 1, "roughness": 0.2},
                      "floor": {"brdf": "phong", "diffuse": [0.5, 0.5, 0.5], "specular": [0.04, 0.04, 0.04], "exponent": 200},
                      "wall": {"brdf": "lambert", "diffuse": [0.8, 0.8, 0.8]}},
        "settings": {"diffuseLights": 128, "combine": "ratio", "occlusion": true},
        "lights": [{"shape": "rectangle", "center": [0, 0, 3], "u": [1, 0, 0], "v": [0, -0.5, 0], "radiance": [10, 9, 7]},
                   {"shape": "sphere", "name": "bulb", "center": [2, 0, 1], "radius": 0.1, "flux": [5, 5, 5], "visible": false},
                   {"shape": "disc", "center": [0, 0, 1], "normal": [0, 0, 1], "radius": 1, "radiance": [1, 1, 1], "twoSided": true},
                   {"shape": "polygon", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "radiance": [1, 1, 1]}]})";
    std::ofstream(folder / "model.json") << R"({"model": "a.obj"})";
    std::ofstream(folder / "camera.json") << R"({"eye": [1, 2, 3], "target": [0, 0, 0], "up": [0, 0, 1], "fovy": 30})";
    std::ofstream(folder / "lights.json") << R"({"map": "a.exr", "sampler": "auto", "seed": 1, "residual": "b.exr", "stats": {},
 "lights": [{"direction": [0, 0, 1], "flux": [1, 2, 3]}],
 "suns": [{"direction": [1, 0, 0], "flux": [1, 2, 3], "radiusDeg": 1}]})";
}

void writeGltfs(const fs::path& folder)
{
    // A triangle of floats; whatever else is read of the buffer are its zeros and ones.
    const std::string bytes = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAAAAAAAAAAAAAAAAAAAAAAA";
    std::ofstream(folder / "surface.gltf") << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "buffers": [{"byteLength": 60, "uri": "data:;base64,)"
                                           << bytes << R"("}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
  {"bufferView": 0, "componentType": 5121, "count": 3, "type": "VEC4", "normalized": true,
   "sparse": {"count": 1, "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 0}}}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM/4EAAB/uBfvxq7p3AAAAAElFTkSuQmCC"}],
 "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497}], "textures": [{"source": 0, "sampler": 0}],
 "materials": [{"name": "m", "alphaMode": "MASK", "doubleSided": true, "normalTexture": {"index": 0, "scale": 0.5},
  "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "baseColorTexture": {"index": 0, "texCoord": 1,
   "extensions": {"KHR_texture_transform": {"offset": [0, 1], "rotation": 1, "scale": [2, 2]}}}},
  "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatTexture": {"index": 0}}}}],
 "meshes": [{"weights": [0.5], "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0, "COLOR_0": 2}, "indices": 1, "material": 0,
  "targets": [{"POSITION": 0}]}]}],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 3, "spot": {"outerConeAngle": 0.5}}]}},
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7}}],
 "nodes": [{"mesh": 0, "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}]})";
    std::ofstream(folder / "motion.gltf")
        << R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 60, "uri": "data:;base64,)" << bytes << R"("}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
  {"bufferView": 1, "byteOffset": 12, "componentType": 5121, "count": 3, "type": "VEC4"},
  {"componentType": 5126, "count": 3, "type": "VEC4"},
  {"bufferView": 0, "byteOffset": 8, "componentType": 5126, "count": 1, "type": "SCALAR"},
  {"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC3"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}], "skins": [{"joints": [1, 2]}],
 "animations": [{"samplers": [{"input": 3, "output": 4, "interpolation": "STEP"}],
  "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"children": [2], "rotation": [0, 0, 0, 1]}, {"translation": [1, 2, 3]}]})";
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: " << argv[0] << " FOLDER\n";
        return 2;
    }
    try {
        const fs::path folder(argv[1]);
        for (const char* kind : {"exr", "hdr", "json", "gltf"}) fs::create_directories(folder / kind);
        writeExrs(folder / "exr");
        writeHdrs(folder / "hdr");
        writeJsons(folder / "json");
        writeGltfs(folder / "gltf");
    } catch (const std::exception& e) {
        std::cerr << e.what() << "\n";
        return 1;
    }
    return 0;
}
