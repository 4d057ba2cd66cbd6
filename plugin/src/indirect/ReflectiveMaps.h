/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Limits.h"

#include <osgEnvLight/Export>

#include <osg/BoundingBox>
#include <osg/FrameBufferObject>
#include <osg/Matrixd>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osg/Vec4d>

#include <vector>

namespace osgEnvLight
{

/** A light whose reflections by polished surfaces are followed. */
struct ReflectedLight {
    osg::Vec4d position;    // in the world; w = 0: the direction to it
    osg::Vec3f irradiance;  // over pi, of a surface that faces a sun, in units of the map's mean
    double radius = 0.0;    // angular, of a sun
    int sceneLight = -1;    // its number in the application's list; -1: it is a sun
};

/** A reflective shadow map [Dachsbacher, Stamminger 2005]: what a light sees of the scene, about the part that is to reflect it.
 */
struct ReflectiveMap {
    ReflectedLight light;
    osg::Matrixd projection;  // clip space from the world about the origin
    osg::Vec3d axis;          // to the light
    double texelArea = 0.0;   // across the axis; of a light with a place, at distance 1
};

/** @param mirrors  what is to reflect it, in the world; valid
 * @param size     of a map's side [texels] */
OSGENVLIGHT_EXPORT ReflectiveMap reflectiveMap(const ReflectedLight& light, const osg::BoundingBoxd& mirrors,
                                               const osg::Vec3d& origin, unsigned size);

/** Where the maps of a view are drawn, side by side in a square, and the virtual lights that are chosen from them. */
struct OSGENVLIGHT_EXPORT ReflectiveTargets {
    ReflectiveTargets() = default;
    /** @param size     of a map's side, a power of two [texels]
     * @param columns  maps along a side, 1 or 2
     * @param lights   virtual ones */
    ReflectiveTargets(unsigned size, unsigned columns, unsigned lights);

    unsigned size = 0, columns = 0, lights = 0;
    osg::ref_ptr<osg::Texture2D> flux, places, normals, depth;  // as pass/reflectivemap.frag
    osg::ref_ptr<osg::Texture2D> virtualLights;                 // as pass/virtuallights.glsl
    osg::ref_ptr<osg::FrameBufferObject> target;

    std::vector<osg::Texture2D*> textures() const;
    size_t bytes() const;
    void resizeGLObjectBuffers(unsigned maximum) const;
    void releaseGLObjects(osg::State* state) const;
};

/** What polished surfaces throw of suns and lamps onto others, as it stands in a frame. */
struct OSGENVLIGHT_EXPORT Caustics {
    ReflectiveTargets targets;
    std::vector<ReflectiveMap> maps;  // at most MOST_REFLECTED_LIGHTS
    osg::Vec3d origin;                // of them and of the virtual lights, in the world
    int suns = 0, sceneLights = 0;    // bit i: light i of each list is among them
    double lift = 0.0;                // off a surface, where rays begin
    double pointWidth = 0.0;          // half of what lies between surface points

    /** Of pass/reflectedlights.glsl and of what reads that. */
    void setUniforms(osg::StateSet& state) const;
};

}  // namespace osgEnvLight
