// SPDX-License-Identifier: MIT
#include "environment/MomentTable.h"

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// A real coordinate as the column or row before it and the share of the next.
struct Position {
    int cell;
    double share;

    Position(double x, int size) : cell(std::min(int(x), size - 1)), share(x - cell) {}
};

template <class T>
T linear(const std::vector<T>& sums, double x)
{
    const Position p(x, int(sums.size()) - 1);
    return sums[size_t(p.cell)] * (1.0 - p.share) + sums[size_t(p.cell) + 1] * p.share;
}

}  // namespace

int MomentTable::columnsFor(unsigned lights)
{
    return std::max(512, int(32.0 * std::sqrt(double(lights))));
}

MomentTable::MomentTable(const RadianceMap& map, int columns, double floor) : _floor(floor * map.meanOfChannels())
{
    _block = std::max({map.width / std::clamp(columns, 64, 1024), (map.width + 1023) / 1024, 1});
    _repeatX = map.width < 64 ? (63 + map.width) / map.width : 1;
    _repeatY = map.height < 32 ? (31 + map.height) / map.height : 1;
    _width = (map.width * _repeatX + _block - 1) / _block;
    _height = (map.height * _repeatY + _block - 1) / _block;
    _columns = double(map.width * _repeatX) / _block;
    _rows = double(map.height * _repeatY) / _block;
    const int fineWidth = map.width * _repeatX;
    _azimuth.resize(size_t(fineWidth));
    for (int x = 0; x < fineWidth; ++x) {
        const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2((x + 0.5) / fineWidth, 0.5));
        _azimuth[size_t(x)].set(d.x, d.y);
    }
    _cells.reset(new Cell[size_t(_width + 1) * size_t(_height + 1)]);
    std::vector<Cell> sums(size_t(_width) + 1, Cell{});
    std::copy(sums.begin(), sums.end(), &cell(0, 0));
    for (int y = 0; y < _height; ++y) {
        std::fill(sums.begin(), sums.end(), Cell{});
        const int end = std::min((y + 1) * _block, map.height * _repeatY);
        for (int row = y * _block; row < end; ++row) sumBlocks(map, row, sums);
        accumulate(y + 1, sums);
    }
    if (hasFloor()) prepareFloor();
}

// Adds a row of the map to the cells 1 .. width of a row of the table.
void MomentTable::sumBlocks(const RadianceMap& map, int row, std::vector<Cell>& sums) const
{
    const int fineWidth = int(_azimuth.size());
    const glsl::vec2 size(fineWidth, map.height * _repeatY);
    const double solidAngle = glsl::latlongTexelSolidAngle(row, size);
    const double theta = glsl::PI * (row + 0.5) / size.y;
    const double sinTheta = solidAngle * std::sin(theta) / 3.0;
    const double cosTheta = solidAngle * std::cos(theta) / 3.0;
    for (int bx = 0; bx < _width; ++bx) {
        double r = 0.0, g = 0.0, b = 0.0, lx = 0.0, ly = 0.0;
        const int end = std::min((bx + 1) * _block, fineWidth);
        for (int x = bx * _block; x < end; ++x) {
            const float* t = map.texel(_repeatX == 1 ? x : x / _repeatX, row / _repeatY);
            const double red = double(t[0]), green = double(t[1]), blue = double(t[2]);
            const double l = red + green + blue;
            const osg::Vec2d& a = _azimuth[size_t(x)];
            lx += l * a.x();
            ly += l * a.y();
            r += red;
            g += green;
            b += blue;
        }
        double* c = sums[size_t(bx) + 1].value;
        const double l = r + g + b;
        c[0] += l * solidAngle / 3.0;
        c[1] += lx * sinTheta;
        c[2] += ly * sinTheta;
        c[3] += l * cosTheta;
        c[4] += r * solidAngle;
        c[5] += g * solidAngle;
        c[6] += b * solidAngle;
    }
}

void MomentTable::accumulate(int row, const std::vector<Cell>& sums)
{
    Cell left{};
    for (int x = 0; x <= _width; ++x) {
        Cell& c = cell(x, row);
        const Cell& above = cell(x, row - 1);
        for (int k = 0; k < 8; ++k) {
            left.value[k] += sums[size_t(x)].value[k];
            c.value[k] = above.value[k] + left.value[k];
        }
    }
}

