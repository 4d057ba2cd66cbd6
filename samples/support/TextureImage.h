// SPDX-License-Identifier: MIT
#pragma once

#include <metrics/Picture>

#include <osg/Image>
#include <osg/State>
#include <osg/Texture2D>

/** A texture's first level as floats. Its context is current. */
osg::ref_ptr<osg::Image> readTexture(const osg::Texture2D& texture, osg::State& state);

/** Of four floats a pixel. */
osgEnvLight::Picture pictureOf(const osg::Image& image);
