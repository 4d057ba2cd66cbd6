// SPDX-License-Identifier: MIT
#include "gl/ContextNeeds.h"

#include <osg/GLExtensions>

#include <iomanip>
#include <locale>
#include <sstream>

namespace osgEnvLight
{

std::string unmetNeeds(const osg::State& state)
{
    const auto* gl = state.get<osg::GLExtensions>();
    const float least = 3.3f - 0.01f;  // versions are sums of floats
    const float leastProfiles = 3.2f - 0.01f;
    const GLenum contextProfileMask = 0x9126;
    const GLint coreProfile = 1;
    GLint profile = 0;
    if (gl->glVersion > leastProfiles) glGetIntegerv(contextProfileMask, &profile);
    const bool isCore = (profile & coreProfile) != 0;
    if (gl->glVersion > least && gl->glslLanguageVersion > least && !isCore) return "";
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::fixed << std::setprecision(1) << "the context has OpenGL " << gl->glVersion
        << (isCore ? " in the core profile" : "") << " with GLSL " << std::setprecision(2) << gl->glslLanguageVersion
        << ", expected at least OpenGL 3.3 with GLSL 3.30 in the compatibility profile";
    return out.str();
}

}  // namespace osgEnvLight
