// SPDX-License-Identifier: MIT
#include "node/SceneAreaLights.h"

#include "base/ReadMessage.h"
#include "surface/Emitter.h"

#include <osg/ImageStream>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <stdexcept>

namespace osgEnvLight
{

namespace
{

const double huge = 1e30;

osg::Vec3d point(const JsonValue& v)
{
    return v.vector(-huge, huge, "three numbers");
}

osg::Vec3d required(const JsonValue& v, const char* key)
{
    if (!v.has(key)) v.failMissing(key, "three numbers");
    return point(v[key]);
}

double radius(const JsonValue& v)
{
    const char* const expected = "a radius greater than 0";
    if (!v.has("radius")) v.failMissing("radius", expected);
    return v["radius"].number(1e-30, huge, expected);
}

// Its keys, beside those of every light.
void checkKeys(const JsonValue& v, std::vector<std::string> keys)
{
    const std::vector<std::string> common = {"shape", "name", "radiance", "flux", "twoSided", "visible"};
    keys.insert(keys.end(), common.begin(), common.end());
    v.object(keys, "a light");
}

osg::ref_ptr<osg::Vec3Array> vertices(const JsonValue& v)
{
    const std::string expected = "3 to " + std::to_string(AreaLight::mostVertices) + " points, each three numbers";
    if (!v.has("vertices")) v.failMissing("vertices", expected);
    const JsonValue list = v["vertices"];
    if (!list.get().is_array() || list.size() < 3 || list.size() > AreaLight::mostVertices) list.fail(expected);
    osg::ref_ptr<osg::Vec3Array> points = new osg::Vec3Array;
    for (size_t i = 0; i < list.size(); ++i) points->push_back(osg::Vec3(point(list.element(i))));
    return points;
}

void readShape(const JsonValue& v, AreaLight& light)
{
    const std::string shape = v.get().is_object() && v.has("shape") ? v["shape"].string() : std::string();
    if (shape == "rectangle") {
        checkKeys(v, {"center", "u", "v", "image"});
        light.setRectangle(required(v, "center"), required(v, "u"), required(v, "v"));
    } else if (shape == "disc") {
        checkKeys(v, {"center", "normal", "radius"});
        light.setDisc(required(v, "center"), required(v, "normal"), radius(v));
    } else if (shape == "sphere") {
        checkKeys(v, {"center", "radius"});
        light.setSphere(required(v, "center"), radius(v));
    } else if (shape == "polygon") {
        checkKeys(v, {"vertices"});
        light.setPolygon(*vertices(v));
    } else {
        v.fail("an object whose shape is \"rectangle\", \"disc\", \"sphere\" or \"polygon\"");
    }
}

osg::ref_ptr<AreaLight> readAreaLight(const JsonValue& v)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    readShape(v, *light);
    if (v.has("radiance") == v.has("flux")) v.fail("either radiance or flux");
    const char* const emission = v.has("flux") ? "flux" : "radiance";
    const osg::Vec3f value(v[emission].vector(0, 1e12, "three linear colour values in 0..1e12"));
    light->setEmission(v.has("flux") ? AreaLight::FLUX : AreaLight::RADIANCE, value);
    if (v.has("name")) light->setName(v["name"].string());
    if (v.has("twoSided")) light->setTwoSided(v["twoSided"].boolean());
    if (v.has("visible")) light->setVisible(v["visible"].boolean());
    Emitter placed;
    const std::string problem = placeEmitter(*light, osg::Matrixd(), placed);
    if (!problem.empty()) v.fail("a light that can be drawn", "one that " + problem);
    if (!v.has("image")) return light;
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->setFileName(v["image"].string());
    light->setImage(image);
    return light;
}

}  // namespace

std::vector<osg::ref_ptr<AreaLight>> readAreaLights(const JsonValue& list)
{
    if (!list.get().is_array()) list.fail("a list of lights");
    std::vector<osg::ref_ptr<AreaLight>> lights;
    for (size_t i = 0; i < list.size(); ++i) lights.push_back(readAreaLight(list.element(i)));
    return lights;
}

osg::ref_ptr<AreaLight> loadAreaLight(const AreaLight& light, const osgDB::Options* options, const std::string& file)
{
    const osg::ref_ptr<AreaLight> loaded = osg::clone(&light);
    if (!light.getImage()) return loaded;
    const std::string name = light.getImage()->getFileName(), at = file + ": key 'lights': '" + name + "': ";
    osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readImage(name, options);
    if (!result.validImage())
        throw std::runtime_error(at + (osgDB::findDataFile(name, options).empty() ? "no such file" : readMessage(result, name)));
    loaded->setImage(result.getImage());
    if (auto* video = dynamic_cast<osg::ImageStream*>(result.getImage())) video->play();
    Emitter placed;
    const std::string problem = placeEmitter(*loaded, osg::Matrixd(), placed);
    if (!problem.empty()) throw std::runtime_error(at + "the light " + problem);
    return loaded;
}

}  // namespace osgEnvLight
