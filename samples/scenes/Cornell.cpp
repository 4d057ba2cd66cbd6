// SPDX-License-Identifier: MIT
// The Cornell box [Goral, Torrance, Greenberg, Battaile 1984] as measured at Cornell (graphics.cornell.edu/online/box/data.html),
// in units of 100 mm, with its colours in RGB. One lamp lights it, and no map.
#include "Scene.h"

namespace scenes
{

namespace
{

constexpr double width = 5.56, depth = 5.592, height = 5.488;

// x, y, z of the data: to the left, up, away from the eye.
osg::Vec3d point(double x, double y, double z)
{
    return osg::Vec3d(width - x / 100, z / 100, y / 100);
}

// A block by its top's corners, clockwise in the data's x and z.
Mesh block(const std::vector<osg::Vec3d>& top)
{
    Mesh mesh;
    mesh.addQuad(top[0], top[1] - top[0], top[3] - top[0]);
    for (size_t i = 0; i < 4; ++i) {
        const osg::Vec3d& a = top[i];
        const osg::Vec3d& b = top[(i + 1) % 4];
        mesh.addQuad(b, a - b, osg::Vec3d(0, 0, -a.z()));
    }
    return mesh;
}

}  // namespace

Scene cornell()
{
    const std::map<std::string, Material> materials{{"white", lambert({0.886, 0.699, 0.666})},
                                                    {"green", lambert({0.105, 0.378, 0.076})},
                                                    {"red", lambert({0.57, 0.043, 0.044})}};
    Scene scene("cornell", {"sky", 0, 0, 1.6}, {{2.78, -8, 2.73}, {2.78, 0, 2.73}, 39.3}, materials);
    const osg::Vec3d right(width, 0, 0), away(0, depth, 0), up(0, 0, height);
    Mesh white;
    white.addQuad({}, right, away);
    white.addQuad(up, away, right);
    white.addQuad(away, right, up);
    scene.add(white, "white");
    Mesh red, green;
    red.addQuad({}, away, up);
    green.addQuad(right, up, away);
    scene.add(red, "red");
    scene.add(green, "green");
    scene.add(block({point(130, 165, 65), point(82, 165, 225), point(240, 165, 272), point(290, 165, 114)}), "white");
    scene.add(block({point(423, 330, 247), point(265, 330, 296), point(314, 330, 456), point(472, 330, 406)}), "white");
    // A millimetre below the ceiling.
    scene.addLight(
        R"({ "name": "lamp", "shape": "rectangle", "center": [2.78, 2.795, 5.478], "u": [0, 0.525, 0], "v": [0.65, 0, 0], )"
        R"("radiance": [18.4, 14, 6.75] })");
    return scene;
}

}  // namespace scenes
