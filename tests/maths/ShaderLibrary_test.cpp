// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "gl/ShaderLibrary.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <stdexcept>

namespace ShaderLibrary_test
{

using osgEnvLight::ShaderLibrary;
using osgEnvLight::ShaderText;
namespace fs = std::filesystem;

namespace
{

// A folder of shaders of our own on ENVLIGHT_SHADER_PATH.
class Folder
{
  public:
    Folder() : _root(fs::path(testing::TempDir()) / ("envlight_shaders_" + std::to_string(std::uintptr_t(this))))
    {
        fs::create_directories(_root / "pass");
        fs::create_directories(_root / "lib");
        setenv("ENVLIGHT_SHADER_PATH", ("/no/such/folder:" + _root.string()).c_str(), 1);
    }
    ~Folder()
    {
        unsetenv("ENVLIGHT_SHADER_PATH");
        fs::remove_all(_root);
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(_root / name) << text; }

  private:
    fs::path _root;
};

osg::ref_ptr<ShaderLibrary> library()
{
    return new ShaderLibrary(nullptr);
}

size_t occurrences(const std::string& text, const std::string& word)
{
    size_t count = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

// 1-based line of `text` that contains `word`, as the driver counts after the #line directive.
unsigned driverLine(const std::string& text, const std::string& word)
{
    return unsigned(std::count(text.begin(), text.begin() + long(text.find(word)), '\n')) + 1;
}

std::set<std::string> matches(const std::string& text, const std::string& pattern)
{
    const std::regex regex(pattern);
    std::set<std::string> result;
    for (std::sregex_iterator m(text.begin(), text.end(), regex), none; m != none; ++m) result.insert((*m)[1].str());
    return result;
}

std::string failureOf(const std::string& name)
{
    try {
        library()->expand(name);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return std::string();
}

}  // namespace

TEST(ShaderLibrary, NamesAreTheFilesOfTheSourceTree)
{
    std::vector<std::string> files;
    const fs::path root = fs::path(ENVLIGHT_SOURCE_DIR) / "shaders";
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".glsl" || extension == ".vert" || extension == ".frag")
            files.push_back(fs::relative(entry.path(), root).generic_string());
    }
    std::vector<std::string> names = ShaderLibrary::names();
    std::sort(names.begin(), names.end());
    std::sort(files.begin(), files.end());
    EXPECT_EQ(names, files);
}

TEST(ShaderLibrary, EmbeddedTextIsTheFile)
{
    for (unsigned i = 0; i < osgEnvLight::numEmbeddedShaders; ++i) {
        const osgEnvLight::EmbeddedShader& shader = osgEnvLight::embeddedShaders[i];
        std::ifstream in(fs::path(ENVLIGHT_SOURCE_DIR) / "shaders" / shader.name, std::ios::binary);
        EXPECT_EQ(std::string(shader.text), std::string(std::istreambuf_iterator<char>(in), {})) << shader.name;
    }
}

TEST(ShaderLibrary, IncludesAreExpandedOnce)
{
    for (const std::string& name : ShaderLibrary::names()) {
        const std::string text = library()->expand(name).text;
        EXPECT_EQ(occurrences(text, "#include"), 0u) << name;
        EXPECT_LE(occurrences(text, "#version"), 1u) << name;
        EXPECT_LE(occurrences(text, "const float PI ="), 1u) << name;
    }
    EXPECT_EQ(occurrences(library()->expand("pass/composite.frag").text, "const float PI ="), 1u);
}

TEST(ShaderLibrary, VersionAndPragmasComeFirst)
{
    // OSG's import of defines, and #version itself, allow nothing in front.
    const Folder folder;
    folder.write("lib/a.glsl", "#pragma import_defines(B)\nfloat a();\n");
    folder.write("pass/p.frag", "#version 330\n// comment\n#include \"lib/a.glsl\"\n#pragma import_defines(A)\nvoid main() {}\n");
    const std::string text = library()->expand("pass/p.frag").text;
    EXPECT_EQ(text.rfind("#version 330\n#pragma import_defines(B)\n#pragma import_defines(A)\n#line ", 0), 0u) << text;
}

TEST(ShaderLibrary, AMissingIncludeNamesWhereAndWhat)
{
    const Folder folder;
    folder.write("pass/p.frag", "#version 330\n\n#include \"lib/x.glsl\"\n");
    EXPECT_EQ(failureOf("pass/p.frag"), "pass/p.frag:3: no shader text named 'lib/x.glsl'");
    folder.write("lib/y.glsl", "#include \"lib/z.glsl\"\n");
    folder.write("pass/q.frag", "#include \"lib/y.glsl\"\n");
    EXPECT_EQ(failureOf("pass/q.frag"), "lib/y.glsl:1: no shader text named 'lib/z.glsl'");
    EXPECT_EQ(failureOf("pass/none.frag"), "no shader text named 'pass/none.frag'");
}

TEST(ShaderLibrary, IncludingEachOtherEnds)
{
    const Folder folder;
    folder.write("lib/a.glsl", "#include \"lib/b.glsl\"\nfloat a;\n");
    folder.write("lib/b.glsl", "#include \"lib/a.glsl\"\nfloat b;\n");
    EXPECT_NE(library()->expand("lib/a.glsl").text.find("float b;\nfloat a;\n"), std::string::npos);
}

TEST(ShaderLibrary, LogsAreTranslatedToFileAndLine)
{
    const Folder folder;
    folder.write("lib/a.glsl", "// first\nfloat fault = 1\n");
    folder.write("pass/p.frag", "#version 330\n#pragma import_defines(A)\n#include \"lib/a.glsl\"\nvoid main() { here; }\n");
    const ShaderText text = library()->expand("pass/p.frag");
    const std::string a = std::to_string(driverLine(text.text, "float fault"));
    const std::string b = std::to_string(driverLine(text.text, "void main"));
    // Mesa, NVIDIA, glslang
    EXPECT_EQ(text.translate("0:" + a + "(7): error: bad\n"), "lib/a.glsl:2: error: bad\n");
    EXPECT_EQ(text.translate("0(" + b + ") : error C1008: undefined\n"), "pass/p.frag:4 : error C1008: undefined\n");
    EXPECT_EQ(text.translate("ERROR: 0:" + b + ": 'here' : undeclared\n"), "ERROR: pass/p.frag:4: 'here' : undeclared\n");
    EXPECT_EQ(text.translate("no position\n0:9999(1): far\n"), "no position\n0:9999(1): far\n");
}

TEST(ShaderLibrary, LineDirectiveCountsTheLinesInFront)
{
    const Folder folder;
    folder.write("pass/p.frag", "#version 330\n#pragma import_defines(A)\nfirst\n");
    // #line n numbers the line after it n: the one that "first" has in the expanded text.
    const std::string text = library()->expand("pass/p.frag").text;
    const size_t at = text.find("#line ");
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(std::stoul(text.substr(at + 6)), driverLine(text, "first"));
}

TEST(ShaderLibrary, AFileOnThePathReplacesTheEmbedded)
{
    const Folder folder;
    folder.write("lib/frame.glsl", "// ours\n");
    EXPECT_NE(library()->expand("lib/frame.glsl").text.find("// ours"), std::string::npos);
    // Others stay embedded, and include ours.
    const std::string text = library()->expand("pass/specular.frag").text;
    EXPECT_NE(text.find("// ours"), std::string::npos);
    EXPECT_EQ(text.find("mat3 frameAround(vec3 n)\n{"), std::string::npos);
}

TEST(ShaderLibrary, ProgramsAreKeptUntilReload)
{
    const Folder folder;
    folder.write("pass/p.frag", "#version 330\nvoid main() { /* one */ }\n");
    const osg::ref_ptr<ShaderLibrary> shaders = library();
    const osg::ref_ptr<osg::Program> first = shaders->program("pass/fullscreen.vert", "pass/p.frag");
    ASSERT_EQ(first->getNumShaders(), 2u);
    folder.write("pass/p.frag", "#version 330\nvoid main() { /* two */ }\n");
    EXPECT_EQ(shaders->program("pass/fullscreen.vert", "pass/p.frag"), first);
    shaders->reload();
    const osg::ref_ptr<osg::Program> second = shaders->program("pass/fullscreen.vert", "pass/p.frag");
    EXPECT_NE(second, first);
    EXPECT_NE(second->getShader(1)->getShaderSource().find("two"), std::string::npos);
    EXPECT_NE(first->getShader(1)->getShaderSource().find("one"), std::string::npos);
}

TEST(ShaderLibrary, AnotherVertexShaderIsAnotherProgram)
{
    const osg::ref_ptr<ShaderLibrary> shaders = library();
    const osg::ref_ptr<osg::Program> a = shaders->program("pass/surface.vert", "pass/gbuffer.frag");
    EXPECT_NE(a, shaders->program("pass/surface.vert", "pass/forward.frag"));
    EXPECT_EQ(a, shaders->program("pass/surface.vert", "pass/gbuffer.frag"));
}

// A define that a text asks for and nobody imports is never there: OSG sets those alone that a shader names.
TEST(ShaderLibrary, EveryTextImportsTheDefinesItAsksFor)
{
    unsigned asking = 0;
    for (const std::string& name : ShaderLibrary::names()) {
        const std::string text = library()->expand(name).text;
        const std::set<std::string> own = matches(text, "#define +(\\w+)");
        std::set<std::string> imported;
        for (const std::string& list : matches(text, "#pragma import_defines\\(([^)]*)\\)"))
            imported.merge(matches(list, "(\\w+)"));
        std::set<std::string> asked;
        for (const std::string& line : matches(text, "(#(?:if|elif)[^\n]*)"))
            for (const std::string& word : matches(line, "\\b([A-Z][A-Z0-9_]+)\\b"))
                if (!own.count(word)) asked.insert(word);
        EXPECT_EQ(asked, imported) << name;
        asking += !asked.empty();
    }
    EXPECT_GT(asking, 10u);
}

}  // namespace ShaderLibrary_test
