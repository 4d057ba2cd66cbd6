// SPDX-License-Identifier: MIT
#include "lights/MapRegenerator.h"

#include "base/WorkerThread.h"

#include <exception>

namespace osgEnvLight
{

MapRegenerator::~MapRegenerator()
{
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _stop = true;
        _hasJob = false;
    }
    _wake.notify_one();
    if (_thread.joinable()) _thread.join();
}

MapRegenerator::Result MapRegenerator::make(const MapState& state, const MapTextures::Continuation& former)
{
    Result result;
    const osg::ref_ptr<const RadianceMap> map = state.read(result.error);
    if (map) result.textures = new MapTextures(map.get(), former);
    return result;
}

void MapRegenerator::post(const MapState& state, const MapTextures::Continuation& former)
{
    Job job;
    job.state = state.copy();
    job.former = former;
    enqueue(std::move(job));
}

void MapRegenerator::postSettle(const MapTextures& former)
{
    Job job;
    job.settling = new MapTextures(former);
    enqueue(std::move(job));
}

void MapRegenerator::enqueue(Job job)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _job = std::move(job);
    _hasJob = true;
    if (!_thread.joinable()) _thread = startWorker([this] { run(); });
    _wake.notify_one();
}

void MapRegenerator::discard()
{
    std::lock_guard<std::mutex> lock(_mutex);
    _job = Job();
    _hasJob = false;
    _result = Result();
    _hasResult = false;
    _discarded = _working;
}

bool MapRegenerator::busy() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _hasJob || (_working && !_discarded) || _hasResult;
}

bool MapRegenerator::take(Result& result)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_hasResult) return false;
    result = std::move(_result);
    _result = Result();
    _hasResult = false;
    return true;
}

void MapRegenerator::run()
{
    std::unique_lock<std::mutex> lock(_mutex);
    for (;;) {
        _wake.wait(lock, [this] { return _stop || _hasJob; });
        if (_stop) return;
        Job job = std::move(_job);
        _job = Job();
        _hasJob = false;
        _working = true;
        lock.unlock();
        Result result;
        try {
            if (job.settling) {
                job.settling->settle();
                result.textures = job.settling;
            } else {
                result = make(job.state, job.former);
            }
        } catch (const std::exception& e) {  // no memory for a map of that size
            result.error = std::string("the environment map can't be made into light: ") + e.what();
        }
        job = Job();
        lock.lock();
        _working = false;
        if (!_discarded) {
            _result = std::move(result);
            _hasResult = true;
        }
        _discarded = false;
    }
}

}  // namespace osgEnvLight
