/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Caster.h"
#include "surface/Emitter.h"

#include <map>
#include <vector>

namespace osgEnvLight
{

/** Casters that are lamps, as area lights [shapesOf]. What has only moved and turned is not measured
 * again. */
class OSGENVLIGHT_EXPORT MeshLights
{
  public:
    /** Those of the casters, in the world.
     * @param scale  radiance of an emission of 1
     * @param slack  by which a place may differ and count as the same [world units] */
    std::vector<Emitter> of(const std::vector<Caster>& casters, double scale, double slack);

    /** Whether there was none at the last call. */
    bool empty() const { return _lamps.empty(); }
    void clear() { _lamps.clear(); }

  private:
    struct Lamp {
        Caster first;                 // where it was measured
        std::vector<Emitter> shapes;  // with radiance 1
        Caster now;
        std::vector<Emitter> placed;  // the shapes where it is
    };
    static void place(Lamp& lamp, const Caster& caster);

    std::multimap<const osg::Geometry*, Lamp> _lamps;
};

}  // namespace osgEnvLight
