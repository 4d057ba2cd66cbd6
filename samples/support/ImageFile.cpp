// SPDX-License-Identifier: MIT
#include "ImageFile.h"

#include <osgDB/FileNameUtils>
#include <osgDB/Registry>
#include <osgDB/fstream>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
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

// Writes into the file; messages speak of the name that the user gave.
void writeInto(const std::string& file, const osg::Image& image, const std::string& name)
{
    std::string message;
    bool written;
    if (osgDB::getLowerCaseFileExtension(name) == "png") {
        written = writePng(image, file, message);
    } else {
        osgDB::ReaderWriter::WriteResult result = osgDB::Registry::instance()->writeImage(image, file, nullptr);
        written = result.success();
        message = result.message();
    }
    if (!written)
        throw std::runtime_error(name + ": can't be written: " + (message.empty() ? "no plugin, or no such folder" : message));
}

}  // namespace

void writeImageFile(const osg::Image& image, const std::string& name)
{
    writeInto(name, image, name);
}

void writeWholeImageFile(const osg::Image& image, const std::string& name)
{
    const std::string part =
        osgDB::getNameLessExtension(name) + ".part" + std::to_string(getpid()) + "." + osgDB::getFileExtension(name);
    try {
        writeInto(part, image, name);
        std::filesystem::rename(std::filesystem::u8path(part), std::filesystem::u8path(name));
    } catch (const std::filesystem::filesystem_error& e) {
        std::remove(part.c_str());
        throw std::runtime_error(name + ": can't be written: " + e.code().message());
    } catch (...) {
        std::remove(part.c_str());
        throw;
    }
}
