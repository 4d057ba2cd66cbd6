// SPDX-License-Identifier: MIT
#include "Statistics.h"

#include "HeadlessContext.h"

#include <osgDB/fstream>

#include <nlohmann/json.hpp>

bool Statistics::write(const std::string& fileName, const osgEnvLight::LitScene& lit, const HeadlessContext& context,
                       std::string& error) const
{
    nlohmann::ordered_json j;
    j["scene"] = scene;
    j["size"] = {width, height};
    j["renderer"] = context.renderer();
    j["version"] = context.version();
    j["frames"] = frames;
    j["firstFrameMilliseconds"] = firstFrame;
    j["lastFrameMilliseconds"] = lastFrame;
    if (lit.plan().runs("accumulate")) {
        const osgEnvLight::Average average = lit.average();
        j["average"] = {{"frames", average.frames}, {"lights", average.lights}};
        if (average.standardError >= 0.0) j["average"]["standardError"] = average.standardError;
    }
    j["textureBytes"] = lit.textureBytes();
    const osgEnvLight::Plan plan = lit.plan();
    for (const auto& r : plan.passes) {
        j["plan"].push_back({{"pass", r.pass}, {"runs", r.runs}, {"reason", r.reason}});
        if (r.cpu >= 0.0) j["passes"][r.pass]["cpuMilliseconds"] = r.cpu;
        if (r.gpu >= 0.0) j["passes"][r.pass]["gpuMilliseconds"] = r.gpu;
    }
    j["counts"] = {{"diffuseLights", plan.diffuseLights},
                   {"occlusionLights", plan.occlusionLights},
                   {"specularSamples", plan.runs("specular") ? lit.getSettings()->specularSamples : 0},
                   {"suns", plan.suns},
                   {"sunMapsDrawn", lit.drawnSunMaps()},
                   {"deferredDrawables", plan.surfaces.deferred},
                   {"forwardDrawables", plan.surfaces.forward}};
    for (const auto& p : osgEnvLight::Settings::table()) j["settings"][p.name] = p.getString(*lit.getSettings());
    osgDB::ofstream out(fileName.c_str());
    out << j.dump(2) << "\n";
    out.flush();
    if (out) return true;
    error = fileName + ": can't be written";
    return false;
}
