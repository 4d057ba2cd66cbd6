// SPDX-License-Identifier: MIT
#include "frame/FullScreen.h"

#include <osg/GLExtensions>
#include <osg/Program>
#include <osg/Viewport>

#include <cstring>

namespace osgEnvLight
{

namespace
{

// Uploads to the program in use; names that it lacks are skipped.
class Uploader
{
  public:
    Uploader(const osg::Program::PerContextProgram& program, const osg::GLExtensions& ext) : _program(program), _ext(ext) {}

    void matrix4(const char* name, const osg::Matrixd& m) const
    {
        const osg::Matrixf f(m);
        if (const GLint l = location(name); l >= 0) _ext.glUniformMatrix4fv(l, 1, GL_FALSE, f.ptr());
    }

    // Rotation only. OSG multiplies row vectors, so its rows are GLSL's columns.
    void matrix3(const char* name, const osg::Matrixd& m) const
    {
        float f[9];
        for (int i = 0; i < 3; ++i) {
            osg::Vec3d row(m(i, 0), m(i, 1), m(i, 2));
            row.normalize();
            for (int j = 0; j < 3; ++j) f[3 * i + j] = float(row[j]);
        }
        if (const GLint l = location(name); l >= 0) _ext.glUniformMatrix3fv(l, 1, GL_FALSE, f);
    }

    void vec2(const char* name, double x, double y) const
    {
        if (const GLint l = location(name); l >= 0) _ext.glUniform2f(l, float(x), float(y));
    }

  private:
    GLint location(const char* name) const { return _program.getUniformLocation(name); }

    const osg::Program::PerContextProgram& _program;
    const osg::GLExtensions& _ext;
};

}  // namespace

FullScreen::FullScreen(osg::Vec3Array* vertices)
{
    setFullScreenTriangle(*this, vertices);
}

// Of OpenGL 3.0, but GLExtensions lacks them; each target has a value of its own, as glClear() can't.
void FullScreen::clearTargets() const
{
    if (clears.empty()) return;
    void(GL_APIENTRY * clearFloats)(GLenum, GLint, const GLfloat*) = nullptr;
    void(GL_APIENTRY * clearBits)(GLenum, GLint, const GLuint*) = nullptr;
    osg::setGLExtensionFuncPtr(clearFloats, "glClearBufferfv");
    osg::setGLExtensionFuncPtr(clearBits, "glClearBufferuiv");
    for (const Clear& c : clears) {
        GLuint bits[4];
        std::memcpy(bits, c.value.data(), sizeof(bits));
        if (c.bits && clearBits) clearBits(GL_COLOR, c.target, bits);
        if (!c.bits && clearFloats) clearFloats(GL_COLOR, c.target, c.value.data());
    }
}

void FullScreen::uploadUniforms(const osg::State& state) const
{
    const Uploader upload(*state.getLastAppliedProgramObject(), *state.get<osg::GLExtensions>());
    const osg::Matrixd projection =
        osg::Matrixd(state.getProjectionMatrix()) * depth.fromHostClip() * osg::Matrixd::translate(subpixel[0], subpixel[1], 0.0);
    const osg::Matrixd eyeToWorld = osg::Matrixd::inverse(state.getInitialViewMatrix());
    const auto* viewport = static_cast<const osg::Viewport*>(state.getLastAppliedAttribute(osg::StateAttribute::VIEWPORT));
    upload.matrix4("projection", projection);
    upload.matrix4("inverseProjection", osg::Matrixd::inverse(projection));
    upload.matrix3("mapFromEye", eyeToWorld * mapFromWorld);
    upload.matrix4("atlasFromEye", eyeToWorld * osg::Matrixd::translate(-atlasOrigin));
    upload.vec2("viewportSize", viewport->width(), viewport->height());
    upload.vec2("viewportOrigin", viewport->x(), viewport->y());
    upload.vec2("subpixel", subpixel[0], subpixel[1]);
    upload.vec2("hostDepth", depth.toHostDepth()[0], depth.toHostDepth()[1]);
}

void FullScreen::drawImplementation(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    osg::ref_ptr<ContextWatch::Listener> listener;
    if (owner.lock(listener)) ContextWatch::add(state, listener.get());
    if (!state.getLastAppliedProgramObject()) return;  // it has reported why
    uploadUniforms(state);
    timed.begin(state);
    clearTargets();
    drawShapes(renderInfo);
    timed.end(state);
    // State knows what is bound by its address alone, and would take a later texture at a freed one's for it.
    for (unsigned unit = 0; unit < textureUnits; ++unit) state.haveAppliedTextureAttribute(unit, osg::StateAttribute::TEXTURE);
}

}  // namespace osgEnvLight
