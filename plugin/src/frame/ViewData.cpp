// SPDX-License-Identifier: MIT
#include "frame/ViewData.h"

namespace osgEnvLight
{

void ViewData::fit(int width, int height)
{
    if (width == _width && height == _height) return;
    _width = width;
    _height = height;
    _viewport = new osg::Viewport(0, 0, width, height);
    retireAll();
    _gbuffer = nullptr;
    _frames.clear();
}

GBuffer& ViewData::gbuffer()
{
    if (!_gbuffer) _gbuffer = new GBuffer(_width, _height);
    return *_gbuffer;
}

FrameResources& ViewData::frame(const osg::Referenced* cullVisitor)
{
    osg::ref_ptr<FrameResources>& frame = _frames[cullVisitor];
    if (!frame) frame = new FrameResources;
    frame->lastCull = _cull;
    return *frame;
}

void ViewData::forgetUnused(FrameResources& current)
{
    const unsigned idle = 4;  // culls; the frames of a view take turns
    current.forgetUnused(*_retired);
    atlasLights.endFrame();
    for (auto it = _frames.begin(); it != _frames.end();) {
        const bool used = _cull - it->second->lastCull < idle;
        if (!used) it->second->retire(*_retired);
        it = used ? std::next(it) : _frames.erase(it);
    }
    ++_cull;
}

ViewData::~ViewData()
{
    retireAll();
}

// All that is of the view's size.
void ViewData::retireAll()
{
    if (_gbuffer) {
        for (const auto* t : {&_gbuffer->albedo, &_gbuffer->normal, &_gbuffer->specular, &_gbuffer->emission, &_gbuffer->depth})
            _retired->add(t->get());
        _retired->add(_gbuffer->frameBuffer());
    }
    graph.retire();
    for (const auto& [cullVisitor, frame] : _frames) frame->retire(*_retired);
}

void ViewData::resizeGLObjectBuffers(unsigned maximum)
{
    if (_gbuffer) _gbuffer->resizeGLObjectBuffers(maximum);
    graph.resizeGLObjectBuffers(maximum);
    atlasLights.resizeGLObjectBuffers(maximum);
    casterStates.moving.resizeGLObjectBuffers(maximum);
    for (auto& [cullVisitor, frame] : _frames) frame->resizeGLObjectBuffers(maximum);
}

void ViewData::releaseGLObjects(osg::State* state) const
{
    if (_gbuffer) _gbuffer->releaseGLObjects(state);
    graph.releaseGLObjects(state);
    atlasLights.releaseGLObjects(state);
    timer->releaseGLObjects(state);
    casterStates.moving.releaseGLObjects(state);
    for (const auto& [cullVisitor, frame] : _frames) frame->releaseGLObjects(state);
}

size_t ViewData::bytes() const
{
    const size_t pixels = size_t(_width) * size_t(_height);
    return (_gbuffer ? 36 * pixels : 0) + graph.bytes() + atlasLights.bytes();
}

}  // namespace osgEnvLight
