// SPDX-License-Identifier: MIT
#include "Scene.h"

#include "SceneBuilder.h"

#include <algorithm>
#include <exception>
#include <sstream>

namespace osgEnvLight::gltf
{

namespace
{

bool wants(const osgDB::Options* options, const std::string& word)
{
    std::istringstream words(options ? options->getOptionString() : std::string());
    for (std::string w; words >> w;)
        if (w == word) return true;
    return false;
}

/** One line, and not too long: names and URIs are the file's. */
std::string asLine(const std::string& text)
{
    constexpr std::size_t longest = 400;
    std::string line = text.size() <= longest ? text : text.substr(0, longest) + "...";
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < ' '; }, '?');
    return line;
}

}  // namespace

osg::ref_ptr<osg::Node> readGltf(std::istream& in, const std::string& name, const osgDB::Options* options, std::string& error)
{
    error.clear();
    try {
        const Asset asset = readAsset(in, name, options);
        return SceneBuilder(asset).build(wants(options, "keepYUp"));
    } catch (const std::bad_alloc&) {
        error = name + ": not enough memory";
    } catch (const std::exception& e) {
        error = asLine(e.what());
    }
    return nullptr;
}

}  // namespace osgEnvLight::gltf
