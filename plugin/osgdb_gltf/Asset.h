// SPDX-License-Identifier: MIT
#pragma once

#include "TinyGltf.h"

#include <osg/ref_ptr>
#include <osgDB/Options>

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace osgEnvLight::gltf
{

using Bytes = std::vector<unsigned char>;

/** A glTF file whose JSON has been checked against the schema (Schema.h) and whose buffers are in memory. Images are read when a
 * texture asks for them. */
struct Asset {
    std::string name;        // of the file, for messages
    tinygltf::Model model;   // without images and cameras
    std::vector<int> views;  // of each image: its buffer view, -1 where it has a URI
    std::vector<std::string> uris;
    struct Camera {
        std::string name;
        double yfov = 0.0;  // radians; 0: orthographic
    };
    std::vector<Camera> cameras;
    osg::ref_ptr<const osgDB::Options> files;  // where URIs are looked for

    /** Throws std::runtime_error: one line that names the file and the property. */
    [[noreturn]] void fail(const std::string& path, const std::string& expected, const std::string& found) const;

    /** A range of a buffer. Throws unless the view lies within it. */
    struct Range {
        const unsigned char* data = nullptr;
        std::uint64_t size = 0;
    };
    Range view(int index) const;

    /** The encoded bytes of an image. */
    Bytes image(int index) const;

    /** Of all buffers together: what a file may claim is held against it. */
    std::uint64_t bufferBytes() const;
};

/** "meshes[2]" */
std::string element(const std::string& list, std::size_t index);

/** Reads .gltf and .glb. Throws std::runtime_error in words that name the file. */
Asset readAsset(std::istream& in, const std::string& name, const osgDB::Options* options);

}  // namespace osgEnvLight::gltf
