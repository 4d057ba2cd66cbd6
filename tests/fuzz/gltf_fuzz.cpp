// SPDX-License-Identifier: MIT
// Any bytes: the glTF reader gives a scene or one line of error, never both, and never fails otherwise.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "Scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    std::string error;
    const osg::ref_ptr<osg::Node> node = osgEnvLight::gltf::readGltf(in, "fuzz", nullptr, error);
    if (node.valid() != error.empty()) std::abort();
    if (!node && (error.rfind("fuzz: ", 0) != 0 || error.find('\n') != std::string::npos)) std::abort();
    if (node) node->getBound();
    return 0;
}
