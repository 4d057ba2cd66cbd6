// SPDX-License-Identifier: MIT
#include "PenroseRelaxation.h"

#include "lights/PenroseTiling.h"

#include <algorithm>
#include <cmath>

using osgEnvLight::PenrosePoint;
using osgEnvLight::PenroseTable;

namespace
{

const int rows = 192;  // of the raster that stands for the domain
const int rounds = 30;
const double fewest = 491.0;  // points; each density lies in the middle of its importance index
// Lloyd's steps are too short; by this factor the same rounds come three times as far.
const double stretch = 1.8;

// Sums of the raster's points nearest to each of the points; these lie in buckets of about one point each.
class VoronoiRaster
{
  public:
    explicit VoronoiRaster(const std::vector<osg::Vec2d>& points)
        : _points(points), _rows(std::max(1, int(std::sqrt(double(points.size()) / 2.0)))), _buckets(size_t(2 * _rows * _rows))
    {
        for (size_t i = 0; i < points.size(); ++i) bucket(column(points[i].x()), row(points[i].y())).push_back(i);
    }

    /** By point. */
    std::vector<osg::Vec2d> centroids() const
    {
        std::vector<osg::Vec2d> sums(_points.size());
        std::vector<double> counts(_points.size(), 0.0);
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < 2 * rows; ++x) {
                const osg::Vec2d p((x + 0.5) / rows, (y + 0.5) / rows);
                const size_t i = nearest(p);
                sums[i] += p;
                counts[i] += 1.0;
            }
        for (size_t i = 0; i < sums.size(); ++i) sums[i] = counts[i] > 0.0 ? sums[i] / counts[i] : _points[i];
        return sums;
    }

  private:
    int column(double x) const { return std::clamp(int(x * _rows), 0, 2 * _rows - 1); }
    int row(double y) const { return std::clamp(int(y * _rows), 0, _rows - 1); }
    std::vector<size_t>& bucket(int x, int y) { return _buckets[size_t(y * 2 * _rows + x)]; }

    size_t nearest(const osg::Vec2d& p) const
    {
        size_t best = 0;
        double least = 1e30;
        const int cx = column(p.x());
        const int cy = row(p.y());
        // Until the next ring of buckets is farther than the nearest point.
        for (int ring = 0; ring <= 2 * _rows && (ring == 0 || least > (ring - 1.0) * (ring - 1.0) / (_rows * _rows)); ++ring)
            for (int y = std::max(cy - ring, 0); y <= std::min(cy + ring, _rows - 1); ++y)
                for (int x = std::max(cx - ring, 0); x <= std::min(cx + ring, 2 * _rows - 1); ++x) {
                    if (std::max(std::abs(x - cx), std::abs(y - cy)) != ring) continue;
                    for (size_t i : _buckets[size_t(y * 2 * _rows + x)]) {
                        const double d = (_points[i] - p).length2();
                        if (d < least) {
                            least = d;
                            best = i;
                        }
                    }
                }
        return best;
    }

    const std::vector<osg::Vec2d>& _points;
    int _rows;
    std::vector<std::vector<size_t>> _buckets;
};

// One step: the table's row moves by the mean way of its points, those near the border left out.
void relax(const std::vector<PenrosePoint>& points, PenroseTable& table)
{
    std::vector<osg::Vec2d> positions;
    for (const PenrosePoint& p : points) positions.push_back(correctedPosition(p, table));
    const std::vector<osg::Vec2d> centroids = VoronoiRaster(positions).centroids();
    const double border = 2.0 * std::sqrt(2.0 / double(points.size()));
    double ways[21][21][2] = {};
    double counts[21][21] = {};
    for (size_t i = 0; i < points.size(); ++i) {
        const PenrosePoint& p = points[i];
        const osg::Vec2d& at = positions[i];
        if (at.x() < border || at.x() > 2.0 - border || at.y() < border || at.y() > 1.0 - border) continue;
        const osg::Vec2d way = (centroids[i] - at) / p.scale;
        const double angle = osg::PI / 10.0 * p.turn;
        ways[p.importanceIndex][p.structuralIndex][0] += way.x() * std::cos(angle) + way.y() * std::sin(angle);
        ways[p.importanceIndex][p.structuralIndex][1] += way.y() * std::cos(angle) - way.x() * std::sin(angle);
        counts[p.importanceIndex][p.structuralIndex] += 1.0;
    }
    for (size_t i = 0; i < 21; ++i)
        for (size_t s = 0; s < 21; ++s)
            for (size_t k = 0; k < 2; ++k)
                if (counts[i][s] > 0.0) table.shift[i][s][k] += float(stretch * ways[i][s][k] / counts[i][s]);
}

}  // namespace

void relaxPenroseRow(unsigned density, PenroseTable& table)
{
    osgEnvLight::PenroseRule rule;
    rule.onePerCell = false;
    const size_t count = size_t(fewest * std::pow(2.6180339887498949, density / 21.0));
    const auto points = choosePenrosePoints(osgEnvLight::ImportanceGrid(1, 1, {1.0}), count, rule);
    for (int round = 0; round < rounds; ++round) relax(points, table);
}

PenroseTable relaxedPenroseTable()
{
    PenroseTable table = {};
    for (unsigned density = 0; density < 21; ++density) relaxPenroseRow(density, table);
    return table;
}
