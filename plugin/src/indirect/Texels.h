/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "gl/TargetTexture.h"

#include <osg/Image>
#include <osg/Vec3f>

#include <algorithm>

namespace osgEnvLight
{

/** Floats for a texture, 0 at first. */
struct Texels {
    osg::ref_ptr<osg::Image> image;
    int channels;

    Texels(int width, int height, int count) : image(new osg::Image), channels(count)
    {
        static const GLenum formats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
        image->allocateImage(width, height, 1, formats[channels - 1], GL_FLOAT);
        std::fill_n(reinterpret_cast<float*>(image->data()), size_t(width) * size_t(height) * size_t(channels), 0.0f);
    }
    float* at(int x, int y) { return reinterpret_cast<float*>(image->data(unsigned(x), unsigned(y))); }
    float* at(int i) { return at(i % image->s(), i / image->s()); }
    void put(int i, const osg::Vec3f& v, float w)
    {
        std::copy_n(v.ptr(), 3, at(i));
        at(i)[3] = w;
    }

    osg::ref_ptr<osg::Texture2D> texture(GLint format) const
    {
        osg::ref_ptr<osg::Texture2D> t = targetTexture(image->s(), image->t(), format);
        image->setInternalTextureFormat(format);
        t->setImage(image);
        return t;
    }
};

}  // namespace osgEnvLight
