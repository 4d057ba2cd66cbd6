// SPDX-License-Identifier: MIT
#include "StudyMaps.h"

#include <osgDB/ReadFile>

#include <algorithm>
#include <stdexcept>

namespace testmaths
{

using glsl::vec3;

namespace
{

const char* const folder = "/usr/share/blender/datafiles/studiolights/world/";

vec3 skyAndSun(const vec3& d, bool disc)
{
    const vec3 sun(std::sin(0.8) * std::cos(1.0), std::sin(0.8) * std::sin(1.0), std::cos(0.8));
    const double g = std::max(glsl::dot(d, sun), 0.0);
    const double sky =
        (d.z > 0.0 ? 0.3 + 0.5 * (1.0 - d.z) * (1.0 - d.z) + 0.3 * std::pow(g, 4.0) : 0.12) + 0.8 * std::pow(g, 40.0);
    const bool inside = disc && glsl::dot(d, sun) > std::cos(0.5 * pi / 180.0);
    return vec3(0.7, 0.9, 1.3) * sky + (inside ? vec3(1.1, 1.0, 0.85) * 2e4 : vec3(0.0));
}

vec3 windows(double u, double v)
{
    static const double w[6][4] = {{.05, .40, .06, .12}, {.18, .42, .05, .10}, {.36, .38, .09, .14},
                                   {.55, .44, .04, .08}, {.70, .30, .10, .22}, {.88, .47, .05, .12}};
    double l = 0.02;
    for (int k = 0; k < 6; ++k)
        if (u >= w[k][0] && u < w[k][0] + w[k][2] && v >= w[k][1] && v < w[k][1] + w[k][3]) l = 4.0 + k;
    return vec3(1.05, 1.0, 0.9) * l;
}

// A map whose texels average 8 x 8 samples in the image's coordinates.
osg::ref_ptr<osg::Image> averaged(int width, const std::function<vec3(double, double)>& radiance)
{
    const int height = width / 2;
    osg::ref_ptr<osg::Image> image = makeMap(width, height, [](const vec3&) { return vec3(0.0); });
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            vec3 sum(0.0);
            for (int j = 0; j < 8; ++j)
                for (int i = 0; i < 8; ++i) sum += radiance((x + (i + 0.5) / 8) / width, (y + (j + 0.5) / 8) / height);
            for (int k = 0; k < 3; ++k) texelOf(*image, x, y)[k] = float(sum[k] / 64.0);
        }
    return image;
}

vec3 directionAt(double u, double v)
{
    const double azimuth = pi - 2.0 * pi * u;
    return vec3(std::sin(pi * v) * std::cos(azimuth), std::sin(pi * v) * std::sin(azimuth), std::cos(pi * v));
}

osg::ref_ptr<osg::Image> reduced(const osg::Image& source, int width)
{
    const int block = std::max(source.s() / width, 1);
    const int height = source.t() / block;
    osg::ref_ptr<osg::Image> image = makeMap(source.s() / block, height, [](const vec3&) { return vec3(0.0); });
    for (int y = 0; y < source.t(); ++y) {
        const double share = texelSolidAngle(y, source.s(), source.t()) / texelSolidAngle(y / block, image->s(), height);
        for (int x = 0; x < source.s(); ++x) {
            const osg::Vec4 c = source.getColor(unsigned(x), unsigned(source.t() - 1 - y));
            float* t = texelOf(*image, x / block, y / block);
            for (int k = 0; k < 3; ++k) t[k] += float(share * std::max(double(c[unsigned(k)]), 0.0));
        }
    }
    return image;
}

}  // namespace

std::vector<StudyMap> syntheticMaps(int width)
{
    auto over = [](const vec3& d) { return vec3(0.95, 1.0, 1.05) * (d.z > 0.0 ? (1.0 + 2.0 * d.z) / 3.0 : 0.15); };
    return {{"overcast", false, makeMap(width, width / 2, over)},
            {"sun and sky", false, averaged(width, [](double u, double v) { return skyAndSun(directionAt(u, v), true); })},
            {"six windows", false, averaged(width, windows)},
            {"checker", false,
             averaged(width, [](double u, double v) { return vec3(1.0, 0.8, 0.6) * double((int(u * 24) + int(v * 12)) & 1); })}};
}

std::vector<StudyMap> realMaps(int width)
{
    std::vector<StudyMap> maps;
    for (const char* name : {"city", "courtyard", "forest", "interior", "night", "studio", "sunrise", "sunset"}) {
        const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(std::string(folder) + name + ".exr");
        if (!image) return {};
        maps.push_back({name, true, reduced(*image, width)});
    }
    return maps;
}

std::vector<StudyMap> allMaps(int width)
{
    std::vector<StudyMap> maps = syntheticMaps(width);
    for (StudyMap& m : realMaps(width)) maps.push_back(m);
    return maps;
}

osg::ref_ptr<osg::Image> turned(const osg::Image& image, double azimuth, double tilt)
{
    const int width = image.s();
    const int height = image.t();
    return makeMap(width, height, [&](const vec3& centre) {
        vec3 sum(0.0);
        const double u0 = 0.5 - std::atan2(centre.y, centre.x) / (2.0 * pi);
        const double v0 = std::acos(std::clamp(centre.z, -1.0, 1.0)) / pi;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                vec3 d = directionAt(u0 + i / (3.0 * width), v0 + j / (3.0 * height));
                d = vec3(d.x * std::cos(tilt) + d.z * std::sin(tilt), d.y, d.z * std::cos(tilt) - d.x * std::sin(tilt));
                const double u = 0.5 - (std::atan2(d.y, d.x) - azimuth) / (2.0 * pi);
                const double v = std::acos(std::clamp(d.z, -1.0, 1.0)) / pi;
                const int x = int(std::floor((u - std::floor(u)) * width)) % width;
                const int y = std::clamp(int(v * height), 0, height - 1);
                const float* t = reinterpret_cast<const float*>(image.data(unsigned(x), unsigned(height - 1 - y)));
                sum += vec3(t[0], t[1], t[2]);
            }
        return sum / 9.0;
    });
}

}  // namespace testmaths
