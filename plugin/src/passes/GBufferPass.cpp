// SPDX-License-Identifier: MIT
#include "passes/GBufferPass.h"

#include "frame/PassBuilder.h"
#include "gl/BindTargets.h"

#include <osg/Depth>
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

// What cameras below the node draw, before or after the host's own: as without us, and while the G-buffer stands still, too.
void handOverCameras(FrameContext& c)
{
    osgUtil::RenderStage& own = *c.frame.gbufferStage;
    const auto adopt = [&](osgUtil::RenderStage& stage) {
        SurfaceSorter::release(stage, *c.frame.fill->getStateSet());
        const osg::Camera* camera = stage.getCamera();
        if (!camera) return;
        const auto inherits = [&](unsigned what) { return (unsigned(camera->getInheritanceMask()) & what) != 0; };
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

// In a frame without a G-buffer: a light behind the node in the graph is heard of only by a stage that the host has, here empty.
void awaitLights(FrameContext& c)
{
    GBufferStage& stage = *c.frame.gbufferStage;
    if (!stage.afterCull) return;
    stage.getStateGraphList().clear();
    stage.getRenderBinList().clear();
    stage.setPositionalStateContainer(nullptr);  // the host's, which is not to be drawn twice
    stage.setCamera(nullptr);
    stage.setClearMask(0);
    c.host.addPreRenderStage(&stage, afterHosts);
}

}  // namespace

Requirement GBufferPass::require(const FrameContext& c) const
{
    Requirement r;
    return r.because(counted(c.facts.surfaces.deferred, "drawable") + ", " + std::to_string(c.facts.surfaces.forward) +
                     " drawn forward");
}

osg::StateSet& GBufferPass::state(FrameContext& c, bool sunny)
{
    const DepthConvention& depth = c.depth;
    const bool plain = !depth.reversed && depth.near == 0.0 && depth.far == 1.0;
    const char* const name = plain ? "gbuffer" : depth.grows() ? "gbuffer growing" : "gbuffer falling";
    osg::Program* program = c.shaders.program("pass/surface.vert", "pass/gbuffer.frag");
    // Only the suns' maps are asked from the smooth surface above a facet.
    const std::vector<std::string> defines(sunny ? 1 : 0, "HAS_SUN_MAPS");
    const StateSets::State state = _states.get({name, defines, {c.viewport, program}});
    _states.endFrame();
    if (!state.isNew) return state.stateSet;
    GBufferFill::setState(state.stateSet, program, c.viewport);
    for (const std::string& d : defines) state.stateSet.setDefine(d);
    const double near = depth.grows() ? 0.0 : 1.0;
    if (!plain)
        state.stateSet.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, near, 1.0 - near),
                                            osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
    return state.stateSet;
}

void GBufferPass::prepareFrame(FrameContext& c, bool sunny)
{
    FrameResources& f = c.frame;
    osg::StateSet& shared = state(c, sunny);
    if (f.fillState != &shared) {
        const osg::ref_ptr<osg::StateSet> own = new osg::StateSet(shared);
        f.subpixel = new osg::Uniform("subpixel", osg::Vec2());
        f.materialColors = new osg::Uniform("materialColors", 0);
        f.emittedStops = new osg::Uniform("emittedStops", 0.0f);
        for (osg::Uniform* u : {f.subpixel.get(), f.materialColors.get(), f.emittedStops.get()}) own->addUniform(u);
        f.fill = new GBufferFill(own.get(), _sorter.get());
        f.fillState = &shared;
    }
    f.materialColors->set(c.settings.materialColors);
    f.emittedStops->set(float(-c.baseStops));
    *f.gbufferTimes = c.timed(name());
    if (f.gbufferCamera) return;
    f.gbufferStage = new GBufferStage;
    f.gbufferCamera = new StageCamera;
    BindTargets::install(*f.gbufferCamera, c.gbuffer.frameBuffer(), _failure.get(), f.gbufferTimes);
}

SurfaceKinds GBufferPass::cull(FrameContext& c, const std::function<void()>& traverse, std::vector<ForwardGraph>& forward)
{
    FrameResources& f = c.frame;
    if (osg::Camera* camera = c.host.getCamera()) {
        f.gbufferCamera->setView(camera->getView());
        f.gbufferCamera->setCullMask(camera->getCullMask());
    }
    f.gbufferCamera->setProjectionMatrix(*c.cv.getProjectionMatrix());
    f.gbufferCamera->setViewMatrix(c.host.getInitialViewMatrix() ? osg::Matrixd(*c.host.getInitialViewMatrix()) : osg::Matrixd());
    f.gbufferCamera->setViewport(c.viewport);
    prepareStage(*f.gbufferStage, c.host, *f.gbufferCamera, *c.viewport, gbufferClear);
    // Light sources and clip planes below the node also reach what is drawn forward.
    f.gbufferStage->setPositionalStateContainer(c.host.getPositionalStateContainer());

    osgUtil::RenderBin* hostBin = c.cv.getCurrentRenderBin();
    f.forwardState = nullptr;
    const SurfaceSorter::LitState lit = [&] {
        if (!f.forwardState) f.forwardState = new osg::StateSet;  // the forward pass fills it
        return f.forwardState.get();
    };
    c.cv.pushViewport(c.viewport);
    const SurfaceSorter::Sorted sorted = f.fill->fill(c.cv, *f.gbufferStage, hostBin, lit, c.lampRule(), forward, [&] {
        c.cv.setCurrentRenderBin(f.gbufferStage.get());
        traverse();
        c.cv.setCurrentRenderBin(hostBin);
    });
    c.cv.popViewport();
    handOverCameras(c);
    passClearOn(*f.gbufferStage, c.host);
    c.fog = sorted.fog;
    return sorted.kinds;
}

void GBufferPass::setup(PassBuilder&, FrameContext& c)
{
    if (!c.facts.ownGBuffer) return;
    if (c.isConverged())
        awaitLights(c);
    else
        c.host.addPreRenderStage(c.frame.gbufferStage.get(), afterHosts);
    c.frame.subpixel->set(osg::Vec2(c.subpixel));
}

}  // namespace osgEnvLight
