/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/FrameBufferObject>
#include <osg/Image>
#include <osg/Texture2D>
#include <osg/Vec3d>

namespace osgEnvLight
{

/** A texture of exact texels, to draw into or to look up: NEAREST, clamped to its edge, not resized to powers of two. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Texture2D> targetTexture(int width, int height, GLint internalFormat);

/** Let look-ups between its texels be linear. */
OSGENVLIGHT_EXPORT void filterLinearly(osg::Texture& texture);

/** Write a texel of a table of floats, RGBA. */
void writeTexel(osg::Image& image, unsigned column, unsigned row, const osg::Vec3d& rgb, double alpha);
/** Such a table, to look up. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Texture2D> tableTexture(osg::Image* image);

/** A frame buffer of these; depth may be null. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::FrameBufferObject> frameBufferOf(osg::Texture2D* color, osg::Texture2D* depth = nullptr);

}  // namespace osgEnvLight
