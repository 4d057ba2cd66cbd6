// SPDX-License-Identifier: MIT
#include "base/ReadMessage.h"
#include <osgEnvLight/ModelCameras>
#include <osgEnvLight/SceneDescription>

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/fstream>

namespace
{

/** `scene.envlight`, a scene description; or `model.osgt.envlight` and `model.osgt.(studio.exr).envlight`, any model under
 * the sky or under the map in brackets.*/
class ReaderWriterEnvLight : public osgDB::ReaderWriter
{
  public:
    ReaderWriterEnvLight()
    {
        supportsExtension("envlight", "a scene description, or any model lit by an environment");
        supportsOption("strict", "refuse a map with NaN, Inf or negative radiance instead of repairing it");
    }

    const char* className() const override { return "osgEnvLight scene reader"; }

    ReadResult readObject(const std::string& file, const Options* options) const override { return readNode(file, options); }

    ReadResult readNode(const std::string& file, const Options* options) const override
    {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(file))) return ReadResult::FILE_NOT_HANDLED;
        std::string error;
        const bool described = !osgDB::findDataFile(file, options).empty();
        osg::ref_ptr<osg::Node> node = described ? readDescription(file, options, error) : readModel(file, options, error);
        return node ? ReadResult(node.get()) : ReadResult(error);
    }

    ReadResult readNode(std::istream& in, const Options* options) const override
    {
        std::string error;
        osgEnvLight::SceneDescription scene;
        osg::ref_ptr<osg::Node> node;
        if (scene.read(in, "stream", error)) node = scene.build(options, error);
        return node ? ReadResult(node.get()) : ReadResult(error);
    }

  private:
    static bool wantsStrict(const Options* options)
    {
        return options && options->getOptionString().find("strict") != std::string::npos;
    }

    static osg::ref_ptr<osg::Node> readDescription(const std::string& file, const Options* options, std::string& error)
    {
        osgEnvLight::SceneDescription scene;
        if (!scene.readFile(file, options, error)) return nullptr;
        scene.strict = scene.strict || wantsStrict(options);
        return scene.build(options, error);
    }

    static osg::ref_ptr<osg::Node> readModel(const std::string& file, const Options* options, std::string& error)
    {
        std::string model = osgDB::getNameLessExtension(file);
        std::string map;
        const size_t bracket = model.rfind(".(");
        if (!model.empty() && model.back() == ')' && bracket != std::string::npos) {
            map = model.substr(bracket + 2, model.size() - bracket - 3);
            model.resize(bracket);
        }
        if (osgDB::findDataFile(model, options).empty() && osgDB::getFileExtension(model).empty()) {
            error = file + ": no such file";
            return nullptr;
        }
        ReadResult read = osgDB::Registry::instance()->readNode(model, options);
        if (!read.validNode()) {
            const bool missing = osgDB::findDataFile(model, options).empty();
            error = file + ": the model '" + model + "': " + (missing ? "no such file" : osgEnvLight::readMessage(read, model));
            return nullptr;
        }
        osg::ref_ptr<osgEnvLight::LitScene> lit = new osgEnvLight::LitScene;
        lit->getEnvironmentMap()->setStrict(wantsStrict(options));
        if (!map.empty() && !lit->getEnvironmentMap()->load(map, options, error)) return nullptr;
        lit->addChild(read.getNode());
        if (const auto home = osgEnvLight::firstModelCamera(*lit)) lit->setHomeView(*home);
        return lit;
    }
};

}  // namespace

REGISTER_OSGPLUGIN(envlight, ReaderWriterEnvLight)
