/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Emitter.h"

#include <vector>

namespace osgEnvLight
{

/** A point that stands for a part of an area light, or for several small lights. */
struct EmitterPoint {
    osg::Vec3d position;
    osg::Vec3d normal;     // unit, of the side that sends light
    osg::Vec3d power;      // radiance times the part's area
    osg::Vec3d even;       // the same if the light sent as much from everywhere; of a light without a picture it is the power
    double area = 0.0;     // of the part
    bool isRound = false;  // other points of the light face where this one does not

    // Of its shadow map:
    double turn = 0.0;     // about the normal
    double tangent = 0.0;  // half the width of the widest window, at distance 1

    bool operator==(const EmitterPoint& o) const
    {
        return position == o.position && normal == o.normal && power == o.power && even == o.even && area == o.area &&
               isRound == o.isRound && turn == o.turn && tangent == o.tangent;
    }
};

/** Points of all lights together, dealt by flux, at least one to each lit side: a golden lattice on each light [area-lights.md 3,
 * "Pattern"]. Where there are more sides than points, a point stands for neighbours, which it finds in Morton order,
 * systematically by their flux [area-lights.md 3, "Many lights"]. The points of a light are side by side.
 * @param count  of the points; dark ones fill up where no light is lit
 * @param round  of sets of points, each elsewhere: together they cover the lights evenly */
OSGENVLIGHT_EXPORT std::vector<EmitterPoint> emitterPoints(const std::vector<Emitter>& lights, unsigned count,
                                                           unsigned round = 0);

}  // namespace osgEnvLight
