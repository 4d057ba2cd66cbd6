// SPDX-License-Identifier: MIT
#include <osgEnvLight/MapLayout>

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

using glsl::vec2;
using glsl::vec3;

// Samples along each side of a texel of the result.
const int cubeSamples = 2;
const int squareSamples = 2;

bool isCube(MapLayout layout)
{
    return layout == MapLayout::VERTICAL_CROSS || layout == MapLayout::HORIZONTAL_CROSS || layout == MapLayout::STRIP ||
           layout == MapLayout::CUBE;
}

bool isDisc(MapLayout layout)
{
    return layout == MapLayout::ANGULAR || layout == MapLayout::MIRROR_BALL;
}

int sideOf(MapLayout layout, int width, int height)
{
    if (layout == MapLayout::VERTICAL_CROSS) return width / 3;
    if (layout == MapLayout::HORIZONTAL_CROSS) return width / 4;
    return std::min(width, height);
}

// Where texel (x, y) of a slice belongs: to which chart (a face of the cube, or the one square) and where there.
struct Place {
    int chart = -1;  // none: the layout has nothing there
    int i = 0;
    int j = 0;
};

const int upDownCross[4][3] = {{-1, 2, -1}, {1, 4, 0}, {-1, 3, -1}, {-1, 5, -1}};
const int leftRightCross[3][4] = {{-1, 2, -1, -1}, {1, 4, 0, 5}, {-1, 3, -1, -1}};

Place placeOf(MapLayout layout, int side, int x, int y, int slice)
{
    const int column = x / side;
    const int row = y / side;
    Place p{slice, x - column * side, y - row * side};
    if (layout == MapLayout::VERTICAL_CROSS) p.chart = upDownCross[row][column];
    if (layout == MapLayout::HORIZONTAL_CROSS) p.chart = leftRightCross[row][column];
    if (layout == MapLayout::STRIP) p.chart = std::max(column, row);
    if (layout == MapLayout::VERTICAL_CROSS && p.chart == 5) {  // upside down
        p.i = side - 1 - p.i;
        p.j = side - 1 - p.j;
    }
    return p;
}

// Centre of texel (i, j) of a chart in [-1, 1]^2, y down.
vec2 centreOf(int i, int j, int side)
{
    return vec2(2.0 * i + 1.0 - side, 2.0 * j + 1.0 - side) / double(side);
}

// Solid angle [sr] of the texel about point p of a chart in [-1, 1]^2: the density there times its area.
double texelSolidAngle(MapLayout layout, vec2 p, int side)
{
    const double area = 4.0 / (double(side) * side);
    const double q = 1.0 + glsl::dot(p, p);
    if (isCube(layout)) return area / (q * std::sqrt(q));
    const double r = glsl::length(p);
    if (layout == MapLayout::ANGULAR) return area * (r > 0.0 ? glsl::PI * std::sin(glsl::PI * r) / r : glsl::PI * glsl::PI);
    return layout == MapLayout::MIRROR_BALL ? 4.0 * area : glsl::PI * area;
}

// A point of a chart in [-1, 1]^2, y down.
struct Point {
    int chart;
    double x;
    double y;
};

// Four floats which GCC and clang keep in one register.
struct Rgba {
    float v __attribute__((vector_size(16))) = {};
};

// The texels by charts, each with a border of one texel, so that bilinear reading needs no cases.
class Charts
{
  public:
    Charts(int count, int side) : _side(side), _pitch(size_t(side) + 2), _texels(size_t(count) * _pitch * _pitch) {}

    // -1 <= i, j <= side
    Rgba& at(int chart, int i, int j) { return _texels[(size_t(chart) * _pitch + size_t(j + 1)) * _pitch + size_t(i + 1)]; }

