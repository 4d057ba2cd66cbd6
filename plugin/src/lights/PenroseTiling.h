/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include "lights/PenroseTable.h"

#include <osg/Vec2d>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgEnvLight
{

/** Importance over the domain 0 <= x < 2, 0 <= y < 1: width x height cells, and the largest under any rectangle from a
 * pyramid of maxima, so that no tile that covers a small lamp is passed over.*/
class OSGENVLIGHT_EXPORT ImportanceGrid
{
  public:
    /** @param values  by y * width + x, >= 0, in any unit*/
    ImportanceGrid(int width, int height, const std::vector<double>& values);

    size_t cells() const { return _levels[0].values.size(); }
    size_t cellAt(double x, double y) const;
    osg::Vec2d centre(size_t cell) const;
    /** In units of the mean. */
    double importance(size_t cell) const { return double(_levels[0].values[cell]); }
    /** An upper bound of all within the rectangle, 0 outside the domain: exact, or of a somewhat larger one. */
    double maximum(double x0, double y0, double x1, double y1) const;
    /** Take a cell out. */
    void clear(size_t cell);

  private:
    struct Level {
        int width;
        int height;
        std::vector<float> values;

        float& at(int x, int y) { return values[size_t(y) * size_t(width) + size_t(x)]; }
        const float& at(int x, int y) const { return values[size_t(y) * size_t(width) + size_t(x)]; }
    };
    void pull(size_t level, int x, int y);

    std::vector<Level> _levels;
};

/** A sampling tile of the tiling: a vertex, and what its correction is found by. */
struct PenrosePoint {
    osg::Vec2d vertex;
    uint64_t rank;             // the Fibonacci code as a number: the density at which the point appears
    size_t cell;               // of the importance grid
    int turn;                  // of the tile [18 degrees]
    double scale;              // of the tile
    unsigned importanceIndex;  // between two levels of subdivision, 0..20
    unsigned structuralIndex;  // last six digits of the Fibonacci code as a number, 0..20
};

struct PenroseRule {
    /** At most one point in a cell of the grid: for lights that gather the flux around them, where a second light within
     * the resolution of the map has nothing to give. Else as many as the importance asks for.*/
    bool onePerCell = true;
};

/** The points of the Penrose tiling with the least rank over importance [Ostromoukhov, Donohue, Jodoin 2004].
 *
 * Triangles of Robinson's two shapes are subdivided by six rules; some rules leave a sampling tile at a vertex, numbered by
 * the digits gathered on the way down, read in the Fibonacci number system, last digit first. The paper accepts a tile
 * where the importance exceeds its number. A tile keeps its number at every later level, so here tiles come out of a queue
 * by number over importance: any count is exact, without a search for the scale of the importance.
 *
 * Subdivision ends at level 31, where a tile is 1e-6 across; with one point per cell at a density of four tiles a cell,
 * after which cells still without a point get one at their centre, the most important first. In the order of choice; fewer
 * than count where the tiling, or the cells with importance, run out.*/
OSGENVLIGHT_EXPORT std::vector<PenrosePoint> choosePenrosePoints(ImportanceGrid grid, size_t count, const PenroseRule& rule);

/** Where the point is put: moved within its tile by the table; at the vertex where that would leave the domain above or
 * below. May lie beyond x = 0 or 2.*/
OSGENVLIGHT_EXPORT osg::Vec2d correctedPosition(const PenrosePoint& point, const PenroseTable& table);

}  // namespace osgEnvLight
