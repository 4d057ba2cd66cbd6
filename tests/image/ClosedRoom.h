// SPDX-License-Identifier: MIT
#pragma once

#include <SceneRenderer.h>

/** Six boxes about the cube of half-side inner, up to that of half-side outer. */
inline void addClosedRoom(osgEnvLight::LitScene& lit, double inner, double outer)
{
    for (int axis = 0; axis < 3; ++axis)
        for (double side : {-1.0, 1.0}) {
            osg::Vec3d low(-outer, -outer, -outer), high(outer, outer, outer);
            low[axis] = side > 0.0 ? inner : -outer;
            high[axis] = side > 0.0 ? outer : -inner;
            lit.addChild(makeBox(low, high));
        }
}