    // Adds weight times the bilinear value at point p.
    void addTo(Rgba& sum, float weight, const Point& p) const
    {
        const double s = 0.5 * _side * (p.x + 1.0) + 0.5;
        const double t = 0.5 * _side * (p.y + 1.0) + 0.5;
        const int i = int(s);
        const int j = int(t);
        const float a = float(s - i);
        const float b = float(t - j);
        const Rgba* top = _texels.data() + (size_t(p.chart) * _pitch + size_t(j)) * _pitch + size_t(i);
        const Rgba* bottom = top + _pitch;
        const Rgba upper{top[0].v + a * (top[1].v - top[0].v)};
        const Rgba lower{bottom[0].v + a * (bottom[1].v - bottom[0].v)};
        sum.v += weight * (upper.v + b * (lower.v - upper.v));
    }

  private:
    int _side;
    size_t _pitch;
    std::vector<Rgba> _texels;
};

// Clarberg's square continues across its edges at the mirrored place [pbrt-v4, WrapEqualAreaSquare].
void wrapOctahedral(int& i, int& j, int side)
{
    if (i < 0 || i >= side) {
        i = std::clamp(i, 0, side - 1);
        j = side - 1 - j;
    }
    if (j < 0 || j >= side) {
        i = side - 1 - i;
        j = std::clamp(j, 0, side - 1);
    }
}

// The border, and what lies outside a disc, from the texels that belong to the chart.
void fillOutside(Charts& charts, MapLayout layout, int count, int side)
{
    for (int chart = 0; chart < count; ++chart)
        for (int j = -1; j <= side; ++j)
            for (int i = -1; i <= side; ++i) {
                const bool border = i < 0 || j < 0 || i == side || j == side;
                int fromI = std::clamp(i, 0, side - 1);
                int fromJ = std::clamp(j, 0, side - 1);
                if (isDisc(layout)) {
                    const vec2 p = centreOf(i, j, side);
                    if (glsl::dot(p, p) <= 1.0) continue;
                    // So far inside that the texel about this point has its centre in the disc too.
                    const vec2 q = glsl::normalize(p) * std::max(0.0, 1.0 - 1.4143 / side);
                    fromI = int(0.5 * (q.x + 1.0) * side);
                    fromJ = int(0.5 * (q.y + 1.0) * side);
                } else if (!border) {
                    continue;
                } else if (layout == MapLayout::OCTAHEDRAL) {
                    fromI = i;
                    fromJ = j;
                    wrapOctahedral(fromI, fromJ, side);
                }
                charts.at(chart, i, j) = charts.at(chart, fromI, fromJ);
            }
}

Charts readCharts(MapLayout layout, int width, int height, int side, const TexelReader& read)
{
    const int count = isCube(layout) ? 6 : 1;
    const int slices = layout == MapLayout::CUBE ? 6 : 1;
    Charts charts(count, side);
    for (int slice = 0; slice < slices; ++slice)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Place place = placeOf(layout, side, x, y, slice);
                const vec2 p = centreOf(place.i, place.j, side);
                if (place.chart < 0 || (isDisc(layout) && glsl::dot(p, p) > 1.0)) continue;
                const osg::Vec3d c = read(x, y, slice, texelSolidAngle(layout, p, side));
                charts.at(place.chart, place.i, place.j) = Rgba{{float(c[0]), float(c[1]), float(c[2]), 0.0f}};
            }
    fillOutside(charts, layout, count, side);
    return charts;
}

// Faces of the cube with their axes as in the table of the OpenGL specification (8.13, cube map texture selection).
Point cubePoint(const vec3& d)
{
    const double x = -d.y;
    const double y = d.z;
    const double z = d.x;
    const double ax = std::abs(x);
    const double ay = std::abs(y);
    const double az = std::abs(z);
    if (az >= ax && az >= ay) {
        const double r = 1.0 / az;
        return z > 0.0 ? Point{4, x * r, -y * r} : Point{5, -x * r, -y * r};
    }
    if (ax >= ay) {
        const double r = 1.0 / ax;
        return x > 0.0 ? Point{0, -z * r, -y * r} : Point{1, z * r, -y * r};
    }
    const double r = 1.0 / ay;
    return y > 0.0 ? Point{2, x * r, z * r} : Point{3, x * r, -z * r};
}

