// SPDX-License-Identifier: MIT
// Every program of shaders/pass, with sets of the defines it imports, is valid GLSL to the reference compiler and links in
// this machine's driver.
#include <gtest/gtest.h>

#include "gl/ShaderLibrary.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "DefineSets.h"
#include "GlContext.h"

namespace validation_test
{

using osgEnvLight::ShaderLibrary;
namespace fs = std::filesystem;

namespace
{

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

std::string outputOf(const std::string& command, int& status)
{
    std::string output;
    char buffer[4096];
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    while (const size_t n = fread(buffer, 1, sizeof(buffer), pipe)) output.append(buffer, n);
    status = pclose(pipe);
    return output;
}

// Judges texts by glslangValidator: many in one run, since it takes longer to start than to judge one, but never more on the
// disk: the sets of one program are so many that their texts would fill it.
class Validation
{
  public:
    Validation() { fs::create_directories(_folder); }
    ~Validation() { fs::remove_all(_folder); }

    void add(const std::string& what, const std::string& text, const std::string& extension)
    {
        const size_t most = 1000;  // names of files fit a command line
        if (_files.size() == most) judge();
        _whats.push_back(what);
        _files.push_back(std::to_string(_whats.size()) + extension);
        std::ofstream(_folder / _files.back()) << text;
    }

    // Empty if all were valid, else the messages, each behind what it is about.
    std::string faults()
    {
        judge();
        return _faults;
    }

  private:
    void judge()
    {
        if (_files.empty()) return;
        std::string command = "cd '" + _folder.string() + "' && '" GLSLANG_VALIDATOR "'";
        for (const std::string& file : _files) command += " " + file;
        int status = 0;
        std::istringstream output(outputOf(command, status));
        if (status != 0) report(status, output);
        _whats.clear();
        _files.clear();  // the next ones are written over them
    }

    void report(int status, std::istream& output)
    {
        _faults += "status " + std::to_string(status) + "\n";
        std::string what;
        for (std::string line; std::getline(output, line);) {
            const auto file = std::find(_files.begin(), _files.end(), line);
            if (file != _files.end())
                what = _whats[size_t(file - _files.begin())];
            else if (!line.empty())
                _faults += what + ": " + line + "\n";
        }
    }

