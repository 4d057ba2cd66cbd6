// SPDX-License-Identifier: MIT
#include "surface/AlbedoTable.h"

namespace osgEnvLight
{

namespace
{

osg::ref_ptr<osg::Image> makeImage(int blocks)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(blocks * albedoSide, albedoSide, 1, GL_RGB, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGB32F_ARB);
    const uint16_t* value = albedoTable.data();
    for (int block = 0; block < blocks; ++block)
        for (int y = 0; y < albedoSide; ++y) {
            float* out = reinterpret_cast<float*>(image->data(unsigned(block * albedoSide), unsigned(y)));
            for (int i = 0; i < 3 * albedoSide; ++i) *out++ = float(*value++ * albedoUnit);
        }
    return image;
}

}  // namespace

osg::ref_ptr<osg::Image> albedoTableImage(bool anisotropic)
{
    if (anisotropic) {
        static const osg::ref_ptr<osg::Image> image = makeImage(albedoBlocks);
        return image;
    }
    static const osg::ref_ptr<osg::Image> image = makeImage(limits::ALBEDO_BLOCKS);
    return image;
}

}  // namespace osgEnvLight
