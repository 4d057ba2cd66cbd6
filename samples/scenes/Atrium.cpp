// SPDX-License-Identifier: MIT
// A court with two storeys of arcades around it: light comes in from above alone, and most of what gives shade is out of
// the picture.
#include "Scene.h"

#include <cmath>

namespace scenes
{

namespace
{

constexpr double bay = 2.8, halfX = 2.5 * bay, halfY = 1.5 * bay;  // the court
constexpr double outerX = 12, outerY = 8, wall = 0.4;
constexpr double storey = 4.4, slab = 0.35, springing = 2.35, archRadius = 1.1;

const std::map<std::string, Material> atriumMaterials{{"plaster", lambert({0.76, 0.69, 0.58})},
                                                      {"stone", lambert({0.78, 0.75, 0.69})},
                                                      {"terracotta", lambert({0.52, 0.22, 0.13})},
                                                      {"ochre", lambert({0.66, 0.46, 0.2})},
                                                      {"ceiling", lambert({0.82, 0.81, 0.78})},
                                                      {"dark tile", phong({0.13, 0.12, 0.12}, 0.08, 400)},
                                                      {"light tile", phong({0.55, 0.5, 0.43}, 0.08, 400)},
                                                      {"bronze", cookTorrance({0.66, 0.47, 0.28}, 1, 0.35)},
                                                      {"water", cookTorrance({0.03, 0.07, 0.07}, 0, 0.04)}};

Mesh column()
{
    const std::vector<ProfilePoint> profile{{0, 0, true},       {0.29, 0, true},     {0.29, 0.1, true},   {0.265, 0.12, true},
                                            {0.28, 0.165},      {0.255, 0.21, true}, {0.225, 0.22, true}, {0.222, 0.6, true},
                                            {0.205, 1.4, true}, {0.185, 2.02, true}, {0.21, 2.03, true},  {0.21, 2.07, true},
                                            {0.19, 2.08, true}, {0.215, 2.16},       {0.275, 2.22, true}};
    Mesh mesh = lathe(profile, 40, 5);
    mesh.add(box({-0.29, -0.29, 2.22}, {0.29, 0.29, springing}, 0.015, 2));
    return mesh;
}

// The middle of each bay, and of each column, around the court; turned so that the arcade runs along x.
struct Place {
    double x, y, turn;
};

std::vector<Place> bays()
{
    std::vector<Place> result;
    for (double side : {-1.0, 1.0}) {
        for (int i = -2; i <= 2; ++i) result.push_back({i * bay, side * halfY, 0});
        for (int i = -1; i <= 1; ++i) result.push_back({side * halfX, i * bay, 90});
    }
    return result;
}

std::vector<Place> columnPlaces()
{
    std::vector<Place> result;
    for (double side : {-1.0, 1.0}) {
        for (int i = 0; i <= 5; ++i) result.push_back({-halfX + i * bay, side * halfY, 0});
        for (int i = 1; i <= 2; ++i) result.push_back({side * halfX, -halfY + i * bay, 0});
    }
    return result;
}

osg::Matrixd placement(const Place& p, double z)
{
    return osg::Matrixd::rotate(osg::DegreesToRadians(p.turn), osg::Z_AXIS) * osg::Matrixd::translate(p.x, p.y, z);
}

// Boxes that leave the court open.
Mesh ring(double inner, double bottom, double top)
{
    const double x = halfX + inner, y = halfY + inner;
    Mesh mesh;
    mesh.add(box({-outerX, -outerY, bottom}, {outerX, -y, top}));
    mesh.add(box({-outerX, y, bottom}, {outerX, outerY, top}));
    mesh.add(box({-outerX, -y, bottom}, {-x, y, top}));
    mesh.add(box({x, -y, bottom}, {outerX, y, top}));
    return mesh;
}

void addArcades(Scene& scene)
{
    const Mesh over = arch(bay, storey - slab - springing, 0.42, archRadius, 16);
    const osg::ref_ptr<osg::Geometry> model = column().geometry();
    Mesh arches, rails;
    for (int floor = 0; floor < 2; ++floor) {
        for (double x : {-halfX, halfX})
            for (double y : {-halfY, halfY})
                arches.add(
                    box({x - 0.21, y - 0.21, floor * storey + springing}, {x + 0.21, y + 0.21, (floor + 1) * storey - slab}));
        for (const Place& p : bays()) {
            arches.add(over, placement(p, floor * storey + springing));
            if (floor == 0) continue;
            Mesh rail;
            rail.add(tube({{-0.5 * bay, 0, 0.95}, {0.5 * bay, 0, 0.95}}, 0.035, 16, 1));
            for (int i = -4; i <= 4; ++i) rail.add(tube({{i * 0.27, 0, 0}, {i * 0.27, 0, 0.95}}, 0.014, 12, 1));
            rails.add(rail, placement(p, storey));
        }
        for (const Place& p : columnPlaces()) scene.add(model, "stone", placement(p, floor * storey));
    }
    scene.add(arches, "plaster");
    scene.add(rails, "bronze");
}

void addShell(Scene& scene)
{
    const double top = 2 * storey;
    scene.add(ring(-0.25, storey - slab, storey - 0.05), "ceiling");
    scene.add(ring(-0.3, storey - 0.05, storey), "light tile");
    scene.add(ring(-0.25, top - slab, top), "ceiling");
    scene.add(ring(-0.4, top, top + 0.25), "stone");
    Mesh ends, sides;
    for (double side : {-1.0, 1.0}) {
        ends.add(box({side * outerX - 0.5 * wall, -outerY, 0}, {side * outerX + 0.5 * wall, outerY, top}));
        sides.add(box({-outerX, side * outerY - 0.5 * wall, 0}, {outerX, side * outerY + 0.5 * wall, top}));
    }
    scene.add(ends, "terracotta");
    scene.add(sides, "ochre");
}

void addFloor(Scene& scene)
{
    const int nx = 24, ny = 16;
    Mesh tiles[2];
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) tiles[(i + j) % 2].addQuad({i - 12.0, j - 8.0, 0}, {1, 0, 0}, {0, 1, 0});
    scene.add(tiles[0], "light tile");
    scene.add(tiles[1], "dark tile");
}

void addFountain(Scene& scene)
{
    scene.add(lathe({{0, 0, true},
                     {1.5, 0, true},
                     {1.5, 0.12, true},
                     {1.35, 0.16},
                     {1.4, 0.5},
                     {1.5, 0.56, true},
                     {1.38, 0.58, true},
                     {1.28, 0.5},
                     {1.2, 0.2, true},
                     {0, 0.2, true}},
                    96, 6),
              "stone");
    scene.add(lathe({{0, 0.2, true},
                     {0.2, 0.2, true},
                     {0.14, 0.35},
                     {0.1, 0.8},
                     {0.16, 1.05},
                     {0.6, 1.2},
                     {0.66, 1.27, true},
                     {0.6, 1.27, true},
                     {0.3, 1.17},
                     {0, 1.14}},
                    64, 6),
              "bronze");
    scene.add(lathe({{0, 0.47, true}, {1.27, 0.47, true}}, 96, 1), "water");
}

}  // namespace

Scene atrium()
{
    Scene scene("atrium", {"sky", -50, 0.6, 2.6}, {{-10.4, -6.5, 1.75}, {-1.5, -2.6, 1.85}, 58}, atriumMaterials);
    addFloor(scene);
    addArcades(scene);
    addShell(scene);
    addFountain(scene);
    return scene;
}

}  // namespace scenes
