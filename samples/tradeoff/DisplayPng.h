// SPDX-License-Identifier: MIT
#pragma once

#include <metrics/Picture>

#include <string>

namespace tradeoff
{

enum Encoding { LINEAR, ENCODED };

/** The picture as a data: URI of a PNG, opaque. LINEAR ones are multiplied by the scale and encoded in sRGB. Throws
 * std::runtime_error if OSG has no plugin that writes PNG.*/
std::string pngUri(const osgEnvLight::Picture& picture, Encoding encoding, double scale = 1.0);

}  // namespace tradeoff
