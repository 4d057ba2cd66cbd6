// SPDX-License-Identifier: MIT
#include "gl/GpuTimer.h"

#include <osg/ContextData>
#include <osg/GLExtensions>
#include <osg/GLObjects>

namespace osgEnvLight
{

namespace
{

// Deletes the queries of dead timers when their context is next current.
class QueryManager : public osg::GLObjectManager
{
  public:
    explicit QueryManager(unsigned contextID) : osg::GLObjectManager("osgEnvLight::QueryManager", contextID) {}

    void deleteGLObject(GLuint query) override
    {
        if (const auto* ext = osg::GLExtensions::Get(_contextID, true)) ext->glDeleteQueries(1, &query);
    }
};

}  // namespace

GpuTimer::~GpuTimer()
{
    for (const auto& [contextID, ring] : _rings) destroy(contextID, ring);
}

void GpuTimer::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto it = _rings.begin(); it != _rings.end();) {
        const bool released = !state || it->first == state->getContextID();
        if (released) destroy(it->first, it->second);
        it = released ? _rings.erase(it) : std::next(it);
    }
}

void GpuTimer::destroy(unsigned contextID, const Ring& ring)
{
    for (GLuint query : ring.queries)
        if (query) osg::get<QueryManager>(contextID)->scheduleGLObjectForDeletion(query);
}

void GpuTimer::create(Ring& ring, osg::State& state)
{
    osg::get<QueryManager>(state.getContextID());
    state.get<osg::GLExtensions>()->glGenQueries(GLsizei(ring.queries.size()), ring.queries.data());
}

void GpuTimer::begin(osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _begin = std::chrono::steady_clock::now();
    const auto* ext = state.get<osg::GLExtensions>();
    if (!ext->isARBTimerQuerySupported) return;
    Ring& ring = _rings[state.getContextID()];
    if (!ring.queries[0]) create(ring, state);
    ext->glQueryCounter(ring.queries[2 * (ring.frame % 4)], GL_TIMESTAMP);
}

void GpuTimer::end(osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _cpu = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - _begin).count();
    const auto* ext = state.get<osg::GLExtensions>();
    auto found = _rings.find(state.getContextID());
    if (found == _rings.end()) return;
    Ring& ring = found->second;
    ext->glQueryCounter(ring.queries[2 * (ring.frame % 4) + 1], GL_TIMESTAMP);
    if (++ring.frame < 4) return;
    const size_t oldest = 2 * (ring.frame % 4);
    GLint ready = 0;
    ext->glGetQueryObjectiv(ring.queries[oldest + 1], GL_QUERY_RESULT_AVAILABLE, &ready);
    if (!ready) return;
    GLuint64 t0 = 0;
    GLuint64 t1 = 0;
    ext->glGetQueryObjectui64v(ring.queries[oldest], GL_QUERY_RESULT, &t0);
    ext->glGetQueryObjectui64v(ring.queries[oldest + 1], GL_QUERY_RESULT, &t1);
    _gpu = double(t1 - t0) * 1e-6;
}

double GpuTimer::gpu() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _gpu;
}

double GpuTimer::cpu() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _cpu;
}

}  // namespace osgEnvLight
