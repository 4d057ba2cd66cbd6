/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgDB/ReaderWriter>

#include <string>

namespace osgEnvLight
{

/** Why osgDB did not read the named file, in words, without the name in front. */
inline std::string readMessage(osgDB::ReaderWriter::ReadResult& result, const std::string& name)
{
    using Result = osgDB::ReaderWriter::ReadResult;
    std::string reason = result.message();
    if (result.status() == Result::FILE_NOT_FOUND) reason = "no such file";
    if (result.status() == Result::FILE_NOT_HANDLED || result.status() == Result::NOT_IMPLEMENTED)
        reason = "no plugin of OpenSceneGraph reads this kind of file";
    if (reason.empty()) reason = "can't be read";
    return reason.rfind(name + ": ", 0) == 0 ? reason.substr(name.size() + 2) : reason;
}

}  // namespace osgEnvLight
