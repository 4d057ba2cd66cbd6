// SPDX-License-Identifier: MIT
#include <osgEnvLight/SurfaceProgram>

#include "gl/CasterProgram.h"
#include "gl/ShaderLibrary.h"

namespace osgEnvLight
{

namespace
{

const char* const movedVertices = "osgEnvLight moved vertices";

osg::ref_ptr<osg::Shader> ours(osg::Shader::Type type, const std::string& name)
{
    const osg::ref_ptr<ShaderLibrary> library = new ShaderLibrary(nullptr);
    std::string text = library->expand(name).text;
    if (type == osg::Shader::VERTEX) text.insert(text.find('\n') + 1, "#define MOVES_VERTICES\n");
    const osg::ref_ptr<osg::Shader> shader = new osg::Shader(type, text);
    shader->setName(name);
    return shader;
}

}  // namespace

osg::ref_ptr<osg::Program> SurfaceProgram::create(const std::string& source)
{
    const bool hasVersion = source.find("#version") != std::string::npos;
    const osg::ref_ptr<osg::Shader> own =
        new osg::Shader(osg::Shader::VERTEX, hasVersion ? source : "#version 330 compatibility\n" + source);
    own->setName(movedVertices);
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("osgEnvLight pass/movedsurface.frag");
    program->addShader(own);
    program->addShader(ours(osg::Shader::VERTEX, "pass/surface.vert"));
    program->addShader(ours(osg::Shader::FRAGMENT, "pass/movedsurface.frag"));
    return program;
}

const osg::Shader* SurfaceProgram::vertexShaderOf(const osg::Program& program)
{
    for (unsigned i = 0; i < program.getNumShaders(); ++i)
        if (program.getShader(i)->getName() == movedVertices) return program.getShader(i);
    return nullptr;
}

osg::ref_ptr<osg::Program> passProgram(const osg::Program& moving, const std::string& pass)
{
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    const std::string path = "pass/" + pass;
    program->setName("osgEnvLight " + path + ".frag");
    program->addShader(const_cast<osg::Shader*>(SurfaceProgram::vertexShaderOf(moving)));
    program->addShader(ours(osg::Shader::VERTEX, path + ".vert"));
    program->addShader(ours(osg::Shader::FRAGMENT, path + ".frag"));
    for (const auto& [name, location] : moving.getAttribBindingList()) program->addBindAttribLocation(name, location);
    for (const auto& [name, index] : moving.getUniformBlockBindingList()) program->addBindUniformBlock(name, index);
    return program;
}

bool followsTime(const osg::Shader& shader)
{
    for (const char* name :
         {"osg_FrameTime", "osg_SimulationTime", "osg_DeltaFrameTime", "osg_DeltaSimulationTime", "osg_FrameNumber"})
        if (shader.getShaderSource().find(name) != std::string::npos) return true;
    return false;
}

}  // namespace osgEnvLight
