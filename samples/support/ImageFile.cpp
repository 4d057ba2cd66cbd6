// SPDX-License-Identifier: MIT
#include "ImageFile.h"

#include <osgDB/Registry>

#include <stdexcept>

void writeImageFile(const osg::Image& image, const std::string& name)
{
    osgDB::ReaderWriter::WriteResult result = osgDB::Registry::instance()->writeImage(image, name, nullptr);
    if (!result.success())
        throw std::runtime_error(
            name + ": can't be written: " + (result.message().empty() ? "no plugin, or no such folder" : result.message()));
}
