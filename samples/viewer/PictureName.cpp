// SPDX-License-Identifier: MIT
#include "PictureName.h"

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>

std::string unusedName(const std::string& scene, const std::string& extension)
{
    const std::string simple = osgDB::getNameLessAllExtensions(osgDB::getSimpleFileName(scene));
    const std::string base = simple.empty() ? "envlight" : simple;
    for (int i = 1;; ++i) {
        const std::string name = base + "-" + std::to_string(i) + "." + extension;
        if (!osgDB::fileExists(name)) return name;
    }
}