// The sums of a uniform map are products of a part of the column and a part of the row.
void MomentTable::prepareFloor()
{
    _azimuthSum.assign(size_t(_width) + 1, osg::Vec2d());
    for (int x = 0; x < _width; ++x) {
        const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2((x + 0.5) / _columns, 0.5));
        _azimuthSum[size_t(x) + 1] = _azimuthSum[size_t(x)] + osg::Vec2d(d.x, d.y);
    }
    _polarSum.assign(size_t(_height) + 1, osg::Vec3d());
    for (int y = 0; y < _height; ++y) {
        const double w = glsl::latlongTexelSolidAngle(y, glsl::vec2(_columns, _rows));
        const double theta = glsl::PI * (y + 0.5) / _rows;
        _polarSum[size_t(y) + 1] = _polarSum[size_t(y)] + osg::Vec3d(w * std::sin(theta), w * std::cos(theta), w);
    }
}

void MomentTable::at(double u, double v, double sign, Cell& sum) const
{
    const Position x(u, _width);
    const Position y(v, _height);
    const double w00 = sign * (1 - y.share) * (1 - x.share);
    const double w10 = sign * (1 - y.share) * x.share;
    const double w01 = sign * y.share * (1 - x.share);
    const double w11 = sign * y.share * x.share;
    const Cell& c00 = cell(x.cell, y.cell);
    const Cell& c10 = cell(x.cell + 1, y.cell);
    const Cell& c01 = cell(x.cell, y.cell + 1);
    const Cell& c11 = cell(x.cell + 1, y.cell + 1);
    for (int k = 0; k < 8; ++k) sum.value[k] += w00 * c00.value[k] + w10 * c10.value[k] + w01 * c01.value[k] + w11 * c11.value[k];
}

double MomentTable::fluxAt(double u, double v) const
{
    const Position x(u, _width);
    const Position y(v, _height);
    const double* c = cell(x.cell, y.cell).value;
    const double* d = cell(x.cell, y.cell + 1).value;
    return (1 - y.share) * ((1 - x.share) * c[0] + x.share * c[8]) + y.share * ((1 - x.share) * d[0] + x.share * d[8]);
}

Moments MomentTable::region(double u0, double v0, double u1, double v1) const
{
    Cell sum{};
    at(u1, v1, 1.0, sum);
    at(u0, v1, -1.0, sum);
    at(u1, v0, -1.0, sum);
    at(u0, v0, 1.0, sum);
    const double* s = sum.value;
    const Moments m = {s[0], osg::Vec3d(s[1], s[2], s[3]), osg::Vec3d(s[4], s[5], s[6])};
    return isDark(m) ? Moments() : m;
}

// Differences of the sums have the rounding of the brightest area: a few 1e-16 of the total.
bool MomentTable::isDark(const Moments& m) const
{
    return m.flux <= 1e-14 * cell(_width, _height).value[0];
}

Moments MomentTable::floorRegion(double u0, double v0, double u1, double v1) const
{
    Moments m;
    if (!hasFloor()) return m;
    const osg::Vec2d azimuth = linear(_azimuthSum, u1) - linear(_azimuthSum, u0);
    const osg::Vec3d polar = (linear(_polarSum, v1) - linear(_polarSum, v0)) * _floor;
    m.flux = polar[2] * (u1 - u0);
    m.vector.set(polar[0] * azimuth[0], polar[0] * azimuth[1], polar[1] * (u1 - u0));
    return m;
}

double MomentTable::deciding(double u0, double v0, double u1, double v1) const
{
    const double flux = fluxAt(u1, v1) - fluxAt(u0, v1) - fluxAt(u1, v0) + fluxAt(u0, v0);
    if (!hasFloor()) return flux;
    return flux + _floor * (u1 - u0) * (linear(_polarSum, v1)[2] - linear(_polarSum, v0)[2]);
}

osg::Vec2d MomentTable::extent(double u0, double v0, double u1, double v1) const
{
    const double theta0 = glsl::PI * v0 / _rows;
    const double theta1 = glsl::PI * v1 / _rows;
    const bool equator = theta0 < 0.5 * glsl::PI && theta1 > 0.5 * glsl::PI;
    return osg::Vec2d(glsl::TWO_PI * (u1 - u0) / _columns * (equator ? 1.0 : std::max(std::sin(theta0), std::sin(theta1))),
                      theta1 - theta0);
}

osg::Vec3d MomentTable::direction(double u, double v) const
{
    const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2(u / _columns, v / _rows));
    return osg::Vec3d(d.x, d.y, d.z);
}

}  // namespace osgEnvLight
