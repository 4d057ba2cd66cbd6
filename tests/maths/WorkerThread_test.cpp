// SPDX-License-Identifier: MIT
#include <base/WorkerThread.h>

#include <OpenThreads/Affinity>
#include <OpenThreads/Thread>

#include <gtest/gtest.h>

#include <sched.h>

namespace WorkerThread_test
{

namespace
{

// On which this thread may run.
int processors()
{
    cpu_set_t set;
    return sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set) : 0;
}

}  // namespace

// As the thread of an osgViewer::Viewer that draws and starts it is.
TEST(WorkerThread, IsNotBoundToTheProcessorOfTheThreadThatStartsIt)
{
    const int all = processors();
    if (all < 2) GTEST_SKIP() << "one processor";
    int bound = 0, ofWorker = 0, inherited = 0;
    std::thread([&] {
        OpenThreads::SetProcessorAffinityOfCurrentThread(OpenThreads::Affinity(0));
        bound = processors();
        std::thread([&] { inherited = processors(); }).join();
        osgEnvLight::startWorker([&] { ofWorker = processors(); }).join();
    }).join();
    EXPECT_EQ(1, bound);
    EXPECT_EQ(1, inherited);  // what a thread is without it
    EXPECT_EQ(all, ofWorker);
}

}  // namespace WorkerThread_test
