// SPDX-License-Identifier: MIT
#include "surface/CoarseMesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace osgEnvLight
{

namespace
{

using Mesh = CasterMesh;
using Triangle = CasterMesh::Triangle;

const int mostHalvings = 8;
const double mostChange = 0.1;   // of a caster's area
const double meanWeight = 1e-3;  // of the mean beside the planes: rounding errors stay below it

osg::Vec3d normalOf(const Mesh& mesh, const Triangle& t)
{
    const osg::Vec3d a = mesh.positions[t[0]];
    return (osg::Vec3d(mesh.positions[t[1]]) - a) ^ (osg::Vec3d(mesh.positions[t[2]]) - a);
}

// Of the surface at each vertex, of unit length: the mean over the triangles that meet at its place, by their areas.
std::vector<osg::Vec3d> surfaceNormals(const Mesh& mesh)
{
    const std::vector<unsigned> places = placesOf(mesh);
    std::vector<osg::Vec3d> sums(places.size()), normals;
    for (const Triangle& t : mesh.triangles)
        for (unsigned v : t) sums[places[v]] += normalOf(mesh, t);
    for (osg::Vec3d& sum : sums) sum.normalize();
    for (unsigned place : places) normals.push_back(sums[place]);
    return normals;
}

double area(const Mesh& mesh)
{
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) sum += 0.5 * normalOf(mesh, t).length();
    return sum;
}

// The ways that the vertices in a cube of the grid face. If some face against the others, they are a cell of their own. Else the
// two sides of a thin wall would become one, and light from one side would end within it.
struct Cube {
    osg::Vec3d least, most;  // components of unit normals, and 0

    void add(const osg::Vec3d& normal)
    {
        for (int k = 0; k < 3; ++k) {
            least[k] = std::min(least[k], normal[k]);
            most[k] = std::max(most[k], normal[k]);
        }
    }

    // 1 for those against the axis along which the cube's vertices face both ways most, else 0.
    unsigned side(const osg::Vec3d& normal) const
    {
        double opposed = 0.25;
        unsigned side = 0;
        for (int k = 0; k < 3; ++k) {
            if (std::min(-least[k], most[k]) <= opposed) continue;
            opposed = std::min(-least[k], most[k]);
            side = normal[k] < 0.0 ? 1 : 0;
        }
        return side;
    }
};

// The mean of a cell's vertices, and the quadric of the planes of the triangles that have a corner in it: the sum of their
// squared distances from a place about the mean, weighted by the triangles' areas [Garland and Heckbert 1997].
struct Cell {
    osg::Vec3d mean;
    double count = 0.0;
    double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
    osg::Vec3d right;

    void addPlane(const osg::Vec3d& unit, double area, const osg::Vec3d& point)
    {
        xx += area * unit.x() * unit.x();
        yy += area * unit.y() * unit.y();
        zz += area * unit.z() * unit.z();
        xy += area * unit.x() * unit.y();
        xz += area * unit.x() * unit.z();
        yz += area * unit.y() * unit.z();
        right += unit * (area * (unit * (point - mean)));
    }

    // Where the planes meet, no further than reach from the mean along each axis; the mean along directions of which they say
    // nothing.
    osg::Vec3d place(double reach) const
    {
        const double weight = meanWeight * (xx + yy + zz);
        if (!(weight > 0.0)) return mean;
        const osg::Vec3d a(xx + weight, xy, xz), b(xy, yy + weight, yz), c(xz, yz, zz + weight);
        const osg::Vec3d bc = b ^ c;
        osg::Vec3d offset = (bc * right.x() + (c ^ a) * right.y() + (a ^ b) * right.z()) / (a * bc);
        for (int k = 0; k < 3; ++k) offset[k] = std::clamp(offset[k], -reach, reach);
        return mean + offset;
    }
};

struct KeyHash {
    size_t operator()(const std::array<long, 3>& key) const
    {
        return size_t(key[0]) * 73856093u ^ size_t(key[1]) * 19349663u ^ size_t(key[2]) * 83492791u;
    }
};

// The cells of a mesh, and in which one each vertex is that a triangle uses.
struct Cells {
    std::vector<Cell> cells;
    std::vector<unsigned> of;

    // normals: of the surface at the vertices
    Cells(const Mesh& mesh, const std::vector<osg::Vec3d>& normals, double size) : of(mesh.positions.size(), unset)
    {
        const std::vector<Cube> cubes = findCubes(mesh, normals, size);
        std::vector<unsigned> numbers(2 * cubes.size(), unset);
        for (size_t v = 0; v < of.size(); ++v) {
            if (of[v] == unset) continue;
            unsigned& number = numbers[2 * of[v] + cubes[of[v]].side(normals[v])];
            if (number == unset) {
                number = unsigned(cells.size());
                cells.emplace_back();
            }
            of[v] = number;
            cells[number].mean += mesh.positions[v];
            ++cells[number].count;
        }
        for (Cell& cell : cells) cell.mean /= cell.count;
        for (const Triangle& t : mesh.triangles) addPlane(mesh, t);
    }

  private:
    static constexpr unsigned unset = ~0u;

    // Puts their numbers into `of`.
    std::vector<Cube> findCubes(const Mesh& mesh, const std::vector<osg::Vec3d>& normals, double size)
    {
        std::vector<Cube> cubes;
        std::unordered_map<std::array<long, 3>, unsigned, KeyHash> numbers(mesh.positions.size());
        for (const Triangle& t : mesh.triangles)
            for (unsigned v : t) {
                if (of[v] != unset) continue;
                const osg::Vec3f& p = mesh.positions[v];
                std::array<long, 3> key;
                for (int k = 0; k < 3; ++k) key[size_t(k)] = std::lround(double(p[k]) / size);
                of[v] = numbers.emplace(key, unsigned(cubes.size())).first->second;
                if (of[v] == cubes.size()) cubes.emplace_back();
                cubes[of[v]].add(normals[v]);
            }
        return cubes;
    }

    void addPlane(const Mesh& mesh, const Triangle& t)
    {
        osg::Vec3d normal = normalOf(mesh, t);
        const double twice = normal.normalize();
        if (!(twice > 0.0)) return;
        const unsigned a = of[t[0]], b = of[t[1]], c = of[t[2]];
        const osg::Vec3d point = mesh.positions[t[0]];
        cells[a].addPlane(normal, twice, point);
        if (b != a) cells[b].addPlane(normal, twice, point);
        if (c != a && c != b) cells[c].addPlane(normal, twice, point);
    }
};

// A vertex for each cell; triangles may be there several times. Corners keep their normals.
Mesh merged(const Mesh& mesh, const std::vector<osg::Vec3d>& normals, double size)
{
    const Cells cells(mesh, normals, size);
    Mesh result;
    for (const Cell& cell : cells.cells) result.positions.push_back(osg::Vec3f(cell.place(0.5 * size)));
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        Triangle m;
        for (size_t k = 0; k < 3; ++k) m[k] = cells.of[mesh.triangles[i][k]];
        if (m[0] == m[1] || m[1] == m[2] || m[2] == m[0]) continue;
        // The least number first: alike if it is there twice, and it still faces the same way.
        const auto first = std::min_element(m.begin(), m.end()) - m.begin();
        std::rotate(m.begin(), m.begin() + first, m.end());
        result.triangles.push_back(m);
        if (mesh.normals.empty()) continue;
        result.normals.push_back(mesh.normals[i]);
        std::rotate(result.normals.back().begin(), result.normals.back().begin() + first, result.normals.back().end());
    }
    return result;
}