// (Dx r, Dy r), r = acos(Dz) / (pi sqrt(Dx^2 + Dy^2)) with D = right, up, front [Debevec, Light Probe Image Gallery]; the
// angle by atan, which keeps its digits.
Point angularPoint(const vec3& d)
{
    const double length = glsl::length(vec2(d.y, d.z));
    if (length == 0.0) return Point{0, d.x > 0.0 ? 0.0 : 1.0, 0.0};
    const double r = std::atan2(length, d.x) / (glsl::PI * length);
    return Point{0, -d.y * r, -d.z * r};
}

// (Dx r, Dy r), r = sin(acos(Dz) / 2) / sqrt(Dx^2 + Dy^2) [Reinhard et al. 2005, High Dynamic Range Imaging, 9.4], where
// the sine is sqrt((1 - Dz) / 2).
Point mirrorBallPoint(const vec3& d)
{
    const double length = glsl::length(vec2(d.y, d.z));
    if (length == 0.0) return Point{0, d.x > 0.0 ? 0.0 : 1.0, 0.0};
    const double r = d.x > 0.0 ? std::sqrt(0.5 / (1.0 + d.x)) : std::sqrt(0.5 * (1.0 - d.x)) / length;
    return Point{0, -d.y * r, -d.z * r};
}

// [Clarberg 2008, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD; pbrt-v4, EqualAreaSphereToSquare], where
// sqrt(1 - |z|) is written so that it keeps its digits near the poles.
Point octahedralPoint(const vec3& d)
{
    const double r = glsl::length(vec2(d)) / std::sqrt(1.0 + std::abs(d.z));
    const double phi = r > 0.0 ? std::atan2(std::abs(d.y), std::abs(d.x)) * 2.0 / glsl::PI : 0.0;
    double x = r - phi * r;
    double y = phi * r;
    if (d.z < 0.0) {
        std::swap(x, y);
        x = 1.0 - x;
        y = 1.0 - y;
    }
    return Point{0, std::copysign(x, d.x), std::copysign(y, -d.y)};
}

// Each texel the mean over samples x samples directions, each row of samples by its solid angle.
template <class Projection>
osg::ref_ptr<osg::Image> resample(const Charts& charts, int height, int samples, const Projection& project)
{
    const int width = 2 * height;
    const vec2 fine(width * samples, height * samples);
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGB, GL_FLOAT);
    std::vector<vec3> azimuths;
    for (int x = 0; x < width * samples; ++x) azimuths.push_back(glsl::directionFromLatlong(vec2((x + 0.5) / fine.x, 0.5)));
    std::vector<vec3> meridian(size_t(samples), vec3(0.0));
    std::vector<float> weights(meridian.size());
    for (int y = 0; y < height; ++y) {
        for (int k = 0; k < samples; ++k) {
            const int row = y * samples + k;
            meridian[size_t(k)] = glsl::directionFromLatlong(vec2(0.5, (row + 0.5) / fine.y));
            weights[size_t(k)] =
                float(glsl::latlongTexelSolidAngle(row, fine) / glsl::latlongTexelSolidAngle(y, vec2(width, height)));
        }
        float* out = reinterpret_cast<float*>(image->data(0, unsigned(height - 1 - y)));
        for (const vec3* azimuth = azimuths.data(); azimuth != azimuths.data() + azimuths.size(); azimuth += samples, out += 3) {
            Rgba sum;
            for (size_t k = 0; k < meridian.size(); ++k)
                for (const vec3* a = azimuth; a != azimuth + samples; ++a)
                    charts.addTo(sum, weights[k], project(vec3(meridian[k].x * a->x, meridian[k].x * a->y, meridian[k].z)));
            for (int k = 0; k < 3; ++k) out[k] = sum.v[k];
        }
    }
    return image;
}

