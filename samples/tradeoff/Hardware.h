// SPDX-License-Identifier: MIT
#pragma once

#include "Report.h"

#include <HeadlessContext.h>

namespace tradeoff
{

/** Renderer, its version, whether it is software, processor and cores, operating system, versions of the libraries. */
Texts describeHardware(const HeadlessContext& context);

/** Now, in UTC: "2026-11-22 03:14". */
std::string today();

}  // namespace tradeoff
