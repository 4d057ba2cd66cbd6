/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "shadow/DepthProbe.h"

#include <osg/BoundingSphere>

namespace osgEnvLight
{

/** The part of a large scene that a view shows, as a sphere that stays while the view wanders within it: there the maps of the
 * sky shadow atlas are too coarse, and finer ones stand beside them. A view that looks about from a place has the sphere about
 * the eye, which turning does not leave; one that looks from afar, about what it shows. */
class OSGENVLIGHT_EXPORT NearCascade
{
  public:
    /** Go along with what the view shows now. No points change nothing. */
    void follow(const ProbedPoints& seen, double sceneRadius);

    /** Invalid where the view shows so much of the scene that finer maps would not be much finer. */
    const osg::BoundingSphered& sphere() const { return _sphere; }

    /** Of the scene's radius: no larger neighbourhood is worth maps of its own. */
    static constexpr double largest = 0.36;

  private:
    osg::BoundingSphered _sphere;
};

}  // namespace osgEnvLight
