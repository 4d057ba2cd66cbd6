// SPDX-License-Identifier: MIT
// Any bytes: a scene description, a camera file and a list of lights are read, or refused with one message that names the file.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include <osgEnvLight/LightFile>
#include <osgEnvLight/SceneDescription>

namespace
{

void require(bool read, const std::string& error)
{
    if (read != error.empty()) std::abort();
    if (!read && error.rfind("fuzz: ", 0) != 0) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text(reinterpret_cast<const char*>(data), size);
    std::istringstream scene(text);
    std::string error;
    osgEnvLight::SceneDescription description;
    require(description.read(scene, "fuzz", error), error);

    std::istringstream camera(text);
    error.clear();
    osgEnvLight::HomeView view;
    require(osgEnvLight::readCamera(camera, "fuzz", view, error), error);

    std::istringstream list(text);
    error.clear();
    osgEnvLight::LightFile lights;
    require(osgEnvLight::readLights(list, "fuzz", lights, error), error);
    return 0;
}
