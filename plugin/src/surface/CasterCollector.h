/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterState.h"
#include "surface/MovingStates.h"

#include <osg/BoundingBox>
#include <osg/CullStack>
#include <osg/Geometry>
#include <osg/NodeVisitor>

#include <map>
#include <vector>

namespace osgUtil
{
class CullVisitor;
}

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
};

/** All that casts shadows below a node, whether the view shows it or not: levels of detail, switches, billboards and paged
 * nodes as the view sees them. It is no cull traversal: cull callbacks don't run, no page is asked for or kept alive, and
 * nothing is left in the graph. Drawables other than osg::Geometry cast nothing, nor do points and lines. */
class OSGENVLIGHT_EXPORT CasterCollector : public osg::NodeVisitor, public osg::CullStack
{
  public:
    /** State sets of perforated casters, and of those that move, kept from frame to frame. */
    struct StateSets {
        std::map<CasterState::Key, osg::ref_ptr<osg::StateSet>> perforated;
        MovingStates moving;
    };

    /** @param cv             the host's traversal, standing at the node
     * @param worldFromEye   of the view
     * @param facts          what is remembered of textures */
    CasterCollector(osgUtil::CullVisitor& cv, const osg::Matrixd& worldFromEye, StateSets& stateSets,
                    SurfaceFacts* facts = nullptr);

    /** Find out what light the casters send on, too.
     * @param displayColors  the host's colours are display values */
    void findSentLight(bool displayColors)
    {
        _findsSentLight = true;
        _displayColors = displayColors;
    }

    /** Find out which are lamps. These send on what they reflect alone. */
    void findLamps(const LampRule& rule) { _lampRule = rule; }

    /** The casters below the group. */
    std::vector<Caster> collect(osg::Group& group);

    /** Drop the state sets, and with them the user's textures, that none of the casters has. */
    static void forgetUnused(StateSets& stateSets, const std::vector<Caster>& casters);

    osg::CullStack* asCullStack() override { return this; }
    const osg::CullStack* asCullStack() const override { return this; }
    osg::Vec3 getEyePoint() const override { return getEyeLocal(); }
    osg::Vec3 getViewPoint() const override { return getViewPointLocal(); }
    float getDistanceToEyePoint(const osg::Vec3& pos, bool withLODScale) const override;
    float getDistanceToViewPoint(const osg::Vec3& pos, bool withLODScale) const override;
    float getDistanceFromEyePoint(const osg::Vec3& pos, bool withLODScale) const override;

    void apply(osg::Node& node) override;
    void apply(osg::Transform& node) override;
    void apply(osg::Billboard& node) override;
    void apply(osg::Projection&) override {}
    void apply(osg::Camera&) override {}
    void apply(osg::Geometry& geometry) override;
    void apply(osg::Drawable&) override {}

  private:
    void push(const osg::StateSet* stateSet);
    void pop(const osg::StateSet* stateSet);
    void traverseWith(const osg::StateSet* stateSet, osg::Node& node);
    void add(const osg::Geometry& geometry, const osg::Matrixd& eyeFromModel);

    const osg::Matrixd _worldFromEye;
    StateSets& _stateSets;
    std::vector<CasterState> _states;
    MovingStates::Path _path;  // the state sets that these are made of
    std::vector<Caster> _casters;
    bool _findsSentLight = false;
    bool _displayColors = true;
    LampRule _lampRule;
};

/** True if both throw the same shadow: one shape at one place, to within slack [world units]. */
OSGENVLIGHT_EXPORT bool sameShadow(const Caster& a, const Caster& b, double slack);

/** True if both lists throw the same shadows: the same shapes at the same places, to within slack [world units]. */
OSGENVLIGHT_EXPORT bool sameShadows(const std::vector<Caster>& a, const std::vector<Caster>& b, double slack);

/** The casters' bound in the world; bounds that are not finite don't count. */
OSGENVLIGHT_EXPORT osg::BoundingBoxd boundOf(const std::vector<Caster>& casters);
OSGENVLIGHT_EXPORT osg::BoundingBoxd boundOf(const Caster& caster);

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

/** Whether a map shows any of a box about its origin: not if all corners lie beyond one side, or below. What lies above the map's
 * heights casts shadows into it. */
OSGENVLIGHT_EXPORT bool mapShows(const osg::Matrixd& projection, const osg::BoundingBoxd& bound);

}  // namespace osgEnvLight