void dropCopies(Mesh& mesh)
{
    std::vector<size_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return mesh.triangles[a] < mesh.triangles[b]; });
    const auto same = [&](size_t a, size_t b) { return mesh.triangles[a] == mesh.triangles[b]; };
    order.erase(std::unique(order.begin(), order.end(), same), order.end());
    Mesh once;
    for (size_t i : order) {
        once.triangles.push_back(mesh.triangles[i]);
        if (!mesh.normals.empty()) once.normals.push_back(mesh.normals[i]);
    }
    mesh.triangles.swap(once.triangles);
    mesh.normals.swap(once.normals);
}

}  // namespace

CasterMesh coarseMesh(const Caster& caster, const osg::Vec3d& origin, double cell)
{
    Mesh mesh = meshOf(caster, origin);
    const std::vector<osg::Vec3d> normals = surfaceNormals(mesh);
    const double whole = area(mesh);
    for (int halving = 0; halving < mostHalvings; ++halving, cell *= 0.5) {
        Mesh all = merged(mesh, normals, cell);
        Mesh coarse = all;
        dropCopies(coarse);
        if (coarse.triangles.size() >= mesh.triangles.size()) break;
        if (!(std::abs(area(coarse) - whole) <= mostChange * whole)) continue;
        std::vector<unsigned> own(all.positions.size());
        std::iota(own.begin(), own.end(), 0u);
        coarse.closed = isClosed(all, own);
        return coarse;
    }
    return mesh;
}

}  // namespace osgEnvLight
