// SPDX-License-Identifier: MIT
#include "gl/ContextWatch.h"

#include <osg/ContextData>

namespace osgEnvLight
{

ContextWatch::ContextWatch(unsigned contextID) : osg::GraphicsObjectManager("osgEnvLight::ContextWatch", contextID) {}

void ContextWatch::add(osg::State& state, Listener* listener)
{
    ContextWatch& watch = *osg::get<ContextWatch>(state.getContextID());
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
