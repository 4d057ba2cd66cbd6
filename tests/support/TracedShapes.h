// SPDX-License-Identifier: MIT
// Bodies for rays on the CPU.
#pragma once

#include "indirect/TracedScene.h"

#include <cmath>

/** A surface of its own of that many triangles more. */
inline unsigned addSurface(osgEnvLight::TracedScene& scene, bool closed, float opacity = 1.0f)
{
    scene.surfaces.push_back({closed, opacity});
    return unsigned(scene.surfaces.size() - 1);
}

inline void addTriangle(osgEnvLight::TracedScene& scene, unsigned surface, const osg::Vec3f& a, const osg::Vec3f& b,
                        const osg::Vec3f& c)
{
    const auto first = unsigned(scene.positions.size());
    for (const osg::Vec3f& p : {a, b, c}) scene.positions.push_back(p);
    scene.triangles.push_back({first, first + 1, first + 2});
    scene.surfaceOf.push_back(surface);
}

/** A parallelogram that faces along across x up. */
inline void addQuad(osgEnvLight::TracedScene& scene, unsigned surface, const osg::Vec3f& corner, const osg::Vec3f& across,
                    const osg::Vec3f& up)
{
    addTriangle(scene, surface, corner, corner + across, corner + across + up);
    addTriangle(scene, surface, corner, corner + across + up, corner + up);
}

/** Six sides that face outwards, or, of a room, inwards. */
inline void addBox(osgEnvLight::TracedScene& scene, unsigned surface, const osg::Vec3f& low, const osg::Vec3f& high,
                   bool inwards = false)
{
    for (int axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true}) {
            osg::Vec3f corner = low, across, up;
            if (upper) corner[axis] = high[axis];
            across[(axis + 1) % 3] = high[(axis + 1) % 3] - low[(axis + 1) % 3];
            up[(axis + 2) % 3] = high[(axis + 2) % 3] - low[(axis + 2) % 3];
            if (upper != inwards)
                addQuad(scene, surface, corner, across, up);
            else
                addQuad(scene, surface, corner, up, across);
        }
}

/** Of side x 2 side quadrilaterals. */
inline void addSphere(osgEnvLight::TracedScene& scene, unsigned surface, const osg::Vec3f& center, float radius, int side)
{
    const auto at = [&](int i, int j) {
        const double polar = M_PI * i / side, azimuth = M_PI * (j % (2 * side)) / side;
        return center + osg::Vec3f(float(std::sin(polar) * std::cos(azimuth)), float(std::sin(polar) * std::sin(azimuth)),
                                   float(std::cos(polar))) *
                            radius;
    };
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < 2 * side; ++j) {
            if (i > 0) addTriangle(scene, surface, at(i, j), at(i + 1, j + 1), at(i, j + 1));
            if (i < side - 1) addTriangle(scene, surface, at(i, j), at(i + 1, j), at(i + 1, j + 1));
        }
}
