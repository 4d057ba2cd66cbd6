// SPDX-License-Identifier: MIT
// How the G-buffer of a frame is filled, and what below the node is not for it.
#include "node/DeferredTechnique.h"

#include <osgEnvLight/LitScene>

#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

namespace
{

const GLbitfield gbufferClear = GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT;

// An osg::ClearNode below the node speaks of the host's buffers.
void passClearOn(osgUtil::RenderStage& gbuffer, osgUtil::RenderStage& host)
{
    if (gbuffer.getClearMask() == gbufferClear && gbuffer.getClearColor() == osg::Vec4()) return;
    host.setClearMask(gbuffer.getClearMask());
    host.setClearColor(gbuffer.getClearColor());
    gbuffer.setClearMask(gbufferClear);
    gbuffer.setClearColor(osg::Vec4());
}

}  // namespace

void DeferredTechnique::fillGBuffer(Cull& c, LitScene& node, osgUtil::CullVisitor& cv, std::vector<ForwardGraph>& forward)
{
    if (node.getGBuffer()) {
        node.osg::Group::traverse(cv);
        c.view.plan.surfaces = {true, true, 1, 0};
        return;
    }
    Frame& f = c.frame;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        osg::StateSet& state = gbufferState(c);
        if (f.fillState != &state) {
            const osg::ref_ptr<osg::StateSet> own = new osg::StateSet(state);
            f.subpixel = new osg::Uniform("subpixel", osg::Vec2());
            f.materialColors = new osg::Uniform("materialColors", 0);
            f.emittedStops = new osg::Uniform("emittedStops", 0.0f);
            for (osg::Uniform* u : {f.subpixel.get(), f.materialColors.get(), f.emittedStops.get()}) own->addUniform(u);
            f.fill = new GBufferFill(own.get(), _sorter.get());
            f.fillState = &state;
        }
        f.materialColors->set(c.settings.materialColors);
        f.emittedStops->set(float(-c.baseStops()));
        if (!f.gbufferCamera || f.gbufferTimed != c.timed) {
            f.gbufferCamera = new StageCamera(c.view.plainCamera());
            f.gbufferTimed = c.timed;
            BindTargets::install(*f.gbufferCamera, c.gbuffer.frameBuffer(), c.timed ? &c.view.timer("gbuffer") : nullptr,
                                 _failure.get());
        }
    }
    if (osg::Camera* camera = c.host.getCamera()) {
        f.gbufferCamera->setView(camera->getView());
        f.gbufferCamera->setCullMask(camera->getCullMask());
    }
    f.gbufferCamera->setProjectionMatrix(*cv.getProjectionMatrix());
    f.gbufferCamera->setViewMatrix(c.host.getInitialViewMatrix() ? osg::Matrixd(*c.host.getInitialViewMatrix()) : osg::Matrixd());
    f.gbufferCamera->setViewport(c.view.viewport());
    prepareStage(*f.gbufferStage, c.host, *f.gbufferCamera, *c.view.viewport(), gbufferClear);
    // Light sources and clip planes below the node also reach what is drawn forward.
    f.gbufferStage->setPositionalStateContainer(c.host.getPositionalStateContainer());

    osgUtil::RenderBin* hostBin = cv.getCurrentRenderBin();
    f.forwardState = nullptr;
    const SurfaceSorter::LitState lit = [&] {
        if (!f.forwardState) f.forwardState = new osg::StateSet;  // setForwardState() fills it
        return f.forwardState.get();
    };
    cv.pushViewport(c.view.viewport());
    c.view.plan.surfaces = f.fill->fill(cv, *f.gbufferStage, hostBin, lit, forward, [&] {
        cv.setCurrentRenderBin(f.gbufferStage.get());
        node.osg::Group::traverse(cv);
        cv.setCurrentRenderBin(hostBin);
    });
    cv.popViewport();
    handOverCameras(c);
    passClearOn(*f.gbufferStage, c.host);
}

// What cameras below the node draw, before or after the host's own: as without us, and while the G-buffer stands still, too.
void DeferredTechnique::handOverCameras(Cull& c)
{
    osgUtil::RenderStage& own = *c.frame.gbufferStage;
    const auto adopt = [&](osgUtil::RenderStage& stage) {
        SurfaceSorter::release(stage, *c.frame.fill->getStateSet());
        const osg::Camera* camera = stage.getCamera();
        if (!camera) return;
        const auto inherits = [&](unsigned what) { return (camera->getInheritanceMask() & what) != 0; };
        if (!camera->getViewport()) stage.setViewport(c.host.getViewport());
        if (!camera->getColorMask()) stage.setColorMask(c.host.getColorMask());
        if (inherits(osg::CullSettings::DRAW_BUFFER))
            stage.setDrawBuffer(c.host.getDrawBuffer(), c.host.getDrawBufferApplyMask());
        if (inherits(osg::CullSettings::READ_BUFFER))
            stage.setReadBuffer(c.host.getReadBuffer(), c.host.getReadBufferApplyMask());
        if (inherits(osg::CullSettings::CLEAR_MASK)) stage.setClearMask(c.host.getClearMask());
        if (inherits(osg::CullSettings::CLEAR_COLOR)) stage.setClearColor(c.host.getClearColor());
    };
    for (auto& [order, stage] : own.getPreRenderList()) {
        adopt(*stage);
        c.host.addPreRenderStage(stage, order);
    }
    for (auto& [order, stage] : own.getPostRenderList()) {
        adopt(*stage);
        c.host.addPostRenderStage(stage, order);
    }
    own.getPreRenderList().clear();
    own.getPostRenderList().clear();
}

}  // namespace osgEnvLight
