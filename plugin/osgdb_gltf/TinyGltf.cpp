// SPDX-License-Identifier: MIT
// What the header needs and includes only beside the parts that are left out.
#include <fstream>
#include <sstream>

#define TINYGLTF_IMPLEMENTATION
#include "TinyGltf.h"
