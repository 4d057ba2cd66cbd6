/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "shadow/EmitterPoints.h"

#include <osg/Vec2d>

#include <vector>

namespace osgEnvLight
{

/** A side of a light that sends light. */
struct LitSide {
    const Emitter* light;
    double turned;  // -1: the back
    double flux;
};

std::vector<LitSide> litSides(const std::vector<Emitter>& lights);
size_t countLitSides(const std::vector<Emitter>& lights);

/** Of a golden lattice on a side, which has so many points. */
struct SidePart {
    unsigned part = 0;
    unsigned parts = 1;
};

/** The point of a part, with its share of the light's power, and the colour that a picture has there.
 * @param shift  of the lattice, each way from 0 to 1 */
EmitterPoint pointOf(const LitSide& side, const SidePart& part, const osg::Vec2d& shift);

}  // namespace osgEnvLight
