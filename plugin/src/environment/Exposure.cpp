// SPDX-License-Identifier: MIT
#include "environment/Exposure.h"

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const int columns = 64;
const int rows = 32;
const int orientations = 512;

struct Cell {
    osg::Vec3d direction;
    osg::Vec3d flux;
};

// Flux of the map's cells, each from its flux centroid.
std::vector<Cell> cellsOf(const RadianceMap& map)
{
    std::vector<Cell> cells(size_t(columns * rows));
    std::vector<osg::Vec3d> sums(cells.size());
    for (int y = 0; y < map.height; ++y) {
        const double top = osg::PI * y / map.height, bottom = osg::PI * (y + 1) / map.height;
        const double solidAngle = 2.0 * osg::PI / map.width * (std::cos(top) - std::cos(bottom));
        const double theta = 0.5 * (top + bottom);
        const size_t row = size_t(columns * (y * rows / map.height));
        for (int x = 0; x < map.width; ++x) {
            const float* t = map.texel(x, y);
            const osg::Vec3d flux = osg::Vec3d(double(t[0]), double(t[1]), double(t[2])) * solidAngle;
            const double weight = flux[0] + flux[1] + flux[2];
            if (!(weight > 0.0)) continue;
            const double phi = 2.0 * osg::PI * (0.5 - (x + 0.5) / map.width);  // the centre is +X
            const size_t cell = row + size_t(x * columns / map.width);
            cells[cell].flux += flux;
            sums[cell] += osg::Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)) * weight;
        }
    }
    std::vector<Cell> lit;
    for (size_t i = 0; i < cells.size(); ++i) {
        if (!(sums[i].length2() > 0.0)) continue;
        cells[i].direction = sums[i] / sums[i].length();
        lit.push_back(cells[i]);
    }
    return lit;
}

double radiosity(const std::vector<Cell>& cells, const osg::Vec3d& normal)
{
    osg::Vec3d sum;
    for (const Cell& cell : cells) sum += cell.flux * std::max(cell.direction * normal, 0.0);
    return std::max({sum[0], sum[1], sum[2]}) / osg::PI;
}

}  // namespace

Radiosity Radiosity::of(const RadianceMap& map)
{
    const std::vector<Cell> cells = cellsOf(map);
    Radiosity result;
    const osg::Vec3d mean = map.flux / (4.0 * osg::PI);
    result.mean = std::max({mean[0], mean[1], mean[2]});
    const double golden = osg::PI * (3.0 - std::sqrt(5.0));
    for (int i = 0; i < orientations; ++i) {  // a Fibonacci lattice
        const double z = 1.0 - (2.0 * i + 1.0) / orientations;
        const double r = std::sqrt(1.0 - z * z);
        const osg::Vec3d normal(r * std::cos(golden * i), r * std::sin(golden * i), z);
        result.greatest = std::max(result.greatest, radiosity(cells, normal));
    }
    return result;
}

double mapExposure(const RadianceMap& map)
{
    const Radiosity radiosity = Radiosity::of(map);
    const double middle = std::sqrt(radiosity.mean) * std::sqrt(radiosity.greatest);
    return middle > 0.0 ? std::log2(glsl::METERED_WHITE / middle) : 0.0;
}

}  // namespace osgEnvLight
