/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Emitter.h"

#include <osg/Image>
#include <osg/Texture2DArray>

#include <vector>

namespace osgEnvLight
{

/** Textures of area lights are an array of layers, so many at most: OpenGL 3.3 has 256 everywhere. Further pictures are even. */
const unsigned mostAreaPictures = 256;

bool showsPicture(const Emitter& light);
/** As pass/arealights.glsl reads the lights. */
osg::ref_ptr<osg::Image> areaLightImage(const std::vector<Emitter>& lights, const osg::Vec3d& origin);
/** Clusters of them, as pass/lightcuts.glsl reads these; at least one. */
osg::ref_ptr<osg::Image> lightTreeImage(const std::vector<Emitter>& lights, const osg::Vec3d& origin);
/** A texel for each of these, as pass/lightcuts.glsl reads them. */
osg::ref_ptr<osg::Image> lightsWithPointsImage(const std::vector<unsigned char>& sides);
/** A layer for each light that shows a picture, in their order. */
osg::ref_ptr<osg::Texture2DArray> areaPictureTexture(const std::vector<Emitter>& lights);

}  // namespace osgEnvLight
