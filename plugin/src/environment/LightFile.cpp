// SPDX-License-Identifier: MIT
#include <osgEnvLight/LightFile>

#include <osgDB/FileUtils>
#include <osgDB/fstream>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/JsonValue.h"

namespace osgEnvLight
{

namespace
{

using nlohmann::json;

const size_t mostLights = 65536;
const double largest = std::numeric_limits<double>::max();
const double unitTolerance = 1e-14;  // of the squared length: a direction that was made unit is left as it is

// Text that is not UTF-8 is no reason to write nothing.
std::string quoted(const std::string& text)
{
    return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string text(double x)
{
    return json(x).dump();
}

std::string text(const osg::Vec3d& v)
{
    return "[" + text(v[0]) + ", " + text(v[1]) + ", " + text(v[2]) + "]";
}

std::string text(const DirectionalLight& light)
{
    return "{\"direction\": " + text(light.direction) + ", \"flux\": " + text(light.flux) + "}";
}

std::string text(const DominantLight& sun)
{
    return "{\"direction\": " + text(sun.direction) + ", \"flux\": " + text(sun.flux) +
           ", \"radiusDeg\": " + text(osg::RadiansToDegrees(sun.radius)) + "}";
}

// One line for each light: a file of thousands can be read by eye, and compared.
template <class List>
std::string listText(const List& lights)
{
    std::string all;
    for (const auto& light : lights) all += (all.empty() ? "\n    " : ",\n    ") + text(light);
    return "[" + all + (all.empty() ? "]" : "\n  ]");
}

osg::Vec3d readDirection(const JsonValue& v)
{
    osg::Vec3d d = v.vector(-largest, largest, "three numbers");
    if (std::abs(d.length2() - 1.0) <= unitTolerance) return d;
    const double most = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    if (!(most > 0.0)) v.fail("a direction, of any length but zero");
    for (int i = 0; i < 3; ++i) d[i] /= most;  // squares neither overflow nor vanish
    d.normalize();
    return d;
}

DirectionalLight readLight(const JsonValue& v, const std::vector<std::string>& keys, const char* what)
{
    v.object(keys, what);
    for (const char* key : {"direction", "flux"})
        if (!v.has(key)) v.fail(what);
    return {readDirection(v["direction"]), v["flux"].vector(0.0, largest, "three numbers >= 0")};
}

void readList(const JsonValue& v, LightList& lights)
{
    const char* const what = "an object with direction and flux";
    for (size_t i = 0; i < v.size(); ++i) lights.push_back(readLight(v.element(i), {"direction", "flux"}, what));
}

void readList(const JsonValue& v, DominantLights& suns)
{
    const char* const what = "an object with direction, flux and, if it is not a point, radiusDeg";
    for (size_t i = 0; i < v.size(); ++i) {
        const JsonValue item = v.element(i);
        const DirectionalLight light = readLight(item, {"direction", "flux", "radiusDeg"}, what);
        double degrees = 0.0;
        if (item.has("radiusDeg")) degrees = item["radiusDeg"].number(0.0, 90.0, "an angle in 0..90 degrees");
        suns.push_back({light.direction, light.flux, osg::DegreesToRadians(degrees)});
    }
}

template <class List>
void readMember(const JsonValue& v, const char* key, List& list)
{
    if (!v.has(key)) return;
    const JsonValue member = v[key];
    if (!member.get().is_array()) member.fail("a list");
    if (member.size() > mostLights)
        member.fail("at most " + std::to_string(mostLights) + " lights", std::to_string(member.size()));
    readList(member, list);
}

unsigned readSeed(const JsonValue& v)
{
    const unsigned long most = std::numeric_limits<unsigned>::max();
    if (!v.get().is_number_unsigned() || v.get().get<unsigned long>() > most)
        v.fail("a whole number in 0.." + std::to_string(most));
    return v.get().get<unsigned>();
}

}  // namespace

std::string writeLights(const LightFile& file, const std::string& stats)
{
    std::string all = "{\n";
    const auto add = [&all](const char* key, const std::string& value) {
        all += (all.size() > 2 ? ",\n  \"" : "  \"") + std::string(key) + "\": " + value;
    };
    if (!file.map.empty()) add("map", quoted(file.map));
    if (!file.sampler.empty()) add("sampler", quoted(file.sampler));
    add("seed", std::to_string(file.seed));
    add("lights", listText(file.lights));
    add("suns", listText(file.suns));
    if (!file.residual.empty()) add("residual", quoted(file.residual));
    if (!stats.empty()) add("stats", stats);
    return all + "\n}\n";
}

bool writeLightFile(const std::string& fileName, const LightFile& file, const std::string& stats, std::string& error)
{
    const std::string all = writeLights(file, stats);
    osgDB::ofstream out(fileName.c_str(), std::ios::binary);
    out << all << std::flush;
    if (out) return true;
    error = fileName + ": can't be written";
    return false;
}

bool readLights(std::istream& in, const std::string& name, LightFile& result, std::string& error)
try {
    const json j = parseJson(in, name);
    const JsonValue v(j, name, "");
    v.object({"map", "sampler", "seed", "lights", "suns", "residual", "stats"}, "an object with lights or suns");
    if (!v.has("lights") && !v.has("suns")) v.fail("an object with lights or suns");
    LightFile file;
    if (v.has("map")) file.map = v["map"].string();
    if (v.has("sampler")) file.sampler = v["sampler"].string();
    if (v.has("seed")) file.seed = readSeed(v["seed"]);
    readMember(v, "lights", file.lights);
    readMember(v, "suns", file.suns);
    if (v.has("residual")) file.residual = v["residual"].string();
    if (v.has("stats") && !v["stats"].get().is_object()) v["stats"].fail("an object");
    result = std::move(file);
    return true;
} catch (const std::exception& e) {
    error = e.what();
    return false;
}

bool readLightFile(const std::string& fileName, LightFile& result, std::string& error)
{
    if (osgDB::fileType(fileName) != osgDB::REGULAR_FILE) {
        error = fileName + ": " + (osgDB::fileExists(fileName) ? "not a file" : "no such file");
        return false;
    }
    osgDB::ifstream in(fileName.c_str(), std::ios::binary);
    return readLights(in, fileName, result, error);
}

}  // namespace osgEnvLight
