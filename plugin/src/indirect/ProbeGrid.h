/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "indirect/CasterBvh.h"
#include "indirect/SurfacePoints.h"

#include <osg/BoundingBox>

#include <array>

namespace osgEnvLight
{

/** Probes on a grid over a scene, and in one far larger than what a view shows on two finer ones about that. Each knows, for
 * directions all about, which surface point it sees: which does not change with the light [indirect2.md 4].*/
struct OSGENVLIGHT_EXPORT ProbeGrid {
    /** What a probe sees in a direction, where that is no point. */
    enum Link : int { SKY = -1, BACK = -2 };
    /** By the ray in the middle of a direction's texel, then by rays at other places in it: the numbers of points, or Link. */
    using Links = std::array<int, 4>;

    /** @param nearest  of points of the scene, not none
     * @param most     probes along the longer sides of a grid's box; half of these along the shortest
     * @param stop     set by another thread: the rest stays empty */
    ProbeGrid(const TracedScene& scene, const CasterBvh& bvh, const NearestPoint& nearest, int most,
              const TransportFocus& focus = {}, const std::atomic<bool>* stop = nullptr);

    /** The directions of all probes, texels of six faces of a cube, and their share of the sphere. */
    struct Direction {
        osg::Vec3f to;
        float share;
        std::array<osg::Vec3f, 3> others;  // within the texel
    };
    static const std::vector<Direction>& directions();

    size_t probes() const { return places.size(); }
    /** In which share of directions closedPart of the probes of all the scene see no surface, at most. */
    double openShare() const;
    /** Around a room with walls as thick as a cell, all of the outermost probes stand outside: half of them. A mean would tell
     * such a room from balls on a floor less well. */
    static constexpr double closedPart = 0.375;

    using Planes = std::array<std::vector<float>, 3>;
    struct Level {
        Planes planes;                              // that probes belong to: where they cross the axes, ascending
        std::array<std::array<bool, 2>, 3> ends{};  // along each axis whether the scene ends below and above it
        float cell = 0.0f;                          // side of its cubes; of the first level 0
    };
    /** First that of all the scene, finer where the scene is; then those about the focus, each of cubes. They lie on lattices
     * that do not depend on its centre: where it moves, most places have a probe as before. */
    std::vector<Level> levels;
    struct Place {
        osg::Vec3f position;  // may be off the planes, out of a body
        float weight;         // little in a narrow gap: it is also seen from beside the gap, of which it knows nothing
        bool on;              // else it lies within one, and all that it knows is of the nearest that is on
    };
    std::vector<Place> places;  // of each level, first along x
    std::vector<Links> links;   // of all directions of the first probe, and so on
    /** Of each probe an octahedral map of distances, depthSide texels a side: mean and mean square about a direction. */
    std::vector<std::array<float, 2>> depths;

  private:
    struct Seen {
        float distance;
        int triangle;  // or SKY, BACK
        bool back;
    };
    static Seen look(const TracedScene& scene, const CasterBvh& bvh, const osg::Vec3f& from, const osg::Vec3f& to);
    static std::vector<Seen> lookAround(const TracedScene& scene, const CasterBvh& bvh, const osg::Vec3f& from);
    std::vector<Seen> settle(const TracedScene& scene, const CasterBvh& bvh, Place& place, float cell) const;
    void addLevel(const TracedScene& scene, const CasterBvh& bvh, const NearestPoint& nearest, const Level& level,
                  const std::atomic<bool>* stop);
    void addLinks(const TracedScene& scene, const CasterBvh& bvh, const NearestPoint& nearest, const Place& place,
                  const std::vector<Seen>& seen);
    float weightOf(const std::vector<Seen>& seen, float cell) const;
    void addDepths(const std::vector<Seen>& seen, float widest);
    void replaceThoseOff(size_t first);
};

}  // namespace osgEnvLight
