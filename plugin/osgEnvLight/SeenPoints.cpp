// SPDX-License-Identifier: MIT
#include <osgEnvLight/SeenPoints>

#include <osg/GLExtensions>

namespace osgEnvLight
{

SeenPointsBuffer::SeenPointsBuffer() : _pixels(new osg::PixelDataBufferObject)
{
    _pixels->setDataSize(side * side * unsigned(sizeof(osg::Vec4f)));
}

std::optional<SeenPoints> SeenPointsBuffer::take()
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::optional<SeenPoints> seen;
    seen.swap(_measured);
    return seen;
}

void SeenPointsBuffer::exchange(osg::State& state)
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

void SeenPointsBuffer::publish(const osg::Vec4f* pixels)
{
    SeenPoints seen;
    for (int i = 0; i < side * side; ++i)
        if (pixels[i][3] > 0.0f) seen.points.push_back(osg::Vec3d(pixels[i][0], pixels[i][1], pixels[i][2]) * _worldFromEye);
    if (_perspective) seen.eye = _worldFromEye.getTrans();
    seen.worldFromEye = _worldFromEye;
    std::lock_guard<std::mutex> lock(_mutex);
    _measured = std::move(seen);
}

void SeenPointsBuffer::releaseGLObjects(osg::State* state) const
{
    _pixels->releaseGLObjects(state);
    _begun = false;
}

void SeenPointsPass::drawImplementation(osg::RenderInfo& renderInfo) const
{
    FullScreen::drawImplementation(renderInfo);
    buffer->exchange(*renderInfo.getState());
}

}  // namespace osgEnvLight
