/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/DirectionalLight>
#include <osgEnvLight/EnvironmentMap>
#include <osgEnvLight/Export>

#include <osg/Vec2d>

#include <vector>

namespace osgEnvLight
{

/** Directions of a map drawn in proportion to what it sends from there, by the inverse of its cumulative distribution
 * [Pharr, Humphreys 2004]. The density is that of the channels' sum, plus a uniform floor.*/
class OSGENVLIGHT_EXPORT MapDistribution
{
  public:
    /** @param floor  radiance added to each channel, for the density alone */
    explicit MapDistribution(const RadianceMap& map, double floor = 0.0);

    /** The direction at u in [0,1)^2, and radiance over density: the mean of n such fluxes is the map's integral. Both 0 where
     * nothing can be drawn: the map is black. */
    DirectionalLight at(const osg::Vec2d& u);

  private:
    double deciding(int x, int y) const;

    osg::ref_ptr<const RadianceMap> _map;
    double _floor;
    std::vector<double> _rows;     // sums up to each row
    std::vector<double> _columns;  // of one row
    int _row = -1;                 // which
};

/** An endless sequence of such lights, well spread wherever it is cut: R2 points [Roberts 2018]. */
class OSGENVLIGHT_EXPORT MapSequence
{
  public:
    explicit MapSequence(const RadianceMap& map) : _distribution(map) {}

    /** The next count lights: fluxes whose sum is an estimate of the map's. */
    LightList next(unsigned count);

  private:
    MapDistribution _distribution;
    unsigned _index = 0;
};

/** Point i of the R2 sequence, in [0,1)^2. */
OSGENVLIGHT_EXPORT osg::Vec2d r2Point(unsigned i);

}  // namespace osgEnvLight
