/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "lights/LightTexels.h"

namespace osgEnvLight
{

/** Chooses, again and again, the texel of a group that is farthest from those chosen [Hochbaum, Shmoys 1985].
 *
 * A choice changes distances only nearer than the greatest one, so only the rows and columns around it are visited: the
 * whole costs texels * log(count), not texels * count.*/
class OSGENVLIGHT_EXPORT FarthestPoints
{
  public:
    /** @param taken  directions chosen before, elsewhere; if there are none the first texel is the one of most radiance*/
    FarthestPoints(const LightTexels& texels, const TexelGroup& group, const std::vector<osg::Vec3d>& taken);

    /** The next, never one twice while there are others. */
    size_t next();

  private:
    void approach(size_t chosen, float farthest);
    void approachRow(int y, int x0, int x1, size_t chosen);
    void findGreatest(size_t segment);

    const LightTexels& _texels;
    size_t _segments;  // of a row
    size_t _stride;    // texels of a row, padded to whole segments
    // Padded: directions, and the squared chord to the nearest chosen one, -1 where a texel is none of the group.
    std::vector<float> _x, _y, _z, _chord;
    std::vector<float> _greatest;  // of each segment
};

}  // namespace osgEnvLight
