// SPDX-License-Identifier: MIT
#include "surface/FogValues.h"

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

int kindOf(osg::Fog::Mode mode)
{
    switch (mode) {
        case osg::Fog::LINEAR:
            return glsl::FOG_LINEAR;
        case osg::Fog::EXP2:
            return glsl::FOG_EXP2;
        default:
            return glsl::FOG_EXP;
    }
}

}  // namespace

FogValues::FogValues(const osg::Fog& fog)
    : kind(kindOf(fog.getMode())),
      color(fog.getColor().x(), fog.getColor().y(), fog.getColor().z()),
      density(fog.getDensity()),
      start(fog.getStart()),
      end(fog.getEnd()),
      isRadial(fog.getUseRadialFog())
{
}

}  // namespace osgEnvLight
