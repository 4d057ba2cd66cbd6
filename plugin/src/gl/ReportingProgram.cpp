// SPDX-License-Identifier: MIT
#include "gl/ReportingProgram.h"

#include "gl/ContextNeeds.h"

#include <osg/GLExtensions>
#include <osg/State>

#include <array>
#include <cctype>
#include <set>
#include <sstream>

namespace osgEnvLight
{

namespace
{

const char* const importPragma = "#pragma import_defines(";

bool imports(const std::string& line)
{
    return line.rfind(importPragma, 0) == 0;
}

// The names in "#pragma import_defines(A, B)".
void addImports(const std::string& line, std::set<std::string>& defines)
{
    std::string name;
    for (const char c : line.substr(std::char_traits<char>::length(importPragma))) {
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
            name += c;
        } else if (!name.empty()) {
            defines.insert(name);
            name.clear();
        }
    }
}

}  // namespace

/** The program under one set of defines in one context. */
class ReportingProgram::Variant : public osg::Program::PerContextProgram
{
  public:
    Variant(const ReportingProgram& program, unsigned contextID)
        : PerContextProgram(&program, contextID), _texts{&program._vertex, &program._fragment}
    {
    }

    void linkProgram(osg::State& state) override
    {
        if (!_needsLink) return;
        _needsLink = false;
        _isLinked = false;
        if (_glProgramHandle == 0) return;
        _log.clear();
        const std::array<GLuint, 2> shaders = {compile(GL_VERTEX_SHADER, *_texts[0], state),
                                               compile(GL_FRAGMENT_SHADER, *_texts[1], state)};
        if (shaders[0] && shaders[1]) link(shaders, state);
        for (const GLuint shader : shaders)
            if (shader) _extensions->glDeleteShader(shader);
        if (_isLinked) readUniforms();
    }

    /** Why it is not linked. */
    const std::string& log() const { return _log; }

  private:
    // 0 if it does not compile.
    GLuint compile(GLenum type, const ShaderText& text, const osg::State& state)
    {
        std::string source = text.text;
        if (state.getUseVertexAttributeAliasing() || state.getUseModelViewAndProjectionUniforms())
            state.convertVertexShaderSourceToOsgBuiltIns(source);
        const size_t body = source.find('\n') + 1;  // of the line with #version, which must be the first
        source.insert(body, getDefineString());
        const GLuint shader = _extensions->glCreateShader(type);
        const GLchar* pointer = source.c_str();
        _extensions->glShaderSource(shader, 1, &pointer, nullptr);
        _extensions->glCompileShader(shader);
        GLint compiled = GL_FALSE;
        _extensions->glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
        if (compiled == GL_TRUE) return shader;
        std::string log;
        if (_extensions->getShaderInfoLog(shader, log)) _log += text.translate(log);
        _extensions->glDeleteShader(shader);
        return 0;
    }

    void link(const std::array<GLuint, 2>& shaders, osg::State& state)
    {
        for (const GLuint shader : shaders) _extensions->glAttachShader(_glProgramHandle, shader);
        if (state.getUseVertexAttributeAliasing())
            for (const auto& [name, location] : state.getAttributeBindingList())
                _extensions->glBindAttribLocation(_glProgramHandle, location, name.c_str());
        _extensions->glLinkProgram(_glProgramHandle);
        GLint linked = GL_FALSE;
        _extensions->glGetProgramiv(_glProgramHandle, GL_LINK_STATUS, &linked);
        _isLinked = linked == GL_TRUE;
        if (!_isLinked) getInfoLog(_log);
        for (const GLuint shader : shaders) _extensions->glDetachShader(_glProgramHandle, shader);
        _extensions->debugObjectLabel(GL_PROGRAM, _glProgramHandle, _program->getName());
    }

    void readUniforms()
    {
        _uniformInfoMap.clear();
        _lastAppliedUniformList.clear();
        GLint count = 0;
        GLint longest = 0;
        _extensions->glGetProgramiv(_glProgramHandle, GL_ACTIVE_UNIFORMS, &count);
        _extensions->glGetProgramiv(_glProgramHandle, GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
        std::vector<GLchar> name(size_t(longest) + 1);
        for (GLint i = 0; i < count; ++i) {
            GLint size = 0;
            GLenum type = 0;
            _extensions->glGetActiveUniform(_glProgramHandle, GLuint(i), longest, nullptr, &size, &type, name.data());
            std::string plain = name.data();
            plain = plain.substr(0, plain.find('['));  // drivers add it to the names of arrays
            const GLint location = _extensions->glGetUniformLocation(_glProgramHandle, plain.c_str());
            if (location >= 0) _uniformInfoMap[osg::Uniform::getNameID(plain)] = ActiveVarInfo(location, type, size);
        }
    }

    const std::array<const ShaderText*, 2> _texts;  // of the program, which owns this
    std::string _log;
};

ReportingProgram::ReportingProgram(Failure* failure, const std::string& vertexName, const ShaderText& vertex,
                                   const std::string& fragmentName, const ShaderText& fragment)
    : _failure(failure), _vertex(vertex), _fragment(fragment)
{
    setName("osgEnvLight " + fragmentName);
    addText(osg::Shader::VERTEX, vertexName, vertex);
    addText(osg::Shader::FRAGMENT, fragmentName, fragment);
}

// OSG sees the text without the pragmas, each of which it would print, and is told the names in them.
void ReportingProgram::addText(osg::Shader::Type type, const std::string& shaderName, const ShaderText& text)
{
    std::set<std::string> defines;
    std::string source;
    std::istringstream in(text.text);
    for (std::string line; std::getline(in, line);) {
        if (imports(line))
            addImports(line, defines);
        else
            source += line + '\n';
    }
    osg::ref_ptr<osg::Shader> shader = new osg::Shader(type, source);
    shader->setName(shaderName);
    shader->getShaderDefines().insert(defines.begin(), defines.end());
    addShader(shader);
}

ReportingProgram::Variant& ReportingProgram::variant(osg::State& state) const
{
    const unsigned contextID = state.getContextID();
    osg::ref_ptr<ProgramObjects>& objects = _pcpList[contextID];
    if (!objects) objects = new ProgramObjects(this, contextID);
    const std::string defines = state.getDefineString(getShaderDefines());
    for (const auto& program : objects->_perContextPrograms)
        if (auto* known = program->getDefineString() == defines ? dynamic_cast<Variant*>(program.get()) : nullptr) return *known;
    osg::ref_ptr<Variant> made = new Variant(*this, contextID);
    made->setDefineString(defines);
    objects->_perContextPrograms.push_back(made);
    return *made;
}

void ReportingProgram::compileGLObjects(osg::State& state) const
{
    variant(state).linkProgram(state);
}

void ReportingProgram::apply(osg::State& state) const
{
    if (!state.get<osg::GLExtensions>()->isGlslSupported) return;
    Variant& program = variant(state);
    program.linkProgram(state);
    if (program.isLinked()) {
        program.useProgram();
        state.setLastAppliedProgramObject(&program);
        return;
    }
    state.get<osg::GLExtensions>()->glUseProgram(0);
    state.setLastAppliedProgramObject(nullptr);
    if (_failure->happened(state.getContextID())) return;
    const std::string unmet = unmetNeeds(state);
    _failure->report(state.getContextID(), unmet.empty() ? getName() + " does not compile\n" + program.log() : unmet);
}

}  // namespace osgEnvLight
