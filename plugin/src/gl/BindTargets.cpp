// SPDX-License-Identifier: MIT
#include "gl/BindTargets.h"

#include <osg/GLExtensions>
#include <osg/GraphicsContext>
#include <osg/RenderInfo>

namespace osgEnvLight
{

void bindFrameBuffer(osg::State& state, osg::FrameBufferObject& target)
{
    target.apply(state);
    // At its first use apply() creates the textures, bound to the active unit behind State's back.
    state.haveAppliedTextureAttribute(state.getActiveTextureUnit(), osg::StateAttribute::TEXTURE);
}

BindTargets::BindTargets(bool before, osg::FrameBufferObject* target, Failure* failure,
                         const std::shared_ptr<const TimedDraw>& timed)
    : _before(before), _target(target), _timed(timed), _failure(failure)
{
}

void BindTargets::install(osg::Camera& camera, osg::FrameBufferObject* target, Failure* failure,
                          const std::shared_ptr<const TimedDraw>& timed)
{
    camera.setPreDrawCallback(new BindTargets(true, target, failure, timed));
    camera.setPostDrawCallback(new BindTargets(false, target, failure, timed));
}

void BindTargets::operator()(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    const auto* ext = state.get<osg::GLExtensions>();
    if (!_before) {
        if (_timed) _timed->end(state);
        const osg::GraphicsContext* context = state.getGraphicsContext();
        ext->glBindFramebuffer(GL_FRAMEBUFFER_EXT, context ? context->getDefaultFboId() : 0);
        return;
    }
    bindFrameBuffer(state, *_target);
    if (_checked.insert(state.getContextID()).second) check(state);
    if (_timed) _timed->begin(state);
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

}  // namespace osgEnvLight
