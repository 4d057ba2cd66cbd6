// SPDX-License-Identifier: MIT
#include "Maps.h"

#include <stdexcept>

namespace testmaths
{

glsl::vec3 texelDirection(int x, int y, int width, int height)
{
    const double azimuth = pi - 2.0 * pi * (x + 0.5) / width;  // counter-clockwise from +X
    const double polar = pi * (y + 0.5) / height;
    return glsl::vec3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
}

double texelSolidAngle(int y, int width, int height)
{
    return 2.0 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
}

float* texelOf(osg::Image& image, int x, int y)
{
    return reinterpret_cast<float*>(image.data(unsigned(x), unsigned(image.t() - 1 - y)));
}

osg::ref_ptr<osg::Image> makeMap(int width, int height, const Radiance& radiance)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGB, GL_FLOAT);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glsl::vec3 c = radiance(texelDirection(x, y, width, height));
            float* t = texelOf(*image, x, y);
            for (int i = 0; i < 3; ++i) t[i] = float(c[i]);
        }
    return image;
}

osg::ref_ptr<const osgEnvLight::RadianceMap> radianceOf(const osg::ref_ptr<osg::Image>& image)
{
    const osg::ref_ptr<osgEnvLight::EnvironmentMap> map = new osgEnvLight::EnvironmentMap(image.get());
    std::string error;
    osg::ref_ptr<const osgEnvLight::RadianceMap> radiance = map->radiance(error);
    if (!radiance) throw std::runtime_error(error);
    return radiance;
}

std::vector<glsl::vec3> irradiance(const osgEnvLight::RadianceMap& map, const std::vector<glsl::vec3>& normals)
{
    std::vector<glsl::vec3> result(normals.size(), glsl::vec3(0.0));
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const float* t = map.texel(x, y);
            const glsl::vec3 flux = glsl::vec3(t[0], t[1], t[2]) * texelSolidAngle(y, map.width, map.height);
            if (flux == glsl::vec3(0.0)) continue;
            const glsl::vec3 d = texelDirection(x, y, map.width, map.height);
            for (size_t i = 0; i < normals.size(); ++i) result[i] += flux * std::max(glsl::dot(d, normals[i]), 0.0);
        }
    return result;
}

}  // namespace testmaths
