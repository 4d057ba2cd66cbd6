// SPDX-License-Identifier: MIT
#include "surface/CasterMesh.h"

#include <osg/Array>
#include <osg/BoundingBox>
#include <osg/TriangleIndexFunctor>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "glsl.h"
#include "lib/octahedral.glsl"

namespace osgEnvLight
{

namespace
{

using Mesh = CasterMesh;
using Triangle = CasterMesh::Triangle;

struct Collect {
    std::vector<Triangle>* triangles = nullptr;
    void operator()(unsigned a, unsigned b, unsigned c) const { triangles->push_back({a, b, c}); }
};

// Vertices of any type that OSG draws.
class VertexReader : public osg::ConstValueVisitor
{
  public:
    void apply(const osg::Vec2& v) override { value = osg::Vec3d(v.x(), v.y(), 0); }
    void apply(const osg::Vec3& v) override { value = v; }
    void apply(const osg::Vec4& v) override { value = osg::Vec3d(v.x(), v.y(), v.z()) / double(v.w()); }
    void apply(const osg::Vec2d& v) override { value = osg::Vec3d(v.x(), v.y(), 0); }
    void apply(const osg::Vec3d& v) override { value = v; }
    void apply(const osg::Vec4d& v) override { value = osg::Vec3d(v.x(), v.y(), v.z()) / v.w(); }
    void apply(const osg::Vec2s& v) override { value = osg::Vec3d(v.x(), v.y(), 0); }
    void apply(const osg::Vec3s& v) override { value = osg::Vec3d(v.x(), v.y(), v.z()); }
    void apply(const osg::Vec4s& v) override { value = osg::Vec3d(v.x(), v.y(), v.z()) / double(v.w()); }
    osg::Vec3d value;
};

// Numbers places so that those that differ by rounding have the same number.
class Places
{
  public:
    Places(const osg::Vec3f& low, float cell) : _low(low), _cell(cell) {}

    unsigned number(const osg::Vec3f& p)
    {
        // The cell of the place, and those beyond the borders that are near.
        std::array<std::array<int, 2>, 3> along;
        for (int k = 0; k < 3; ++k) {
            const float place = (p[k] - _low[k]) / _cell;
            const int own = int(std::floor(place));
            along[size_t(k)] = {own, own + (place - float(own) < 0.5f ? -1 : 1)};
        }
        for (size_t i = 0; i < 8; ++i) {
            const auto found = _numbers.find({along[0][i & 1], along[1][i >> 1 & 1], along[2][i >> 2]});
            if (found != _numbers.end()) return found->second;
        }
        return _numbers.emplace(std::array<int, 3>{along[0][0], along[1][0], along[2][0]}, unsigned(_numbers.size()))
            .first->second;
    }

  private:
    osg::Vec3f _low;
    float _cell;
    std::map<std::array<int, 3>, unsigned> _numbers;
};

bool areNumbers(const osg::Vec3d& v)
{
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

// The corners' normals, or flat where they are the triangle's own.
Mesh::Normals normalsOf(const Mesh& mesh, const Triangle& t, const std::vector<osg::Vec3d>& ofVertices)
{
    const double leastTurned = 0.9999995;  // cosine of .06 degrees
    const osg::Vec3d a = mesh.positions[t[0]];
    osg::Vec3d own = (osg::Vec3d(mesh.positions[t[1]]) - a) ^ (osg::Vec3d(mesh.positions[t[2]]) - a);
    own.normalize();
    Mesh::Normals codes;
    bool turned = false;
    for (size_t k = 0; k < 3; ++k) {
        const osg::Vec3d& n = ofVertices[t[k]];
        if (!(n.length2() > 0.0)) return Mesh::flat;
        turned = turned || std::abs(n * own) < leastTurned;
        codes[k] = float(glsl::packDirection(glsl::vec3(n.x(), n.y(), n.z())));
    }
    return turned ? codes : Mesh::flat;
}

void takeNormals(const Caster& caster, Mesh& mesh)
{
    const osg::Array* normals = caster.geometry->getNormalArray();
    if (!normals || normals->getBinding() != osg::Array::BIND_PER_VERTEX || normals->getNumElements() < mesh.positions.size())
        return;
    const osg::Matrixd modelFromWorld = osg::Matrixd::inverse(caster.worldFromModel);
    std::vector<osg::Vec3d> ofVertices;
    VertexReader reader;
    for (unsigned i = 0; i < mesh.positions.size(); ++i) {
        normals->accept(i, reader);
        osg::Vec3d n = osg::Matrixd::transform3x3(modelFromWorld, reader.value);
        n.normalize();
        ofVertices.push_back(areNumbers(n) ? n : osg::Vec3d());
    }
    for (const Triangle& t : mesh.triangles) mesh.normals.push_back(normalsOf(mesh, t, ofVertices));
}

}  // namespace

CasterMesh meshOf(const Caster& caster, const osg::Vec3d& origin)
{
    Mesh mesh;
    const osg::Array* vertices = caster.geometry->getVertexArray();
    if (!vertices) return mesh;
    const osg::Matrixd matrix = caster.worldFromModel * osg::Matrixd::translate(-origin);
    VertexReader reader;
    for (unsigned i = 0; i < vertices->getNumElements(); ++i) {
        vertices->accept(i, reader);
        mesh.positions.push_back(osg::Vec3f(reader.value * matrix));
    }
    for (unsigned i = 0; i < caster.geometry->getNumPrimitiveSets(); ++i) {
        osg::TriangleIndexFunctor<Collect> collect;
        collect.triangles = &mesh.triangles;
        caster.geometry->getPrimitiveSet(i)->accept(collect);
    }
    const auto usable = [&](unsigned v) { return v < mesh.positions.size() && areNumbers(mesh.positions[v]); };
    const auto bad = [&](const Triangle& t) { return !usable(t[0]) || !usable(t[1]) || !usable(t[2]); };
    mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), bad), mesh.triangles.end());
    takeNormals(caster, mesh);
    return mesh;
}

std::vector<unsigned> placesOf(const CasterMesh& mesh)
{
    std::vector<unsigned> at;
    osg::BoundingBoxf box;
    for (const osg::Vec3f& p : mesh.positions) box.expandBy(p);
    if (!box.valid()) return at;
    // A sphere's pole may be many vertices at nearly one place.
    Places places(box._min, 1e-5f * (box._max - box._min).length() + 1e-30f);
    for (const osg::Vec3f& p : mesh.positions) at.push_back(places.number(p));
    return at;
}

bool isClosed(const CasterMesh& mesh, const std::vector<unsigned>& at)
{
    std::unordered_map<uint64_t, int> edges;  // a number one way, its negative the other
    double volume = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const osg::Vec3d a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        volume += a * (b ^ c);
        for (int k = 0; k < 3; ++k) {
            const uint64_t from = at[t[size_t(k)]], to = at[t[size_t((k + 1) % 3)]];
            if (from == to) continue;
            edges[std::min(from, to) << 32 | std::max(from, to)] += from < to ? 1 : -1;
        }
    }
    const auto isEven = [](const auto& edge) { return edge.second == 0; };
    return volume > 0.0 && std::all_of(edges.begin(), edges.end(), isEven);
}

bool isClosed(const CasterMesh& mesh)
{
    if (mesh.closed) return *mesh.closed;
    return !mesh.positions.empty() && isClosed(mesh, placesOf(mesh));
}

}  // namespace osgEnvLight
