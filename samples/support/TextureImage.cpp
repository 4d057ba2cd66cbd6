// SPDX-License-Identifier: MIT
#include "TextureImage.h"

#include <algorithm>

osg::ref_ptr<osg::Image> readTexture(const osg::Texture2D& texture, osg::State& state)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    state.setActiveTextureUnit(0);
    texture.getTextureObject(state.getContextID())->bind();
    image->readImageFromCurrentTexture(state.getContextID(), false, GL_FLOAT);
    state.haveAppliedTextureAttribute(0, osg::StateAttribute::TEXTURE);
    return image;
}

osgEnvLight::Picture pictureOf(const osg::Image& image)
{
    osgEnvLight::Picture picture(image.s(), image.t());
    std::copy_n(reinterpret_cast<const float*>(image.data()), picture.rgba.size(), picture.rgba.begin());
    return picture;
}
