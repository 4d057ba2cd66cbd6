// SPDX-License-Identifier: MIT
#include <osgEnvLight/Failure>

#include <osg/Notify>

namespace osgEnvLight
{

void Failure::report(const std::string& message)
{
    if (!_happened.exchange(true)) OSG_WARN << "osgEnvLight: " << message << "; the scene is shown unlit" << std::endl;
}

}  // namespace osgEnvLight
