// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/** Drop a file on the window as a file manager does: the XDND protocol, version 5. False if the window does not take it. */
bool dropFile(const std::string& display, unsigned long window, const std::string& file);
