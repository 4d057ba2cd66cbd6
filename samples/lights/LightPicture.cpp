// SPDX-License-Identifier: MIT
#include "LightPicture.h"

#include "NearestDirection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "glsl.h"

namespace
{

using glsl::vec2;
using glsl::vec3;
using osgEnvLight::DominantLight;
using osgEnvLight::LightFile;
using osgEnvLight::LightList;
using osgEnvLight::RadianceMap;
using osgEnvLight::sumOf;

const int smallestWidth = 1024;
const int largestWidth = 4096;
const double middleGrey = 0.18;
const double darkest = 1e-3;  // of the mean radiance: what is darker is exposed as this
const double covered = 0.04;  // share of the sphere that the dots have together
const vec3 black(0.0);
const vec3 white(1.0);
const vec3 magenta(1.0, 0.0, 0.85);

vec3 toVec3(const osg::Vec3d& v)
{
    return vec3(v[0], v[1], v[2]);
}

double luminance(const vec3& c)
{
    return glsl::dot(c, vec3(0.2126, 0.7152, 0.0722));
}

// A latitude-longitude picture of display colours, y from the top.
class Canvas
{
  public:
    Canvas(int w, int h) : width(w), height(h), pixel(glsl::PI / h), _colors(size_t(w) * size_t(h)) {}

    vec3& at(int x, int y) { return _colors[size_t(y) * size_t(width) + size_t(x)]; }
    vec3 direction(double x, double y) const { return glsl::directionFromLatlong(vec2(x / width, y / height)); }
    vec3 direction(int x, int y) const { return direction(x + 0.5, y + 0.5); }
    void blend(int x, int y, const vec3& color, double alpha) { at(x, y) = glsl::mix(at(x, y), color, alpha); }

    // Calls paint(x, y, angle to the centre) for the pixels of a disc on the sphere, across the seam and over the poles.
    template <class Paint>
    void visitDisc(const vec3& centre, double radius, Paint paint) const
    {
        const vec2 uv = glsl::latlongFromDirection(centre);
        const double theta = glsl::PI * uv.y;
        const int first = std::max(0, int((theta - radius) / pixel));
        const int last = std::min(height - 1, int((theta + radius) / pixel));
        const bool pole = theta <= radius || theta + radius >= glsl::PI;
        const double half = pole ? glsl::PI : std::asin(std::min(1.0, std::sin(radius) / std::sin(theta)));
        const int columns = std::min(width, 2 * int(std::ceil(half / glsl::TWO_PI * width)) + 3);
        const int start = int(uv.x * width) - columns / 2 + width;
        for (int y = first; y <= last; ++y)
            for (int i = 0; i < columns; ++i) {
                const int x = (start + i) % width;
                const double angle = 2.0 * std::asin(std::min(1.0, 0.5 * glsl::length(direction(x, y) - centre)));
                if (angle <= radius) paint(x, y, angle);
            }
    }

    osg::ref_ptr<osg::Image> image() const
    {
        osg::ref_ptr<osg::Image> result = new osg::Image;
        result->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE);
        const vec3* color = _colors.data();
        for (int y = 0; y < height; ++y) {
            unsigned char* p = result->data(0, unsigned(height - 1 - y));
            for (int x = 0; x < width; ++x, ++color)
                for (int c = 0; c < 3; ++c)
                    *p++ = static_cast<unsigned char>(std::lround(255.0 * glsl::clamp((*color)[c], 0.0, 1.0)));
        }
        return result;
    }

    const int width;
    const int height;
    const double pixel;  // height of one [radians]

  private:
    std::vector<vec3> _colors;
};

// Whole multiples of small maps, so that their texels are seen as they are.
Canvas canvasFor(const RadianceMap& map)
{
    const int times = std::max(1, (smallestWidth + map.width - 1) / map.width);
    const int width = std::min(map.width * times, largestWidth);
    return Canvas(width, width / 2);
}

vec3 texelAt(const RadianceMap& map, const vec3& d)
{
    const vec2 uv = glsl::latlongFromDirection(d);
    const float* t = map.texel(std::min(int(uv.x * map.width), map.width - 1), std::min(int(uv.y * map.height), map.height - 1));
    return vec3(t[0], t[1], t[2]);
}

// Makes the mean of the logarithm middle grey; 0 for a black map.
double exposure(const RadianceMap& map)
{
    if (!(map.mean > 0.0)) return 0.0;
    double sum = 0.0;
    for (int y = 0; y < map.height; ++y) {
        double row = 0.0;
        for (int x = 0; x < map.width; ++x) {
            const float* t = map.texel(x, y);
            row += std::log(std::max(luminance(vec3(t[0], t[1], t[2])), darkest * map.mean));
        }
        sum += row * glsl::latlongTexelSolidAngle(y, vec2(map.width, map.height));
    }
    return middleGrey / std::exp(sum / (4.0 * glsl::PI));
}

void paintMap(Canvas& canvas, const RadianceMap& map, double rotation)
{
    const double scale = exposure(map);
    const double c = std::cos(osg::DegreesToRadians(rotation));
    const double s = std::sin(osg::DegreesToRadians(rotation));
    const int samples = (map.width + canvas.width - 1) / canvas.width;  // of a pixel, along each side
    for (int y = 0; y < canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x) {
            vec3 sum(0.0);
            for (int i = 0; i < samples * samples; ++i) {
                const vec3 d = canvas.direction(x + (i % samples + 0.5) / samples, y + (i / samples + 0.5) / samples);
                sum += texelAt(map, vec3(c * d.x + s * d.y, c * d.y - s * d.x, d.z));
            }
            const vec3 toned = glsl::toneReinhard(sum * (scale / (samples * samples)));
            canvas.at(x, y) = glsl::srgbEncode3(glsl::min(toned, white));
        }
}

