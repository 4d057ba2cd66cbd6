// SPDX-License-Identifier: MIT
#include "indirect/TracedScene.h"

namespace osgEnvLight
{

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
        const auto& normals = part.mesh->normals;
        scene.normals.insert(scene.normals.end(), normals.begin(), normals.end());
        scene.normals.resize(scene.triangles.size(), CasterMesh::flat);
    }
    return scene;
}

}  // namespace osgEnvLight
