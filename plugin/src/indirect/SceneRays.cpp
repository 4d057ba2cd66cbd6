// SPDX-License-Identifier: MIT
#include "indirect/SceneRays.h"

#include "base/Limits.h"
#include "indirect/SurfaceCells.h"
#include "indirect/Texels.h"

#include <algorithm>

namespace osgEnvLight
{

namespace
{

constexpr int columns = limits::RAY_COLUMNS;

Texels makeTable(size_t texels)
{
    const size_t rows = std::max((texels + columns - 1) / columns, size_t(1));
    return Texels(columns, int(rows), 4);
}

// A leaf is below 0: its first triangle and how many it has. An inner node is its first child.
float reference(const CasterBvh::Node& node)
{
    if (node.count == 0) return float(node.first);
    return -float(node.first * limits::RAY_LEAF + node.count);
}

}  // namespace

SceneRays::SceneRays(const TracedScene& scene, const CasterBvh& bvh, const std::vector<SurfacePart>& parts,
                     unsigned partsPerPoint)
{
    static_assert(CasterBvh::leafSize < limits::RAY_LEAF);
    static_assert(mostTriangles * limits::RAY_LEAF < 1u << 24, "they are kept as floats");
    writeNodes(bvh);
    writeTriangles(scene, bvh);
    writeCells(scene, parts, partsPerPoint);
}

void SceneRays::writeNodes(const CasterBvh& bvh)
{
    Texels texels = makeTable(2 * bvh.nodes().size());
    for (size_t i = 0; i < bvh.nodes().size(); ++i) {
        const CasterBvh::Node& node = bvh.nodes()[i];
        texels.put(int(2 * i), node.box._min, reference(node));
        texels.put(int(2 * i + 1), node.box._max, 0.0f);
    }
    nodes = texels.texture(GL_RGBA32F_ARB);
}

void SceneRays::writeTriangles(const TracedScene& scene, const CasterBvh& bvh)
{
    Texels texels = makeTable(limits::TRIANGLE_TEXELS * bvh.triangles().size());
    for (size_t i = 0; i < bvh.triangles().size(); ++i) {
        const CasterBvh::Triangle& t = bvh.triangles()[i];
        const unsigned surface = scene.surfaceOf[t.number];
        const CasterMesh::Normals& n = scene.normals.empty() ? CasterMesh::flat : scene.normals[t.number];
        const int first = limits::TRIANGLE_TEXELS * int(i);
        texels.put(first, t.corner, float(surface));
        texels.put(first + 1, t.edge, scene.surfaces[surface].opacity);
        texels.put(first + 2, t.otherEdge, 0.0f);
        texels.put(first + 3, osg::Vec3f(n[0], n[1], n[2]), 0.0f);
    }
    triangles = texels.texture(GL_RGBA32F_ARB);
}

void SceneRays::writeCells(const TracedScene& scene, const std::vector<SurfacePart>& parts, unsigned partsPerPoint)
{
    const SurfaceCells cells(scene, parts, partsPerPoint);
    cellColumns = SurfaceCells::facings * cells.count[0];
    cellRows = cells.count[1] * cells.count[2];
    constexpr int most = SurfaceCells::mostPoints;
    Texels texels(2 * most / 4 * cellColumns, cellRows, 4);
    for (int z = 0; z < cells.count[2]; ++z)
        for (int y = 0; y < cells.count[1]; ++y)
            for (int facing = 0; facing < SurfaceCells::facings; ++facing)
                for (int x = 0; x < cells.count[0]; ++x) {
                    const SurfaceCells::Shares& shares = cells.shares[cells.entry(x, y, z, facing)];
                    float* points = texels.at(2 * most / 4 * (facing * cells.count[0] + x), z * cells.count[1] + y);
                    for (int k = 0; k < most; ++k) {
                        points[k] = float(shares[size_t(k)].point);
                        points[most + k] = shares[size_t(k)].weight;
                    }
                }
    cellPoints = texels.texture(GL_RGBA32F_ARB);
    uniforms = new osg::StateSet;
    uniforms->addUniform(new osg::Uniform("cellsLow", cells.low));
    uniforms->addUniform(new osg::Uniform("cellWidth", cells.width));
    const osg::ref_ptr<osg::Uniform> count = new osg::Uniform(osg::Uniform::INT_VEC3, "cellCount");
    count->set(cells.count[0], cells.count[1], cells.count[2]);
    uniforms->addUniform(count);
}

osg::ref_ptr<osg::Texture2D> SceneRays::colors(const StaticCasters::Parts& parts)
{
    Texels texels = makeTable(limits::SURFACE_TEXELS * parts.size());
    for (size_t i = 0; i < parts.size(); ++i) {
        const SentLight& sent = parts[i].sent;
        const int first = limits::SURFACE_TEXELS * int(i);
        texels.put(first, sent.diffuse, 1.0f);
        texels.put(first + 1, sent.glossy, sent.roughness);
        texels.put(first + 2, sent.emission, 1.0f);
    }
    return texels.texture(GL_RGBA32F_ARB);
}

}  // namespace osgEnvLight
