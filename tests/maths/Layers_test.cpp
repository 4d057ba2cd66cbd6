// SPDX-License-Identifier: MIT
// The nodekit's folders: each may include those below it, never above; public headers include no private ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace Layers_test
{

namespace
{

namespace fs = std::filesystem;

const fs::path plugin = fs::path(ENVLIGHT_SOURCE_DIR) / "plugin";
const fs::path publicHeaders = plugin / "include" / "osgEnvLight";
// From the lowest on.
const std::vector<std::string> layers = {"base",     "gl",     "environment", "lights", "surface",
                                         "indirect", "shadow", "frame",       "passes", "node"};

// In private sources a public header counts as of the folder that has its source; those without one, as of the lowest.
size_t layerOfPublic(const std::string& header)
{
    for (size_t i = 0; i < layers.size(); ++i)
        if (fs::exists(plugin / "src" / layers[i] / (header + ".cpp"))) return i;
    return 0;
}

size_t layerOf(const std::string& folder)
{
    const auto found = std::find(layers.begin(), layers.end(), folder);
    EXPECT_NE(found, layers.end()) << folder << " is not among the layers";
    return size_t(found - layers.begin());
}

struct Include {
    std::string kind;  // "src" or "osgEnvLight"
    std::string folder;
    std::string name;
};

std::vector<Include> includesOf(const fs::path& file)
{
    const std::regex own("#include \"([a-z]+)/([A-Za-z]+)\\.h\".*"), general("#include <osgEnvLight/([A-Za-z]+)>.*");
    std::vector<Include> all;
    std::ifstream in(file);
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
        if (std::regex_match(line, match, own) && fs::exists(plugin / "src" / std::string(match[1])))
            all.push_back({"src", match[1], match[2]});
        else if (std::regex_match(line, match, general))
            all.push_back({"osgEnvLight", "", match[1]});
    }
    return all;
}

}  // namespace

TEST(Layers, NoFolderIncludesOneAboveIt)
{
    int seen = 0;
    for (const auto& entry : fs::recursive_directory_iterator(plugin / "src")) {
        if (!entry.is_regular_file()) continue;
        const size_t own = layerOf(entry.path().parent_path().filename().string());
        for (const Include& i : includesOf(entry.path())) {
            ++seen;
            const size_t other = i.kind == "src" ? layerOf(i.folder) : layerOfPublic(i.name);
            EXPECT_LE(other, own) << entry.path() << " includes " << i.name;
        }
    }
    EXPECT_GT(seen, 200);
}

TEST(Layers, PublicHeadersIncludeOnlyEachOther)
{
    for (const auto& entry : fs::directory_iterator(publicHeaders))
        for (const Include& i : includesOf(entry.path())) {
            EXPECT_EQ("osgEnvLight", i.kind) << entry.path() << " includes " << i.name;
            EXPECT_TRUE(fs::exists(publicHeaders / i.name)) << entry.path() << " includes " << i.name;
        }
}

TEST(Layers, FilesAreShort)
{
    for (const auto& root : {plugin, fs::path(ENVLIGHT_SOURCE_DIR) / "shaders", fs::path(ENVLIGHT_SOURCE_DIR) / "tests",
                             fs::path(ENVLIGHT_SOURCE_DIR) / "samples"})
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            const std::string extension = entry.path().extension().string();
            const bool isText = extension.empty() || extension == ".cpp" || extension == ".h" || extension == ".glsl" ||
                                extension == ".frag" || extension == ".vert";
            if (!entry.is_regular_file() || !isText) continue;
            std::ifstream in(entry.path());
            const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
            EXPECT_LE(lines, 400) << entry.path();
        }
}

}  // namespace Layers_test
