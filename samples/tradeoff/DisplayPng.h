// SPDX-License-Identifier: MIT
#pragma once

#include <metrics/Picture>

#include <string>

namespace tradeoff
{

/** A display-encoded picture as a data: URI of a PNG, opaque. Throws std::runtime_error if OSG has no plugin that writes PNG. */
std::string pngUri(const osgEnvLight::Picture& encoded);

}  // namespace tradeoff
