// SPDX-License-Identifier: MIT
// A living room in the evening: a television that shows a sunset, a standard lamp, and a window with what is left of the day.
#include "Scene.h"

#include <cmath>

namespace scenes
{

namespace
{

constexpr double roomWidth = 5.2, roomDepth = 4.4, roomHeight = 2.6;  // x from the window, y away from the eye
constexpr double windowLow = 0.9, windowHigh = 2.2, windowFront = 1.4, windowBack = 3.2;

const std::map<std::string, Material> roomMaterials{{"plaster", lambert({0.72, 0.68, 0.6})},
                                                    {"ceiling", lambert({0.82, 0.81, 0.78})},
                                                    {"oak", cookTorrance({0.36, 0.22, 0.12}, 0, 0.22)},
                                                    {"walnut", cookTorrance({0.16, 0.09, 0.05}, 0, 0.3)},
                                                    {"cloth", lambert({0.2, 0.3, 0.36})},
                                                    {"rug", lambert({0.5, 0.18, 0.12})},
                                                    {"shade", lambert({0.85, 0.78, 0.62})},
                                                    {"black", cookTorrance({0.02, 0.02, 0.02}, 0, 0.15)},
                                                    {"brass", cookTorrance({0.89, 0.7, 0.37}, 1, 0.25)},
                                                    {"china", cookTorrance({0.8, 0.8, 0.78}, 0, 0.1)}};

// Walls have a thickness: light comes in by the window alone.
void addWalls(Scene& scene)
{
    const double t = 0.15;
    Mesh walls;
    walls.add(box({-t, roomDepth, 0}, {roomWidth + t, roomDepth + t, roomHeight}));
    walls.add(box({-t, -t, 0}, {roomWidth + t, 0, roomHeight}));
    walls.add(box({roomWidth, 0, 0}, {roomWidth + t, roomDepth, roomHeight}));
    walls.add(box({-t, 0, 0}, {0, roomDepth, windowLow}));
    walls.add(box({-t, 0, windowHigh}, {0, roomDepth, roomHeight}));
    walls.add(box({-t, 0, windowLow}, {0, windowFront, windowHigh}));
    walls.add(box({-t, windowBack, windowLow}, {0, roomDepth, windowHigh}));
    scene.add(walls, "plaster");
    scene.add(box({-t, -t, roomHeight}, {roomWidth + t, roomDepth + t, roomHeight + t}), "ceiling");
    scene.add(box({-t, -t, -t}, {roomWidth + t, roomDepth + t, 0}), "oak");
    Mesh frame;
    const double middle = 0.5 * (windowFront + windowBack), bar = 0.03;
    frame.add(box({-0.1, middle - bar, windowLow}, {-0.04, middle + bar, windowHigh}));
    frame.add(box({-0.14, windowFront - 0.05, windowLow - 0.04}, {0.12, windowBack + 0.05, windowLow}));
    scene.add(frame, "ceiling");
}

void addSofa(Scene& scene)
{
    Mesh sofa;
    sofa.add(box({0.3, 0.35, 0.12}, {1.15, 2.35, 0.42}, 0.05, 4));
    sofa.add(box({0.2, 0.3, 0.12}, {0.45, 2.4, 0.85}, 0.08, 4));
    for (double y : {0.2, 2.3}) sofa.add(box({0.25, y, 0.12}, {1.15, y + 0.2, 0.62}, 0.07, 4));
    for (double y : {0.45, 1.38}) sofa.add(box({0.42, y, 0.42}, {1.12, y + 0.88, 0.56}, 0.06, 4));
    scene.add(sofa, "cloth");
}

void addFurniture(Scene& scene)
{
    Mesh table;
    table.add(box({1.9, 1.5, 0.36}, {3.1, 2.2, 0.4}, 0.01, 2));
    for (double x : {1.95, 2.99})
        for (double y : {1.55, 2.09}) table.add(box({x, y, 0}, {x + 0.06, y + 0.06, 0.36}));
    scene.add(table, "walnut");
    scene.add(box({1.5, 1.0, 0}, {3.6, 2.8, 0.012}), "rug");
    scene.add(box({1.5, 3.95, 0.12}, {3.7, 4.38, 0.5}, 0.01, 2), "walnut");
    Mesh bowl = lathe({{0, 0.01, true}, {0.05, 0, true}, {0.12, 0.06}, {0.16, 0.11, true}, {0.15, 0.11, true}, {0, 0.02}}, 40, 4);
    scene.add(bowl.geometry(), "china", osg::Matrixd::translate(2.7, 1.9, 0.4));
    scene.add(sphere(0.045, 16).geometry(), "brass", osg::Matrixd::translate(2.2, 1.75, 0.445));
    addSofa(scene);
}

void addTelevision(Scene& scene)
{
    Mesh television;
    television.add(box({1.78, 4.14, 0.6}, {3.42, 4.2, 1.56}, 0.01, 2));
    television.add(box({2.3, 4.02, 0.5}, {2.9, 4.32, 0.52}, 0.005, 2));
    television.add(box({2.55, 4.15, 0.5}, {2.65, 4.19, 0.62}));
    scene.add(television, "black");
    scene.addLight(
        R"({ "name": "television", "shape": "rectangle", "center": [2.6, 4.135, 1.08], "u": [0.8, 0, 0], "v": [0, 0, 0.45], )"
        R"("radiance": [7, 7, 7], "image": "livingroom.png" })");
}

void addLamp(Scene& scene)
{
    const osg::Matrixd place = osg::Matrixd::translate(4.6, 3.7, 0);
    Mesh stand = cylinder(0.15, 0.03, 0.01, 40);
    stand.add(cylinder(0.015, 1.5, 0, 16));
    scene.add(stand.geometry(), "brass", place);
    // Open above and below.
    const Mesh shade =
        lathe({{0.22, 1.35, true}, {0.16, 1.7, true}, {0.155, 1.7, true}, {0.215, 1.35, true}, {0.22, 1.35, true}}, 48, 2);
    scene.add(shade.geometry(), "shade", place);
    scene.addLight(
        R"({ "name": "lamp", "shape": "sphere", "center": [4.6, 3.7, 1.52], "radius": 0.05, "radiance": [130, 85, 42] })");
}

double smooth(double from, double to, double x)
{
    const double t = std::min(std::max((x - from) / (to - from), 0.0), 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// A sun that sets behind hills, over water; x and y from 0 to 1, from the lower left.
osg::Vec3d sunset(double x, double y)
{
    const osg::Vec3d low(1, 0.45, 0.1), high(0.12, 0.16, 0.5), sun(1, 0.85, 0.5), hill(0.05, 0.04, 0.07);
    const double shore = 0.36, up = std::abs(y - shore);  // the water mirrors the sky
    const double ripple = y < shore ? 0.01 * std::sin(400 * y * y) : 0.0;
    osg::Vec3d c = low * (1 - smooth(0, 0.6, up)) + high * smooth(0, 0.6, up);
    const double far = std::hypot(1.78 * (x + ripple - 0.62), up - 0.2);
    c += (sun - c) * (1 - smooth(0.085, 0.095, far)) + low * (0.5 * std::exp(-12 * far));
    const double crest = 0.09 + 0.05 * std::sin(5 * x + 1) + 0.03 * std::sin(13 * x) + 0.012 * std::sin(37 * x);
    if (up < crest) c = hill;
    return y < shore ? c * 0.7 + osg::Vec3d(0.02, 0.04, 0.08) : c;
}

osg::ref_ptr<osg::Image> picture()
{
    const int columns = 480, rows = 270;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(columns, rows, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const osg::Vec3d c = sunset((x + 0.5) / columns, (y + 0.5) / rows);
            for (int k = 0; k < 3; ++k)
                image->data(unsigned(x), unsigned(y))[k] = static_cast<unsigned char>(std::min(c[k], 1.0) * 255 + 0.5);
        }
    return image;
}

}  // namespace

Scene livingRoom()
{
    Scene scene("livingroom", {"sky", 200, 0.12, 2.2}, {{4.7, 0.35, 1.55}, {2.2, 3.0, 0.75}, 62}, roomMaterials);
    addWalls(scene);
    addFurniture(scene);
    addTelevision(scene);
    addLamp(scene);
    scene.addImage("livingroom.png", picture());
    return scene;
}

}  // namespace scenes
