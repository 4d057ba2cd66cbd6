// SPDX-License-Identifier: MIT
#include "ImageFile.h"

#include <osgDB/FileNameUtils>
#include <osgDB/Registry>
#include <osgDB/fstream>

#include <sstream>
#include <stdexcept>

namespace
{

// OSG's plugin does not look whether its last bytes reach the disk.
bool writePng(const osg::Image& image, const std::string& name, std::string& message)
{
    osgDB::ReaderWriter* plugin = osgDB::Registry::instance()->getReaderWriterForExtension("png");
    std::ostringstream bytes;
    if (!plugin || !plugin->writeImage(image, bytes).success()) return false;
    osgDB::ofstream file(name.c_str(), std::ios::binary);
    if (!file) return false;
    file << bytes.str();
    file.close();
    if (!file) message = "not all of it reached the disk";
    return bool(file);
}

}  // namespace

void writeImageFile(const osg::Image& image, const std::string& name)
{
    std::string message;
    bool written;
    if (osgDB::getLowerCaseFileExtension(name) == "png") {
        written = writePng(image, name, message);
    } else {
        osgDB::ReaderWriter::WriteResult result = osgDB::Registry::instance()->writeImage(image, name, nullptr);
        written = result.success();
        message = result.message();
    }
    if (!written)
        throw std::runtime_error(name + ": can't be written: " + (message.empty() ? "no plugin, or no such folder" : message));
}
