// SPDX-License-Identifier: MIT
#include <osgEnvLight/AreaLight>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

namespace
{

using osgEnvLight::AreaLight;

// A polygon's vertices and a rectangle's image. Binary files have no names of properties: those of before images came would be
// misread if images had a property of their own. So a light with an image writes an array of one number first, whether vertices
// follow it.

bool checkVertices(const AreaLight& light)
{
    return light.getVertices() || light.getImage();
}

bool readVertices(osgDB::InputStream& is, AreaLight& light)
{
    const osg::ref_ptr<osg::Array> array = is.readArray();
    const auto* hasVertices = dynamic_cast<osg::IntArray*>(array.get());
    if (!hasVertices) {
        light.setVertices(dynamic_cast<osg::Vec3Array*>(array.get()));
        return true;
    }
    light.setImage(is.readImage());
    if (hasVertices->empty() || (*hasVertices)[0] == 0) return true;
    const osg::ref_ptr<osg::Array> vertices = is.readArray();
    light.setVertices(dynamic_cast<osg::Vec3Array*>(vertices.get()));
    return true;
}

bool writeVertices(osgDB::OutputStream& os, const AreaLight& light)
{
    if (light.getImage()) {
        const osg::ref_ptr<osg::IntArray> hasVertices = new osg::IntArray;
        hasVertices->push_back(light.getVertices() ? 1 : 0);
        os.writeArray(hasVertices);
        os.writeImage(light.getImage());
    }
    if (light.getVertices()) os.writeArray(light.getVertices());
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
