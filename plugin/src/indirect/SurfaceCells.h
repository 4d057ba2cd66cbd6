/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Limits.h"
#include "indirect/SurfacePoints.h"

#include <osg/BoundingBox>

#include <array>
#include <functional>

namespace osgEnvLight
{

/** Cubes of space. Each knows, of six ways to face, which surface points stand for the surfaces in it: the light on any place of
 * a surface is the mean of what the points of the eight cubes about it receive. */
struct OSGENVLIGHT_EXPORT SurfaceCells {
    static constexpr int facings = 6;  // -x, x, -y, y, -z, z
    static constexpr int mostPoints = limits::CELL_POINTS;
    static constexpr int most = 32768;  // cells

    /** @param parts  so many of each point, one point's after the other's */
    SurfaceCells(const TracedScene& scene, const std::vector<SurfacePart>& parts, unsigned partsPerPoint);

    struct Share {
        unsigned point = 0;
        float weight = 0.0f;  // sum of its parts', each of which has one of 1 among the cells and facings about it
    };
    using Shares = std::array<Share, mostPoints>;

    osg::Vec3f low;      // corner of the first cell
    float width = 0.0f;  // of a cell
    std::array<int, 3> count{};
    std::vector<Shares> shares;  // of the cells, first along x, then y and z; of each cell its facings

    size_t entry(int x, int y, int z, int facing) const { return size_t(((z * count[1] + y) * count[0] + x) * facings + facing); }

  private:
    bool layOut(const osg::BoundingBoxf& box);
    void forEntriesAbout(const SurfacePart& part, const std::function<void(size_t, float)>& visit) const;
};

}  // namespace osgEnvLight
