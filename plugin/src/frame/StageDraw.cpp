// SPDX-License-Identifier: MIT
#include "frame/StageDraw.h"

#include <osg/Viewport>

namespace osgEnvLight
{

void prepareStage(DrawnStage& stage, osgUtil::RenderStage& host, osg::Camera& camera, osg::Viewport& viewport,
                  GLbitfield clearMask)
{
    stage.setPositionalStateContainer(nullptr);  // reset() would empty it, and below it may be the host's
    stage.reset();
    // The stage observes its camera, and does not take a new one at a dead one's address for another.
    stage.setCamera(nullptr);
    stage.setCamera(&camera);
    stage.setCameraRequiresSetUp(false);  // its callbacks bind the target: OSG would only print that it sets up a frame buffer
    stage.ownCamera = &camera;
    stage.setViewport(&viewport);
    // State caches one draw buffer for all frame buffers, so none is set here.
    stage.setDrawBuffer(GL_NONE, false);
    stage.setReadBuffer(GL_NONE, false);
    stage.setClearMask(clearMask);
    stage.setClearColor(osg::Vec4(0, 0, 0, 0));
    stage.setClearDepth(1.0);
    stage.setColorMask(nullptr);
    stage.setInitialViewMatrix(host.getInitialViewMatrix());
}

StageDraw::StageDraw(osg::Drawable* drawable) : _stage(new DrawnStage), _drawable(drawable)
{
    _stage->root = new osgUtil::StateGraph;
    _stage->setStateGraph(_stage->root.get());
}

void StageDraw::add(osgUtil::RenderStage& host, osg::Camera& camera, osg::Viewport& viewport,
                    const std::vector<osg::StateSet*>& states, osg::RefMatrix* projection, osg::RefMatrix* modelView)
{
    prepareStage(*_stage, host, camera, viewport, 0);
    _stage->root->clean();
    _stage->root->prune();  // of the former frame's state sets, which hold textures
    _added = true;
    osgUtil::StateGraph* graph = _stage->root.get();
    for (osg::StateSet* state : states) graph = graph->find_or_insert(state);
    if (!_stage->leaf)
        _stage->leaf = new osgUtil::RenderLeaf(_drawable.get(), projection, modelView);
    else
        _stage->leaf->set(_drawable.get(), projection, modelView);
    _stage->addStateGraph(graph);
    graph->addLeaf(_stage->leaf.get());
    host.addPreRenderStage(_stage.get(), afterHosts);
}

}  // namespace osgEnvLight
