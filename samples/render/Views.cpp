// SPDX-License-Identifier: MIT
#include "Views.h"

#include <osgEnvLight/SceneDescription>

#include <osg/Math>
#include <osg/Quat>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/fstream>

#include <cstdio>

void Views::addTo(CommandLine& line)
{
    line.add("--cameras", camerasFile, "a picture from each camera of a JSON list; their numbers follow the output's name");
    line.add("--turntable", turntable, "so many pictures of a turn about what the camera looks at").within(1, 9999);
    line.add("--part", part, "K/N: of the pictures only the K-th and each N-th from there, for jobs side by side");
    line.addFlag("--resume", resumes, "leave pictures that are there already");
}

std::vector<osgEnvLight::HomeView> Views::of(osgEnvLight::LitScene& lit, const SceneOptions& scene) const
{
    std::vector<osgEnvLight::HomeView> views;
    if (!camerasFile.empty()) {
        if (turntable > 0) throw BadArguments("--cameras and --turntable exclude each other");
        if (!scene.camera.empty() || !scene.eye.empty()) throw BadArguments("--cameras excludes --camera and --eye");
        std::string error = camerasFile + ": can't be read";
        osgDB::ifstream in(camerasFile.c_str(), std::ios::binary);
        if (!in || !osgEnvLight::readCameras(in, camerasFile, views, error)) throw std::runtime_error(error);
        return views;
    }
    const osgEnvLight::HomeView first = scene.view(lit);
    for (int i = 0; i < std::max(turntable, 1); ++i) {
        osgEnvLight::HomeView view = first;
        const osg::Quat turn(2.0 * osg::PI * i / std::max(turntable, 1), first.up);
        view.eye = first.target + turn * (first.eye - first.target);
        views.push_back(view);
    }
    return views;
}

bool Views::makes(size_t index, const std::string& file) const
{
    unsigned own = 1, all = 1;
    char rest = 0;
    if (!part.empty() && (std::sscanf(part.c_str(), "%u/%u%c", &own, &all, &rest) != 2 || own < 1 || own > all))
        throw BadArguments("--part is '" + part + "', expected K/N with K from 1 to N");
    return index % all == own - 1 && !(resumes && osgDB::fileExists(file));
}

std::string numbered(const std::string& output, size_t index)
{
    char number[32];
    std::snprintf(number, sizeof(number), "-%04zu", index + 1);
    return osgDB::getNameLessExtension(output) + number + "." + osgDB::getFileExtension(output);
}
