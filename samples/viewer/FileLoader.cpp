// SPDX-License-Identifier: MIT
#include "FileLoader.h"

#include "base/ReadMessage.h"
#include <osgEnvLight/ModelCameras>

#include <osgDB/FileUtils>
#include <osgDB/Registry>

namespace
{

using osgDB::ReaderWriter;
using osgEnvLight::EnvironmentMap;
using osgEnvLight::LitScene;

void replaceChildren(LitScene& lit, osg::Group& source)
{
    lit.removeChildren(0, lit.getNumChildren());
    for (unsigned i = 0; i < source.getNumChildren(); ++i) lit.addChild(source.getChild(i));
}

// A map of its own, so that the former one can come back.
bool loadMap(const std::string& name, LitScene& lit, std::string& error)
{
    osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap;
    map->setRotation(lit.getEnvironmentMap()->getRotation());
    map->setIntensity(lit.getEnvironmentMap()->getIntensity());
    if (!map->load(name, nullptr, error) || !map->radiance(error)) return false;
    lit.setEnvironmentMap(map);
    return true;
}

// Whether a plugin knows this kind of file, and it was at fault.
bool isFaulty(const ReaderWriter::ReadResult& result)
{
    return result.status() == ReaderWriter::ReadResult::ERROR_IN_READING_FILE;
}

bool isImage(const std::string& name)
{
    const ReaderWriter::ReadResult result = osgDB::Registry::instance()->readImage(name, nullptr);
    return result.success() || isFaulty(result);
}

}  // namespace

LoadedFile loadFile(const std::string& name, LitScene& lit)
{
    LoadedFile loaded;
    if (osgDB::fileType(name) != osgDB::REGULAR_FILE) {
        loaded.error = name + (osgDB::fileExists(name) ? ": not a file" : ": no such file");
        return loaded;
    }
    ReaderWriter::ReadResult result = osgDB::Registry::instance()->readNode(name, nullptr);
    if (auto* scene = dynamic_cast<LitScene*>(result.getNode())) {
        replaceChildren(lit, *scene);
        lit.setStateSet(scene->getStateSet());
        lit.setEnvironmentMap(scene->getEnvironmentMap());
        lit.setSettings(scene->getSettings());
        loaded.homeView = scene->getHomeView();
        loaded.kind = Loaded::SCENE;
    } else if (result.validNode()) {
        const osg::ref_ptr<osg::Group> model = new osg::Group;
        model->addChild(result.getNode());
        replaceChildren(lit, *model);
        loaded.homeView = osgEnvLight::firstModelCamera(lit);
        loaded.kind = Loaded::MODEL;
    } else if (loadMap(name, lit, loaded.error)) {
        loaded.kind = Loaded::MAP;
    } else if (isFaulty(result)) {
        loaded.error = name + ": " + osgEnvLight::readMessage(result, name);
    } else if (!isImage(name)) {
        loaded.error = name + ": neither a model nor an environment map that OpenSceneGraph reads";
    }
    return loaded;
}
