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
    double turn = 0.0;       // about the normal
    double tangent = 0.0;    // half the width of the widest window, at distance 1
    double nearest = 1e300;  // what is nearer than that may be missing

    unsigned lightNumber = 0;  // another one stands for another light, and an older map shows nothing of it

    bool operator==(const EmitterPoint& o) const
    {
        return position == o.position && normal == o.normal && power == o.power && even == o.even && area == o.area &&
               isRound == o.isRound && turn == o.turn && tangent == o.tangent && nearest == o.nearest &&
               lightNumber == o.lightNumber;
    }
};

/** One that sends nothing. */
inline EmitterPoint darkPoint()
{
    EmitterPoint point;
    point.normal = osg::Vec3d(0, 0, 1);
    point.area = 1.0;
    return point;
}

/** By which a set of points is shifted on the lights: the first lies where it is, the others between its points. */
osg::Vec2d pointShift(unsigned round);
/** Sets turn, by the points' numbers, and tangent. */
void placeMaps(std::vector<EmitterPoint>& points, double tangent);

/** Points of all lights together, dealt by flux, at least one to each lit side: a golden lattice on each light [area-lights.md 3,
 * "Pattern"]. Where there are more sides than points, some are chosen [PointChoice.h]. The points of a light are side by side.
 * @param count  of the points; dark ones fill up where no light is lit
 * @param round  of sets of points, each elsewhere: together they cover the lights evenly */
OSGENVLIGHT_EXPORT std::vector<EmitterPoint> emitterPoints(const std::vector<Emitter>& lights, unsigned count,
                                                           unsigned round = 0);

}  // namespace osgEnvLight
