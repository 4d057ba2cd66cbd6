/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Camera>
#include <osgUtil/RenderLeaf>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <limits>
#include <utility>
#include <vector>

namespace osgEnvLight
{

/** Order of our stages before a host's own: after all that the host renders to texture, which our passes may read. Stages of
 * equal order are drawn as they were inserted.*/
constexpr int afterHosts = std::numeric_limits<int>::max();

/** A stage that keeps what it draws. The host's stage refers to it until it is next culled; the frame, the view or the node
 * that made it may die before, while a draw thread still reads it.*/
class DrawnStage : public osgUtil::RenderStage
{
  public:
    osg::ref_ptr<osgUtil::StateGraph> root;
    osg::ref_ptr<osgUtil::RenderLeaf> leaf;  // the end of draw cleans the graph, and the next stage looks back at this
    osg::ref_ptr<osg::Camera> ownCamera;     // RenderStage only observes it
};

/** One drawable that draws into a frame buffer of ours: a stage with a state graph of its own, so that nothing of the host's
 * state reaches it. Owned by one frame of one view.*/
class OSGENVLIGHT_EXPORT StageDraw : public osg::Referenced
{
  public:
    explicit StageDraw(osg::Drawable* drawable);

    /** Hang it on the host's stage for this frame.
     * @param camera  carries the callbacks that bind the target
     * @param states  from the outermost on */
    void add(osgUtil::RenderStage& host, osg::Camera& camera, osg::Viewport& viewport, const std::vector<osg::StateSet*>& states,
             osg::RefMatrix* projection, osg::RefMatrix* modelView);

    osg::Drawable& drawable() { return *_drawable; }

    /** Whether it was added since the last call. */
    bool takeAdded() { return std::exchange(_added, false); }

  private:
    osg::ref_ptr<DrawnStage> _stage;
    osg::ref_ptr<osg::Drawable> _drawable;
    bool _added = false;
};

/** Prepares a stage of ours for this frame: empty, bound to the viewport and the camera, no draw buffer of its own. */
OSGENVLIGHT_EXPORT void prepareStage(DrawnStage& stage, osgUtil::RenderStage& host, osg::Camera& camera, osg::Viewport& viewport,
                                     GLbitfield clearMask);

}  // namespace osgEnvLight
