// SPDX-License-Identifier: MIT
#include <osgEnvLight/PenroseTable>

namespace osgEnvLight
{

const PenroseTable penroseTable = {};

}  // namespace osgEnvLight
