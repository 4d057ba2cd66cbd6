// SPDX-License-Identifier: MIT
// Every BRDF from smooth to rough: four rows of seven spheres before a seamless backdrop.
#include "Scene.h"

#include <cmath>

namespace scenes
{

namespace
{

constexpr int columns = 7;
constexpr double radius = 0.5, spacing = 1.25;

struct Row {
    const char* name;
    Material (*material)(double t);  // t from 0, smooth or dark, to 1, rough or bright
};

Material lambertAt(double t)
{
    const double albedo = 0.08 + 0.8 * t;
    return lambert(osg::Vec3d(albedo, albedo * 0.97, albedo * 0.92));
}

Material phongAt(double t)
{
    return phong({0.42, 0.05, 0.04}, 0.25, std::pow(10, 4 - 3 * t));
}

Material dielectricAt(double t)
{
    return cookTorrance({0.06, 0.2, 0.42}, 0, 0.02 + 0.98 * t);
}

Material metalAt(double t)
{
    return cookTorrance({1, 0.77, 0.34}, 1, t);
}

const std::vector<Row> rows{{"metal", metalAt}, {"dielectric", dielectricAt}, {"phong", phongAt}, {"lambert", lambertAt}};

std::string name(const Row& row, int column)
{
    return std::string(row.name) + "-" + std::to_string(column + 1);
}

std::map<std::string, Material> allMaterials()
{
    std::map<std::string, Material> materials{{"ground", lambert({0.4, 0.4, 0.41})}};
    for (const Row& row : rows)
        for (int i = 0; i < columns; ++i) materials[name(row, i)] = row.material(i / (columns - 1.0));
    return materials;
}

// A floor that bends up into a wall without an edge.
Mesh backdrop()
{
    const double halfWidth = 9, front = -7, back = 4, bend = 2.5, height = 3.5;
    const unsigned steps = 24;
    Mesh mesh;
    mesh.addGrid(1, steps + 2, [&](unsigned i, unsigned j) {
        const double angle = 0.5 * osg::PI * (j == 0 ? 0.0 : j > steps ? 1.0 : (j - 1.0) / (steps - 1));
        double y = back + bend * std::sin(angle), z = bend * (1 - std::cos(angle));
        if (j == 0) y = front;
        if (j == steps + 2) z = height;
        return Vertex{{i ? halfWidth : -halfWidth, y, z}, {0, -std::sin(angle), std::cos(angle)}, {}};
    });
    return mesh;
}

}  // namespace

Scene materialSpheres()
{
    Scene scene("spheres", {"studio", 20, 0.55, 0.86}, {{0, -11.5, 6.4}, {0, 0.0, 0.35}, 33}, allMaterials());
    const osg::ref_ptr<osg::Geometry> model = sphere(radius, 40).geometry();
    for (size_t j = 0; j < rows.size(); ++j)
        for (int i = 0; i < columns; ++i) {
            const osg::Vec3d centre((i - 0.5 * (columns - 1)) * spacing, (double(j) - 1.5) * spacing, radius);
            scene.add(model, name(rows[j], i), osg::Matrixd::translate(centre));
        }
    scene.add(backdrop(), "ground");
    return scene;
}

}  // namespace scenes
