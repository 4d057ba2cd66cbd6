/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Fog>

namespace osgEnvLight
{

/** What an osg::Fog says, as pass/fog.glsl takes it. */
struct OSGENVLIGHT_EXPORT FogValues {
    FogValues() = default;
    explicit FogValues(const osg::Fog& fog);

    int kind = 0;      // of lib/fog.glsl; 0: there is no fog
    osg::Vec3f color;  // as typed
    float density = 0.0f;
    float start = 0.0f;
    float end = 0.0f;
    bool isRadial = false;

    bool operator==(const FogValues& o) const
    {
        return kind == o.kind && color == o.color && density == o.density && start == o.start && end == o.end &&
               isRadial == o.isRadial;
    }
};

}  // namespace osgEnvLight
