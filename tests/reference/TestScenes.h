// SPDX-License-Identifier: MIT
// Ten scenes, made by code, of what light can do.
#pragma once

#include <osg/Group>

#include <string>
#include <vector>

struct TestScene {
    std::string name;
    osg::ref_ptr<osg::Node> node;
    osg::Vec3d eye;
    osg::Vec3d target;
};

/** Sphere on a plane, glossy metal, mirror, Phong, transparent pane, alpha-tested fence, lit interior, grid of boxes, thin
 * bars, rough dielectric in a corner.*/
std::vector<TestScene> testScenes();
