// SPDX-License-Identifier: MIT
#include "gl/ContextWatch.h"

#include <osg/BufferObject>
#include <osg/ContextData>
#include <osg/FrameBufferObject>
#include <osg/Program>
#include <osg/Texture>

#include <utility>

namespace osgEnvLight
{

namespace
{

// OSG makes a context's managers, unlocked, when they are first asked for: that of frame buffers when the first dies, in
// whatever thread, while the draw thread walks over those that there are.
void makeManagers(unsigned contextID)
{
    osg::get<osg::TextureObjectManager>(contextID);
    osg::get<osg::GLBufferObjectManager>(contextID);
    osg::get<osg::GLRenderBufferManager>(contextID);
    osg::get<osg::GLFrameBufferObjectManager>(contextID);
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    const osg::ref_ptr<osg::Referenced> object = new osg::Program::PerContextProgram(program, contextID);  // dies, and asks
}

}  // namespace

ContextWatch::ContextWatch(unsigned contextID) : osg::GraphicsObjectManager("osgEnvLight::ContextWatch", contextID) {}

void ContextWatch::add(osg::State& state, Listener* listener)
{
    ContextWatch& watch = *osg::get<ContextWatch>(state.getContextID());
    if (!std::exchange(watch._hasManagers, true)) makeManagers(state.getContextID());
    std::lock_guard<std::mutex> lock(watch._mutex);
    if (!watch._listeners.insert(listener).second) return;
    for (auto it = watch._listeners.begin(); it != watch._listeners.end();)
        it = it->valid() ? std::next(it) : watch._listeners.erase(it);
}

void ContextWatch::tell()
{
    std::set<osg::observer_ptr<Listener>> listeners;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        listeners.swap(_listeners);
    }
    for (const auto& listener : listeners) {
        osg::ref_ptr<Listener> alive;
        if (listener.lock(alive)) alive->contextLost(getContextID());
    }
}

// What the listeners hand to managers that have discarded theirs before would be deleted in the next context of this number.
void ContextWatch::discardAllGLObjects()
{
    if (_discarding) return;
    _discarding = true;
    tell();
    osg::discardAllGLObjects(getContextID());
    _discarding = false;
}

}  // namespace osgEnvLight
