// SPDX-License-Identifier: MIT
#include <osgEnvLight/GBufferCallback>

#include <osgEnvLight/ShaderLibrary>

#include <osg/GLExtensions>
#include <osg/Viewport>
#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

void bindFrameBuffer(osg::State& state, osg::FrameBufferObject& target)
{
    target.apply(state);
    // At its first use apply() creates the textures, bound to the active unit behind State's back.
    state.haveAppliedTextureAttribute(state.getActiveTextureUnit(), osg::StateAttribute::TEXTURE);
}

BindTargets::BindTargets(bool before, osg::FrameBufferObject* target, GpuTimer* timer, Failure* failure)
    : _before(before), _target(target), _timer(timer), _failure(failure)
{
}

void BindTargets::install(osg::Camera& camera, osg::FrameBufferObject* target, GpuTimer* timer, Failure* failure)
{
    camera.setPreDrawCallback(new BindTargets(true, target, timer, failure));
    camera.setPostDrawCallback(new BindTargets(false, target, timer, failure));
}

void BindTargets::operator()(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    const auto* ext = state.get<osg::GLExtensions>();
    if (!_before) {
        if (_timer) _timer->end(state);
        const osg::GraphicsContext* context = state.getGraphicsContext();
        ext->glBindFramebuffer(GL_FRAMEBUFFER_EXT, context ? context->getDefaultFboId() : 0);
        return;
    }
    bindFrameBuffer(state, *_target);
    if (_checked.insert(state.getContextID()).second) check(state);
    if (_timer) _timer->begin(state);
}

void BindTargets::check(osg::State& state) const
{
    const auto* ext = state.get<osg::GLExtensions>();
    GLint profile = 0;
    if (ext->glVersion >= 3.2f) glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    if (profile & GL_CONTEXT_CORE_PROFILE_BIT)
        _failure->report(state.getContextID(),
                         "this is a core profile of OpenGL, in which OpenSceneGraph's fixed-function state does not work");
    if (ext->glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) != GL_FRAMEBUFFER_COMPLETE_EXT)
        _failure->report(state.getContextID(), "this OpenGL can't draw into the G-buffer's formats (frame buffer incomplete)");
}

GBufferCallback::GBufferCallback(int width, int height) : _gbuffer(new GBuffer(width, height)), _sorter(new SurfaceSorter)
{
    osg::ref_ptr<ShaderLibrary> library = new ShaderLibrary(new Failure);
    _stateSet = new osg::StateSet;
    setState(*_stateSet, library->program("pass/surface.vert", "pass/gbuffer.frag"), new osg::Viewport(0, 0, width, height));
}

GBufferCallback::GBufferCallback(GBuffer* gbuffer, osg::StateSet* stateSet, SurfaceSorter* sorter)
    : _gbuffer(gbuffer), _stateSet(stateSet), _sorter(sorter)
{
}

void GBufferCallback::setState(osg::StateSet& stateSet, osg::Program* program, osg::Viewport* viewport)
{
    stateSet.setAttribute(program, osg::StateAttribute::ON | osg::StateAttribute::PROTECTED);
    stateSet.setMode(GL_BLEND, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    stateSet.setAttribute(viewport);  // the host's own is re-applied with its state
    stateSet.addUniform(new osg::Uniform("baseColorMap", 0));
    stateSet.addUniform(new osg::Uniform("materialColors", 0));
    stateSet.addUniform(new osg::Uniform("emittedStops", 0.0f));
}

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
    fill(
        *cv, *cv->getCurrentRenderBin(), nullptr, [] { return nullptr; }, leftOut, [&] { traverse(node, nv); });
}

void GBufferCallback::resizeGLObjectBuffers(unsigned maximum)
{
    _gbuffer->resizeGLObjectBuffers(maximum);
    _stateSet->resizeGLObjectBuffers(maximum);
}

void GBufferCallback::releaseGLObjects(osg::State* state) const
{
    _gbuffer->releaseGLObjects(state);
    _stateSet->releaseGLObjects(state);
}

osgUtil::StateGraph& GBufferCallback::push(osgUtil::CullVisitor& cv, osg::ref_ptr<osg::RefMatrix>& projection)
{
    projection = cv.getProjectionMatrix();
    cv.pushStateSet(_stateSet.get());
    return *cv.getCurrentStateGraph();
}

void GBufferCallback::pop(osgUtil::CullVisitor& cv)
{
    cv.popStateSet();
}

}  // namespace osgEnvLight
