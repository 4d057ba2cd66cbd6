// SPDX-License-Identifier: MIT
#include <osgEnvLight/EnvironmentMap>

#include <osg/Notify>
#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

namespace
{

using osgEnvLight::EnvironmentMap;

// A map with a name is written by its name, one that an application made, with its pixels.
bool checkMap(const EnvironmentMap& map)
{
    return !map.getMap().empty();
}

bool writeName(osgDB::OutputStream& os, const std::string& name)
{
    os.writeWrappedString(name);
    os << std::endl;
    return true;
}

using Load = bool (EnvironmentMap::*)(const std::string&, const osgDB::Options*, std::string&);

bool readName(osgDB::InputStream& is, EnvironmentMap& map, Load load)
{
    std::string name;
    std::string error;
    is.readWrappedString(name);
    if (!(map.*load)(name, is.getOptions(), error)) OSG_WARN << "osgEnvLight: " << error << std::endl;
    return true;
}

bool writeMap(osgDB::OutputStream& os, const EnvironmentMap& map)
{
    return writeName(os, map.getMap());
}

bool readMap(osgDB::InputStream& is, EnvironmentMap& map)
{
    return readName(is, map, &EnvironmentMap::load);
}

bool checkLights(const EnvironmentMap& map)
{
    return !map.getLightFile().empty();
}

bool writeLights(osgDB::OutputStream& os, const EnvironmentMap& map)
{
    return writeName(os, map.getLightFile());
}

bool readLights(osgDB::InputStream& is, EnvironmentMap& map)
{
    return readName(is, map, &EnvironmentMap::loadLights);
}

bool checkImage(const EnvironmentMap& map)
{
    return map.getMap().empty() && map.getImage();
}

bool writeImage(osgDB::OutputStream& os, const EnvironmentMap& map)
{
    os.writeImage(map.getImage());
    return true;
}

bool readImage(osgDB::InputStream& is, EnvironmentMap& map)
{
    map.setImage(is.readImage());
    return true;
}

}  // namespace

REGISTER_OBJECT_WRAPPER(osgEnvLight_EnvironmentMap, new osgEnvLight::EnvironmentMap, osgEnvLight::EnvironmentMap,
                        "osg::Object osgEnvLight::EnvironmentMap")
{
    // Before the map, whose shape it explains.
    using Layout = osgDB::EnumSerializer<MyClass, osgEnvLight::MapLayout, void>;
    const std::vector<std::string>& names = osgEnvLight::mapLayoutNames();
    osg::ref_ptr<Layout> layout = new Layout("Layout", osgEnvLight::MapLayout::AUTO, &MyClass::getLayout, &MyClass::setLayout);
    for (size_t i = 0; i < names.size(); ++i) layout->add(names[i].c_str(), osgEnvLight::MapLayout(i));
    wrapper->addSerializer(layout.get(), osgDB::BaseSerializer::RW_ENUM);
    wrapper->addSerializer(new osgDB::UserSerializer<MyClass>("Map", checkMap, readMap, writeMap),
                           osgDB::BaseSerializer::RW_USER);
    wrapper->addSerializer(new osgDB::UserSerializer<MyClass>("Image", checkImage, readImage, writeImage),
                           osgDB::BaseSerializer::RW_USER);
    ADD_DOUBLE_SERIALIZER(Rotation, 0.0);
    ADD_DOUBLE_SERIALIZER(Intensity, 1.0);
    ADD_BOOL_SERIALIZER(Strict, false);
    wrapper->addSerializer(new osgDB::UserSerializer<MyClass>("Lights", checkLights, readLights, writeLights),
                           osgDB::BaseSerializer::RW_USER);
}
