// SPDX-License-Identifier: MIT
// envlight-lights: a map as a list of directional lights, for looking at and for other programs.
#include "CommandLine.h"
#include "ImageFile.h"
#include "LightPicture.h"
#include "PluginPath.h"
#include "Statistics.h"
#include "environment/DominantLight.h"

#include <osgEnvLight/LightSampler>

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>

#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace
{

using namespace osgEnvLight;

struct Arguments {
    std::string map;
    std::string layout = "auto";
    std::string sampler = "auto";
    unsigned count = 128;
    std::string suns = "auto";
    SampleOptions options;
    std::string weights = "auto";
    double rotation = 0.0;
    std::vector<std::string> outputs;
};

// What is written: directions as in the map, and what they are of.
struct Result {
    osg::ref_ptr<const RadianceMap> map;
    osg::ref_ptr<const RadianceMap> residual;
    LightFile file;
    Statistics statistics;
};

std::string samplerChoices()
{
    std::string list;
    for (const char* name : LightSampler::names()) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

bool isPicture(const std::string& name)
{
    return osgDB::getLowerCaseFileExtension(name) == "png";
}

std::string residualName(const std::string& name)
{
    return osgDB::getNameLessExtension(name) + ".residual.exr";
}

void checkOutputs(const Arguments& a)
{
    for (const std::string& name : a.outputs) {
        if (!isPicture(name) && osgDB::getLowerCaseFileExtension(name) != "json")
            throw BadArguments("-o is '" + name + "', expected a name ending in .json or .png");
        for (const std::string& written : {name, isPicture(name) ? name : residualName(name)})
            if (osgDB::fileExists(written) && osgDB::getRealPath(written) == osgDB::getRealPath(a.map))
                throw BadArguments("-o is '" + name + "', which would write over the map");
    }
}

// Not Option::within, which lets NaN pass.
void checkRange(const char* option, double value, double low, double high)
{
    if (value >= low && value <= high) return;
    std::ostringstream text;
    text << option << " is " << value << ", expected a number in " << low << ".." << high;
    throw BadArguments(text.str());
}

// How many at most.
unsigned sunsOf(const Arguments& a)
{
    if (a.suns == "off") return 0;
    if (a.suns == "auto") return std::numeric_limits<unsigned>::max();
    const bool digits = !a.suns.empty() && a.suns.find_first_not_of("0123456789") == std::string::npos;
    if (!digits || a.suns.size() > 6) throw BadArguments("--suns is '" + a.suns + "', expected auto, off or how many at most");
    return unsigned(std::stoul(a.suns));
}

SampleOptions::Weights weightsOf(const Arguments& a)
{
    if (a.weights == "auto") return SampleOptions::WEIGHTS_AUTO;
    if (a.weights == "on") return SampleOptions::WEIGHTS_ON;
    if (a.weights == "off") return SampleOptions::WEIGHTS_OFF;
    throw BadArguments("--weights is '" + a.weights + "', expected auto, on or off");
}

Result sampleMap(const Arguments& a)
{
    SampleOptions options = a.options;
    options.weights = weightsOf(a);
    const unsigned suns = sunsOf(a);
    const osg::ref_ptr<const LightSampler> sampler = LightSampler::create(a.sampler);
    if (!sampler) throw BadArguments("--sampler is '" + a.sampler + "', expected one of " + samplerChoices());
    MapLayout layout = MapLayout::AUTO;
    if (!mapLayoutFromName(a.layout, layout))
        throw BadArguments("--layout is '" + a.layout + "', expected one of " + mapLayoutChoices());

    osg::ref_ptr<EnvironmentMap> environment = new EnvironmentMap;
    environment->setLayout(layout);
    std::string error;
    if (!environment->load(a.map, nullptr, error)) throw std::runtime_error(error);
    Result r;
    r.map = environment->radiance(error);
    if (!r.map) throw std::runtime_error(error);
    const auto start = std::chrono::steady_clock::now();
    SunSplit split = splitSuns(*r.map, suns);
    r.residual = split.residual;
    r.file = {environment->getMap(), a.sampler, options.seed, sampler->sample(*r.residual, a.count, options), split.suns, ""};
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    r.statistics = {a.count, ms, a.rotation};
    return r;
}

// Counter-clockwise about +Z.
LightFile turned(LightFile file, double degrees)
{
    if (degrees == 0.0) return file;
    const double c = std::cos(osg::DegreesToRadians(degrees));
    const double s = std::sin(osg::DegreesToRadians(degrees));
    const auto turn = [c, s](osg::Vec3d& d) { d.set(c * d.x() - s * d.y(), s * d.x() + c * d.y(), d.z()); };
    for (DirectionalLight& l : file.lights) turn(l.direction);
    for (DominantLight& l : file.suns) turn(l.direction);
    return file;
}

void writeOutputs(const Arguments& a, const Result& r)
{
    LightFile file = turned(r.file, a.rotation);
    for (const std::string& name : a.outputs) {
        if (isPicture(name)) {
            writeImageFile(*lightPicture(*r.map, a.rotation, file), name);
            continue;
        }
        if (!file.suns.empty()) {
            writeImageFile(*r.residual->image, residualName(name));
            file.residual = osgDB::getSimpleFileName(residualName(name));
        }
        std::string error;
        if (!writeLightFile(name, file, r.statistics.json(*r.map, *r.residual, r.file), error)) throw std::runtime_error(error);
    }
}

void addOptions(CommandLine& line, Arguments& a)
{
    line.add("MAP", a.map, "environment map: a file, sky or studio").required();
    line.add("--sampler", a.sampler, samplerChoices() + "; default auto");
    line.add("--count", a.count, "how many lights; default 128").within(1, 65536);
    line.add("--suns", a.suns,
             "auto (default): small bright sources are cut from the map and listed apart; a number: that many at most; off");
    line.add("--seed", a.options.seed, "of samplers that place points; default 0");
    line.add("--rotation", a.rotation, "degrees that the directions are turned, counter-clockwise about +Z");
    line.add("--floor", a.options.floor, "uniform radiance, in units of the map's mean, that draws lights into dark parts");
    line.add("--weights", a.weights, "whether the lights are weighted to match the map's harmonics: auto (default), on, off");
    line.add("--layout", a.layout, "layout of the map where its shape does not say it: " + mapLayoutChoices());
    line.add("-o,--output", a.outputs, "OUT.json (the list) or OUT.png (the map with the lights on it); repeatable")
        .repeatable()
        .required();
}

int run(const Arguments& a)
{
    addPluginPath();
    checkOutputs(a);
    checkRange("--rotation", a.rotation, -1e6, 1e6);
    checkRange("--floor", a.options.floor, 0.0, 1e6);
    writeOutputs(a, sampleMap(a));
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    CommandLine line("envlight-lights", "Writes a high-dynamic-range environment map as a list of directional lights.");
    addOptions(line, arguments);
    return line.run(argc, argv, [&] { return run(arguments); });
}
