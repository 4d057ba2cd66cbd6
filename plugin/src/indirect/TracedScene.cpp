// SPDX-License-Identifier: MIT
#include "indirect/TracedScene.h"

#include <osg/BoundingBox>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace osgEnvLight
{

namespace
{

using Cell = std::array<int, 3>;

// Each edge is one of two triangles, which run along it in opposite directions, and the triangles face outwards.
bool isClosed(const CasterMesh& mesh)
{
    osg::BoundingBoxf box;
    for (const osg::Vec3f& p : mesh.positions) box.expandBy(p);
    if (!box.valid()) return false;
    // Corners with normals of their own are several vertices at one place, and a sphere's pole may be many that nearly are.
    const float cell = 1e-5f * (box._max - box._min).length() + 1e-30f;
    std::map<Cell, unsigned> numbers;
    std::vector<unsigned> at;
    for (const osg::Vec3f& p : mesh.positions) {
        Cell place;
        for (int k = 0; k < 3; ++k) place[size_t(k)] = int(std::lround((p[k] - box._min[k]) / cell));
        at.push_back(numbers.emplace(place, unsigned(numbers.size())).first->second);
    }
    std::unordered_map<uint64_t, int> edges;  // a number one way, its negative the other
    double volume = 0.0;
    for (const auto& t : mesh.triangles) {
        const osg::Vec3d a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        volume += a * (b ^ c);
        for (int k = 0; k < 3; ++k) {
            const uint64_t from = at[t[size_t(k)]], to = at[t[size_t((k + 1) % 3)]];
            if (from == to) continue;
            const uint64_t edge = std::min(from, to) << 32 | std::max(from, to);
            edges[edge] += from < to ? 1 : -1;
        }
    }
    for (const auto& [edge, sum] : edges)
        if (sum != 0) return false;
    return volume > 0.0;
}

}  // namespace

TracedScene tracedScene(const StaticCasters::Parts& parts)
{
    TracedScene scene;
    for (const StaticCasters::Part& part : parts) {
        const auto first = unsigned(scene.positions.size()), surface = unsigned(scene.surfaces.size());
        scene.surfaces.push_back({isClosed(*part.mesh), part.sent.opacity});
        scene.positions.insert(scene.positions.end(), part.mesh->positions.begin(), part.mesh->positions.end());
        for (const auto& t : part.mesh->triangles) {
            scene.triangles.push_back({first + t[0], first + t[1], first + t[2]});
            scene.surfaceOf.push_back(surface);
        }
    }
    return scene;
}

}  // namespace osgEnvLight
