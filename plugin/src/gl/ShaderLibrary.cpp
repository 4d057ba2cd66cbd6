// SPDX-License-Identifier: MIT
#include "gl/ShaderLibrary.h"

#include "gl/ReportingProgram.h"

#include <osgDB/FileUtils>
#include <osgDB/FileNameUtils>
#include <osgDB/fstream>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace osgEnvLight
{

namespace
{

bool startsWith(const std::string& line, const char* word)
{
    size_t i = line.find_first_not_of(" \t");
    return i != std::string::npos && line.compare(i, std::char_traits<char>::length(word), word) == 0;
}

std::string quotedName(const std::string& line)
{
    size_t a = line.find('"');
    size_t b = line.rfind('"');
    return a != std::string::npos && b > a ? line.substr(a + 1, b - a - 1) : std::string();
}

}  // namespace

void ShaderText::append(const std::string& line, const std::string& file, unsigned number)
{
    text += line + '\n';
    _origins.push_back({file, number});
}

std::string ShaderText::translate(const std::string& log) const
{
    // Mesa "0:12(5): error", NVIDIA "0(12) : error", glslang "ERROR: 0:12:"
    static const std::regex position("(^|[^0-9A-Za-z_.])\\d+[:(](\\d+)\\)?(\\(\\d+\\))?");
    std::istringstream in(log);
    std::string line;
    std::string out;
    while (std::getline(in, line)) {
        std::smatch m;
        if (std::regex_search(line, m, position)) {
            unsigned long number = std::stoul(m[2].str().substr(0, 9));
            if (number >= 1 && number <= _origins.size()) {
                const Origin& o = _origins[number - 1];
                line = m.prefix().str() + m[1].str() + o.file + ":" + std::to_string(o.line) + m.suffix().str();
            }
        }
        out += line + '\n';
    }
    return out;
}

ShaderLibrary::ShaderLibrary(Failure* failure) : _failure(failure)
{
    if (const char* path = std::getenv("ENVLIGHT_SHADER_PATH")) {
        osgDB::FilePathList folders;
        osgDB::convertStringPathIntoFilePathList(path, folders);
        _path.assign(folders.begin(), folders.end());
    }
}

ShaderLibrary::~ShaderLibrary() = default;

std::vector<std::string> ShaderLibrary::names()
{
    std::vector<std::string> result;
    for (unsigned i = 0; i < numEmbeddedShaders; ++i) result.push_back(embeddedShaders[i].name);
    return result;
}

std::string ShaderLibrary::source(const std::string& name, const std::string& includedFrom) const
{
    for (const std::string& folder : _path) {
        osgDB::ifstream in(osgDB::concatPaths(folder, name).c_str(), std::ios::binary);
        std::ostringstream text;
        if (in && text << in.rdbuf()) return text.str();
    }
    for (unsigned i = 0; i < numEmbeddedShaders; ++i)
        if (name == embeddedShaders[i].name) return embeddedShaders[i].text;
    throw std::runtime_error(includedFrom + "no shader text named '" + name + "'");
}

void ShaderLibrary::expandInto(ShaderText& out, std::vector<std::string>& pragmas, std::vector<std::string>& seen,
                               const std::string& name, const std::string& includedFrom) const
{
    if (std::find(seen.begin(), seen.end(), name) != seen.end()) return;
    seen.push_back(name);
    std::istringstream in(source(name, includedFrom));
    std::string line;
    for (unsigned number = 1; std::getline(in, line); ++number) {
        if (startsWith(line, "#include"))
            expandInto(out, pragmas, seen, quotedName(line), name + ":" + std::to_string(number) + ": ");
        else if (startsWith(line, "#version") || startsWith(line, "#pragma"))
            pragmas.push_back(line);
        else
            out.append(line, name, number);
    }
}

ShaderText ShaderLibrary::expand(const std::string& name) const
{
    ShaderText body;
    std::vector<std::string> pragmas;
    std::vector<std::string> seen;
    expandInto(body, pragmas, seen, name, "");
    ShaderText result;
    for (const std::string& line : pragmas) result.append(line, name, 1);
    // OSG inserts a line for each define after #version; numbering from here on hides them from the driver's log.
    result.append("#line " + std::to_string(pragmas.size() + 2), name, 1);
    result.text += body.text;
    result._origins.insert(result._origins.end(), body._origins.begin(), body._origins.end());
    return result;
}

osg::Program* ShaderLibrary::program(const std::string& vertexShader, const std::string& fragmentShader)
{
    osg::ref_ptr<osg::Program>& program = _programs[vertexShader + " " + fragmentShader];
    if (program) return program.get();
    program = new ReportingProgram(_failure.get(), vertexShader, expand(vertexShader), fragmentShader, expand(fragmentShader));
    return program.get();
}

void ShaderLibrary::reload()
{
    _programs.clear();
}

void ShaderLibrary::resizeGLObjectBuffers(unsigned maximum)
{
    for (auto& [name, program] : _programs)
        if (program) program->resizeGLObjectBuffers(maximum);
}

void ShaderLibrary::releaseGLObjects(osg::State* state) const
{
    for (const auto& [name, program] : _programs)
        if (program) program->releaseGLObjects(state);  // null: its text is missing
}

}  // namespace osgEnvLight
