// SPDX-License-Identifier: MIT
#include "MeshBuilder.h"

#include "Directions.h"

#include <osg/TriangleIndexFunctor>

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

// An element of any array of OSG's as four numbers; integers of normalised arrays as OpenGL scales them.
class ElementReader : public osg::ConstValueVisitor
{
  public:
    using Value = osg::ConstValueVisitor;

    glm::dvec4 read(const osg::Array& array, unsigned index)
    {
        _value = glm::dvec4(0, 0, 0, 1);
        if (index < array.getNumElements()) array.accept(index, *this);
        const bool scaled = array.getNormalize() || array.getType() == osg::Array::Vec4ubArrayType;
        if (scaled && array.getDataType() == GL_UNSIGNED_BYTE)
            _value /= glm::dvec4(255.0, 255.0, 255.0, array.getDataSize() > 3 ? 255.0 : 1.0);
        if (scaled && array.getDataType() == GL_BYTE) _value = glm::max(_value / 127.0, glm::dvec4(-1.0));
        if (scaled && array.getDataType() == GL_UNSIGNED_SHORT) _value /= 65535.0;
        if (scaled && array.getDataType() == GL_SHORT) _value = glm::max(_value / 32767.0, glm::dvec4(-1.0));
        return _value;
    }

    void apply(const GLfloat& v) override { _value.x = double(v); }
    void apply(const GLdouble& v) override { _value.x = v; }
    void apply(const osg::Vec2& v) override { set(v, 2); }
    void apply(const osg::Vec3& v) override { set(v, 3); }
    void apply(const osg::Vec4& v) override { set(v, 4); }
    void apply(const osg::Vec2d& v) override { set(v, 2); }
    void apply(const osg::Vec3d& v) override { set(v, 3); }
    void apply(const osg::Vec4d& v) override { set(v, 4); }
    void apply(const osg::Vec2b& v) override { set(v, 2); }
    void apply(const osg::Vec3b& v) override { set(v, 3); }
    void apply(const osg::Vec4b& v) override { set(v, 4); }
    void apply(const osg::Vec2s& v) override { set(v, 2); }
    void apply(const osg::Vec3s& v) override { set(v, 3); }
    void apply(const osg::Vec4s& v) override { set(v, 4); }
    void apply(const osg::Vec2ub& v) override { set(v, 2); }
    void apply(const osg::Vec3ub& v) override { set(v, 3); }
    void apply(const osg::Vec4ub& v) override { set(v, 4); }
    void apply(const osg::Vec2us& v) override { set(v, 2); }
    void apply(const osg::Vec3us& v) override { set(v, 3); }
    void apply(const osg::Vec4us& v) override { set(v, 4); }

  private:
    template <class V>
    void set(const V& v, int n)
    {
        for (int i = 0; i < n; ++i) _value[i] = double(v.ptr()[i]);
    }

    glm::dvec4 _value{0, 0, 0, 1};
};

struct Collect {
    std::vector<glm::uvec3>* triangles = nullptr;
    void operator()(unsigned a, unsigned b, unsigned c) const { triangles->emplace_back(a, b, c); }
};

// Which element of an array a vertex takes.
unsigned elementOf(const osg::Array& array, unsigned vertex, unsigned primitiveSet)
{
    if (array.getBinding() == osg::Array::BIND_OVERALL) return 0;
    return array.getBinding() == osg::Array::BIND_PER_PRIMITIVE_SET ? primitiveSet : vertex;
}

bool perPrimitiveSet(const osg::Array* array)
{
    return array && array->getBinding() == osg::Array::BIND_PER_PRIMITIVE_SET;
}

// Null where the array gives nothing: off, or not there.
const osg::Array* bound(const osg::Array* array)
{
    return array && array->getNumElements() > 0 && array->getBinding() != osg::Array::BIND_OFF ? array : nullptr;
}

std::vector<glm::uvec3> trianglesOf(const osg::PrimitiveSet& set)
{
    std::vector<glm::uvec3> triangles;
    osg::TriangleIndexFunctor<Collect> collect;
    collect.triangles = &triangles;
    set.accept(collect);
    return triangles;
}

bool degenerate(const TriangleMesh& mesh, const glm::uvec3& t)
{
    const glm::dvec3 a = mesh.positions[t.x];
    const glm::dvec3 n = glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
    const double area = glm::dot(n, n);
    return !(area > 0.0) || !std::isfinite(area);
}

