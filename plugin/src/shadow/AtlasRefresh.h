/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Caster.h"
#include "gl/FrameTimer.h"
#include "shadow/ShadowTargets.h"

#include <osg/Drawable>

namespace osgEnvLight
{

/** Draws maps of height, or parts of them. It draws the casters twice, for the first and the second surface from each light. Then
 * it writes what is made of both into the maps. Owned by one frame of one view; written at cull. */
class OSGENVLIGHT_EXPORT AtlasRefresh : public osg::Drawable
{
  public:
    /** @param vertices  fullScreenVertices() */
    AtlasRefresh(const std::string& name, osg::Vec3Array* vertices);

    /** The programs' state sets, each with its own depth state and textures; midpoints reads the first two's targets. */
    struct States {
        osg::ref_ptr<osg::StateSet> first, second, midpoints;
    };
    void prepare(const ShadowTargets& targets, const std::vector<ShadowRefresh>& refreshes, std::vector<Caster>&& casters,
                 const States& states, const TimedDraw& timed);

    void drawImplementation(osg::RenderInfo& renderInfo) const override;
    osg::BoundingBox computeBoundingBox() const override { return osg::BoundingBox(); }
    void resizeGLObjectBuffers(unsigned maximum) override;
    void releaseGLObjects(osg::State* state) const override;

  private:
    struct Placed {
        osg::ref_ptr<const osg::Geometry> geometry;
        osg::ref_ptr<osg::RefMatrix> modelView;
        osg::ref_ptr<osg::StateSet> state;
        osg::BoundingBoxd bound;  // about the maps' origin
    };
    struct Map {
        unsigned index;
        osg::ref_ptr<osg::RefMatrix> projection;
        osg::Matrixd ofRegion;  // the projection that shows no more
        float texel, octaves;
        MapRegion region;
    };
    void drawCasters(osg::RenderInfo& renderInfo, osg::FrameBufferObject& target, const osg::StateSet& stateSet, size_t begin,
                     size_t end) const;
    void drawRun(osg::RenderInfo& renderInfo, size_t caster, size_t casterEnd, size_t begin, size_t end) const;
    void scissor(const Map& map, int x, int y) const;
    void storeMidpoints(osg::RenderInfo& renderInfo, size_t begin, size_t end) const;

    osg::ref_ptr<osg::Geometry> _triangle;
    ShadowTargets _targets;
    States _states;
    std::vector<Placed> _casters;  // those of a state set side by side
    std::vector<Map> _maps;
    TimedDraw _timed;
};

}  // namespace osgEnvLight