    const fs::path _folder = fs::path(testing::TempDir()) / ("envlight_validation_" + std::to_string(std::uintptr_t(this)));
    std::vector<std::string> _whats;
    std::vector<std::string> _files;
    std::string _faults;
};

using Sets = std::vector<Defines> (*)(const Defines&);

// Those that can be reached; where they are more, that many of them from all over, and someSets().
std::vector<Defines> spreadSets(const Defines& defines, size_t most)
{
    std::vector<Defines> sets = reachableSets(defines);
    if (sets.size() <= most) return sets;
    std::vector<Defines> result = someSets(defines);
    const size_t stride = sets.size() / most | 1;  // odd: those next to each other differ by the defines named last
    for (size_t i = 0; i < sets.size(); i += stride) result.push_back(sets[i]);
    return result;
}

void expectGlslangAccepts(Sets setsOf)
{
    for (const char* extension : {".vert", ".frag"})
        for (const std::string& name : programs(extension)) {
            const std::string text = expanded(name);
            Validation judged;
            for (const Defines& set : setsOf(imported(text)))
                judged.add(name + " " + listOf(set), withDefines(text, set), extension);
            EXPECT_EQ(judged.faults(), "");
        }
}

void expectTheDriverLinks(Sets setsOf)
{
    const GlContext context;
    const std::string surface = expanded("pass/surface.vert");
    const std::string fullscreen = expanded("pass/fullscreen.vert");
    EXPECT_NE(context.link(fullscreen, "#version 330\nvoid main() { fault; }\n"), "");
    for (const std::string& name : programs(".frag")) {
        const std::string text = expanded(name);
        const std::string& vertex = text.find("in vec3 eyePosition;") != std::string::npos ? surface : fullscreen;
        for (const Defines& set : setsOf(imported(text)))
            EXPECT_EQ(context.link(withDefines(vertex, set), withDefines(text, set)), "") << name << " " << listOf(set);
    }
}

}  // namespace

TEST(validation, EveryProgramHasADefineSet)
{
    EXPECT_GE(programs(".frag").size(), 7u);
    EXPECT_GE(programs(".vert").size(), 2u);
    const size_t most = 200000;  // that are listed in two seconds
    for (const char* extension : {".vert", ".frag"})
        for (const std::string& name : programs(extension))
            EXPECT_LT(reachableSets(imported(expanded(name))).size(), most) << name;
    EXPECT_EQ(someSets(imported("#pragma import_defines(A, B)\n")).size(), 4u);
    EXPECT_EQ(someSets({"A", "B", "C", "D", "E"}).size(), 32u);
    EXPECT_EQ(reachableSets({"A", "B", "C", "D", "E", "F", "G"}).size(), 128u);
    EXPECT_EQ(reachableSets({"SLICES_1", "SLICES_2", "SLICES_3", "A"}).size(), 8u);      // no two of them
    EXPECT_EQ(reachableSets({"SUNS_OVER_2", "SUNS_OVER_4", "SUNS_OVER_6"}).size(), 4u);  // none, 2, 2 4, 2 4 6
    EXPECT_EQ(reachableSets({"BACKGROUND_BLUR"}).size(), 2u);                            // which imports no BACKGROUND
}

TEST(validation, TripleSetsHaveAnyThreeDefinesInAllWays)
{
    Defines defines;
    for (int i = 0; i < 24; ++i) defines.push_back("D" + std::to_string(i));
    const std::vector<Defines> sets = tripleSets(defines);
    EXPECT_LT(sets.size(), 50u);  // of 2^24
    for (size_t i = 0; i < defines.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            for (size_t k = 0; k < j; ++k) {
                std::set<std::array<bool, 3>> ways;
                for (const Defines& set : sets) {
                    const auto has = [&](size_t d) { return std::find(set.begin(), set.end(), defines[d]) != set.end(); };
                    ways.insert({has(i), has(j), has(k)});
                }
                EXPECT_EQ(ways.size(), 8u) << listOf({defines[i], defines[j], defines[k]});
            }
}

TEST(validation, GlslangFindsFaults)
{
    if (std::string(GLSLANG_VALIDATOR).empty()) GTEST_SKIP() << "glslangValidator (package glslang-tools) is not installed";
    const char* const valid = "#version 330\nvoid main() {}\n";
    Validation judged;
    judged.add("valid", valid, ".frag");
    EXPECT_EQ(judged.faults(), "");
    for (int i = 0; i < 1500; ++i) judged.add("early", valid, ".frag");  // of another run
    judged.add("faulty", "#version 330\nvoid main() { fault; }\n", ".frag");
    judged.add("valid, too", valid, ".frag");
    const std::string faults = judged.faults();
    EXPECT_NE(faults.find("faulty: ERROR: 0:2: 'fault'"), std::string::npos) << faults;
    EXPECT_EQ(faults.find("valid"), std::string::npos) << faults;
    EXPECT_EQ(faults.find("early"), std::string::npos) << faults;
    EXPECT_EQ(judged.faults(), faults) << "judged once";
}

TEST(validation, GlslangAcceptsSomeSets)
{
    if (std::string(GLSLANG_VALIDATOR).empty()) GTEST_SKIP() << "glslangValidator (package glslang-tools) is not installed";
    expectGlslangAccepts(someSets);
}

TEST(validation, GlslangAcceptsReachableSets)
{
    if (std::string(GLSLANG_VALIDATOR).empty()) GTEST_SKIP() << "glslangValidator (package glslang-tools) is not installed";
    expectGlslangAccepts([](const Defines& defines) { return spreadSets(defines, 8000); });  // .006 s each
}

TEST(validation, TheDriverLinksSomeSets)
{
    // Glslang has judged the others: what a driver makes of them takes it ten times as long.
    expectTheDriverLinks([](const Defines& defines) { return defines.size() <= 5 ? someSets(defines) : tripleSets(defines); });
}

TEST(validation, TheDriverLinksReachableSets)
{
    expectTheDriverLinks([](const Defines& defines) { return spreadSets(defines, 1000); });  // .05 s each
}

}  // namespace validation_test
