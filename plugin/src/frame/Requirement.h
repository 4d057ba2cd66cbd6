/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <string>

namespace osgEnvLight
{

/** Whether a view needs something, and why or why not, in words. */
struct Requirement {
    bool needed = true;
    std::string reason;

    /** Not needed if the condition holds: of several, the first that does gives the reason. */
    Requirement& unless(bool condition, const std::string& why)
    {
        if (condition && needed) {
            needed = false;
            reason = why;
        }
        return *this;
    }
    /** The reason of what is needed. */
    Requirement& because(const std::string& why)
    {
        if (needed) reason = why;
        return *this;
    }
};

}  // namespace osgEnvLight
