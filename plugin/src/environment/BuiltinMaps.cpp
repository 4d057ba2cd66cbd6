// SPDX-License-Identifier: MIT
#include <osgEnvLight/BuiltinMaps>

#include <osg/Vec3d>

#include <algorithm>
#include <array>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double pi = glsl::PI;
constexpr int width = 1024, height = 512;

osg::Vec3d direction(double polar, double azimuth)
{
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

// At image coordinates counted in texels from the top left.
osg::Vec3d directionAt(double x, double y)
{
    const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2(x / width, y / height));
    return {d.x, d.y, d.z};
}

// Of a texel of row y counted from the top.
double solidAngle(int y)
{
    return glsl::latlongTexelSolidAngle(y, glsl::vec2(width, height));
}

osg::ref_ptr<osg::Image> emptyMap()
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGB, GL_FLOAT);
    return image;
}

// Row y is counted from the top.
osg::Vec3f& texel(osg::Image& image, int x, int y)
{
    return *reinterpret_cast<osg::Vec3f*>(image.data(static_cast<unsigned>(x), static_cast<unsigned>(height - 1 - y)));
}

double luminance(const osg::Vec3d& c)
{
    return c * osg::Vec3d(0.2126, 0.7152, 0.0722);
}

osg::Vec3d mix(const osg::Vec3d& a, const osg::Vec3d& b, double t)
{
    return a * (1 - t) + b * t;
}

