/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "indirect/CasterBvh.h"
#include "indirect/SurfacePoints.h"

#include <osg/StateSet>
#include <osg/Texture2D>

namespace osgEnvLight
{

/** The triangles of a scene that stands still, for rays on the GPU, and which surface points know the light where a ray meets
 * one. */
class OSGENVLIGHT_EXPORT SceneRays : public osg::Referenced
{
  public:
    static constexpr size_t mostTriangles = 1u << 20;  // 130 MB; their numbers are whole floats

    SceneRays(const TracedScene& scene, const CasterBvh& bvh, const std::vector<SurfacePart>& parts, unsigned partsPerPoint);

    // As pass/scenerays.glsl reads them; rows of RAY_COLUMNS texels, one after the other.
    osg::ref_ptr<osg::Texture2D> nodes, triangles;
    // As pass/surfacecells.frag and pass/scenecells.glsl: of each cell and facing the numbers of its points, four in a texel, and
    // then their weights.
    osg::ref_ptr<osg::Texture2D> cellPoints;
    int cellColumns = 0, cellRows = 0;  // cells in it

    /** For pass/scenecells.glsl. */
    osg::ref_ptr<osg::StateSet> uniforms;

    /** SURFACE_TEXELS a surface, in rows of RAY_COLUMNS: what its diffuse layer reflects of the light that it receives, what its
     * lobe does, with the lobe's roughness, and what it emits.
     * @param parts  those that the scene was made from, as they are now */
    static osg::ref_ptr<osg::Texture2D> colors(const StaticCasters::Parts& parts);

    std::vector<osg::Texture2D*> textures() const { return {nodes.get(), triangles.get(), cellPoints.get()}; }

  protected:
    ~SceneRays() override = default;

  private:
    void writeNodes(const CasterBvh& bvh);
    void writeTriangles(const TracedScene& scene, const CasterBvh& bvh);
    void writeCells(const TracedScene& scene, const std::vector<SurfacePart>& parts, unsigned partsPerPoint);
};

}  // namespace osgEnvLight
