/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/EnvironmentMap>

#include <memory>
#include <vector>

namespace osgEnvLight
{

/** What a region of the map sends: flux (mean of the channels), flux times direction, flux of each channel. */
struct Moments {
    double flux = 0.0;
    osg::Vec3d vector;
    osg::Vec3d rgb;

    /** Unit direction that it comes from; where it comes from none, the other, of any length. */
    osg::Vec3d centroid(const osg::Vec3d& otherwise) const
    {
        const double length = vector.length();
        return flux > 0.0 && length > 1e-12 * flux ? vector / length : otherwise / otherwise.length();
    }
    void operator-=(const Moments& o)
    {
        flux -= o.flux;
        vector -= o.vector;
        rgb -= o.rgb;
    }
};

/** Summed-area table of the map's moments, in double: 1 - |vector / flux|^2 of a small region needs every digit. Read
 * bilinearly, so that borders of regions are real numbers: a region can always be halved.
 *
 * Maps wider than the table are summed in blocks first; maps below 64 x 32 are repeated, so that one texel spans
 * directions. What decides where lights go is the flux of L + floor * mean(L); the moments are those of L.*/
class OSGENVLIGHT_EXPORT MomentTable
{
  public:
    /** For that many lights: 32 sqrt(N) (sampling.md 3), and 512 at least: fewer make V of few lights a sixth larger, because
     * the direction of a sun is lost.*/
    static int columnsFor(unsigned lights);

    /** @param columns at least this many, if the map has them; at most 1024
     * @param floor   uniform radiance, in units of the map's mean, added to what decides*/
    MomentTable(const RadianceMap& map, int columns, double floor = 0.0);

    int width() const { return _width; }
    int height() const { return _height; }
    bool hasFloor() const { return _floor > 0.0; }

    /** Of the columns u0..u1 and rows v0..v1, from the top left. All 0 where isDark(). */
    Moments region(double u0, double v0, double u1, double v1) const;
    /** Whether a difference of sums is no more than their rounding. */
    bool isDark(const Moments& m) const;
    /** The moments of the uniform floor there (no rgb). */
    Moments floorRegion(double u0, double v0, double u1, double v1) const;
    /** The flux that decides: the map's and the floor's. */
    double deciding(double u0, double v0, double u1, double v1) const;

    /** Width of a region at its widest, and height [radians]. */
    osg::Vec2d extent(double u0, double v0, double u1, double v1) const;
    osg::Vec3d direction(double u, double v) const;

  private:
    struct alignas(64) Cell {
        double value[8];  // flux, vector, rgb, unused
    };
    Cell& cell(int x, int y) { return _cells[size_t(y) * size_t(_width + 1) + size_t(x)]; }
    const Cell& cell(int x, int y) const { return _cells[size_t(y) * size_t(_width + 1) + size_t(x)]; }
    void at(double u, double v, double sign, Cell& sum) const;
    double fluxAt(double u, double v) const;
    void sumBlocks(const RadianceMap& map, int row, std::vector<Cell>& sums) const;
    void accumulate(int row, const std::vector<Cell>& sums);
    void prepareFloor();

    int _block;
    int _repeatX;
    int _repeatY;
    int _width;
    int _height;
    double _columns;  // to the full turn, and rows to the half: not whole where blocks do not divide the map
    double _rows;
    double _floor;                     // radiance
    std::unique_ptr<Cell[]> _cells;    // not cleared first: at 1024 columns that would take as long as the sums
    std::vector<osg::Vec2d> _azimuth;  // (cos, sin) of each fine column
    std::vector<osg::Vec2d> _azimuthSum;
    std::vector<osg::Vec3d> _polarSum;  // over rows, of solid angle times (sin, cos, 1)
};

}  // namespace osgEnvLight
