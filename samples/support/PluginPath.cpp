// SPDX-License-Identifier: MIT
#include "PluginPath.h"

#include "gl/ShaderLibrary.h"

#include <osgDB/FileNameUtils>
#include <osgDB/Registry>

#include <dlfcn.h>

void addPluginPath()
{
    Dl_info info;
    if (dladdr(reinterpret_cast<const void*>(&osgEnvLight::numEmbeddedShaders), &info) && info.dli_fname)
        osgDB::Registry::instance()->getLibraryFilePathList().push_back(osgDB::getFilePath(info.dli_fname));
}
