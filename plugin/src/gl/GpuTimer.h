/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/State>

#include <array>
#include <chrono>
#include <map>
#include <mutex>

namespace osgEnvLight
{

/** Time of one pass: on the GPU by timestamps, which nest inside OSG's own timers and are read some frames late without
 * waiting; on the CPU by the steady clock. Thread-safe; one ring of queries for each context.*/
class OSGENVLIGHT_EXPORT GpuTimer : public osg::Referenced
{
  public:
    /** Around the pass, in its draw thread. */
    void begin(osg::State& state);
    void end(osg::State& state);

    /** Milliseconds of the last pass that has finished, negative when none has. */
    double gpu() const;
    double cpu() const;

    void releaseGLObjects(osg::State* state) const;

  protected:
    ~GpuTimer() override;

  private:
    struct Ring {
        std::array<GLuint, 8> queries{};
        unsigned frame = 0;
    };
    static void create(Ring& ring, osg::State& state);
    static void destroy(unsigned contextID, const Ring& ring);

    mutable std::mutex _mutex;
    mutable std::map<unsigned, Ring> _rings;  // by context
    std::chrono::steady_clock::time_point _begin;
    double _gpu = -1.0;
    double _cpu = -1.0;
};

}  // namespace osgEnvLight
