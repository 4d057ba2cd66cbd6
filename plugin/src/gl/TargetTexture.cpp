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

}  // namespace osgEnvLight
