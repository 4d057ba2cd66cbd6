/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include "base/Failure.h"

#include <osg/Program>
#include <osg/Referenced>

#include <map>
#include <string>
#include <vector>

namespace osgEnvLight
{

/** A file of shaders/ as it was built into the library. */
struct EmbeddedShader {
    const char* name;
    const char* text;
};
extern const EmbeddedShader embeddedShaders[];
extern const unsigned numEmbeddedShaders;

/** A shader with its includes expanded, and where each of its lines came from. */
class OSGENVLIGHT_EXPORT ShaderText
{
  public:
    /** What the driver gets: `#version`, pragmas, `#line`, everything else. */
    std::string text;

    /** The driver's log with the line numbers of the expanded text replaced by file and line ("lib/ggx.glsl:12"). */
    std::string translate(const std::string& log) const;

  private:
    friend class ShaderLibrary;
    struct Origin {
        std::string file;
        unsigned line;
    };
    void append(const std::string& line, const std::string& file, unsigned number);
    std::vector<Origin> _origins;  // of each line of text
};

/** Shader text by name, as "pass/diffuse.frag": built into the library, or the file of that name in the first folder of
 * the environment variable ENVLIGHT_SHADER_PATH that has one. Not shared between LitScenes; not thread-safe.*/
class OSGENVLIGHT_EXPORT ShaderLibrary : public osg::Referenced
{
  public:
    /** Reads ENVLIGHT_SHADER_PATH. Programs that do not link report their translated log to failure. */
    explicit ShaderLibrary(Failure* failure);

    /** Names of all built-in files. */
    static std::vector<std::string> names();

    /** The named file with its includes expanded, each file once. Throws std::runtime_error
     * "pass/p.frag:3: no shader text named 'lib/x.glsl'" when a file is missing.*/
    ShaderText expand(const std::string& name) const;

    /** A program named by its fragment shader. The same object each time until reload(). Throws as expand().*/
    osg::Program* program(const std::string& vertexShader, const std::string& fragmentShader);

    /** Forget all programs and read the texts again when they are next asked for. */
    void reload();

    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;

  protected:
    ~ShaderLibrary() override;

  private:
    std::string source(const std::string& name, const std::string& includedFrom) const;
    void expandInto(ShaderText& out, std::vector<std::string>& pragmas, std::vector<std::string>& seen, const std::string& name,
                    const std::string& includedFrom) const;

    osg::ref_ptr<Failure> _failure;
    std::vector<std::string> _path;
    std::map<std::string, osg::ref_ptr<osg::Program>> _programs;
};

}  // namespace osgEnvLight
