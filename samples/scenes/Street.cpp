// SPDX-License-Identifier: MIT
// A street at night, lit by what glows in it: neon tubes, shop windows, a sign, paper lanterns and a street lamp. No light is
// set.
#include "Scene.h"

#include <cmath>

namespace scenes
{

namespace
{

constexpr double kerb = -2.0, front = 0.0, roadHeight = -0.12, halfLength = 7.0;  // y of the kerb and the facade, z, x

const std::map<std::string, Material> streetMaterials{{"asphalt", cookTorrance({0.05, 0.05, 0.055}, 0, 0.4)},
                                                      {"stone", cookTorrance({0.22, 0.21, 0.2}, 0, 0.5)},
                                                      {"brick", lambert({0.32, 0.17, 0.12})},
                                                      {"frame", cookTorrance({0.05, 0.07, 0.06}, 0, 0.3)},
                                                      {"door", cookTorrance({0.04, 0.13, 0.12}, 0, 0.25)},
                                                      {"steel", cookTorrance({0.62, 0.6, 0.58}, 1, 0.22)},
                                                      {"wood", cookTorrance({0.3, 0.17, 0.08}, 0, 0.4)},
                                                      {"bottle", cookTorrance({0.03, 0.09, 0.05}, 0, 0.1)},
                                                      {"shop", glow({1.1, 0.7, 0.36})},
                                                      {"pink", glow({9, 0.9, 3})},
                                                      {"cyan", glow({0.6, 4.5, 6})},
                                                      {"sign", glow({0.5, 2.2, 0.7})},
                                                      {"lantern", glow({5, 1.5, 0.3})},
                                                      {"globe", glow({7, 6, 4.5})}};

struct Opening {
    double left, right, low, high;
};
constexpr Opening shopWindow = {-3.6, -0.9, 0.6, 2.5}, door = {0.1, 1.2, 0.0, 2.3}, secondWindow = {2.1, 4.4, 0.6, 2.5};

// A facade about openings from left to right.
void addFacade(Scene& scene)
{
    const double top = 5.5, depth = 0.35;
    Mesh facade, frames;
    double from = -halfLength;
    const auto block = [&](double left, double right, double low, double high) {
        facade.add(box({left, front, low}, {right, front + depth, high}));
    };
    for (const Opening& o : {shopWindow, door, secondWindow}) {
        block(from, o.left, 0, top);
        block(o.left, o.right, o.high, top);
        if (o.low > 0) block(o.left, o.right, 0, o.low);
        const double t = 0.07;
        for (double x : {o.left, o.right - t}) frames.add(box({x, front - 0.04, o.low}, {x + t, front + 0.08, o.high}));
        for (double z : {o.low, o.high - t}) frames.add(box({o.left, front - 0.04, z}, {o.right, front + 0.08, z + t}));
        from = o.right;
    }
    block(from, halfLength, 0, top);
    for (const Opening& o : {shopWindow, secondWindow}) {
        const double middle = 0.5 * (o.left + o.right);
        frames.add(box({middle - 0.03, front, o.low}, {middle + 0.03, front + 0.06, o.high}));
        frames.add(box({o.left - 0.1, front - 0.18, o.low - 0.06}, {o.right + 0.1, front + 0.1, o.low}));
    }
    scene.add(facade, "brick");
    scene.add(frames, "frame");
    scene.add(box({door.left, front + 0.12, 0}, {door.right, front + 0.18, door.high}), "door");
}

// A lit panel at the back of each window, and what stands before it.
void addShops(Scene& scene)
{
    for (const Opening& o : {shopWindow, secondWindow}) {
        Mesh panel;
        panel.addQuad({o.left, front + 0.34, o.low}, {o.right - o.left, 0, 0}, {0, 0, o.high - o.low});
        scene.add(panel, "shop");
        scene.add(box({o.left, front + 0.1, 1.5}, {o.right, front + 0.3, 1.54}), "wood");
    }
    const Mesh bottle =
        lathe({{0.04, 0, true}, {0.045, 0.02}, {0.045, 0.18}, {0.015, 0.25}, {0.015, 0.32, true}, {0, 0.32}}, 24, 3);
    for (int i = 0; i < 9; ++i) scene.add(bottle.geometry(), "bottle", osg::Matrixd::translate(-3.4 + 0.3 * i, 0.2, 1.54));
    for (int i = 0; i < 5; ++i) scene.add(bottle.geometry(), "bottle", osg::Matrixd::translate(2.4 + 0.38 * i, 0.2, 0.6));
}

void addNeon(Scene& scene)
{
    std::vector<osg::Vec3d> ring, wave;
    for (int i = 0; i <= 20; ++i) {
        const double angle = 1.9 * osg::PI * i / 20;
        ring.emplace_back(0.65 + 0.38 * std::sin(angle), front - 0.25, 3.1 + 0.38 * std::cos(angle));
    }
    for (int i = 0; i <= 16; ++i) wave.emplace_back(-3.5 + 0.16 * i, front - 0.25, 3.05 + 0.16 * std::sin(0.25 * osg::PI * i));
    scene.add(tube(ring, 0.035, 12, 3), "pink");
    scene.add(tube(wave, 0.035, 12, 3), "cyan");
}

void addSign(Scene& scene)
{
    scene.add(box({4.9, front - 1.0, 2.6}, {5.0, front - 0.25, 4.4}), "sign");
    Mesh arms;
    for (double z : {2.8, 4.2}) arms.add(box({4.93, front - 0.25, z}, {4.97, front, z + 0.04}));
    scene.add(arms, "steel");
}

void addLanterns(Scene& scene)
{
    const osg::Vec3d from(-6.5, -0.9, 3.3), to(-3.9, -0.9, 3.3);
    std::vector<osg::Vec3d> cord;
    for (int i = 0; i <= 6; ++i) {
        const double t = i / 6.0;
        cord.push_back(from + (to - from) * t - osg::Vec3d(0, 0, 1.2 * t * (1 - t)));
    }
    scene.add(tube(cord, 0.01, 8, 2), "frame");
    for (int i = 1; i < 6; i += 2)
        scene.add(sphere(0.16, 20).geometry(), "lantern", osg::Matrixd::translate(cord[size_t(i)] - osg::Vec3d(0, 0, 0.2)));
}

void addStreet(Scene& scene)
{
    scene.add(box({-halfLength, -9, roadHeight - 0.1}, {halfLength, kerb, roadHeight}), "asphalt");
    Mesh pavement;
    pavement.add(box({-halfLength, kerb, roadHeight - 0.1}, {halfLength, front + 0.35, 0}));
    scene.add(pavement, "stone");
    Mesh bollards;
    for (int i = -3; i <= 3; ++i) bollards.add(cylinder(0.07, 0.85, 0.03, 32), osg::Vec3d(1.7 * i, kerb + 0.25, 0));
    scene.add(bollards, "steel");
    Mesh pole = cylinder(0.05, 3.0, 0, 24);
    pole.add(cylinder(0.1, 0.3, 0.02, 24));
    scene.add(pole.geometry(), "frame", osg::Matrixd::translate(2.9, kerb + 0.5, 0));
    scene.add(sphere(0.17, 24).geometry(), "globe", osg::Matrixd::translate(2.9, kerb + 0.5, 3.16));
    Mesh bench;
    for (int i = 0; i < 4; ++i) bench.add(box({-2.9, -0.85 + 0.13 * i, 0.42}, {-1.3, -0.75 + 0.13 * i, 0.46}, 0.01, 2));
    scene.add(bench, "wood");
    Mesh legs;
    for (double x : {-2.7, -1.55}) legs.add(box({x, -0.83, 0}, {x + 0.06, -0.38, 0.42}));
    scene.add(legs, "frame");
}

}  // namespace

Scene street()
{
    Scene scene("street", {"sky", 0, 0.01, 1.9}, {{-1.2, -7.2, 1.65}, {0.5, 0, 1.65}, 58}, streetMaterials);
    scene.set("areaPoints", 256);  // tubes near a wall need more than lamps that hang free
    addStreet(scene);
    addFacade(scene);
    addShops(scene);
    addNeon(scene);
    addSign(scene);
    addLanterns(scene);
    return scene;
}

}  // namespace scenes
