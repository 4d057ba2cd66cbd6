// SPDX-License-Identifier: MIT
#include "base/Failure.h"

#include <osg/Notify>

namespace osgEnvLight
{

bool Failure::happened(unsigned contextID) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _contexts.count(contextID) > 0;
}

void Failure::report(unsigned contextID, const std::string& message)
{
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (!_contexts.insert(contextID).second) return;
    }
    OSG_WARN << "osgEnvLight: " << message << "; the scene is shown unlit" << std::endl;
}

void Failure::clear()
{
    std::lock_guard<std::mutex> lock(_mutex);
    _contexts.clear();
}

void Failure::clear(unsigned contextID)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _contexts.erase(contextID);
}

}  // namespace osgEnvLight
