// SPDX-License-Identifier: MIT
#include "Scene.h"

#include <osg/CullFace>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osgDB/Options>
#include <osgDB/WriteFile>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace scenes
{

Material lambert(const osg::Vec3d& diffuse)
{
    Material material;
    material.color = diffuse;
    return material;
}

Material phong(const osg::Vec3d& diffuse, double specular, double exponent)
{
    Material material;
    material.brdf = Brdf::Phong;
    material.color = diffuse;
    material.specular.set(specular, specular, specular);
    material.exponent = exponent;
    return material;
}

Material cookTorrance(const osg::Vec3d& baseColor, double metalness, double roughness)
{
    Material material;
    material.brdf = Brdf::CookTorrance;
    material.color = baseColor;
    material.metalness = metalness;
    material.roughness = roughness;
    return material;
}

Material glow(const osg::Vec3d& emission)
{
    Material m = lambert({});
    m.emission = emission;
    return m;
}

namespace
{

// As osg::Material has colours: sRGB (IEC 61966-2-1).
osg::Vec3d displayed(const osg::Vec3d& linear)
{
    osg::Vec3d c;
    for (int k = 0; k < 3; ++k)
        c[k] = linear[k] <= 0.0031308 ? 12.92 * linear[k] : 1.055 * std::pow(linear[k], 1.0 / 2.4) - 0.055;
    return c;
}

// The nearest that fixed-function light comes. A metal keeps part of its colour as diffuse, for there it has nothing to reflect.
osg::ref_ptr<osg::Material> fixedFunction(const std::string& name, const Material& material)
{
    constexpr double dielectric = 0.04, metalDiffuse = 0.3, metalSpecular = 0.65, largestShininess = 128;
    osg::Vec3d diffuse = material.color, specular = material.specular;
    double shininess = material.exponent;
    if (material.brdf == Brdf::CookTorrance) {
        const double alpha = material.roughness * material.roughness;
        diffuse = material.color * (metalDiffuse * material.metalness + (1 - dielectric) * (1 - material.metalness));
        const double plain = dielectric * (1 - material.metalness);
        specular = material.color * (metalSpecular * material.metalness) + osg::Vec3d(plain, plain, plain);
        shininess = 2 / (alpha * alpha) - 2;
    }
    diffuse = displayed(diffuse);
    specular = displayed(specular);
    osg::ref_ptr<osg::Material> result = new osg::Material;
    result->setName(name);
    result->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(diffuse, 1));
    const double brightest = std::max({material.emission[0], material.emission[1], material.emission[2], 1.0});
    result->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(displayed(material.emission / brightest), 1));
    result->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(diffuse, static_cast<float>(material.opacity)));
    result->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(specular, 1));
    result->setShininess(osg::Material::FRONT_AND_BACK, static_cast<float>(std::min(shininess, largestShininess)));
    return result;
}

std::string json(const osg::Vec3d& v)
{
    std::ostringstream text;
    text << '[' << v.x() << ", " << v.y() << ", " << v.z() << ']';
    return text.str();
}

std::string json(const Material& m)
{
    std::ostringstream text;
    if (m.emission != osg::Vec3d())
        text << R"({ "brdf": "lambert", "diffuse": )" << json(m.color) << R"(, "emission": )" << json(m.emission) << " }";
    else if (m.brdf == Brdf::Lambert)
        text << R"({ "brdf": "lambert", "diffuse": )" << json(m.color) << " }";
    else if (m.brdf == Brdf::Phong)
        text << R"({ "brdf": "phong", "diffuse": )" << json(m.color) << R"(, "specular": )" << json(m.specular)
             << R"(, "exponent": )" << m.exponent << " }";
    else
        text << R"({ "brdf": "cook-torrance", "baseColor": )" << json(m.color) << R"(, "metalness": )" << m.metalness
             << R"(, "roughness": )" << m.roughness << " }";
    return text.str();
}

}  // namespace

Scene::Scene(const std::string& name, const Environment& environment, const Camera& camera,
             const std::map<std::string, Material>& materials)
    : _name(name), _environment(environment), _camera(camera), _materials(materials), _root(new osg::Group)
{
    _root->setName(name);
}

osg::StateSet* Scene::stateSet(const std::string& material)
{
    osg::ref_ptr<osg::StateSet>& state = _states[material];
    if (!state) {
        state = new osg::StateSet;
        const Material& look = _materials.at(material);
        state->setAttributeAndModes(fixedFunction(material, look));
        if (look.opacity < 1) {
            state->setMode(GL_BLEND, osg::StateAttribute::ON);
            state->setAttributeAndModes(new osg::CullFace);
            state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        }
    }
    return state;
}

void Scene::add(osg::Node* model, const std::string& material, const osg::Matrixd& placement)
{
    osg::ref_ptr<osg::Group> part = placement.isIdentity() ? new osg::Group : new osg::MatrixTransform(placement);
    part->setName(material);
    part->setStateSet(stateSet(material));
    part->addChild(model);
    _root->addChild(part);
}

void Scene::write(const std::string& folder) const
{
    const std::string model = _name + ".osgb", path = folder + "/" + _name;
    osg::ref_ptr<osgDB::Options> options = new osgDB::Options("WriteImageHint=IncludeData");
    if (!osgDB::writeNodeFile(*_root, folder + "/" + model, options)) throw std::runtime_error("cannot write " + path + ".osgb");

    for (const auto& [name, image] : _images)
        if (!osgDB::writeImageFile(*image, folder + "/" + name)) throw std::runtime_error("cannot write " + folder + "/" + name);

    std::ofstream file(path + ".envlight");
    file << "{\n    \"model\": \"" << model << "\",\n    \"environment\": { \"map\": \"" << _environment.map
         << "\", \"rotation\": " << _environment.rotation << ", \"intensity\": " << _environment.intensity
         << " },\n    \"camera\": { \"eye\": " << json(_camera.eye) << ", \"target\": " << json(_camera.target)
         << ", \"up\": [0, 0, 1], \"fovy\": " << _camera.fovy
         << " },\n    \"settings\": { \"exposureBase\": \"map\", \"exposure\": " << _environment.exposure;
    for (const auto& [name, value] : _settings) file << ", \"" << name << "\": " << value;
    file << " },\n    \"materials\": {";
    const char* separator = "\n";
    for (const auto& [name, material] : _materials) {
        if (material.opacity < 1) continue;  // only its osg::Material can say so
        file << separator << "        \"" << name << "\": " << json(material);
        separator = ",\n";
    }
    file << "\n    }";
    separator = ",\n    \"lights\": [\n        ";
    for (const std::string& light : _lights) {
        file << separator << light;
        separator = ",\n        ";
    }
    file << (_lights.empty() ? "\n}\n" : "\n    ]\n}\n");
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path + ".envlight");
}

}  // namespace scenes