// Lines halfway between neighbouring lights; fainter where they would hide the map.
void paintBorders(Canvas& canvas, const LightList& lights)
{
    const NearestDirection nearest(lights);
    const size_t width = size_t(canvas.width);
    std::vector<unsigned> owner(width * size_t(canvas.height));
    std::vector<double> size(lights.size(), 0.0);  // pixels at the equator
    unsigned guess = 0;
    for (int y = 0; y < canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x) {
            const vec3 d = canvas.direction(x, y);
            guess = nearest.find(osg::Vec3d(d.x, d.y, d.z), guess);
            owner[size_t(y) * width + size_t(x)] = guess;
            size[guess] += std::sin((y + 0.5) * canvas.pixel);
        }
    const auto at = [&](int x, int y) { return owner[size_t(y) * width + size_t(x % canvas.width)]; };
    for (int y = 0; y < canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x) {
            const unsigned own = at(x, y);
            const bool below = y + 1 < canvas.height && at(x, y + 1) != own;
            if (at(x + 1, y) == own && !below) continue;
            const double alpha = glsl::clamp(std::sqrt(size[own]) / 40.0, 0.1, 0.5);
            canvas.blend(x, y, luminance(canvas.at(x, y)) > 0.5 ? black : white, alpha);
        }
}

// A disc without steps at its edge.
double coverage(const Canvas& canvas, double radius, double angle)
{
    return glsl::clamp((radius - angle) / canvas.pixel + 0.5, 0.0, 1.0);
}

// As bright as it can be; dark grey for less than `least`, which is rounding.
vec3 ownColor(const osg::Vec3d& flux, double least)
{
    const double most = std::max({flux[0], flux[1], flux[2]});
    return most > least ? glsl::srgbEncode3(toVec3(flux) / most) : vec3(0.25);
}

// Radius of each dot: the area grows with the flux. All are smaller where lights crowd, so that most don't touch.
std::vector<double> dotRadii(const Canvas& canvas, const LightList& lights)
{
    const double count = double(lights.size());
    const double total = sumOf(lights);
    std::vector<double> radii;
    for (const auto& l : lights) {
        const double even = total > 0.0 ? sumOf(l.flux) / total * count : 1.0;  // 1 if all were alike
        radii.push_back(2.0 * std::sqrt(covered / count * glsl::clamp(even, 0.1, 16.0)));
    }
    std::vector<double> room;  // of some: distance to the nearest over the dot's diameter
    for (size_t i = 0; i < lights.size(); i += 1 + lights.size() / 512) {
        double nearest = 4.0;
        for (size_t j = 0; j < lights.size(); ++j)
            if (j != i) nearest = std::min(nearest, (lights[j].direction - lights[i].direction).length2());
        room.push_back(0.5 * std::sqrt(nearest) / radii[i]);
    }
    const auto crowded = room.begin() + std::ptrdiff_t(room.size() / 4);
    std::nth_element(room.begin(), crowded, room.end());
    const double scale = glsl::clamp(0.8 * *crowded, 0.4, 1.0);
    for (double& r : radii) r = std::max(r * scale, std::min(1.5 * canvas.pixel, r));
    return radii;
}

// The largest first, so that none hides a smaller one.
void paintDots(Canvas& canvas, const LightList& lights)
{
    const std::vector<double> radii = dotRadii(canvas, lights);
    std::vector<size_t> order(lights.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return radii[a] > radii[b]; });
    const double line = std::min(1.2 * canvas.pixel, std::sqrt(4.0 * glsl::PI / double(lights.size())) / 16.0);
    const double dark = 1e-9 * sumOf(lights) / double(lights.size());
    for (size_t i : order) {
        const double radius = radii[i];
        const vec3 fill = ownColor(lights[i].flux, dark);
        canvas.visitDisc(toVec3(lights[i].direction), radius + 2.0 * line + canvas.pixel, [&](int x, int y, double angle) {
            canvas.blend(x, y, black, coverage(canvas, radius + 2.0 * line, angle));
            canvas.blend(x, y, white, coverage(canvas, radius + line, angle));
            canvas.blend(x, y, fill, coverage(canvas, radius, angle));
        });
    }
}

void paintCircle(Canvas& canvas, const vec3& centre, double radius)
{
    const double line = 1.5 * canvas.pixel;
    canvas.visitDisc(centre, radius + 3.0 * line, [&](int x, int y, double angle) {
        const double off = std::abs(angle - radius);
        canvas.blend(x, y, black, coverage(canvas, 1.6 * line, off));
        canvas.blend(x, y, magenta, coverage(canvas, 0.8 * line, off));
    });
}

void paintSun(Canvas& canvas, const DominantLight& sun)
{
    const vec3 centre = toVec3(sun.direction);
    paintCircle(canvas, centre, sun.radius);
    paintCircle(canvas, centre, std::max(1.5 * sun.radius, sun.radius + 14.0 * canvas.pixel));
}

}  // namespace

osg::ref_ptr<osg::Image> lightPicture(const RadianceMap& map, double rotation, const LightFile& file)
{
    Canvas canvas = canvasFor(map);
    paintMap(canvas, map, rotation);
    if (!file.lights.empty()) {
        paintBorders(canvas, file.lights);
        paintDots(canvas, file.lights);
    }
    for (const DominantLight& s : file.suns) paintSun(canvas, s);
    return canvas.image();
}
