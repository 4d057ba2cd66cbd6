// SPDX-License-Identifier: MIT
#include "gl/FrameTimer.h"

#include <osg/ContextData>
#include <osg/GLExtensions>
#include <osg/GLObjects>

#include <algorithm>

namespace osgEnvLight
{

namespace
{

const size_t mostFrames = 4;  // that wait for the GPU; then the oldest is given up

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

FrameTimer::~FrameTimer()
{
    forget();
}

void FrameTimer::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!state || state->getContextID() == _contextID) forget();
}

void FrameTimer::forget() const
{
    if (_contextID == ~0u) return;
    for (const Frame& frame : _frames)
        for (const Record& r : frame.records)
            for (const GLuint q : {r.begin, r.end})
                if (q) _unused.push_back(q);
    _frames.clear();
    for (const GLuint q : _unused) osg::get<QueryManager>(_contextID)->scheduleGLObjectForDeletion(q);
    _unused.clear();
    _contextID = ~0u;
}

GLuint FrameTimer::query(osg::State& state)
{
    const auto* ext = state.get<osg::GLExtensions>();
    if (!ext->isARBTimerQuerySupported) return 0;
    if (_unused.empty()) {
        _unused.resize(16);
        ext->glGenQueries(GLsizei(_unused.size()), _unused.data());
    }
    const GLuint q = _unused.back();
    _unused.pop_back();
    ext->glQueryCounter(q, GL_TIMESTAMP);
    return q;
}

void FrameTimer::begin(osg::State& state, const std::string& pass, unsigned frame)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (_contextID != state.getContextID()) forget();
    _contextID = state.getContextID();
    osg::get<QueryManager>(_contextID);
    if (_frames.empty() || _frames.back().number != frame) {
        finish(state);
        _frames.push_back({frame, {}});
    }
    Record record;
    record.time.pass = pass;
    record.begin = query(state);
    _frames.back().records.push_back(record);
    _begin = std::chrono::steady_clock::now();
}

void FrameTimer::end(osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (_frames.empty() || _frames.back().records.empty()) return;  // released in between
    Record& record = _frames.back().records.back();
    record.time.cpu = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - _begin).count();
    record.end = query(state);
}

// Read the frames that the GPU is through with.
void FrameTimer::finish(osg::State& state)
{
    const auto* ext = state.get<osg::GLExtensions>();
    while (!_frames.empty()) {
        Frame& frame = _frames.front();
        GLint ready = 1;
        const GLuint last = frame.records.back().end;
        if (last) ext->glGetQueryObjectiv(last, GL_QUERY_RESULT_AVAILABLE, &ready);
        if (!ready && _frames.size() < mostFrames) return;
        for (Record& r : frame.records) {
            GLuint64 t0 = 0, t1 = 0;
            if (ready && r.begin && r.end) {
                ext->glGetQueryObjectui64v(r.begin, GL_QUERY_RESULT, &t0);
                ext->glGetQueryObjectui64v(r.end, GL_QUERY_RESULT, &t1);
                r.time.gpu = double(t1 - t0) * 1e-6;
            }
            for (const GLuint q : {r.begin, r.end})
                if (q) _unused.push_back(q);
        }
        if (ready) publish(frame);
        _frames.pop_front();
    }
}

void FrameTimer::publish(const Frame& frame)
{
    _finished.clear();
    for (const Record& r : frame.records) {
        const auto same = [&](const Time& t) { return t.pass == r.time.pass; };
        const auto known = std::find_if(_finished.begin(), _finished.end(), same);
        if (known == _finished.end()) {
            _finished.push_back(r.time);
        } else {
            known->cpu += r.time.cpu;
            known->gpu += std::max(r.time.gpu, 0.0);
        }
    }
}

std::vector<FrameTimer::Time> FrameTimer::finished() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _finished;
}

}  // namespace osgEnvLight
