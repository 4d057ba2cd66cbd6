// SPDX-License-Identifier: MIT
#include "indirect/ReflectiveMaps.h"

#include "gl/TargetTexture.h"

#include <osg/FrameBufferObject>

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double widestTangent = 1.7320508075688772;  // a light between the mirrors sees those within 60 degrees of their middle

double extentAlong(const osg::BoundingBoxd& box, const osg::Vec3d& axis)
{
    double extent = 0.0;
    for (unsigned i = 0; i < 8; ++i) extent = std::max(extent, std::abs((box.corner(i) - box.center()) * axis));
    return extent;
}

osg::Matrixd parallelProjection(const osg::Vec3d (&axes)[3], const osg::Vec3d& center)
{
    osg::Matrixd m;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) m(row, column) = axes[column][row];
        m(3, column) = -(center * axes[column]);
    }
    return m;
}

}  // namespace

ReflectiveMap reflectiveMap(const ReflectedLight& light, const osg::BoundingBoxd& mirrors, const osg::Vec3d& origin,
                            unsigned size)
{
    ReflectiveMap map;
    map.light = light;
    const osg::Vec3d place(light.position.x(), light.position.y(), light.position.z());
    const bool isFar = light.position.w() == 0.0;
    osg::Vec3d to = isFar ? place : place - mirrors.center();
    const double distance = to.normalize();
    map.axis = distance > 0.0 ? to : osg::Vec3d(0, 0, 1);
    const glsl::mat3 frame = glsl::frameAround(glsl::vec3(map.axis.x(), map.axis.y(), map.axis.z()));
    const osg::Vec3d across(frame[0].x, frame[0].y, frame[0].z), up(frame[1].x, frame[1].y, frame[1].z);
    const double border = 1.0 + 2.0 / size;  // a texel about
    if (isFar) {
        const double least = std::max(1e-6 * (mirrors._max - mirrors._min).length(), 1e-12);  // of a mirror seen along its edge
        const double a = border * std::max(extentAlong(mirrors, across), least);
        const double b = border * std::max(extentAlong(mirrors, up), least);
        const double c = border * std::max(extentAlong(mirrors, map.axis), least);
        map.projection = parallelProjection({across / a, up / b, map.axis * (-1.0 / c)}, mirrors.center() - origin);
        map.texelArea = 4.0 * a * b / (double(size) * size);
        return map;
    }
    const double radius = std::max(0.5 * (mirrors._max - mirrors._min).length(), 1e-12);
    const double sine = radius / std::max(distance, radius);
    const double tangent = border * std::min(sine / std::sqrt(std::max(1.0 - sine * sine, 1e-12)), widestTangent);
    const double nearest = std::max(distance - radius, 1e-3 * radius), farthest = distance + radius;
    const osg::Matrixd view = osg::Matrixd::lookAt(place - origin, place - origin - map.axis, up);
    map.projection = view * osg::Matrixd::frustum(-nearest * tangent, nearest * tangent, -nearest * tangent, nearest * tangent,
                                                  nearest, farthest);
    map.texelArea = 4.0 * tangent * tangent / (double(size) * size);
    return map;
}

ReflectiveTargets::ReflectiveTargets(unsigned mapSize, unsigned columnCount, unsigned lightCount)
    : size(mapSize), columns(columnCount), lights(lightCount)
{
    const int side = int(size * columns);
    for (osg::ref_ptr<osg::Texture2D>* t : {&flux, &places, &normals}) *t = targetTexture(side, side, GL_RGBA32F_ARB);
    flux->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST_MIPMAP_NEAREST);
    flux->setNumMipmapLevels(1u + unsigned(std::lround(std::log2(double(side)))));
    depth = targetTexture(side, side, GL_DEPTH_COMPONENT24);
    virtualLights = targetTexture(int(lights), limits::VIRTUAL_LIGHT_ROWS, GL_RGBA32F_ARB);
    target = frameBufferOf(flux.get(), depth.get());
    target->setAttachment(osg::Camera::COLOR_BUFFER1, osg::FrameBufferAttachment(places.get()));
    target->setAttachment(osg::Camera::COLOR_BUFFER2, osg::FrameBufferAttachment(normals.get()));
}

std::vector<osg::Texture2D*> ReflectiveTargets::textures() const
{
    return {flux.get(), places.get(), normals.get(), depth.get(), virtualLights.get()};
}

size_t ReflectiveTargets::bytes() const
{
    if (!target) return 0;
    const size_t texels = size_t(size) * columns * size * columns;
    return texels * (3 * 16 + 4) + texels * 16 / 3 + size_t(lights) * limits::VIRTUAL_LIGHT_ROWS * 16;
}

void ReflectiveTargets::resizeGLObjectBuffers(unsigned maximum) const
{
    if (!target) return;
    for (osg::Texture2D* t : textures()) t->resizeGLObjectBuffers(maximum);
    target->resizeGLObjectBuffers(maximum);
}

void ReflectiveTargets::releaseGLObjects(osg::State* state) const
{
    if (!target) return;
    for (osg::Texture2D* t : textures()) t->releaseGLObjects(state);
    target->releaseGLObjects(state);
}

void Caustics::setUniforms(osg::StateSet& state) const
{
    const unsigned most = limits::MOST_REFLECTED_LIGHTS;
    const auto value = [&](const char* name, osg::Uniform::Type type, unsigned count) -> osg::Uniform& {
        return *state.getOrCreateUniform(name, type, count);
    };
    osg::Uniform& positions = value("reflectedPosition", osg::Uniform::FLOAT_VEC4, most);
    osg::Uniform& axes = value("reflectedAxis", osg::Uniform::FLOAT_VEC4, most);
    osg::Uniform& irradiances = value("reflectedIrradiance", osg::Uniform::FLOAT_VEC4, most);
    osg::Uniform& radii = value("reflectedRadius", osg::Uniform::FLOAT, most);
    for (unsigned i = 0; i < maps.size(); ++i) {
        const ReflectedLight& light = maps[i].light;
        const osg::Vec4d at = light.position - osg::Vec4d(origin, 0.0) * light.position.w();
        positions.setElement(i, osg::Vec4f(at));
        axes.setElement(i, osg::Vec4f(osg::Vec3f(maps[i].axis), float(maps[i].texelArea)));
        irradiances.setElement(i, osg::Vec4f(light.irradiance, float(light.sceneLight)));
        radii.setElement(i, float(light.radius));
    }
    value("reflectedLights", osg::Uniform::INT, 1).set(suns << limits::MOST_SCENE_LIGHTS | sceneLights);
    value("reflectiveColumns", osg::Uniform::INT, 1).set(int(targets.columns));
    value("virtualLights", osg::Uniform::INT, 1).set(int(targets.lights));
    value("reflectorLift", osg::Uniform::FLOAT, 1).set(float(lift));
    value("pointWidth", osg::Uniform::FLOAT, 1).set(float(pointWidth));
}

}  // namespace osgEnvLight
