/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/EnvironmentMap>

#include <memory>
#include <vector>

namespace osgEnvLight
{

/** Where the corners of an octahedral square's texels lie in a latitude-longitude map: what takes longest about making a
 * pyramid, and the same for every map. Never changed once made.*/
class OSGENVLIGHT_EXPORT OctahedralGrid
{
  public:
    explicit OctahedralGrid(unsigned side);

    unsigned side() const { return _side; }
    /** uv of corner (x, y), 0..side. */
    const osg::Vec2d& corner(unsigned x, unsigned y) const { return _corners[size_t(y) * (_side + 1) + x]; }

  private:
    unsigned _side;
    std::vector<osg::Vec2d> _corners;
};

/** Side of level 0 for a map: half its width, which keeps the number of texels on the sphere, as a power of two between 4
 * and 1024.*/
OSGENVLIGHT_EXPORT unsigned pyramidSide(int mapWidth);
/** The last level, of 4 x 4 texels. */
OSGENVLIGHT_EXPORT unsigned pyramidLastLevel(unsigned side);

/** The map's octahedral pyramid of box averages by solid angle, times scale: GL_RGB GL_FLOAT, all levels in one atlas
 * with borders (lib/octahedral.glsl).*/
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Image> makePyramid(const RadianceMap& map, const OctahedralGrid& grid, double scale);

}  // namespace osgEnvLight
