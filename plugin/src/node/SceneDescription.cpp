// SPDX-License-Identifier: MIT
#include <osgEnvLight/ModelCameras>
#include <osgEnvLight/SceneDescription>

#include "base/ReadMessage.h"
#include "node/SceneAreaLights.h"
#include "node/SceneMaterials.h"

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/fstream>

#include <stdexcept>

#include "base/JsonValue.h"

namespace osgEnvLight
{

namespace
{

using nlohmann::json;
using Value = JsonValue;

const double huge = 1e30;

HomeView readView(const Value& v)
{
    v.object({"eye", "target", "up", "fovy"}, "an object with eye and target");
    for (const char* key : {"eye", "target"})
        if (!v.has(key)) v.fail("an object with eye and target");
    HomeView c;
    c.eye = v["eye"].vector(-huge, huge, "three numbers");
    c.target = v["target"].vector(-huge, huge, "three numbers");
    if (v.has("up")) c.up = v["up"].vector(-huge, huge, "three numbers");
    if (v.has("fovy")) c.fovy = v["fovy"].number(0.01, 179.0, "an angle in 0.01..179 degrees");
    const osg::Vec3d forward = c.target - c.eye;
    if (!((forward ^ c.up).length() > 1e-9 * forward.length() * c.up.length()))
        v.fail("eye and target apart, and up not along the view");
    return c;
}

void readEnvironment(const Value& v, SceneDescription& scene)
{
    v.object({"map", "layout", "rotation", "intensity", "strict", "lights"}, "an object with map");
    if (v.has("map")) scene.map = v["map"].string();
    if (v.has("layout") && !mapLayoutFromName(v["layout"].string(), scene.layout))
        v["layout"].fail("one of " + mapLayoutChoices());
    if (v.has("rotation")) scene.rotation = v["rotation"].number(-1e6, 1e6, "an angle in degrees");
    if (v.has("intensity")) scene.intensity = v["intensity"].number(0, 1e12, "a factor in 0..1e12");
    if (v.has("strict")) scene.strict = v["strict"].boolean();
    if (v.has("lights")) scene.lights = v["lights"].string();
}

void readSceneCamera(const Value& v, SceneDescription& scene)
{
    if (v.get() == "") v.fail("an object with eye and target, or the name of a camera");
    if (v.get().is_string())
        scene.cameraName = v.string();
    else
        scene.camera = readView(v);
}

/** Where a scene is seen from at first: as described, else by the model's first camera, if it has one. */
void setHome(LitScene& lit, const SceneDescription& scene)
try {
    if (scene.camera)
        lit.setHomeView(*scene.camera);
    else if (!scene.cameraName.empty())
        lit.setHomeView(modelCamera(lit, scene.cameraName));
    else if (const auto first = firstModelCamera(lit))
        lit.setHomeView(*first);
} catch (const std::exception& e) {
    throw std::runtime_error(scene.fileName + ": key 'camera': " + e.what());
}

std::string settingText(const Value& v)
{
    if (v.get().is_boolean()) return v.boolean() ? "on" : "off";
    if (v.get().is_string()) return v.string();
    if (v.get().is_number()) return v.get().dump();  // JSON's numbers do not depend on the locale
    v.fail("a number, a string or true or false");
}

void readSettings(const Value& v, const std::string& file, SceneDescription& scene)
{
    if (!v.get().is_object()) v.fail("an object");
    osg::ref_ptr<Settings> trial = new Settings;
    const auto read = [&](const std::string& key) {
        const std::string text = settingText(v[key]);
        std::string error;
        if (!trial->set(key, text, error)) throw std::runtime_error(file + ": key 'settings." + key + "': " + error);
        scene.settings.emplace_back(key, text);
    };
    if (v.has("preset")) read("preset");  // first: the others are on top of it
    for (const auto& [key, value] : v.get().items())
        if (key != "preset") read(key);
}

void readModels(const Value& v, SceneDescription& scene)
{
    if (v.has("model")) scene.models.push_back(v["model"].string());
    if (v.has("models")) {
        const Value list = v["models"];
        if (!list.get().is_array()) list.fail("a list of file names");
        for (const json& item : list.get()) {
            if (!item.is_string()) list.fail("a list of file names");
            scene.models.push_back(item.get<std::string>());
        }
    }
    if (scene.models.empty()) v.fail("\"model\": \"file\" or \"models\": [\"file\", ...]");
}

osg::ref_ptr<osg::Node> loadModel(const std::string& name, const osgDB::Options* options, const std::string& file)
{
    osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readNode(name, options);
    if (result.validNode()) return result.getNode();
    const bool missing = osgDB::findDataFile(name, options).empty();
    throw std::runtime_error(file + ": key 'model': '" + name + "': " + (missing ? "no such file" : readMessage(result, name)));
}

// A camera object anywhere: the file itself, or its key "camera".
HomeView cameraOf(const json& j, const std::string& name)
{
    const Value v(j, name, "");
    return readView(j.is_object() && v.has("camera") ? v["camera"] : v);
}

}  // namespace

bool readCamera(std::istream& in, const std::string& name, HomeView& result, std::string& error)
try {
    result = cameraOf(parseJson(in, name), name);
    return true;
} catch (const std::exception& e) {
    error = e.what();
    return false;
}

bool SceneDescription::read(std::istream& in, const std::string& name, std::string& error)
try {
    SceneDescription scene;
    scene.fileName = name;
    const json j = parseJson(in, name);
    const Value v(j, name, "");
    v.object({"model", "models", "environment", "camera", "materials", "settings", "lights"}, "an object");
    readModels(v, scene);
    if (v.has("environment")) readEnvironment(v["environment"], scene);
    if (v.has("camera")) readSceneCamera(v["camera"], scene);
    if (v.has("materials")) {
        const Value table = v["materials"];
        if (!table.get().is_object()) table.fail("an object of materials by name");
        for (const auto& [key, value] : table.get().items()) scene.materials.push_back(readMaterial(table[key], key));
    }
    if (v.has("settings")) readSettings(v["settings"], name, scene);
    if (v.has("lights")) scene.areaLights = readAreaLights(v["lights"]);
    *this = scene;
    return true;
} catch (const std::exception& e) {
    error = e.what();
    return false;
}

bool readCameras(std::istream& in, const std::string& name, std::vector<HomeView>& result, std::string& error)
try {
    const json j = parseJson(in, name);
    const Value list(j, name, "");
    if (!j.is_array() || j.empty()) list.fail("a list of cameras");
    std::vector<HomeView> cameras;
    for (size_t i = 0; i < list.size(); ++i) cameras.push_back(readView(list.element(i)));
    result = std::move(cameras);
    return true;
} catch (const std::exception& e) {
    error = e.what();
    return false;
}

bool SceneDescription::readFile(const std::string& name, const osgDB::Options* options, std::string& error)
{
    const std::string path = osgDB::findDataFile(name, options);
    if (path.empty() || osgDB::fileType(path) != osgDB::REGULAR_FILE) {
        error = name + ": " + (path.empty() ? "no such file" : "not a file");
        return false;
    }
    osgDB::ifstream in(path.c_str(), std::ios::binary);
    return read(in, path, error);
}

osg::ref_ptr<LitScene> SceneDescription::build(const osgDB::Options* options, std::string& error) const
try {
    osg::ref_ptr<osgDB::Options> local = options ? options->cloneOptions() : new osgDB::Options;
    local->getDatabasePathList().push_front(osgDB::getFilePath(osgDB::getRealPath(fileName)));
    osg::ref_ptr<LitScene> lit = new LitScene;
    for (const std::string& m : models) lit->addChild(loadModel(m, local.get(), fileName));
    setMaterials(*lit, materials, fileName);
    for (const osg::ref_ptr<AreaLight>& light : areaLights) lit->addChild(loadAreaLight(*light, local.get(), fileName));
    EnvironmentMap& environment = *lit->getEnvironmentMap();
    environment.setLayout(layout);
    environment.setStrict(strict);
    environment.setRotation(rotation);
    environment.setIntensity(intensity);
    if (!environment.load(map, local.get(), error)) throw std::runtime_error(fileName + ": key 'environment.map': " + error);
    if (!lights.empty() && !environment.loadLights(lights, local.get(), error))
        throw std::runtime_error(fileName + ": key 'environment.lights': " + error);
    for (const auto& [name, value] : settings)
        if (!lit->getSettings()->set(name, value, error)) throw std::runtime_error(fileName + ": " + error);
    setHome(*lit, *this);
    return lit;
} catch (const std::exception& e) {
    error = e.what();
    return nullptr;
}

}  // namespace osgEnvLight
