/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <functional>
#include <thread>

namespace osgEnvLight
{

/** A thread that may run on any processor. A new thread inherits the processors of the one that makes it, and OSG's viewers bind theirs to
 * the first one: without this a worker would take turns with the thread that draws. */
OSGENVLIGHT_EXPORT std::thread startWorker(std::function<void()> run);

}  // namespace osgEnvLight
