// SPDX-License-Identifier: MIT
// Any bytes: the Radiance reader gives an image or one line of error, never both, and never fails otherwise.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "environment/RadianceHdr.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    std::string error;
    const osg::ref_ptr<osg::Image> image = osgEnvLight::readRadianceHdr(in, "fuzz", error);
    if (image.valid() != error.empty()) std::abort();
    if (!image && (error.rfind("fuzz: ", 0) != 0 || error.find('\n') != std::string::npos)) std::abort();
    if (image && (image->s() < 1 || image->t() < 1 || image->getDataType() != GL_FLOAT)) std::abort();
    return 0;
}
