// SPDX-License-Identifier: MIT
#include "indirect/TransportWorker.h"

#include "base/WorkerThread.h"

#include <osg/Notify>

#include <exception>
#include <utility>

namespace osgEnvLight
{

TransportWorker::~TransportWorker()
{
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _ends = true;
        _stop = true;
    }
    _wake.notify_one();
    if (_thread.joinable()) _thread.join();
}

void TransportWorker::post(const Job& job)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _job = job;
    _result = nullptr;
    _stop = _working;
    if (!_thread.joinable()) _thread = startWorker([this] { run(); });
    _wake.notify_one();
}

void TransportWorker::discard()
{
    std::lock_guard<std::mutex> lock(_mutex);
    _job = nullptr;
    _result = nullptr;
    _stop = _working;
}

bool TransportWorker::busy() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _job || (_working && !_stop) || _result;
}

osg::ref_ptr<TransportScene> TransportWorker::take()
{
    std::lock_guard<std::mutex> lock(_mutex);
    return std::exchange(_result, nullptr);
}

void TransportWorker::run()
{
    std::unique_lock<std::mutex> lock(_mutex);
    for (;;) {
        _wake.wait(lock, [this] { return _ends || _job; });
        if (_ends) return;
        const Job job = std::exchange(_job, nullptr);
        _working = true;
        _stop = false;
        lock.unlock();
        osg::ref_ptr<TransportScene> result;
        try {
            result = job(_stop);
        } catch (const std::exception& e) {  // no memory for a scene of that size
            OSG_WARN << "osgEnvLight: light between surfaces can't be followed: " << e.what() << std::endl;
        }
        lock.lock();
        _working = false;
        if (!_stop) _result = result;
    }
}

}  // namespace osgEnvLight
