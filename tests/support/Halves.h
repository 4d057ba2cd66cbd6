// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>

/** Left half red, right half blue: what a light shows that is as good as two lights. */
inline osg::ref_ptr<osg::Image> makeHalves(int width = 256, int height = 4)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int k = 0; k < 3; ++k) image->data(unsigned(x), unsigned(y))[k] = k == (2 * x < width ? 0 : 2) ? 255 : 0;
    return image;
}