void appendVertices(const osg::Geometry& g, unsigned set, const osg::Matrixd& worldFromModel, const osg::Matrixd& textureMatrix,
                    const glm::dvec3& origin, TriangleMesh& mesh)
{
    const osg::Array& vertices = *g.getVertexArray();
    const osg::Array* normals = bound(g.getNormalArray());
    const osg::Array* colors = bound(g.getColorArray());
    const bool textured = mesh.material.texture || mesh.material.anisotropy > 0.0;
    const osg::Array* texCoords = textured ? bound(g.getTexCoordArray(0)) : nullptr;
    const osg::Matrixd modelFromWorld = osg::Matrixd::inverse(worldFromModel);
    ElementReader reader;
    for (unsigned i = 0; i < vertices.getNumElements(); ++i) {
        const glm::dvec4 v = reader.read(vertices, i);
        const osg::Vec3d world = osg::Vec3d(v.x, v.y, v.z) * worldFromModel;
        mesh.positions.emplace_back(toGlm(world) - origin);
        if (normals) {
            // Normals go by the inverse transpose: row vectors on the other side of the inverse.
            const glm::dvec4 n = reader.read(*normals, elementOf(*normals, i, set));
            const osg::Vec3d w = osg::Matrixd::transform3x3(modelFromWorld, osg::Vec3d(n.x, n.y, n.z));
            mesh.normals.emplace_back(toGlm(w));
        }
        // Without colours of its own a drawable has OpenGL's current one, which applying an osg::Material sets to its diffuse.
        if (mesh.material.vertexColored)
            mesh.colors.emplace_back(colors ? reader.read(*colors, elementOf(*colors, i, set)) : mesh.material.color);
        if (textured) {
            const glm::dvec4 c = texCoords ? reader.read(*texCoords, elementOf(*texCoords, i, set)) : glm::dvec4(0, 0, 0, 1);
            const osg::Vec4d st = osg::Vec4d(c.x, c.y, c.z, c.w) * textureMatrix;
            mesh.texCoords.emplace_back(glm::dvec2(st.x(), st.y()));
        }
    }
}

}  // namespace

void expandByTriangles(const osg::Geometry& geometry, const osg::Matrixd& worldFromModel, osg::BoundingBoxd& box)
{
    const osg::Array* vertices = geometry.getVertexArray();
    if (!vertices) return;
    const unsigned count = vertices->getNumElements();
    ElementReader reader;
    for (unsigned set = 0; set < geometry.getNumPrimitiveSets(); ++set) {
        for (const glm::uvec3& t : trianglesOf(*geometry.getPrimitiveSet(set))) {
            if (t.x >= count || t.y >= count || t.z >= count) continue;
            osg::BoundingBoxd own;
            bool finite = true;
            for (int i = 0; i < 3; ++i) {
                const glm::dvec4 v = reader.read(*vertices, t[i]);
                const osg::Vec3d world = osg::Vec3d(v.x, v.y, v.z) * worldFromModel;
                finite = finite && std::isfinite(world.x()) && std::isfinite(world.y()) && std::isfinite(world.z());
                own.expandBy(world);
            }
            if (finite) box.expandBy(own);
        }
    }
}

bool appendTriangles(const osg::Geometry& geometry, const osg::Matrixd& worldFromModel, const osg::Matrixd& textureMatrix,
                     const glm::dvec3& origin, TriangleMesh& mesh, TriangleScene& counts)
{
    const osg::Array* vertices = geometry.getVertexArray();
    if (!vertices || vertices->getNumElements() == 0) return false;
    const bool bySet = perPrimitiveSet(geometry.getNormalArray()) || perPrimitiveSet(geometry.getColorArray());
    bool surfaces = false;
    for (unsigned set = 0; set < geometry.getNumPrimitiveSets(); ++set) {
        std::vector<glm::uvec3> triangles = trianglesOf(*geometry.getPrimitiveSet(set));
        if (triangles.empty()) continue;
        surfaces = true;
        if (mesh.positions.empty() || bySet) {
            const auto base = glm::uint(mesh.positions.size());
            appendVertices(geometry, set, worldFromModel, textureMatrix, origin, mesh);
            for (glm::uvec3& t : triangles) t += base;
        }
        const auto count = glm::uint(mesh.positions.size());
        for (const glm::uvec3& t : triangles) {
            if (t.x >= count || t.y >= count || t.z >= count || degenerate(mesh, t))
                ++counts.degenerate;
            else
                mesh.triangles.push_back(t);
        }
    }
    return surfaces;
}

}  // namespace osgEnvLight
