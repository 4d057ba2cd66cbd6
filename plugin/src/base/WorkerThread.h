/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <functional>
#include <thread>

namespace osgEnvLight
{

/** Start a thread that may run on any processor. OSG's viewers bind the thread that draws to the first processor, and a new
 * thread inherits that: a plain std::thread would share the processor with the drawing. */
OSGENVLIGHT_EXPORT std::thread startWorker(std::function<void()> run);

}  // namespace osgEnvLight
