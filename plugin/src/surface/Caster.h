/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include "surface/SentLight.h"

#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/StateSet>

#include <cstdint>
#include <vector>

namespace osgEnvLight
{

/** A geometry that casts shadows. */
struct Caster {
    osg::ref_ptr<const osg::Geometry> geometry;
    osg::Matrixd worldFromModel;
    osg::ref_ptr<osg::StateSet> state;  // of those that are perforated or move; null: solid
    uint64_t shape = 0;                 // changes with its vertices
    SentLight sent = {};                // where it was asked for
    osg::Vec3f lamp = {};               // emission of what is an area light, as typed, linear; black: it is none
    bool bothSides = true;              // are drawn
    bool moves = false;                 // a program of the application's moves its vertices [SurfaceProgram]
    osg::BoundingBox box = {};          // of the geometry
    osg::BoundingBoxd bound = {};       // of it in the world; not valid: not known
    bool isMeasured = false;            // the bound is that of its vertices, whatever box the geometry says

    bool operator==(const Caster& o) const { return geometry == o.geometry && worldFromModel == o.worldFromModel && isLike(o); }
    /** In all but the geometry and its place. */
    bool isLike(const Caster& o) const
    {
        return state == o.state && shape == o.shape && sent == o.sent && lamp == o.lamp && bothSides == o.bothSides &&
               moves == o.moves && box._min == o.box._min && box._max == o.box._max;
    }
};

/** The casters of a view, kept from frame to frame. */
struct CasterList {
    CasterList() = default;
    explicit CasterList(std::vector<Caster> casters);
    void clear();

    std::vector<Caster> all;
    osg::BoundingBoxd bound;     // of all of them, in the world
    osg::Matrixd worldFromNode;  // of the node below which they were collected
    size_t lamps = 0;            // how many of them are
    unsigned version = 0;        // counts the changes of any of it; 0: they are not counted
};

/** True if both throw the same shadow: one shape at one place, to within slack [world units]. */
OSGENVLIGHT_EXPORT bool sameShadow(const Caster& a, const Caster& b, double slack);

/** True if both lists throw the same shadows: the same shapes at the same places, to within slack [world units]. */
OSGENVLIGHT_EXPORT bool sameShadows(const std::vector<Caster>& a, const std::vector<Caster>& b, double slack);

/** Where casters have changed. */
class ChangedPart
{
  public:
    static ChangedPart everything()
    {
        ChangedPart part;
        part.addAll();
        return part;
    }
    void add(const osg::BoundingBoxd& box) { _box.expandBy(box); }
    void addAll() { _isWhole = true; }
    void add(const ChangedPart& other)
    {
        _box.expandBy(other._box);
        _isWhole = _isWhole || other._isWhole;
    }
    /** It is not known where: anywhere. */
    bool isWhole() const { return _isWhole; }
    /** In the world, where it is known. */
    const osg::BoundingBoxd& box() const { return _box; }

  private:
    osg::BoundingBoxd _box;
    bool _isWhole = false;
};

/** The casters that maps show. */
class OSGENVLIGHT_EXPORT ShownCasters
{
  public:
    /** Take the list if it throws other shadows than the last one taken.
     * @param slack  by which a place may differ and count as the same [world units]
     * @return whether it does */
    bool take(const CasterList& list, double slack);
    const std::vector<Caster>& all() const { return _casters; }
    /** Where the last list that was taken throws other shadows than the one before. */
    const ChangedPart& changed() const { return _changed; }

  private:
    std::vector<Caster> _casters;
    ChangedPart _changed;
    unsigned _version = 0;  // of the list that was taken
};

/** Measure its bound by its vertices. Not measured if they are of a kind that is not known. */
OSGENVLIGHT_EXPORT void measureBound(Caster& caster);

/** A caster's bound in the world; corners that are not finite don't count. */
OSGENVLIGHT_EXPORT osg::BoundingBoxd boundOf(const Caster& caster);
OSGENVLIGHT_EXPORT osg::BoundingBoxd boundOf(const std::vector<Caster>& casters);

/** Whether all of the second lies within the first, which may be empty. */
inline bool contains(const osg::BoundingBoxd& outer, const osg::BoundingBoxd& inner)
{
    return outer.valid() && outer.contains(inner._min) && outer.contains(inner._max);
}
inline double diagonal(const osg::BoundingBoxd& box)
{
    return (box._max - box._min).length();
}

/** Triangles of the casters, about: those of strips and the like by their vertices. */
OSGENVLIGHT_EXPORT size_t trianglesOf(const std::vector<Caster>& casters);

/** Whether a map shows a part of a box about its origin. It does not if all corners lie beyond one of its sides, or below it.
 * What lies above its heights casts shadows into it. */
OSGENVLIGHT_EXPORT bool mapShows(const osg::Matrixd& projection, const osg::BoundingBoxd& bound);

}  // namespace osgEnvLight
