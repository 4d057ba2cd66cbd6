/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "gl/ContextWatch.h"
#include "surface/DepthConvention.h"
#include <osgEnvLight/Export>
#include "gl/FullScreenTriangle.h"
#include "gl/GpuTimer.h"

#include <osg/Geometry>
#include <osg/Matrixd>
#include <osgUtil/RenderLeaf>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <limits>
#include <string>
#include <utility>

namespace osgEnvLight
{

/** Number of our stages before a host's own: after all that the host renders to texture, which our passes may read; equal numbers
 * keep the order of insertion.*/
constexpr int afterHosts = std::numeric_limits<int>::max();

/** A triangle over the viewport for a pass. The host's projection is final only after cull, so the uniforms that depend on it are
 * read from osg::State when it is drawn: projection, inverseProjection, mapFromEye, atlasFromEye, viewportSize,
 * viewportOrigin, hostDepth. None of these may also be an osg::Uniform.*/
class OSGENVLIGHT_EXPORT FullScreen : public osg::Geometry
{
  public:
    /** @param vertices  fullScreenVertices(), which several may share; null: its own */
    FullScreen(const std::string& name, GpuTimer* timer, osg::Vec3Array* vertices = nullptr);

    void drawImplementation(osg::RenderInfo& renderInfo) const override;
    osg::BoundingBox computeBoundingBox() const override { return osg::BoundingBox(); }

    /** Written at cull by the frame that owns this. */
    osg::Matrixd mapFromWorld;
    osg::Vec3d atlasOrigin;  // in the world
    osg::Vec2d subpixel;     // shift of the picture in clip space over w
    DepthConvention depth;   // the host's
    bool timed = false;
    osg::observer_ptr<ContextWatch::Listener> owner;  // told when the context is lost that this was drawn in; may be null
    unsigned textureUnits = 0;                        // that its state set binds, from 0 on

  private:
    osg::ref_ptr<GpuTimer> _timer;
};

/** A stage that keeps what it draws. The host's stage refers to it until it is next culled; the frame, the view or the node
 * that made it may die before, while a draw thread still reads it.*/
class PassStage : public osgUtil::RenderStage
{
  public:
    osg::ref_ptr<osgUtil::StateGraph> root;
    osg::ref_ptr<osgUtil::RenderLeaf> leaf;  // the end of draw cleans the graph, and the next stage looks back at this
    osg::ref_ptr<osg::Camera> ownCamera;     // RenderStage only observes it
};

/** One drawable, full-screen in most, that draws into a frame buffer of ours: a stage with a state graph of its own, so that
 * nothing of the host's state reaches it. Owned by one frame of one view.*/
class OSGENVLIGHT_EXPORT Pass : public osg::Referenced
{
  public:
    explicit Pass(osg::Drawable* drawable);

    /** Hang the pass on the host's stage for this frame.
     * @param camera  carries the callbacks that bind the target
     * @param state   the pass's own state set; uniforms, the frame's*/
    void add(osgUtil::RenderStage& host, osg::Camera& camera, osg::Viewport& viewport, osg::StateSet& state,
             osg::StateSet& uniforms, osg::RefMatrix* projection, osg::RefMatrix* modelView);

    osg::Drawable& drawable() { return *_drawable; }

    /** Whether it was added since the last call. */
    bool takeAdded() { return std::exchange(_added, false); }

  private:
    osg::ref_ptr<PassStage> _stage;
    osg::ref_ptr<osg::Drawable> _drawable;
    bool _added = false;
};

/** Prepares a stage of ours for this frame: empty, bound to the viewport and the camera, no draw buffer of its own. */
OSGENVLIGHT_EXPORT void prepareStage(PassStage& stage, osgUtil::RenderStage& host, osg::Camera& camera, osg::Viewport& viewport,
                                     GLbitfield clearMask);

}  // namespace osgEnvLight