std::string layoutError(MapLayout layout, int width, int height, int slices)
{
    const int side = sideOf(layout, width, height);
    if (layout == MapLayout::CUBE)
        return slices == 6 && width == height ? "" : "expected the six faces of a cube as slices of NxN";
    if (slices != 1) return "expected one slice, or six as the faces of a cube";
    switch (layout) {
        case MapLayout::LATLONG:
            if (width == 2 * height || width == 1 || height == 1) return "";
            return "expected a latitude-longitude image, twice as wide as high";
        case MapLayout::VERTICAL_CROSS:
            return width == 3 * side && height == 4 * side ? "" : "expected a vertical cross, 3Nx4N";
        case MapLayout::HORIZONTAL_CROSS:
            return width == 4 * side && height == 3 * side ? "" : "expected a horizontal cross, 4Nx3N";
        case MapLayout::STRIP:
            return std::max(width, height) == 6 * side ? "" : "expected a strip of six faces, 6NxN or Nx6N";
        case MapLayout::ANGULAR:
        case MapLayout::MIRROR_BALL:
        case MapLayout::OCTAHEDRAL:
            return width == height ? "" : "expected a square, NxN, for the layout '" + mapLayoutNames()[size_t(layout)] + "'";
        default:
            return "expected one of the layouts " + mapLayoutChoices();
    }
}

std::string autoLayout(MapLayout& layout, int width, int height, int slices)
{
    for (MapLayout candidate :
         {MapLayout::LATLONG, MapLayout::VERTICAL_CROSS, MapLayout::HORIZONTAL_CROSS, MapLayout::STRIP, MapLayout::CUBE})
        if (layoutError(candidate, width, height, slices).empty()) {
            layout = candidate;
            return "";
        }
    if (slices != 1) return "expected one slice, or six square ones as the faces of a cube";
    if (width == height)
        return "a square, in which the sphere may lie in several ways: set the layout to 'angular', 'mirror-ball' or "
               "'octahedral'";
    return "expected a latitude-longitude image, twice as wide as high, or a cross (3Nx4N, 4Nx3N) or strip (6NxN, Nx6N) of "
           "cube faces";
}

}  // namespace

const std::vector<std::string>& mapLayoutNames()
{
    static const std::vector<std::string> names = {"auto", "latlong", "vertical-cross", "horizontal-cross", "strip",
                                                   "cube", "angular", "mirror-ball",    "octahedral"};
    return names;
}

std::string mapLayoutChoices()
{
    std::string list;
    for (const std::string& name : mapLayoutNames()) list += (list.empty() ? "" : ", ") + name;
    return list;
}

bool mapLayoutFromName(const std::string& name, MapLayout& layout)
{
    const std::vector<std::string>& names = mapLayoutNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return false;
    layout = MapLayout(found - names.begin());
    return true;
}

std::string resolveMapLayout(MapLayout& layout, int width, int height, int slices)
{
    const std::string reason =
        layout == MapLayout::AUTO ? autoLayout(layout, width, height, slices) : layoutError(layout, width, height, slices);
    if (reason.empty()) return reason;
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    return "is " + size + (slices == 1 ? std::string() : " in " + std::to_string(slices) + " slices") + ", " + reason;
}

osg::ref_ptr<osg::Image> convertToLatlong(MapLayout layout, int width, int height, const TexelReader& read)
{
    const int side = sideOf(layout, width, height);
    const Charts charts = readCharts(layout, width, height, side, read);
    if (isCube(layout)) return resample(charts, 2 * side, cubeSamples, cubePoint);
    if (layout == MapLayout::ANGULAR) return resample(charts, side, squareSamples, angularPoint);
    if (layout == MapLayout::MIRROR_BALL) return resample(charts, side, squareSamples, mirrorBallPoint);
    return resample(charts, side, squareSamples, octahedralPoint);
}

}  // namespace osgEnvLight
