// SPDX-License-Identifier: MIT
#include "gl/TargetTexture.h"

namespace osgEnvLight
{

osg::ref_ptr<osg::Texture2D> targetTexture(int width, int height, GLint internalFormat)
{
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(width, height);
    texture->setInternalFormat(internalFormat);
    const bool depth = internalFormat == GL_DEPTH_COMPONENT24 || internalFormat == GL_DEPTH_COMPONENT16;
    const bool whole = internalFormat == GL_RGBA32UI_EXT;
    texture->setSourceFormat(depth ? GL_DEPTH_COMPONENT : whole ? GL_RGBA_INTEGER_EXT : GL_RGBA);
    texture->setSourceType(depth || whole ? GL_UNSIGNED_INT : GL_FLOAT);
    texture->setResizeNonPowerOfTwoHint(false);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    return texture;
}

void filterLinearly(osg::Texture& texture)
{
    texture.setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    texture.setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
}

void writeTexel(osg::Image& image, unsigned column, unsigned row, const osg::Vec3d& rgb, double alpha)
{
    float* out = reinterpret_cast<float*>(image.data(column, row));
    for (int k = 0; k < 3; ++k) out[k] = float(rgb.ptr()[k]);
    out[3] = float(alpha);
}

osg::ref_ptr<osg::Texture2D> tableTexture(osg::Image* image)
{
    const osg::ref_ptr<osg::Texture2D> texture = targetTexture(image->s(), image->t(), GL_RGBA32F_ARB);
    texture->setImage(image);
    return texture;
}

osg::ref_ptr<osg::FrameBufferObject> frameBufferOf(osg::Texture2D* color, osg::Texture2D* depth)
{
    osg::ref_ptr<osg::FrameBufferObject> target = new osg::FrameBufferObject;
    target->setAttachment(osg::Camera::COLOR_BUFFER0, osg::FrameBufferAttachment(color));
    if (depth) target->setAttachment(osg::Camera::DEPTH_BUFFER, osg::FrameBufferAttachment(depth));
    return target;
}

}  // namespace osgEnvLight
