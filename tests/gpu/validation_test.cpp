// SPDX-License-Identifier: MIT
// Every program of shaders/pass, with every set of the defines it imports, is valid GLSL to the reference compiler and
// links in this machine's driver.
#include <gtest/gtest.h>

#include "gl/ShaderLibrary.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "GlContext.h"

using osgEnvLight::ShaderLibrary;
namespace fs = std::filesystem;

namespace
{

using Defines = std::vector<std::string>;

std::string expanded(const std::string& name)
{
    return osg::ref_ptr<ShaderLibrary>(new ShaderLibrary(nullptr))->expand(name).text;
}

std::vector<std::string> programs(const std::string& extension)
{
    std::vector<std::string> result;
    for (const std::string& name : ShaderLibrary::names())
        if (fs::path(name).extension() == extension) result.push_back(name);
    return result;
}

Defines imported(const std::string& text)
{
    static const std::regex pragma("#pragma import_defines\\(([^)]*)\\)");
    static const std::regex word("\\w+");
    Defines result;
    for (std::sregex_iterator p(text.begin(), text.end(), pragma), none; p != none; ++p) {
        const std::string list = (*p)[1].str();
        for (std::sregex_iterator w(list.begin(), list.end(), word); w != none; ++w)
            if (std::find(result.begin(), result.end(), w->str()) == result.end()) result.push_back(w->str());
    }
    return result;
}

// All subsets of up to 6 defines; of more: none, each alone, any two, all but one, all.
std::vector<Defines> variants(const Defines& defines)
{
    std::vector<Defines> result;
    if (defines.size() <= 6) {
        for (size_t bits = 0; bits < (size_t(1) << defines.size()); ++bits) {
            Defines set;
            for (size_t i = 0; i < defines.size(); ++i)
                if (bits >> i & 1) set.push_back(defines[i]);
            result.push_back(set);
        }
        return result;
    }
    result.push_back({});
    result.push_back(defines);
    for (size_t i = 0; i < defines.size(); ++i) {
        result.push_back({defines[i]});
        for (size_t j = 0; j < i; ++j) result.push_back({defines[j], defines[i]});
        Defines others = defines;
        others.erase(others.begin() + std::ptrdiff_t(i));
        result.push_back(others);
    }
    return result;
}

// As osg::Shader inserts them, behind #version
std::string withDefines(const std::string& text, const Defines& defines)
{
    const size_t at = text.find('\n') + 1;
    std::string lines;
    for (const std::string& d : defines) lines += "#define " + d + "\n";
    return text.substr(0, at) + lines + text.substr(at);
}

std::string listOf(const Defines& defines)
{
    std::string result = "{";
    for (const std::string& d : defines) result += " " + d;
    return result + " }";
}

std::string outputOf(const std::string& command, int& status)
{
    std::string output;
    char buffer[4096];
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    while (const size_t n = fread(buffer, 1, sizeof(buffer), pipe)) output.append(buffer, n);
    status = pclose(pipe);
    return output;
}

// Texts for one run of glslangValidator, which takes longer to start than to judge one.
class Validation
{
  public:
    Validation() { fs::create_directories(_folder); }
    ~Validation() { fs::remove_all(_folder); }

    void add(const std::string& what, const std::string& text, const std::string& extension)
    {
        _whats.push_back(what);
        const fs::path file = _folder / (std::to_string(_whats.size()) + extension);
        std::ofstream(file) << text;
        _files.push_back(file.string());
    }

    // Empty if all are valid, else the messages, each behind what it is about.
    std::string faults() const
    {
        std::string command = "'" GLSLANG_VALIDATOR "'";
        for (const std::string& file : _files) command += " '" + file + "'";
        int status = 0;
        std::istringstream output(outputOf(command, status));
        if (status == 0) return "";
        std::string result = "status " + std::to_string(status) + "\n", what;
        for (std::string line; std::getline(output, line);) {
            const auto file = std::find(_files.begin(), _files.end(), line);
            if (file != _files.end())
                what = _whats[size_t(file - _files.begin())];
            else if (!line.empty())
                result += what + ": " + line + "\n";
        }
        return result;
    }

  private:
    const fs::path _folder = fs::path(testing::TempDir()) / ("envlight_validation_" + std::to_string(std::uintptr_t(this)));
    std::vector<std::string> _whats;
    std::vector<std::string> _files;
};

}  // namespace

TEST(validation, EveryProgramHasADefineSet)
{
    EXPECT_GE(programs(".frag").size(), 7u);
    EXPECT_GE(programs(".vert").size(), 2u);
    EXPECT_EQ(variants(imported("#pragma import_defines(A, B)\n")).size(), 4u);
    EXPECT_EQ(variants(imported("#pragma import_defines(A, B, C, D, E, F, G)\n")).size(), 37u);  // 1 + 7 + 21 + 7 + 1
}

TEST(validation, GlslangAcceptsEveryVariant)
{
    if (std::string(GLSLANG_VALIDATOR).empty()) GTEST_SKIP() << "glslangValidator (package glslang-tools) is not installed";
    const char* const valid = "#version 330\nvoid main() {}\n";
    Validation judged;
    judged.add("valid", valid, ".frag");
    EXPECT_EQ(judged.faults(), "");
    judged.add("faulty", "#version 330\nvoid main() { fault; }\n", ".frag");
    judged.add("valid, too", valid, ".frag");
    const std::string faults = judged.faults();
    EXPECT_NE(faults.find("faulty: ERROR: 0:2: 'fault'"), std::string::npos) << faults;
    EXPECT_EQ(faults.find("valid"), std::string::npos) << faults;

    for (const char* extension : {".vert", ".frag"})
        for (const std::string& name : programs(extension)) {
            const std::string text = expanded(name);
            Validation variantsOfIt;
            for (const Defines& set : variants(imported(text)))
                variantsOfIt.add(name + " " + listOf(set), withDefines(text, set), extension);
            EXPECT_EQ(variantsOfIt.faults(), "");
        }
}

TEST(validation, TheDriverLinksEveryVariant)
{
    const GlContext context;
    const std::string surface = expanded("pass/surface.vert");
    const std::string fullscreen = expanded("pass/fullscreen.vert");
    EXPECT_NE(context.link(fullscreen, "#version 330\nvoid main() { fault; }\n"), "");
    for (const std::string& name : programs(".frag")) {
        const std::string text = expanded(name);
        const std::string& vertex = text.find("in vec3 eyePosition;") != std::string::npos ? surface : fullscreen;
        for (const Defines& set : variants(imported(text)))
            EXPECT_EQ(context.link(withDefines(vertex, set), withDefines(text, set)), "") << name << " " << listOf(set);
    }
}
