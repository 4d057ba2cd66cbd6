/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "shadow/EmitterPoints.h"
#include "shadow/ShadowTargets.h"
#include "surface/StaticCasters.h"

#include <atomic>

namespace osgEnvLight
{

/** The shadow maps of points of lights for one view, side by side in one texture: each shows what of the scene lies in a pyramid
 * before its point, and keeps the middle between the first and the second surface as heights that fall with the distance
 * [lib/emittermap.glsl]. They stand in the world. Some are drawn again each frame when what casts shadows or where a light stands
 * has changed, and until then show what they last showed.
 *
 * Its parts are never replaced: other counts are other maps. update() decides at cull what the same frame's draw makes true. */
class OSGENVLIGHT_EXPORT EmitterMaps : public osg::Referenced
{
  public:
    /** @param size    of a map's side [texels] */
    EmitterMaps(unsigned points, unsigned size);

    const unsigned points;
    const unsigned size;

    /** What casts shadows now; before update(). */
    void setCasters(const CasterList& casters);
    /** What floats are relative to, in the world: near the middle of what casts shadows. */
    const osg::Vec3d& origin() const { return _targets.origin; }

    /** What a frame draws.
     * @param list    the emitter points, in the world; their order is the maps'
     * @param budget  maps at most; points without any come first, then power and age decide */
    std::vector<ShadowRefresh> update(const std::vector<EmitterPoint>& list, unsigned budget);

    /** What the maps of update() show. */
    std::vector<Caster> drawn() const { return _still.drawn(); }
    /** Triangles of drawn(). */
    size_t triangles() const { return _still.triangles(); }

    /** Points that have no map yet, or an outdated one. */
    unsigned waiting() const { return _waiting; }
    /** Changes whenever pointImage() does; 0 before the first update(). */
    unsigned version() const { return _version; }

    /** Rows of a point, of which each is a column [pass/pointmap.glsl]; RGBA 32F. */
    osg::ref_ptr<osg::Image> pointImage() const;

    const ShadowTargets& targets() const { return _targets; }
    void resizeGLObjectBuffers(unsigned maximum);
    /** All maps are lost. */
    void releaseGLObjects(osg::State* state) const;
    size_t bytes() const;

  protected:
    ~EmitterMaps() override = default;

  private:
    // Where a map was last drawn from, and what it shows: a square window at distance 1 along its axis, and distances.
    struct Map : KeptMap {
        osg::Vec3d position, across, up, along;
        double widest = 0.0;  // half the width that a window may have
        osg::Vec2d window;
        double tangent = 1.0;  // half this one's
        double nearest = 1.0, octaves = 1.0;
        unsigned lightNumber = 0;
    };
    void place(Map& map, const EmitterPoint& point) const;
    void fit(Map& map, double nearestOccluder) const;
    osg::Matrixd projection(const Map& map) const;
    double priority(const Map& map, const EmitterPoint& point) const;
    double scale() const;

    std::vector<Map> _maps;
    std::vector<EmitterPoint> _list;
    ShownCasters _casters;
    StaticCasters _still;
    osg::BoundingBoxd _box;  // of what casts shadows
    double _extent = 0.0;    // its diagonal
    bool _moved = false;
    bool _fitted = false;  // the maps are to show another part of the world
    unsigned _waiting = 0;
    unsigned _version = 0;
    mutable std::atomic<bool> _lost{false};
    ShadowTargets _targets;
};

}  // namespace osgEnvLight
