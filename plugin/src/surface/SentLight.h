/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/Vec3f>

namespace osgEnvLight
{

/** What a surface does with light, taken as one diffuse colour: for what it sends to other surfaces. Linear. */
struct SentLight {
    osg::Vec3f reflectance;  // of the Lambert layer and the lobe together, each in [0,1]
    osg::Vec3f emission;     // radiance; of colours of the host's as typed, whatever the exposure
    float opacity = 1.0f;    // share of what meets it that it stops

    bool operator==(const SentLight& o) const
    {
        return reflectance == o.reflectance && emission == o.emission && opacity == o.opacity;
    }
};

}  // namespace osgEnvLight
