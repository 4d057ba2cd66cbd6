/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "lights/LightRegions.h"

namespace osgEnvLight
{

/** Spherical k-means of the map's flux: micro cells, each owned by the nearest of N generators, which move to the flux
 * centroids of what they own (sampling.md 3, `auto`; 4, warm).*/
class OSGENVLIGHT_EXPORT LightClusters
{
  public:
    /** Cold: generators from divided regions. */
    LightClusters(const MomentTable& table, unsigned count);
    /** Warm: generators from a former list, in its order. */
    LightClusters(const MomentTable& table, std::vector<osg::Vec3d> generators);

    /** Assign and move, that often. */
    void refine(unsigned rounds);

    /** Give every generator without a cell the far half of the cluster that needs it most. */
    void fillEmpty();

    /** If the worst cluster's flux * spread exceeds four times the cheapest removal (flux * distance to the nearest
     * generator), move that generator to the worst cluster's farthest cell. Its index, or -1.*/
    int teleport();

    const std::vector<osg::Vec3d>& generators() const { return _generators; }

    /** Light i stands for what generator i owns; dark where that is nothing. */
    LightList lights() const;

    static unsigned microCells(unsigned count);

  private:
    struct Cluster {
        Moments light;
        Moments deciding;
        unsigned cells = 0;
    };

    void setCells(const std::vector<LightRegion>& regions);
    void findNeighbours();
    void assignNear();
    void assignAll();
    void sumClusters();
    void moveGenerators();
    osg::Vec3d cellDirection(size_t j) const;
    unsigned farthestCell(unsigned cluster) const;
    void copyGenerators();

    std::vector<osg::Vec3d> _generators;
    std::vector<Cluster> _clusters;
    std::vector<LightRegion> _cells;
    std::vector<unsigned> _owner;
    std::vector<unsigned> _neighbours;
    size_t _numNeighbours = 0;
    // Single precision decides who owns a cell; sums are in double.
    std::vector<float> _x, _y, _z;     // of the generators
    std::vector<float> _cx, _cy, _cz;  // of the cells
    bool _assigned = false;
};

}  // namespace osgEnvLight
