// SPDX-License-Identifier: MIT
#include "shadow/DepthProbe.h"

#include <osg/State>

#include <osg/GLExtensions>

namespace osgEnvLight
{

DepthProbe::DepthProbe() : _pixels(new osg::PixelDataBufferObject)
{
    _pixels->setDataSize(side * side * unsigned(sizeof(osg::Vec4f)));
}

std::optional<ProbedPoints> DepthProbe::take()
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::optional<ProbedPoints> seen;
    seen.swap(_measured);
    return seen;
}

void DepthProbe::exchange(osg::State& state)
{
    const auto& ext = *state.get<osg::GLExtensions>();
    if (!_begun) _pixels->compileBuffer(state);
    // bindBufferInWriteMode() would allocate it anew.
    ext.glBindBuffer(GL_PIXEL_PACK_BUFFER_ARB, _pixels->getOrCreateGLBufferObject(state.getContextID())->getGLObjectID());
    if (_begun) {
        if (const void* pixels = ext.glMapBuffer(GL_PIXEL_PACK_BUFFER_ARB, GL_READ_ONLY_ARB)) {
            publish(static_cast<const osg::Vec4f*>(pixels));
            ext.glUnmapBuffer(GL_PIXEL_PACK_BUFFER_ARB);
        }
    }
    _worldFromEye = osg::Matrixd::inverse(state.getInitialViewMatrix());
    _perspective = state.getProjectionMatrix()(3, 3) == 0.0;
    glReadPixels(0, 0, side, side, GL_RGBA, GL_FLOAT, nullptr);
    ext.glBindBuffer(GL_PIXEL_PACK_BUFFER_ARB, 0);
    _begun = true;
}

void DepthProbe::publish(const osg::Vec4f* pixels)
{
    ProbedPoints seen;
    for (int i = 0; i < side * side; ++i)
        if (pixels[i][3] > 0.0f) seen.points.push_back(osg::Vec3d(pixels[i][0], pixels[i][1], pixels[i][2]) * _worldFromEye);
    if (_perspective) seen.eye = _worldFromEye.getTrans();
    seen.worldFromEye = _worldFromEye;
    std::lock_guard<std::mutex> lock(_mutex);
    _measured = std::move(seen);
}

void DepthProbe::releaseGLObjects(osg::State* state) const
{
    _pixels->releaseGLObjects(state);
    _begun = false;
}

}  // namespace osgEnvLight
