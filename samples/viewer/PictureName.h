// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/** A name for a picture of the scene in the current folder that no file has yet: chess-1.png, chess-2.png ... */
std::string unusedName(const std::string& scene, const std::string& extension);
