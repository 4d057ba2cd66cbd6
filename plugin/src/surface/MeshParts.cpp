// SPDX-License-Identifier: MIT
#include "surface/MeshParts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace osgEnvLight
{

namespace
{

using Triangles = std::vector<MeshTriangle>;

const double flatCosine = 0.99985;  // of a degree
const double flatHeight = 1e-3;     // of a part's extent, above or below its plane

uint64_t edgeKey(uint64_t a, uint64_t b)
{
    return std::min(a, b) << 32 | std::max(a, b);
}

template <class F>
void forEachEdge(const MeshTriangle& t, F f)
{
    for (size_t k = 0; k < 3; ++k) f(t.corners[k], t.corners[(k + 1) % 3]);
}

class Sets
{
  public:
    explicit Sets(size_t count) : _parent(count) { std::iota(_parent.begin(), _parent.end(), 0u); }

    unsigned of(unsigned i)
    {
        while (_parent[i] != i) i = _parent[i] = _parent[_parent[i]];
        return i;
    }
    void join(unsigned a, unsigned b) { _parent[of(a)] = of(b); }

  private:
    std::vector<unsigned> _parent;
};

Triangles trianglesOf(const CasterMesh& mesh, const std::vector<unsigned>& at, const std::vector<osg::Vec3d>& places)
{
    Triangles triangles;
    for (const auto& t : mesh.triangles) {
        MeshTriangle m{{at[t[0]], at[t[1]], at[t[2]]}, {}, {}, 0.0};
        const osg::Vec3d &a = places[m.corners[0]], &b = places[m.corners[1]], &c = places[m.corners[2]];
        m.normal = (b - a) ^ (c - a);
        m.area = 0.5 * m.normal.normalize();
        m.center = (a + b + c) / 3.0;
        const double longest = std::max({(b - a).length2(), (c - b).length2(), (a - c).length2()});
        if (m.area > 1e-9 * longest) triangles.push_back(m);
    }
    return triangles;
}

void turnOver(MeshTriangle& t)
{
    std::swap(t.corners[1], t.corners[2]);
    t.normal = -t.normal;
}

void closeOrOpen(MeshBodies::Body& body)
{
    std::unordered_map<uint64_t, int> edges;  // a number one way, its negative the other
    double volume = 0.0;
    for (const MeshTriangle& t : body.triangles) {
        volume += t.area * (t.normal * (t.center - body.triangles.front().center));
        forEachEdge(t, [&](unsigned a, unsigned b) { edges[edgeKey(a, b)] += a < b ? 1 : -1; });
    }
    body.open = std::any_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second != 0; });
    if (!body.open && volume < 0.0) std::for_each(body.triangles.begin(), body.triangles.end(), turnOver);
}

double extentOf(const Triangles& triangles, const std::vector<osg::Vec3d>& places)
{
    double extent = 0.0;
    for (const MeshTriangle& t : triangles)
        for (unsigned corner : t.corners) extent = std::max(extent, (places[corner] - triangles.front().center).length());
    return extent;
}

}  // namespace

MeshBodies bodiesOf(const CasterMesh& mesh)
{
    MeshBodies result;
    const std::vector<unsigned> at = placesOf(mesh);
    if (at.empty()) return result;
    result.places.resize(*std::max_element(at.begin(), at.end()) + 1);
    for (size_t i = 0; i < at.size(); ++i) result.places[at[i]] = mesh.positions[i];
    const Triangles triangles = trianglesOf(mesh, at, result.places);
    Sets sets(result.places.size());
    for (const MeshTriangle& t : triangles) forEachEdge(t, [&](unsigned a, unsigned b) { sets.join(a, b); });
    std::map<unsigned, size_t> bodies;
    for (const MeshTriangle& t : triangles) {
        const auto [body, isNew] = bodies.emplace(sets.of(t.corners[0]), result.bodies.size());
        if (isNew) result.bodies.emplace_back();
        result.bodies[body->second].triangles.push_back(t);
    }
    std::for_each(result.bodies.begin(), result.bodies.end(), closeOrOpen);
    return result;
}

std::vector<Triangles> flatPartsOf(const MeshBodies::Body& body, const std::vector<osg::Vec3d>& places)
{
    Triangles all = body.triangles;
    std::stable_sort(all.begin(), all.end(), [](const MeshTriangle& a, const MeshTriangle& b) { return a.area > b.area; });
    std::unordered_multimap<uint64_t, size_t> byEdge;
    for (size_t i = 0; i < all.size(); ++i)
        forEachEdge(all[i], [&](unsigned a, unsigned b) { byEdge.emplace(edgeKey(a, b), i); });
    const double height = flatHeight * extentOf(all, places);
    std::vector<char> taken(all.size(), 0);
    std::vector<Triangles> parts;
    std::vector<size_t> queue;
    for (size_t seed = 0; seed < all.size(); ++seed) {
        if (taken[seed]) continue;
        const MeshTriangle& first = all[seed];
        const auto fits = [&](const MeshTriangle& t) {
            const auto isNear = [&](unsigned c) { return std::abs((places[c] - first.center) * first.normal) <= height; };
            return t.normal * first.normal >= flatCosine && std::all_of(t.corners.begin(), t.corners.end(), isNear);
        };
        taken[seed] = 1;
        queue.assign(1, seed);
        for (size_t k = 0; k < queue.size(); ++k)
            forEachEdge(all[queue[k]], [&](unsigned a, unsigned b) {
                const auto [from, to] = byEdge.equal_range(edgeKey(a, b));
                for (auto next = from; next != to; ++next) {
                    if (taken[next->second] || !fits(all[next->second])) continue;
                    taken[next->second] = 1;
                    queue.push_back(next->second);
                }
            });
        parts.emplace_back();
        for (size_t i : queue) parts.back().push_back(all[i]);
    }
    return parts;
}

std::vector<osg::Vec3d> outlineOf(const Triangles& part, const std::vector<osg::Vec3d>& places)
{
    std::map<std::pair<unsigned, unsigned>, int> edges;
    for (const MeshTriangle& t : part)
        forEachEdge(t, [&](unsigned a, unsigned b) {
            const auto other = edges.find({b, a});
            if (other == edges.end())
                ++edges[{a, b}];
            else if (--other->second == 0)
                edges.erase(other);
        });
    std::map<unsigned, unsigned> next;
    for (const auto& [edge, count] : edges)
        if (count != 1 || !next.emplace(edge.first, edge.second).second) return {};
    if (next.empty()) return {};
    std::vector<osg::Vec3d> corners;
    unsigned at = next.begin()->first;
    for (size_t k = 0; k < next.size(); ++k) {
        corners.push_back(places[at]);
        const auto found = next.find(at);
        if (found == next.end()) return {};
        at = found->second;
        if (at == next.begin()->first && k + 1 < next.size()) return {};  // another outline is left: of a hole
    }
    std::vector<osg::Vec3d> outline;
    for (size_t k = 0; k < corners.size(); ++k) {
        const osg::Vec3d before = corners[k] - corners[(k + corners.size() - 1) % corners.size()];
        const osg::Vec3d after = corners[(k + 1) % corners.size()] - corners[k];
        if ((before ^ after).length() > 1e-4 * before.length() * after.length() || before * after < 0.0)
            outline.push_back(corners[k]);
    }
    return outline;
}

}  // namespace osgEnvLight
