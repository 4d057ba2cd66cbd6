// SPDX-License-Identifier: MIT
#include "shadow/ShadowTargets.h"

#include "gl/TargetTexture.h"

namespace osgEnvLight
{

namespace
{

osg::ref_ptr<osg::FrameBufferObject> makeTarget(osg::Texture2D* color, osg::Texture2D* depth)
{
    osg::ref_ptr<osg::FrameBufferObject> target = new osg::FrameBufferObject;
    target->setAttachment(osg::Camera::COLOR_BUFFER0, osg::FrameBufferAttachment(color));
    if (depth) target->setAttachment(osg::Camera::DEPTH_BUFFER, osg::FrameBufferAttachment(depth));
    return target;
}

}  // namespace

ShadowTargets::ShadowTargets(unsigned mapSize, unsigned columnCount, unsigned rows, unsigned batchSize, GLint mapFormat,
                             GLint slopeFormat)
    : size(mapSize),
      columns(columnCount),
      batch(batchSize),
      texture(targetTexture(int(columns * size), int(rows * size), mapFormat)),
      firstDepth(targetTexture(int(batch * size), int(size), GL_DEPTH_COMPONENT24)),
      firstSlope(targetTexture(int(batch * size), int(size), slopeFormat)),
      secondDepth(targetTexture(int(batch * size), int(size), GL_DEPTH_COMPONENT24)),
      maps(makeTarget(texture.get(), nullptr)),
      first(makeTarget(firstSlope.get(), firstDepth.get())),
      second(makeTarget(firstSlope.get(), secondDepth.get()))
{
}

void ShadowTargets::resizeGLObjectBuffers(unsigned maximum) const
{
    for (osg::Texture2D* t : textures()) t->resizeGLObjectBuffers(maximum);
    for (osg::FrameBufferObject* f : frameBuffers()) f->resizeGLObjectBuffers(maximum);
}

void ShadowTargets::releaseGLObjects(osg::State* state) const
{
    for (osg::Texture2D* t : textures()) t->releaseGLObjects(state);
    for (osg::FrameBufferObject* f : frameBuffers()) f->releaseGLObjects(state);
}

}  // namespace osgEnvLight
