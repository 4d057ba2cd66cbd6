// SPDX-License-Identifier: MIT
#include <osgEnvLight/GBuffer>

#include "gl/TargetTexture.h"

namespace osgEnvLight
{

GBuffer::GBuffer(int w, int h)
    : width(w),
      height(h),
      albedo(targetTexture(w, h, GL_RGBA16)),
      normal(targetTexture(w, h, GL_RGBA16)),
      specular(targetTexture(w, h, GL_RGBA16)),
      emission(targetTexture(w, h, GL_RGBA16F_ARB)),
      depth(targetTexture(w, h, GL_DEPTH_COMPONENT24)),
      _frameBuffer(new osg::FrameBufferObject)
{
    using C = osg::Camera;
    _frameBuffer->setAttachment(C::COLOR_BUFFER0, osg::FrameBufferAttachment(albedo.get()));
    _frameBuffer->setAttachment(C::COLOR_BUFFER1, osg::FrameBufferAttachment(normal.get()));
    _frameBuffer->setAttachment(C::COLOR_BUFFER2, osg::FrameBufferAttachment(specular.get()));
    _frameBuffer->setAttachment(C::COLOR_BUFFER3, osg::FrameBufferAttachment(emission.get()));
    _frameBuffer->setAttachment(C::DEPTH_BUFFER, osg::FrameBufferAttachment(depth.get()));
}

void GBuffer::resizeGLObjectBuffers(unsigned maximum)
{
    for (osg::Texture2D* t : {albedo.get(), normal.get(), specular.get(), emission.get(), depth.get()})
        t->resizeGLObjectBuffers(maximum);
    _frameBuffer->resizeGLObjectBuffers(maximum);
}

void GBuffer::releaseGLObjects(osg::State* state) const
{
    for (osg::Texture2D* t : {albedo.get(), normal.get(), specular.get(), emission.get(), depth.get()})
        t->releaseGLObjects(state);
    _frameBuffer->releaseGLObjects(state);
}

}  // namespace osgEnvLight
