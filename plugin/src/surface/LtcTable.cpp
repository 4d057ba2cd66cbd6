// SPDX-License-Identifier: MIT
#include "surface/LtcTable.h"

namespace osgEnvLight
{

namespace
{

osg::ref_ptr<osg::Image> makeImage()
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(ltcSide, ltcSide, 1, GL_RGBA, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGBA16F_ARB);
    float* out = reinterpret_cast<float*>(image->data());
    for (const int value : ltcTable) *out++ = float(value * ltcUnit);
    return image;
}

}  // namespace

osg::ref_ptr<osg::Image> ltcTableImage()
{
    static const osg::ref_ptr<osg::Image> image = makeImage();
    return image;
}

osg::ref_ptr<osg::Texture2D> makeLtcTable()
{
    osg::ref_ptr<osg::Texture2D> table = new osg::Texture2D(ltcTableImage());
    table->setInternalFormat(GL_RGBA16F_ARB);
    table->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    table->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    table->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    table->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    table->setResizeNonPowerOfTwoHint(false);
    return table;
}

}  // namespace osgEnvLight
