// SPDX-License-Identifier: MIT
#include <osgEnvLight/LightShader>

#include "gl/ShaderLibrary.h"

#include <regex>
#include <set>
#include <sstream>

namespace osgEnvLight
{

namespace
{

const char* const shaderName = "osgEnvLight light";

// Functions of the text but for those that the application calls. They are global to a program, and may have the names of its
// own.
std::set<std::string> privateFunctions(const std::string& text)
{
    static const std::regex definition("^[A-Za-z]\\w* ([a-z]\\w*)\\(");
    std::set<std::string> names;
    std::istringstream in(text);
    std::string line;
    while (std::getline(in, line)) {
        std::smatch match;
        if (std::regex_search(line, match, definition) && match[1] != "envlightLit") names.insert(match[1]);
    }
    return names;
}

}  // namespace

osg::ref_ptr<osg::Shader> LightShader::create()
{
    const osg::ref_ptr<ShaderLibrary> library = new ShaderLibrary(nullptr);
    const std::string text = library->expand("pass/userlight.glsl").text;
    std::string source = "#version 330 compatibility\n";
    for (const std::string& name : privateFunctions(text)) source += "#define " + name + " envlight_" + name + "\n";
    const osg::ref_ptr<osg::Shader> shader = new osg::Shader(osg::Shader::FRAGMENT, source + text);
    shader->setName(shaderName);
    return shader;
}

bool LightShader::isOne(const osg::Shader& shader)
{
    return shader.getName() == shaderName;
}

}  // namespace osgEnvLight
