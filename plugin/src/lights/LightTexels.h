/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>
#include "environment/MomentTable.h"

namespace osgEnvLight
{

/** The map as a grid of directions that each send something: its texels, or blocks of them. For samplers that choose among
 * texels and gather the flux of those around. Sums of a block, not differences of sums: what is dark is exactly 0.
 *
 * Maps below 64 x 32 are repeated, as in MomentTable.*/
class OSGENVLIGHT_EXPORT LightTexels
{
  public:
    /** @param columns at most this many; wider maps are summed in blocks
     * @param floor   uniform radiance, in units of the map's mean, added to what decides*/
    LightTexels(const RadianceMap& map, int columns, double floor = 0.0);

    int width() const { return _width; }
    int height() const { return _height; }
    size_t size() const { return _light.size(); }
    /** How many send what decides. */
    size_t lit() const { return _lit; }

    /** By y * width + x, from the top left. */
    const Moments& light(size_t i) const { return _light[i]; }
    double solidAngle(size_t i) const { return _solidAngle[i]; }
    double deciding(size_t i) const { return _light[i].flux + _floor * solidAngle(i); }
    osg::Vec3d direction(size_t i) const { return osg::Vec3d(double(_x[i]), double(_y[i]), double(_z[i])); }
    /** The directions of the centres by coordinate, for loops over many. */
    const float* x() const { return _x.data(); }
    const float* y() const { return _y.data(); }
    const float* z() const { return _z.data(); }

    /** A light for each texel that is lit. */
    LightList lights() const;

  private:
    void sumBlocks(const RadianceMap& map, int block, int repeatX, int repeatY);

    int _width;
    int _height;
    double _floor;
    size_t _lit = 0;
    std::vector<Moments> _light;
    std::vector<double> _solidAngle;
    std::vector<float> _x, _y, _z;
};

/** A part of the texels, by a label that each has. */
struct TexelGroup {
    const std::vector<unsigned char>& labels;
    unsigned char label;

    bool has(size_t i) const { return labels[i] == label; }
};

/** For the texels of the group, the index of the nearest of the directions, from the first on; others are left as they are.*/
OSGENVLIGHT_EXPORT void findNearest(const LightTexels& texels, const TexelGroup& group, const std::vector<osg::Vec3d>& directions,
                                    size_t first, std::vector<unsigned>& nearest);

/** Light i stands for the texels whose owner is i, at their flux centroid; at directions[i] where that is nothing. */
OSGENVLIGHT_EXPORT LightList gatherLights(const LightTexels& texels, const std::vector<unsigned>& owner,
                                          const std::vector<osg::Vec3d>& directions);

}  // namespace osgEnvLight
