// SPDX-License-Identifier: MIT
// The animation of the method's paper: a chair that swings under its frame, whose shadow moves with it.
#include "Scene.h"

#include <osg/AnimationPath>
#include <osg/MatrixTransform>

#include <cmath>

namespace scenes
{

namespace
{

constexpr double beamHeight = 2.3, halfSpan = 1.35, period = 3.0, swing = 24;  // metres, seconds, degrees

const std::map<std::string, Material> swingMaterials{{"wood", lambert({0.42, 0.24, 0.12})},
                                                     {"lacquer", cookTorrance({0.55, 0.04, 0.03}, 0, 0.18)},
                                                     {"chrome", cookTorrance({0.9, 0.9, 0.92}, 1, 0.08)},
                                                     {"cushion", lambert({0.75, 0.7, 0.58})},
                                                     {"ground", phong({0.38, 0.4, 0.36}, 0.05, 25)}};

// Two trestles and a beam.
Mesh frame()
{
    const double leg = 0.055, foot = 0.85;
    Mesh mesh;
    for (double side : {-1.0, 1.0}) {
        for (double y : {-foot, foot})
            mesh.add(tube({{side * (halfSpan + 0.12), y, 0}, {side * halfSpan, 0, beamHeight + 0.03}}, leg, 32, 1));
        mesh.add(tube({{side * (halfSpan + 0.072), -0.51, 0.92}, {side * (halfSpan + 0.072), 0.51, 0.92}}, 0.035, 24, 1));
    }
    mesh.add(tube({{-halfSpan - 0.25, 0, beamHeight}, {halfSpan + 0.25, 0, beamHeight}}, 0.065, 32, 1));
    return mesh;
}

// Seat, back and arms, in coordinates of the pivot.
Mesh chair()
{
    const double halfWidth = 0.62, seat = -1.75;
    Mesh mesh;
    for (int i = 0; i < 6; ++i) {
        const double y = -0.28 + 0.1 * i;
        mesh.add(box({-halfWidth, y, seat}, {halfWidth, y + 0.085, seat + 0.03}, 0.008, 2));
    }
    for (int i = 0; i < 9; ++i) {
        const double x = -halfWidth + 0.06 + i * 0.1425;
        mesh.add(tube({{x, 0.29, seat + 0.02}, {x, 0.36, seat + 0.35}, {x, 0.46, seat + 0.72}}, 0.018, 16, 8));
    }
    mesh.add(tube({{-halfWidth, 0.46, seat + 0.72}, {0, 0.49, seat + 0.78}, {halfWidth, 0.46, seat + 0.72}}, 0.035, 24, 16));
    for (double side : {-1.0, 1.0}) {
        const double x = side * halfWidth;
        mesh.add(tube({{x, 0.42, seat + 0.3}, {x, 0.0, seat + 0.33}, {x, -0.27, seat + 0.27}, {x, -0.3, seat}}, 0.026, 20, 10));
        mesh.add(box({x - 0.025, -0.3, seat - 0.05}, {x + 0.025, 0.32, seat}, 0.008, 2));
    }
    return mesh;
}

Mesh rods()
{
    Mesh mesh;
    for (double side : {-1.0, 1.0})
        for (double y : {-0.24, 0.34})
            mesh.add(tube({{side * 0.62, y, y < 0 ? -1.47 : -1.42}, {side * 0.62, 0, 0}}, 0.011, 16, 1));
    return mesh;
}

// A pendulum of small angle, over one period.
osg::ref_ptr<osg::AnimationPath> path()
{
    osg::ref_ptr<osg::AnimationPath> result = new osg::AnimationPath;
    result->setLoopMode(osg::AnimationPath::LOOP);
    const int steps = 60;
    for (int i = 0; i <= steps; ++i) {
        const double angle = osg::DegreesToRadians(swing) * std::cos(2 * osg::PI * i / steps);
        result->insert(period * i / steps, osg::AnimationPath::ControlPoint(osg::Vec3d(), osg::Quat(angle, osg::X_AXIS)));
    }
    return result;
}

}  // namespace

Scene swing()
{
    Scene scene("swing", {"sky", 60, 0.42, 1.25}, {{3.2, -5.0, 2.0}, {0, 0, 1.08}, 32}, swingMaterials);
    osg::ref_ptr<osg::MatrixTransform> hung = new osg::MatrixTransform(osg::Matrixd::translate(0, 0, beamHeight));
    osg::ref_ptr<osg::MatrixTransform> pendulum = new osg::MatrixTransform;
    pendulum->setDataVariance(osg::Object::DYNAMIC);
    pendulum->setUpdateCallback(new osg::AnimationPathCallback(path()));
    hung->addChild(pendulum);
    scene.root()->addChild(hung);
    const std::vector<std::pair<Mesh, std::string>> parts{
        {chair(), "lacquer"}, {rods(), "chrome"}, {box({-0.5, -0.24, -1.72}, {0.5, 0.25, -1.64}, 0.035, 6), "cushion"}};
    for (const auto& [mesh, material] : parts) {
        osg::ref_ptr<osg::Group> part = new osg::Group;
        part->setName(material);
        part->setStateSet(scene.stateSet(material));
        part->addChild(mesh.geometry());
        pendulum->addChild(part);
    }
    scene.add(frame(), "wood");
    scene.add(box({-7, -7, -0.2}, {7, 7, 0}), "ground");
    return scene;
}

}  // namespace scenes
