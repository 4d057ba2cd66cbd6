// SPDX-License-Identifier: MIT
// Small glTF files that the tests write, and what the plugin makes of them.
#pragma once

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/NodeVisitor>
#include <osg/TriangleFunctor>
#include <osgDB/Registry>

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gltffiles
{

using nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kByte = 5120;
constexpr int kUByte = 5121;
constexpr int kShort = 5122;
constexpr int kUShort = 5123;
constexpr int kUInt = 5125;

inline std::string base64(const std::string& bytes)
{
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

template <class T>
std::string bytesOf(const std::vector<T>& values)
{
    return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

inline int trianglesOf(const osg::Geometry& geometry)
{
    struct Count {
        int triangles = 0;
        void operator()(const osg::Vec3&, const osg::Vec3&, const osg::Vec3&, bool = false) { ++triangles; }
    };
    osg::TriangleFunctor<Count> count;
    geometry.accept(count);
    return count.triangles;
}

/** A document with one buffer. */
struct File {
    json document = {{"asset", {{"version", "2.0"}}}};
    std::string buffer;

    int add(const char* list, const json& value)
    {
        document[list].push_back(value);
        return int(document[list].size()) - 1;
    }

    int view(const std::string& bytes, int stride = 0)
    {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        json v = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
        if (stride > 0) v["byteStride"] = stride;
        buffer += bytes;
        return add("bufferViews", v);
    }

    template <class T>
    int accessor(const std::vector<T>& values, int componentType, const char* type, int components, bool normalized = false)
    {
        json a = {{"bufferView", view(bytesOf(values))},
                  {"componentType", componentType},
                  {"count", values.size() / std::size_t(components)},
                  {"type", type}};
        if (normalized) a["normalized"] = true;
        return add("accessors", a);
    }
    int scalars(const std::vector<float>& v) { return accessor(v, kFloat, "SCALAR", 1); }
    int vec2(const std::vector<float>& v) { return accessor(v, kFloat, "VEC2", 2); }
    int vec3(const std::vector<float>& v) { return accessor(v, kFloat, "VEC3", 3); }
    int vec4(const std::vector<float>& v) { return accessor(v, kFloat, "VEC4", 4); }

    /** A mesh of one primitive in a node of its own; returns the node. */
    int show(const json& primitive)
    {
        const int mesh = add("meshes", {{"name", "mesh"}, {"primitives", {primitive}}});
        return add("nodes", {{"mesh", mesh}});
    }

    /** A triangle in the plane of x and y. */
    json triangle() { return {{"attributes", {{"POSITION", vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}; }

    std::string text() const
    {
        json d = document;
        if (!buffer.empty())
            d["buffers"] = {{{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
        return d.dump();
    }

    std::string binary() const
    {
        json d = document;
        if (!buffer.empty()) d["buffers"] = {{{"byteLength", buffer.size()}}};
        std::string words = d.dump();
        words.resize((words.size() + 3) / 4 * 4, ' ');
        std::string bin = buffer;
        bin.resize((bin.size() + 3) / 4 * 4);
        const std::uint32_t textSize = std::uint32_t(words.size()), binSize = std::uint32_t(bin.size());
        const std::vector<std::uint32_t> header = {0x46546C67, 2, 12 + 8 + textSize + 8 + binSize, textSize, 0x4E4F534A};
        const std::vector<std::uint32_t> chunk = {binSize, 0x004E4942};
        return bytesOf(header) + words + bytesOf(chunk) + bin;
    }
};

using ReadResult = osgDB::ReaderWriter::ReadResult;

inline ReadResult readText(const std::string& text, const std::string& options = "")
{
    osgDB::ReaderWriter* plugin = osgDB::Registry::instance()->getReaderWriterForExtension("gltf");
    if (!plugin) return ReadResult("there is no plugin");
    std::istringstream in(text);
    const osg::ref_ptr<osgDB::Options> held = new osgDB::Options(options);
    return plugin->readNode(in, held);
}

/** Null with a failure of the test. */
inline osg::ref_ptr<osg::Node> readNode(const std::string& text, const std::string& options = "keepYUp")
{
    ReadResult result = readText(text, options);
    EXPECT_TRUE(result.validNode()) << result.message();
    return result.getNode();
}
inline osg::ref_ptr<osg::Node> readNode(const File& file, const std::string& options = "keepYUp")
{
    return readNode(file.text(), options);
}

/** The message of a file that can't be read. */
inline std::string messageOf(const std::string& text)
{
    ReadResult result = readText(text);
    EXPECT_FALSE(result.validNode());
    return result.message();
}
inline std::string messageOf(const File& file)
{
    return messageOf(file.text());
}

/** All nodes of a type, in the order of the graph. */
template <class T>
std::vector<T*> find(osg::Node* root)
{
    struct Finder : osg::NodeVisitor {
        Finder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
        void apply(osg::Node& node) override
        {
            if (T* t = dynamic_cast<T*>(&node)) found.push_back(t);
            traverse(node);
        }
        std::vector<T*> found;
    } finder;
    if (root) root->accept(finder);
    return finder.found;
}

/** The only geometry of a file. */
inline osg::Geometry* geometryOf(osg::Node* root)
{
    const std::vector<osg::Geometry*> list = find<osg::Geometry>(root);
    EXPECT_EQ(list.size(), 1u);
    return list.empty() ? nullptr : list[0];
}

template <class Array>
const Array& arrayOf(const osg::Array* array)
{
    static const osg::ref_ptr<Array> none = new Array(64);
    const auto* typed = dynamic_cast<const Array*>(array);
    EXPECT_NE(typed, nullptr);
    return typed ? *typed : *none;
}

}  // namespace gltffiles
