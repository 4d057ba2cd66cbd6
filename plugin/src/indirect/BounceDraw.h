/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "gl/FrameTimer.h"
#include "indirect/TransportTargets.h"

#include <osg/Geometry>
#include <osg/StateSet>

#include <vector>

namespace osgEnvLight
{

/** Lets light go on between surface points and probes: what the points send on, then what the probes see of that, some times
 * over; at the end, the light that the cells of surfaces know. Owned by one frame of one view; written at cull.*/
class OSGENVLIGHT_EXPORT BounceDraw : public osg::Drawable
{
  public:
    /** @param vertices  fullScreenVertices() */
    explicit BounceDraw(osg::Vec3Array* vertices);

    /** The programs' state sets, with their textures and uniforms. */
    struct States {
        std::vector<osg::ref_ptr<osg::StateSet>> uniforms;  // of this frame, for all of them
        osg::ref_ptr<osg::StateSet> first;                  // of the points in the first of these bounces; null: as in others
        osg::ref_ptr<osg::StateSet> points;
        osg::ref_ptr<osg::StateSet> near;  // null: no point is close to another; not drawn where there is a first
        osg::ref_ptr<osg::StateSet> harmonics, probes;
        osg::ref_ptr<osg::StateSet> cells;  // null: no rays meet the scene
    };
    /** @param bounces  in this frame */
    void prepare(const TransportTargets& targets, const States& states, unsigned bounces, const TimedDraw& timed);

    void drawImplementation(osg::RenderInfo& renderInfo) const override;
    osg::BoundingBox computeBoundingBox() const override { return osg::BoundingBox(); }
    void resizeGLObjectBuffers(unsigned maximum) override;
    void releaseGLObjects(osg::State* state) const override;

  private:
    void drawInto(osg::RenderInfo& renderInfo, osg::FrameBufferObject& target, const osg::Texture2D& texture,
                  const osg::StateSet& stateSet) const;

    osg::ref_ptr<osg::Geometry> _triangle;
    TransportTargets _targets;
    States _states;
    unsigned _bounces = 0;
    TimedDraw _timed;
};

}  // namespace osgEnvLight
