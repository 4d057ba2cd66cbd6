// SPDX-License-Identifier: MIT
// Area lights in the world, for tests of what is made of them.
#pragma once

#include "surface/Emitter.h"

#include <gtest/gtest.h>

/** A light where its own coordinates are the world's. */
inline osgEnvLight::Emitter placed(const osgEnvLight::AreaLight& light)
{
    osgEnvLight::Emitter emitter;
    EXPECT_EQ("", osgEnvLight::placeEmitter(light, osg::Matrixd(), emitter));
    return emitter;
}

/** A disc that is lit downwards, of radiance 1. */
inline osgEnvLight::Emitter lampAt(const osg::Vec3d& center, double radius)
{
    osg::ref_ptr<osgEnvLight::AreaLight> light = new osgEnvLight::AreaLight;
    light->setDisc(center, osg::Vec3d(0, 0, -1), radius);
    return placed(*light);
}
