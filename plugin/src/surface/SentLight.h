/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Limits.h"

#include <osg/Vec3f>

#include <algorithm>

namespace osgEnvLight
{

/** What a surface does with light, taken as one colour for each of its layers: for what it sends to other surfaces. Linear. */
struct SentLight {
    osg::Vec3f diffuse;      // share of light that the Lambert layer reflects, in [0,1]
    osg::Vec3f glossy;       // that the lobe reflects; the sum of both is below 1
    osg::Vec3f emission;     // radiance; of colours of the host's as typed, whatever the exposure
    float opacity = 1.0f;    // share of what meets it that it stops
    float roughness = 0.0f;  // of the lobe, 0 a mirror

    bool operator==(const SentLight& o) const
    {
        return diffuse == o.diffuse && glossy == o.glossy && emission == o.emission && opacity == o.opacity &&
               roughness == o.roughness;
    }
};

/** Whether it reflects lights as bright images of them, so that these light what is around: polished and brushed metal. */
inline bool isPolished(const SentLight& sent)
{
    const osg::Vec3f& g = sent.glossy;
    return std::max({g.x(), g.y(), g.z()}) >= limits::LEAST_POLISHED && sent.roughness <= limits::MOST_POLISHED_ROUGHNESS;
}

}  // namespace osgEnvLight
