/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/State>

#include <chrono>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace osgEnvLight
{

/** Times of a view's passes, all of one frame: on the GPU by timestamps, which nest inside OSG's own timers and are read some
 * frames later without waiting; on the CPU by the steady clock. Thread-safe; of one context at a time.*/
class OSGENVLIGHT_EXPORT FrameTimer : public osg::Referenced
{
  public:
    struct Time {
        std::string pass;
        double gpu = -1.0;  // milliseconds; negative where OpenGL has no timer queries
        double cpu = -1.0;
    };

    /** Around a pass, in its draw thread. Passes do not nest.
     * @param frame  differs from that of the frame before */
    void begin(osg::State& state, const std::string& pass, unsigned frame);
    void end(osg::State& state);

    /** Of the last frame whose times are all known, in the order in which its passes were drawn: a pass that was not drawn in it
     * is not listed, one that was drawn several times has the sum. */
    std::vector<Time> finished() const;

    void releaseGLObjects(osg::State* state) const;

  protected:
    ~FrameTimer() override;

  private:
    struct Record {
        Time time;
        GLuint begin = 0;
        GLuint end = 0;
    };
    struct Frame {
        unsigned number;
        std::vector<Record> records;
    };
    void finish(osg::State& state);
    void publish(const Frame& frame);
    GLuint query(osg::State& state);
    void forget() const;

    mutable std::mutex _mutex;
    mutable std::deque<Frame> _frames;    // not known yet, the last one being drawn
    mutable std::vector<GLuint> _unused;  // queries
    mutable unsigned _contextID = ~0u;    // that the queries are of
    std::vector<Time> _finished;
    std::chrono::steady_clock::time_point _begin;
};

/** What measures a draw of this frame; without a timer nothing does. */
struct TimedDraw {
    osg::ref_ptr<FrameTimer> timer;
    std::string pass;
    unsigned frame = 0;

    void begin(osg::State& state) const
    {
        if (timer) timer->begin(state, pass, frame);
    }
    void end(osg::State& state) const
    {
        if (timer) timer->end(state);
    }
};

}  // namespace osgEnvLight
