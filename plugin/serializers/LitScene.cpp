// SPDX-License-Identifier: MIT
#include <osgEnvLight/LitScene>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

REGISTER_OBJECT_WRAPPER(osgEnvLight_LitScene, new osgEnvLight::LitScene, osgEnvLight::LitScene,
                        "osg::Object osg::Node osg::Group osgEnvLight::LitScene")
{
    ADD_OBJECT_SERIALIZER(EnvironmentMap, osgEnvLight::EnvironmentMap, NULL);
    ADD_OBJECT_SERIALIZER(Settings, osgEnvLight::Settings, NULL);
}
