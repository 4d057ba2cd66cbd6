// SPDX-License-Identifier: MIT
#include <osgEnvLight/AreaLight>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

namespace
{

using osgEnvLight::AreaLight;

bool checkVertices(const AreaLight& light)
{
    return light.getVertices() != nullptr;
}

bool readVertices(osgDB::InputStream& is, AreaLight& light)
{
    const osg::ref_ptr<osg::Array> array = is.readArray();
    light.setVertices(dynamic_cast<osg::Vec3Array*>(array.get()));
    return true;
}

bool writeVertices(osgDB::OutputStream& os, const AreaLight& light)
{
    os.writeArray(light.getVertices());
    return true;
}

}  // namespace

REGISTER_OBJECT_WRAPPER(osgEnvLight_AreaLight, new osgEnvLight::AreaLight, osgEnvLight::AreaLight,
                        "osg::Object osg::Node osgEnvLight::AreaLight")
{
    BEGIN_ENUM_SERIALIZER(Shape, RECTANGLE);
    ADD_ENUM_VALUE(RECTANGLE);
    ADD_ENUM_VALUE(DISC);
    ADD_ENUM_VALUE(SPHERE);
    ADD_ENUM_VALUE(POLYGON);
    END_ENUM_SERIALIZER();
    ADD_VEC3D_SERIALIZER(Center, osg::Vec3d());
    ADD_VEC3D_SERIALIZER(U, osg::Vec3d(0.5, 0, 0));
    ADD_VEC3D_SERIALIZER(V, osg::Vec3d(0, 0.5, 0));
    wrapper->addSerializer(new osgDB::UserSerializer<MyClass>("Vertices", checkVertices, readVertices, writeVertices),
                           osgDB::BaseSerializer::RW_USER);
    BEGIN_ENUM_SERIALIZER(Quantity, RADIANCE);
    ADD_ENUM_VALUE(RADIANCE);
    ADD_ENUM_VALUE(FLUX);
    END_ENUM_SERIALIZER();
    ADD_VEC3F_SERIALIZER(Emission, osg::Vec3f(1, 1, 1));
    ADD_BOOL_SERIALIZER(TwoSided, false);
    ADD_BOOL_SERIALIZER(Visible, true);
}