double smoothStep(double from, double to, double x)
{
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// The sky of [Preetham, Shirley, Smits 1999]: the distribution function of Perez (their eq. 3) for luminance Y and
// chromaticity x, y, with the coefficients of their appendix A.2.
constexpr double turbidity = 2.6;
const double sunElevation = pi / 4, sunAzimuth = pi * -130 / 180, sunRadius = pi * 0.265 / 180;

struct Perez {
    std::array<double, 5> slope, offset;  // A, B, C, D, E = slope * turbidity + offset

    double operator()(double cosPolar, double angleToSun) const
    {
        std::array<double, 5> p;
        for (size_t i = 0; i < p.size(); ++i) p[i] = slope[i] * turbidity + offset[i];
        const double cosSun = std::cos(angleToSun);
        return (1 + p[0] * std::exp(p[1] / std::max(cosPolar, 1e-4))) *
               (1 + p[2] * std::exp(p[3] * angleToSun) + p[4] * cosSun * cosSun);
    }
};

constexpr Perez perezY{{0.1787, -0.3554, -0.0227, 0.1206, -0.0670}, {-1.4630, 0.4275, 5.3251, -2.5771, 0.3703}};
constexpr Perez perezx{{-0.0193, -0.0665, -0.0004, -0.0641, -0.0033}, {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452}};
constexpr Perez perezy{{-0.0167, -0.0950, -0.0079, -0.0441, -0.0109}, {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529}};

// Rows are powers 2, 1, 0 of turbidity, columns powers 3 to 0 of the sun's polar angle.
using ZenithTable = std::array<std::array<double, 4>, 3>;
constexpr ZenithTable zenithx{
    {{0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr ZenithTable zenithy{
    {{0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}}};

double zenith(const ZenithTable& table, double sunPolar)
{
    double result = 0;
    for (const auto& row : table)
        result = result * turbidity + ((row[0] * sunPolar + row[1]) * sunPolar + row[2]) * sunPolar + row[3];
    return result;
}

osg::Vec3d rec709(double x, double y, double luminance)
{
    const double X = luminance * x / y, Y = luminance, Z = luminance * (1 - x - y) / y;
    return {std::max(0.0, 3.2406 * X - 1.5372 * Y - 0.4986 * Z), std::max(0.0, -0.9689 * X + 1.8758 * Y + 0.0415 * Z),
            std::max(0.0, 0.0557 * X - 0.2040 * Y + 1.0570 * Z)};
}

// Up to a factor.
class Sky
{
  public:
    osg::Vec3d operator()(const osg::Vec3d& d) const
    {
        const double angle = std::acos(std::clamp(d * _sun, -1.0, 1.0));
        return rec709(_x * perezx(d.z(), angle), _y * perezy(d.z(), angle), perezY(d.z(), angle));
    }

  private:
    const double sunPolar = pi / 2 - sunElevation;

    osg::Vec3d _sun = direction(sunPolar, sunAzimuth);
    double _x = zenith(zenithx, sunPolar) / perezx(1, sunPolar);
    double _y = zenith(zenithy, sunPolar) / perezy(1, sunPolar);
};

// Fills the upper half with mean luminance 0.5; returns its irradiance on a horizontal plane.
osg::Vec3d fillSky(osg::Image& image, const Sky& sky, double& scale)
{
    osg::Vec3d irradiance;
    double flux = 0;
    for (int y = 0; y < height / 2; ++y)
        for (int x = 0; x < width; ++x) {
            const osg::Vec3d d = directionAt(x + 0.5, y + 0.5), radiance = sky(d);
            texel(image, x, y) = radiance;
            irradiance += radiance * (d.z() * solidAngle(y));
            flux += luminance(radiance) * solidAngle(y);
        }
    scale = 0.5 * 2 * pi / flux;
    for (int y = 0; y < height / 2; ++y)
        for (int x = 0; x < width; ++x) texel(image, x, y) *= static_cast<float>(scale);
    return irradiance * scale;
}

// A Lambertian plain that fades into the horizon: the path through the haze grows as 1 / tan(depression).
void fillGround(osg::Image& image, const Sky& sky, double scale, const osg::Vec3d& irradiance)
{
    const osg::Vec3d albedo(0.225, 0.198, 0.155), plain = osg::componentMultiply(albedo, irradiance) / pi;
    constexpr double haze = 0.02;
    for (int x = 0; x < width; ++x) {
        const osg::Vec3d horizon = sky(directionAt(x + 0.5, 0.5 * height)) * scale;
        for (int y = height / 2; y < height; ++y) {
            const double depression = pi * (y + 0.5) / height - pi / 2;
            texel(image, x, y) = mix(horizon, plain, std::exp(-haze / std::tan(depression)));
        }
    }
}

// Part of a texel that the sun's disc covers, by area.
double sunCoverage(int x, int y)
{
    constexpr int samples = 32;
    const osg::Vec3d sun = direction(pi / 2 - sunElevation, sunAzimuth);
    int inside = 0;
    for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i) {
            const double u = x + (i + 0.5) / samples, v = y + (j + 0.5) / samples;
            if (directionAt(u, v) * sun > std::cos(sunRadius)) ++inside;
        }
    return double(inside) / (samples * samples);
}

void addSun(osg::Image& image, const osg::Vec3d& flux)
{
    constexpr int reach = 3;
    const osg::Vec3d sun = direction(pi / 2 - sunElevation, sunAzimuth);
    const glsl::vec2 centre = glsl::latlongFromDirection(glsl::vec3(sun.x(), sun.y(), sun.z()));
    const int centreX = static_cast<int>(width * centre.x);
    const int centreY = static_cast<int>(height * centre.y);
    double covered = 0;
    for (int y = centreY - reach; y <= centreY + reach; ++y)
        for (int x = centreX - reach; x <= centreX + reach; ++x) covered += sunCoverage(x, y) * solidAngle(y);
    for (int y = centreY - reach; y <= centreY + reach; ++y)
        for (int x = centreX - reach; x <= centreX + reach; ++x) texel(image, x, y) += flux * (sunCoverage(x, y) / covered);
}

osg::ref_ptr<osg::Image> makeSky()
{
    constexpr double sunOverSky = 4;  // irradiance on a horizontal plane
    const osg::Vec3d sunColour(1.14, 0.98, 0.79);
    osg::ref_ptr<osg::Image> image = emptyMap();
    const Sky sky;
    double scale = 1;
    const osg::Vec3d fromSky = fillSky(*image, sky, scale);
    const osg::Vec3d fromSun = sunColour * (sunOverSky * luminance(fromSky) / luminance(sunColour));
    fillGround(*image, sky, scale, fromSky + fromSun);
    addSun(*image, fromSun / std::sin(sunElevation));
    return image;
}

// A rectangle on the plane at distance 1 in its direction, its sides level and upright.
struct SoftBox {
    double azimuth, elevation;  // degrees
    double halfWidth, halfHeight, edge;
    osg::Vec3d radiance;

    osg::Vec3d operator()(const osg::Vec3d& d) const
    {
        const double a = azimuth * pi / 180, polar = (90 - elevation) * pi / 180;
        const osg::Vec3d centre = direction(polar, a), right(-std::sin(a), std::cos(a), 0), up = centre ^ right;
        const double depth = d * centre;
        if (depth <= 0.05) return {};
        const double x = std::abs(d * right) / depth, y = std::abs(d * up) / depth;
        const double inside =
            smoothStep(halfWidth + edge, halfWidth - edge, x) * smoothStep(halfHeight + edge, halfHeight - edge, y);
        const double centreGlow = 1 - 0.35 * std::min(1.0, x * x / (halfWidth * halfWidth) + y * y / (halfHeight * halfHeight));
        return radiance * (inside * centreGlow);
    }
};

const std::array<SoftBox, 5> softBoxes{{{-140, 38, 0.42, 0.42, 0.04, {11.5, 10.6, 9.4}},  // key
                                        {-28, 22, 0.5, 0.62, 0.08, {1.9, 2.15, 2.6}},     // fill
                                        {62, 28, 0.16, 0.75, 0.03, {6.6, 7.2, 8.2}},      // rim
                                        {148, 20, 0.2, 0.6, 0.04, {3.4, 3.2, 2.9}},       // kicker
                                        {-80, 84, 0.75, 0.2, 0.05, {5.4, 5.4, 5.4}}}};    // top strip

osg::ref_ptr<osg::Image> makeStudio()
{
    const osg::Vec3d floor(0.055, 0.053, 0.05), wall(0.11, 0.112, 0.118), ceiling(0.045, 0.046, 0.05);
    osg::ref_ptr<osg::Image> image = emptyMap();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const osg::Vec3d d = directionAt(x + 0.5, y + 0.5);
            osg::Vec3d radiance = mix(floor, mix(wall, ceiling, smoothStep(0, 0.9, d.z())), smoothStep(-0.5, 0, d.z()));
            for (const SoftBox& box : softBoxes) radiance += box(d);
            texel(*image, x, y) = radiance;
        }
    return image;
}

}  // namespace

osg::ref_ptr<osg::Image> createBuiltinMap(const std::string& name)
{
    if (name == "sky") return makeSky();
    if (name == "studio") return makeStudio();
    return nullptr;
}

const std::vector<std::string>& builtinMapNames()
{
    static const std::vector<std::string> names = {"sky", "studio"};
    return names;
}

}  // namespace osgEnvLight
