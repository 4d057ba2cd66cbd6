// SPDX-License-Identifier: MIT
#include <osgEnvLight/GBufferCallback>

#include "gl/ShaderLibrary.h"
#include "surface/GBufferFill.h"

#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

GBufferCallback::GBufferCallback(int width, int height) : _gbuffer(new GBuffer(width, height))
{
    osg::ref_ptr<ShaderLibrary> library = new ShaderLibrary(new Failure);
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    GBufferFill::setState(*state, library->program("pass/surface.vert", "pass/gbuffer.frag"),
                          new osg::Viewport(0, 0, width, height));
    state->setDefine("HAS_SUN_MAPS");  // as some view that reads it may
    _fill = new GBufferFill(state.get(), new SurfaceSorter);
}

GBufferCallback::~GBufferCallback() = default;

void GBufferCallback::attachTo(osg::Camera& camera)
{
    using C = osg::Camera;
    camera.setRenderTargetImplementation(C::FRAME_BUFFER_OBJECT);
    camera.attach(C::COLOR_BUFFER0, _gbuffer->albedo.get());
    camera.attach(C::COLOR_BUFFER1, _gbuffer->normal.get());
    camera.attach(C::COLOR_BUFFER2, _gbuffer->specular.get());
    camera.attach(C::COLOR_BUFFER3, _gbuffer->emission.get());
    camera.attach(C::DEPTH_BUFFER, _gbuffer->depth.get());
    camera.setViewport(0, 0, _gbuffer->width, _gbuffer->height);
    camera.setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    camera.setClearColor(osg::Vec4(0, 0, 0, 0));
    camera.addCullCallback(this);
}

void GBufferCallback::operator()(osg::Node* node, osg::NodeVisitor* nv)
{
    osgUtil::CullVisitor* cv = nv->asCullVisitor();
    if (!cv) {
        traverse(node, nv);
        return;
    }
    std::vector<ForwardGraph> leftOut;
    _fill->fill(
        *cv, *cv->getCurrentRenderBin(), nullptr, [] { return nullptr; }, LampRule(), leftOut, [&] { traverse(node, nv); });
}

void GBufferCallback::resizeGLObjectBuffers(unsigned maximum)
{
    _gbuffer->resizeGLObjectBuffers(maximum);
    _fill->getStateSet()->resizeGLObjectBuffers(maximum);
}

void GBufferCallback::releaseGLObjects(osg::State* state) const
{
    _gbuffer->releaseGLObjects(state);
    _fill->getStateSet()->releaseGLObjects(state);
}

}  // namespace osgEnvLight
