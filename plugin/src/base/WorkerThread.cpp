// SPDX-License-Identifier: MIT
#include "base/WorkerThread.h"

#include <OpenThreads/Affinity>
#include <OpenThreads/Thread>

#include <utility>

namespace osgEnvLight
{

std::thread startWorker(std::function<void()> run)
{
    return std::thread([run = std::move(run)] {
        OpenThreads::SetProcessorAffinityOfCurrentThread(OpenThreads::Affinity());
        run();
    });
}

}  // namespace osgEnvLight
