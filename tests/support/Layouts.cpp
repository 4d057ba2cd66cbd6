// SPDX-License-Identifier: MIT
#include "Layouts.h"

#include <algorithm>

using glsl::vec2;
using glsl::vec3;
using osgEnvLight::MapLayout;

namespace testmaths
{

namespace
{

// Directions at (a, b) of a wall, a to the right and b down in [-1, 1], seen from inside. Walls keep +Z up; from the front
// wall the roof and the floor are reached without a turn.
vec3 front(double a, double b)
{
    return vec3(1.0, -a, -b);
}
vec3 right(double a, double b)
{
    return vec3(-a, -1.0, -b);
}
vec3 back(double a, double b)
{
    return vec3(-1.0, a, -b);
}
vec3 left(double a, double b)
{
    return vec3(a, 1.0, -b);
}
vec3 roof(double a, double b)
{
    return vec3(b, -a, 1.0);
}
vec3 below(double a, double b)
{
    return vec3(-b, -a, -1.0);
}

using Wall = vec3 (*)(double, double);

// +X -X +Y -Y +Z -Z of a cube whose +Z is in front and whose +Y is up: +X is at the right.
const Wall cube[6] = {right, left, roof, below, front, back};

Wall wallAt(MapLayout layout, int column, int row, int slice)
{
    if (layout == MapLayout::CUBE) return cube[slice];
    if (layout == MapLayout::STRIP) return cube[column + row];
    if (row == 1 && column < 4) return std::array<Wall, 4>{left, front, right, back}[size_t(column)];
    if (column != 1) return nullptr;
    if (row == 0) return roof;
    // Under the floor the back wall hangs upside down.
    return row == 2 ? below : [](double a, double b) { return back(-a, -b); };
}

// A ball seen from the front, at infinity: the view direction mirrored at the normal.
vec3 mirrored(double a, double b)
{
    const vec3 normal(std::sqrt(1.0 - a * a - b * b), -a, -b);
    return 2.0 * normal.x * normal - vec3(1.0, 0.0, 0.0);
}

vec3 angular(double a, double b)
{
    const double r = std::hypot(a, b);
    if (r == 0.0) return vec3(1.0, 0.0, 0.0);
    return vec3(std::cos(pi * r), -std::sin(pi * r) * a / r, -std::sin(pi * r) * b / r);
}

// pbrt-v4's EqualAreaSquareToSphere, whose y points to our -Y.
vec3 equalArea(double u, double v)
{
    const double d = 1.0 - std::abs(u) - std::abs(v);
    const double r = 1.0 - std::abs(d);
    const double phi = r == 0.0 ? 0.0 : ((std::abs(v) - std::abs(u)) / r + 1.0) * pi / 4.0;
    const double z = std::copysign(1.0 - r * r, d);
    const double s = r * std::sqrt(2.0 - r * r);
    return vec3(std::copysign(s * std::cos(phi), u), -std::copysign(s * std::sin(phi), v), z);
}

}  // namespace

bool LaidOut::isCube() const
{
    return layout != MapLayout::ANGULAR && layout != MapLayout::MIRROR_BALL && layout != MapLayout::OCTAHEDRAL;
}

int LaidOut::side() const
{
    if (layout == MapLayout::VERTICAL_CROSS) return width / 3;
    if (layout == MapLayout::HORIZONTAL_CROSS) return width / 4;
    return std::min(width, height);
}

std::ostream& operator<<(std::ostream& out, const LaidOut& l)
{
    return out << l.name() << " " << l.width << "x" << l.height << "x" << l.slices;
}

std::vector<LaidOut> cubeLayouts(int side)
{
    return {{MapLayout::VERTICAL_CROSS, 3 * side, 4 * side, 1},
            {MapLayout::HORIZONTAL_CROSS, 4 * side, 3 * side, 1},
            {MapLayout::STRIP, 6 * side, side, 1},
            {MapLayout::STRIP, side, 6 * side, 1},
            {MapLayout::CUBE, side, side, 6}};
}

std::vector<LaidOut> squareLayouts(int side)
{
    return {{MapLayout::ANGULAR, side, side, 1}, {MapLayout::MIRROR_BALL, side, side, 1}, {MapLayout::OCTAHEDRAL, side, side, 1}};
}

bool texelDirection(const LaidOut& l, int x, int y, int slice, vec3& direction)
{
    const int side = l.side();
    const double a = 2.0 * (x % side + 0.5) / side - 1.0;
    const double b = 2.0 * (y % side + 0.5) / side - 1.0;
    if (l.isCube()) {
        const Wall wall = wallAt(l.layout, x / side, y / side, slice);
        if (wall) direction = glsl::normalize(wall(a, b));
        return wall != nullptr;
    }
    if (l.layout == MapLayout::OCTAHEDRAL) {
        direction = equalArea(a, b);
        return true;
    }
    if (a * a + b * b > 1.0) return false;
    direction = l.layout == MapLayout::ANGULAR ? angular(a, b) : mirrored(a, b);
    return true;
}

float* texelOf(osg::Image& image, int x, int y, int slice)
{
    const int row = image.r() > 1 ? y : image.t() - 1 - y;
    return reinterpret_cast<float*>(image.data(unsigned(x), unsigned(row), unsigned(slice)));
}

osg::ref_ptr<osg::Image> makeImage(const LaidOut& l, const Radiance& radiance, float outside)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(l.width, l.height, l.slices, GL_RGB, GL_FLOAT);
    for (int slice = 0; slice < l.slices; ++slice)
        for (int y = 0; y < l.height; ++y)
            for (int x = 0; x < l.width; ++x) {
                vec3 d;
                const bool used = texelDirection(l, x, y, slice, d);
                const vec3 c = used ? radiance(d) : vec3(outside);
                float* t = texelOf(*image, x, y, slice);
                for (int i = 0; i < 3; ++i) t[i] = float(c[i]);
            }
    return image;
}

}  // namespace testmaths
