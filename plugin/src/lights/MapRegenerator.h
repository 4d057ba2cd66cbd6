/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "lights/MapTextures.h"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace osgEnvLight
{

/** Makes a changed map into light on a thread of its own, which is started at the first change and sleeps between them.
 * Only the newest request counts: one that has not begun is replaced.*/
class OSGENVLIGHT_EXPORT MapRegenerator
{
  public:
    MapRegenerator() = default;
    /** Waits for what is being made. */
    ~MapRegenerator();
    MapRegenerator(const MapRegenerator&) = delete;
    MapRegenerator& operator=(const MapRegenerator&) = delete;

    struct Result {
        osg::ref_ptr<MapTextures> textures;  // null: error says why
        std::string error;
    };

    /** The textures of that state, now. */
    static Result make(const MapState& state, const MapTextures::Continuation& former);

    /** The same on the thread; copies the pixels. */
    void post(const MapState& state, const MapTextures::Continuation& former);
    /** On the thread: a step of a map that no longer changes to its cold lists. */
    void postSettle(const MapTextures& former);

    /** Forget what waits, is being made or has become ready: something newer is there. */
    void discard();

    /** True if something is being made or waits to be taken. */
    bool busy() const;
    /** What has become ready since the last call. */
    bool take(Result& result);

  private:
    struct Job {
        MapState state;
        MapTextures::Continuation former;
        osg::ref_ptr<MapTextures> settling;
    };

    void enqueue(Job job);
    void run();

    mutable std::mutex _mutex;
    std::condition_variable _wake;
    std::thread _thread;
    bool _stop = false;
    bool _hasJob = false;
    bool _working = false;
    bool _hasResult = false;
    bool _discarded = false;  // what is being made
    Job _job;
    Result _result;
};

}  // namespace osgEnvLight
