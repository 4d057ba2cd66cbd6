// SPDX-License-Identifier: MIT
#include "surface/EmitterMesh.h"

#include <cmath>

namespace osgEnvLight
{

namespace
{

const unsigned discCorners = 64;
const unsigned sphereRows = 24;

struct Triangles {
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec2Array> coordinates;  // of a picture; null where there is none
    osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);

    void add(unsigned a, unsigned b, unsigned c)
    {
        for (unsigned i : {a, b, c}) triangles->push_back(GLushort(i));
    }

    void addFan()
    {
        for (unsigned i = 2; i < vertices->size(); ++i) add(0, i - 1, i);
    }
};

void addSphere(const Emitter& e, Triangles& mesh)
{
    const unsigned columns = 2 * sphereRows;
    for (unsigned row = 0; row <= sphereRows; ++row)
        for (unsigned column = 0; column <= columns; ++column) {
            const double polar = osg::PI * row / sphereRows, azimuth = 2.0 * osg::PI * (column % columns) / columns;
            // Exactly one point at each pole, or its triangles have slivers of area.
            const double sine = row % sphereRows == 0 ? 0.0 : std::sin(polar);
            const osg::Vec3d n(sine * std::cos(azimuth), sine * std::sin(azimuth), std::cos(polar));
            mesh.vertices->push_back(e.center + n * e.radius());
            mesh.normals->push_back(n);
        }
    for (unsigned row = 0; row < sphereRows; ++row)
        for (unsigned column = 0; column < columns; ++column) {
            const unsigned a = row * (columns + 1) + column, b = a + columns + 1;
            if (row > 0) mesh.add(a, b, a + 1);
            if (row + 1 < sphereRows) mesh.add(a + 1, b, b + 1);
        }
}

Triangles meshOf(const Emitter& e)
{
    Triangles mesh;
    if (e.shape == AreaLight::SPHERE) addSphere(e, mesh);
    if (e.shape == AreaLight::RECTANGLE)
        for (const osg::Vec3d& corner : {-e.u - e.v, e.u - e.v, e.u + e.v, e.v - e.u})
            mesh.vertices->push_back(e.center + corner);
    if (e.picture) {
        mesh.coordinates = new osg::Vec2Array;
        for (const osg::Vec2& corner : {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)})
            mesh.coordinates->push_back(corner);
    }
    if (e.shape == AreaLight::DISC) {
        const double angle = 2.0 * osg::PI / discCorners;
        const double scale = std::sqrt(angle / std::sin(angle));  // of the disc's area
        for (unsigned i = 0; i < discCorners; ++i)
            mesh.vertices->push_back(e.center + (e.u * std::cos(i * angle) + e.v * std::sin(i * angle)) * scale);
    }
    if (e.shape == AreaLight::POLYGON) {
        for (const osg::Vec3d& p : e.vertices) mesh.vertices->push_back(e.center + p);
        for (size_t i = 0; i + 2 < e.triangles.size(); i += 3) mesh.add(e.triangles[i], e.triangles[i + 1], e.triangles[i + 2]);
    } else if (e.shape != AreaLight::SPHERE) {
        mesh.addFan();
    }
    mesh.normals->resize(mesh.vertices->size(), osg::Vec3(e.normal));
    return mesh;
}

osg::ref_ptr<osg::Geometry> geometryOf(const Triangles& mesh)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(mesh.vertices);
    geometry->setNormalArray(mesh.normals, osg::Array::BIND_PER_VERTEX);
    if (mesh.coordinates) geometry->setTexCoordArray(0, mesh.coordinates);
    geometry->addPrimitiveSet(mesh.triangles);
    geometry->getBound();  // or several culls would compute it at the same time
    return geometry;
}

}  // namespace

osg::ref_ptr<osg::Geometry> makeEmitterMesh(const Emitter& emitter)
{
    return geometryOf(meshOf(emitter));
}

osg::ref_ptr<osg::Geometry> makeEmitterBack(const Emitter& emitter)
{
    Triangles mesh = meshOf(emitter);
    for (osg::Vec3& n : *mesh.normals) n = -n;
    for (size_t i = 0; i + 2 < mesh.triangles->size(); i += 3) std::swap((*mesh.triangles)[i + 1], (*mesh.triangles)[i + 2]);
    return geometryOf(mesh);
}

}  // namespace osgEnvLight
