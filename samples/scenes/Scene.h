// SPDX-License-Identifier: MIT
// A scene in the making: parts under named materials, an environment and a camera, written as NAME.osgb and NAME.envlight.
#pragma once

#include "Mesh.h"

#include <osg/Group>
#include <osg/Image>

#include <map>
#include <string>

namespace scenes
{

enum class Brdf { Lambert, Phong, CookTorrance };

struct Material {
    Brdf brdf = Brdf::Lambert;
    osg::Vec3d color;  ///< linear: the diffuse reflectance, or the base colour of Cook-Torrance
    osg::Vec3d specular;
    double exponent = 0;
    double metalness = 0;
    double roughness = 1;
    double opacity = 1;
    osg::Vec3d emission = {};  ///< linear
};

Material lambert(const osg::Vec3d& diffuse);
Material phong(const osg::Vec3d& diffuse, double specular, double exponent);
Material cookTorrance(const osg::Vec3d& baseColor, double metalness, double roughness);
/// Black but for what it emits.
Material glow(const osg::Vec3d& emission);

struct Environment {
    std::string map;
    double rotation;
    double intensity;
    double exposure;  // stops, beyond what the map asks for
};

struct Camera {
    osg::Vec3d eye;
    osg::Vec3d target;
    double fovy;
};

class Scene
{
  public:
    Scene(const std::string& name, const Environment& environment, const Camera& camera,
          const std::map<std::string, Material>& materials);

    osg::Group* root() { return _root; }

    /// The state of a material of the table, with an osg::Material of that name for those who do not read the .envlight file.
    osg::StateSet* stateSet(const std::string& material);

    void add(const Mesh& mesh, const std::string& material) { add(mesh.geometry(), material, osg::Matrixd()); }
    void add(osg::Node* model, const std::string& material, const osg::Matrixd& placement);

    /// An area light, as an entry of "lights" in the .envlight file.
    void addLight(const std::string& description) { _lights.push_back(description); }

    /// A setting of the .envlight file.
    void set(const std::string& name, int value) { _settings[name] = value; }

    /// An image file beside the .envlight file, for lights.
    void addImage(const std::string& fileName, osg::Image* image) { _images[fileName] = image; }

    /// Throws std::runtime_error when a file cannot be written.
    void write(const std::string& folder) const;

  private:
    std::string _name;
    Environment _environment;
    Camera _camera;
    std::map<std::string, Material> _materials;
    std::map<std::string, osg::ref_ptr<osg::StateSet>> _states;
    std::vector<std::string> _lights;
    std::map<std::string, int> _settings;
    std::map<std::string, osg::ref_ptr<osg::Image>> _images;
    osg::ref_ptr<osg::Group> _root;
};

Scene chess();
Scene atrium();
Scene cornell();
Scene livingRoom();
Scene street();
Scene swing();
Scene materialSpheres();

}  // namespace scenes
