// SPDX-License-Identifier: MIT
#include "shadow/ShadowTargets.h"

#include "gl/TargetTexture.h"

namespace osgEnvLight
{

ShadowTargets::ShadowTargets(unsigned mapSize, unsigned columnCount, unsigned rows, unsigned batchSize, GLint mapFormat,
                             GLint slopeFormat)
    : size(mapSize),
      columns(columnCount),
      batch(batchSize),
      texture(targetTexture(int(columns * size), int(rows * size), mapFormat)),
      firstDepth(targetTexture(int(batch * size), int(size), GL_DEPTH_COMPONENT24)),
      firstSlope(targetTexture(int(batch * size), int(size), slopeFormat)),
      secondDepth(targetTexture(int(batch * size), int(size), GL_DEPTH_COMPONENT24)),
      maps(frameBufferOf(texture.get())),
      first(frameBufferOf(firstSlope.get(), firstDepth.get())),
      second(frameBufferOf(firstSlope.get(), secondDepth.get()))
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
