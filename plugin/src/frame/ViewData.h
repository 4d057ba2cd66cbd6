/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/AtlasLights.h"
#include "frame/FrameContext.h"
#include "frame/FrameGraph.h"
#include "frame/FrameResources.h"
#include "surface/CasterCollector.h"
#include "surface/MeshLights.h"

#include <osgEnvLight/GBuffer>

#include <osg/Viewport>
#include <osg/observer_ptr>

#include <map>

namespace osgEnvLight
{

/** All that one view owns. Its parts are made when a frame first asks for them and never changed afterwards: another size
 * or another map makes new ones, and a draw thread finishes with the old, which its stages hold.*/
class OSGENVLIGHT_EXPORT ViewData : public osg::Referenced
{
  public:
    ViewData(Failure* failure, RetiredObjects* retired) : graph(failure, retired), _retired(retired) {}

    /** Forget what is as large as the view if the size differs. */
    void fit(int width, int height);
    /** At the end of a cull: forget what it did not use. */
    void forgetUnused(FrameResources& current);

    int width() const { return _width; }
    int height() const { return _height; }
    osg::Viewport* viewport() { return _viewport.get(); }
    GBuffer& gbuffer();
    /** The resources of a CullVisitor. */
    FrameResources& frame(const osg::Referenced* cullVisitor);
    /** Counts the culls. */
    unsigned number() const { return _cull; }

    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;
    /** Bytes of its textures. */
    size_t bytes() const;

    osg::observer_ptr<osg::Referenced> identifier;
    osg::observer_ptr<osg::Referenced> camera;
    bool hasCamera = false;
    osg::observer_ptr<osg::State> context;  // that it is drawn in
    bool hasContext = false;
    unsigned contextID = 0;

    FrameGraph graph;
    AtlasLights atlasLights;
    const osg::ref_ptr<FrameTimer> timer = new FrameTimer;
    Plan plan;  // of the last cull, without times
    bool timed = false;
    osg::ref_ptr<const Accumulation> still;
    bool unsettled = false;    // further frames would change the picture by themselves
    unsigned seenUpdates = 0;  // of the node, at the last cull
    FormerFrame former;
    CasterList casters;  // of the last cull
    CasterCollector::StateSets casterStates;
    CasterMotion casterMotion;
    Ground ground;
    std::vector<Emitter> areaLights;  // AreaLights of the last cull, in the world
    MeshLights meshLights;
    SceneLightList lateLights;  // of LightSources behind the node in the graph

  protected:
    ~ViewData() override;

  private:
    void retireAll();

    const osg::ref_ptr<RetiredObjects> _retired;
    int _width = 0;
    int _height = 0;
    osg::ref_ptr<osg::Viewport> _viewport;
    osg::ref_ptr<GBuffer> _gbuffer;
    std::map<const osg::Referenced*, osg::ref_ptr<FrameResources>> _frames;
    unsigned _cull = 0;
};

}  // namespace osgEnvLight
