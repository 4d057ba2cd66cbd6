// SPDX-License-Identifier: MIT
// tinygltf, as structures only: files, images and base64 are read by us, with bounds (Asset.cpp). Compiled in TinyGltf.cpp.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS

#include <tiny_gltf.h>
