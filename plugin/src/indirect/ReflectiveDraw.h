/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "gl/FrameTimer.h"
#include "indirect/ReflectiveMaps.h"
#include "surface/Caster.h"

#include <osg/Drawable>

namespace osgEnvLight
{

/** Draws reflective shadow maps: of what casts shadows the surfaces that lights see, what polished ones reflect of them, and the
 * mipmaps by which virtual lights are chosen. Owned by one frame of one view; written at cull. */
class OSGENVLIGHT_EXPORT ReflectiveDraw : public osg::Drawable
{
  public:
    ReflectiveDraw();

    /** @param uniforms  of this frame
     * @param program   the shader's state set
     * @param origin    of the maps, in the world */
    void prepare(const ReflectiveTargets& targets, const std::vector<ReflectiveMap>& maps, const std::vector<Caster>& casters,
                 const std::vector<osg::ref_ptr<osg::StateSet>>& uniforms, const osg::ref_ptr<osg::StateSet>& program,
                 const osg::Vec3d& origin, const TimedDraw& timed);

    void drawImplementation(osg::RenderInfo& renderInfo) const override;
    osg::BoundingBox computeBoundingBox() const override { return osg::BoundingBox(); }

  private:
    struct Placed {
        osg::ref_ptr<const osg::Geometry> geometry;
        osg::ref_ptr<osg::RefMatrix> modelView;
        osg::ref_ptr<osg::StateSet> state;
        osg::BoundingBoxd bound;  // about the maps' origin
        osg::Vec4f reflects;      // what its lobe reflects, its roughness; black: it only hides
    };
    void drawCasters(osg::RenderInfo& renderInfo, size_t begin, size_t end) const;

    ReflectiveTargets _targets;
    std::vector<osg::ref_ptr<osg::RefMatrix>> _projections;
    std::vector<Placed> _casters;  // those of a state set side by side
    std::vector<osg::ref_ptr<osg::StateSet>> _states;
    TimedDraw _timed;
};

}  // namespace osgEnvLight
