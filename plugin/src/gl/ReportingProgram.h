/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Failure.h"
#include "gl/ShaderLibrary.h"

#include <osg/Program>

namespace osgEnvLight
{

/** A program of ours. It compiles and links its variants itself: where the notify level is INFO, osg::Shader prints its whole
 * source, and osg::Program every uniform, which for our passes is thousands of lines. A variant that does not link is reported to
 * the failure, with the driver's log in terms of the source files.*/
class ReportingProgram : public osg::Program
{
  public:
    ReportingProgram(Failure* failure, const std::string& vertexName, const ShaderText& vertex, const std::string& fragmentName,
                     const ShaderText& fragment);

    void apply(osg::State& state) const override;
    void compileGLObjects(osg::State& state) const override;

  protected:
    ~ReportingProgram() override = default;

  private:
    class Variant;
    Variant& variant(osg::State& state) const;
    void addText(osg::Shader::Type type, const std::string& shaderName, const ShaderText& text);

    const osg::ref_ptr<Failure> _failure;
    const ShaderText _vertex;
    const ShaderText _fragment;
};

}  // namespace osgEnvLight
