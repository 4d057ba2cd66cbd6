// SPDX-License-Identifier: MIT
#include "Statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <nlohmann/json.hpp>

#include "glsl.h"

namespace
{

using osgEnvLight::LightFile;
using osgEnvLight::RadianceMap;

const int blockColumns = 256;  // blocks of the map: 1.4 degrees
const int normals = 256;

// Flux times direction, of each channel: what a surface that all of it shines on receives.
using Sender = std::array<osg::Vec3d, 3>;

void add(Sender& sender, const osg::Vec3d& direction, const osg::Vec3d& flux)
{
    for (int c = 0; c < 3; ++c) sender[size_t(c)] += direction * flux[c];
}

std::vector<Sender> sendersOf(const osgEnvLight::LightList& lights)
{
    std::vector<Sender> senders(lights.size());
    for (size_t i = 0; i < lights.size(); ++i) add(senders[i], lights[i].direction, lights[i].flux);
    return senders;
}

// The map in blocks: exact but for normals whose horizon crosses a block.
std::vector<Sender> sendersOf(const RadianceMap& map)
{
    const int size = std::max(1, map.width / blockColumns);
    const int columns = (map.width + size - 1) / size;
    std::vector<Sender> senders(size_t(columns) * size_t((map.height + size - 1) / size));
    for (int y = 0; y < map.height; ++y) {
        const double solidAngle = glsl::latlongTexelSolidAngle(y, glsl::vec2(map.width, map.height));
        for (int x = 0; x < map.width; ++x) {
            const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2((x + 0.5) / map.width, (y + 0.5) / map.height));
            const float* t = map.texel(x, y);
            add(senders[size_t(y / size) * size_t(columns) + size_t(x / size)], osg::Vec3d(d.x, d.y, d.z),
                osg::Vec3d(t[0], t[1], t[2]) * solidAngle);
        }
    }
    return senders;
}

osg::Vec3d irradiance(const std::vector<Sender>& senders, const osg::Vec3d& normal)
{
    osg::Vec3d sum;
    for (const Sender& s : senders)
        for (int c = 0; c < 3; ++c) sum[c] += std::max(s[size_t(c)] * normal, 0.0);
    return sum;
}

// sqrt(sum |E' - E|^2 / sum |E|^2) over evenly spread normals and the channels (sampling.md 1, U).
double irradianceError(const osgEnvLight::LightList& lights, const RadianceMap& map)
{
    const std::vector<Sender> list = sendersOf(lights);
    const std::vector<Sender> truth = sendersOf(map);
    double difference = 0.0;
    double norm = 0.0;
    for (int i = 0; i < normals; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / normals;
        const double r = std::sqrt(1.0 - z * z);
        const double phi = i * glsl::PI * (3.0 - std::sqrt(5.0));
        const osg::Vec3d normal(r * std::cos(phi), r * std::sin(phi), z);
        const osg::Vec3d e = irradiance(truth, normal);
        difference += (irradiance(list, normal) - e).length2();
        norm += e.length2();
    }
    return norm > 0.0 ? std::sqrt(difference / norm) : 0.0;
}

// Of the channel that has the largest.
double relativeFluxError(const LightFile& file, const osg::Vec3d& flux)
{
    osg::Vec3d sum;
    for (const auto& l : file.lights) sum += l.flux;
    for (const auto& s : file.suns) sum += s.flux;
    double error = 0.0;
    for (int c = 0; c < 3; ++c)
        if (flux[c] > 0.0) error = std::max(error, std::abs(sum[c] / flux[c] - 1.0));
    return error;
}

}  // namespace

std::string Statistics::json(const RadianceMap& map, const RadianceMap& sampled, const LightFile& file) const
{
    nlohmann::ordered_json j;
    if (!(map.meanOfChannels() > 0.0)) j["black"] = true;
    j["requested"] = requested;
    j["count"] = file.lights.size();
    j["dropped"] = requested - file.lights.size();
    j["milliseconds"] = milliseconds;
    j["irradianceError"] = irradianceError(file.lights, sampled);
    j["fluxError"] = relativeFluxError(file, map.flux);
    j["flux"] = {map.flux[0], map.flux[1], map.flux[2]};
    j["mapSize"] = {map.width, map.height};
    j["rotationDeg"] = rotation;
    j["meanRadiance"] = map.mean;
    j["maximumRadiance"] = map.maximum;
    j["notFiniteTexels"] = map.notFinite;
    j["negativeTexels"] = map.negative;
    std::string text;
    for (const auto& [key, value] : j.items()) text += (text.empty() ? "\n    \"" : ",\n    \"") + key + "\": " + value.dump();
    return "{" + text + "\n  }";
}
