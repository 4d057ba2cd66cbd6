// SPDX-License-Identifier: MIT
#include "Hardware.h"

#include <osg/Version>

#include <ctime>
#include <fstream>
#include <thread>

#include <sys/utsname.h>

namespace tradeoff
{

namespace
{

std::string processor()
{
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown";
}

bool isSoftware(const std::string& renderer)
{
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR", "Software"})
        if (renderer.find(name) != std::string::npos) return true;
    return false;
}

}  // namespace

Texts describeHardware(const HeadlessContext& context)
{
    utsname system{};
    uname(&system);
    const std::string renderer = context.renderer();
    return {{"renderer", renderer},
            {"kind", isSoftware(renderer) ? "software: the CPU draws" : "hardware"},
            {"OpenGL and driver", context.version()},
            {"processor", processor()},
            {"cores", std::to_string(std::thread::hardware_concurrency())},
            {"system", std::string(system.sysname) + " " + system.release + " " + system.machine},
            {"OpenSceneGraph", osgGetVersion()}};
}

std::string today()
{
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", &utc);
    return text;
}

}  // namespace tradeoff
