// SPDX-License-Identifier: MIT
#include "RenderCommand.h"

#include <osgDB/FileNameUtils>

#include <locale>
#include <sstream>

namespace
{

using osgEnvLight::MapLayout;
using osgEnvLight::Settings;

std::string quoted(const std::string& word)
{
    const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+=,:@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string result = "'";
    for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

std::string text(double number)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(9);
    out << number;
    return out.str();
}

std::string text(const osg::Vec3d& v)
{
    return text(v.x()) + "," + text(v.y()) + "," + text(v.z());
}

}  // namespace

std::string renderCommand(const osgEnvLight::LitScene& lit, const SceneOrigin& origin, const osgEnvLight::HomeView& view,
                          int width, int height)
{
    const osgEnvLight::EnvironmentMap& map = *lit.getEnvironmentMap();
    std::string command = "envlight-render " + quoted(origin.file);
    if (map.getMap() != origin.map) {
        command += " --env " + quoted(map.getMap());
        const MapLayout layout = map.getLayout();
        if (layout != MapLayout::AUTO) command += " --env-layout " + osgEnvLight::mapLayoutNames()[size_t(layout)];
    }
    command += " --env-rotation=" + text(map.getRotation()) + " --env-intensity=" + text(map.getIntensity());
    command += " --eye=" + text(view.eye) + " --target=" + text(view.target) + " --up=" + text(view.up);
    command += " --fovy " + text(view.fovy) + " --size " + std::to_string(width) + "x" + std::to_string(height);
    for (const Settings::Property& p : Settings::table()) {
        const bool programs = std::string(p.name) == "output" || std::string(p.name) == "regeneration";
        if (!programs && p.get(*lit.getSettings()) != p.get(*origin.settings))
            command += std::string(" --set ") + p.name + "=" + p.getString(*lit.getSettings());
    }
    return command + " -o " + quoted(osgDB::getStrippedName(origin.file) + ".png");
}
