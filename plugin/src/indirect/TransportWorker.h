/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "indirect/TransportScene.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace osgEnvLight
{

/** Makes a TransportScene on a thread of its own, which is started when there is first something to make. */
class OSGENVLIGHT_EXPORT TransportWorker
{
  public:
    TransportWorker() = default;
    /** Gives up what is being made. */
    ~TransportWorker();
    TransportWorker(const TransportWorker&) = delete;
    TransportWorker& operator=(const TransportWorker&) = delete;

    using Job = std::function<osg::ref_ptr<TransportScene>(const std::atomic<bool>& stop)>;

    /** In place of what waits, is being made or is ready. */
    void post(const Job& job);
    /** Nothing is wanted any more. */
    void discard();
    /** Something is being made or waits to be taken. */
    bool busy() const;
    /** What has become ready since the last call, or null. */
    osg::ref_ptr<TransportScene> take();

  private:
    void run();

    mutable std::mutex _mutex;
    std::condition_variable _wake;
    std::thread _thread;
    std::atomic<bool> _stop{false};  // what is being made is no longer wanted
    bool _ends = false;
    bool _working = false;
    Job _job;
    osg::ref_ptr<TransportScene> _result;
};

}  // namespace osgEnvLight
