/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Caster.h"
#include "surface/CasterState.h"
#include "surface/MovingStates.h"

#include <osg/CullStack>
#include <osg/NodeVisitor>

#include <map>
#include <optional>
#include <vector>

namespace osgUtil
{
class CullVisitor;
}

namespace osgEnvLight
{

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

    /** Make the list that of the casters below the group. */
    void collect(osg::Group& group, CasterList& list);

    /** Drop the state sets, and with them the user's textures, that none of the casters has. */
    static void forgetUnused(StateSets& stateSets, const std::vector<Caster>& casters);

    osg::CullStack* asCullStack() override { return &cullStack(); }
    const osg::CullStack* asCullStack() const override { return &cullStack(); }
    osg::Vec3 getEyePoint() const override { return cullStack().getEyeLocal(); }
    osg::Vec3 getViewPoint() const override { return cullStack().getViewPointLocal(); }
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
    /** What the state sets from the root down to a node say. */
    struct Level {
        CasterState state;
        std::optional<osg::Vec3f> lamp;  // once a drawable has asked
        std::optional<SentLight> sent;   // the same, for drawables without colours of their own
    };
    /** Of a transform, or of the node. */
    struct Place {
        osg::Matrixd worldFromModel;
        bool isPushed;  // to the CullStack
    };
    void push(const osg::StateSet* stateSet);
    void pop(const osg::StateSet* stateSet);
    void traverseWith(const osg::StateSet* stateSet, osg::Node& node);
    void traverseAtLastPlace(osg::Transform& node);
    const osg::CullStack& cullStack() const;
    osg::CullStack& cullStack();
    void add(const osg::Geometry& geometry, const osg::Matrixd& worldFromModel);
    void setMotion(const osg::Geometry& geometry, Caster& caster);
    void setLight(const osg::Geometry& geometry, Caster& caster);

    const osg::Matrixd _worldFromEye, _eyeFromWorld;
    StateSets& _stateSets;
    std::vector<Level> _levels;
    MovingStates::Path _path;  // the state sets that these are made of
    std::vector<Place> _places;
    CasterList* _list = nullptr;
    size_t _count = 0;        // of the list's that have been met
    bool _isChanged = false;  // some of them
    bool _findsSentLight = false;
    bool _displayColors = true;
    LampRule _lampRule;
};

}  // namespace osgEnvLight
