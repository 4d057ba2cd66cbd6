/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/AreaLight>
#include "surface/EmitterPicture.h"

#include <osg/Matrixd>

#include <string>
#include <vector>

namespace osgEnvLight
{

/** An area light in one frame of coordinates: the world, or a view. */
struct OSGENVLIGHT_EXPORT Emitter {
    AreaLight::Shape shape = AreaLight::RECTANGLE;
    osg::Vec3d center;  // of a polygon, the mean of its vertices
    osg::Vec3d u, v;    // half axes of a rectangle; of a disc, two radii at right angles; of a sphere, u is (radius, 0, 0)
    osg::Vec3d normal;  // unit, of the lit side, along the cross product of u and v; of a sphere, none
    std::vector<osg::Vec3d> vertices;            // of a polygon, relative to the center, counter-clockwise seen from the lit side
    std::vector<unsigned> triangles;             // of a polygon: three vertices each, as the vertices turn
    osg::Vec3d radiance;                         // of each lit side, its mean; may be black
    osg::ref_ptr<const EmitterPicture> picture;  // of a rectangle that shows an image, else null
    osg::ref_ptr<const osg::Image> image;        // of which the picture was made
    osg::Vec3d tint;                             // by which the picture's colours are multiplied
    bool pictureTurned = false;                  // its upper edge is at -v
    bool twoSided = false;
    bool drawn = false;  // its surface is in the scene
    double area = 0.0;   // of one side; of a sphere, all of it

    /** Radius of a disc or sphere. */
    double radius() const { return u.length(); }
    /** Of a sphere about the center that holds all of it. */
    double extent() const;
    /** Radiance times area times pi, of both sides if both are lit, mean of the colours. */
    double flux() const;
    /** How many of its sides send light: none of a black light. */
    int litSides() const { return !(flux() > 0.0) ? 0 : twoSided ? 2 : 1; }
    bool operator==(const Emitter& o) const;
    bool operator!=(const Emitter& o) const { return !(*this == o); }
    /** Differs from the other by no more than a matrix that went to a view and back is rounded. */
    bool isRounded(const Emitter& o) const;
    /** The same light in other coordinates, to which a rotation and a shift lead. */
    Emitter moved(const osg::Matrixd& rigid) const;
};

/** A light where its node's matrix puts it. A mirroring matrix keeps the lit side of a rectangle, disc and polygon on the side
 * that the mirror shows. A disc that is stretched in one direction, or sheared, becomes a polygon of as many vertices as there
 * may be and of the same area, a sphere that is stretched one of the same volume.
 * @return  why it can not light, as a sentence's end ("has no area"); empty: it can */
OSGENVLIGHT_EXPORT std::string placeEmitter(const AreaLight& light, const osg::Matrixd& matrix, Emitter& emitter);

}  // namespace osgEnvLight
