// SPDX-License-Identifier: MIT
#include <metrics/Picture>

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

bool Picture::finite() const
{
    return std::all_of(rgba.begin(), rgba.end(), [](float f) { return std::isfinite(f); });
}

}  // namespace osgEnvLight
