/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "indirect/TransportScene.h"
#include "indirect/TransportTargets.h"

namespace osgEnvLight
{

/** The light between the surfaces of a view's scene, as it stands in a frame. */
struct IndirectLight {
    osg::ref_ptr<TransportScene> scene;
    bool isOfCasters = false;  // the scene shows the casters as they stand now; if not, a new one is being made
    // Of its points:
    osg::ref_ptr<osg::Texture2D> diffuse;        // what their Lambert layers reflect
    osg::ref_ptr<osg::Texture2D> glossy;         // what their lobes reflect; null: none has one
    osg::ref_ptr<osg::Texture2D> emissions;      // null: none emits
    osg::ref_ptr<osg::Texture2D> surfaceColors;  // SceneRays::colors(); null: no rays meet the scene
    double polishedShare = 0.0;  // of the surfaces, that are of polished metal
    TransportTargets targets;
    double mostReflected = 1.0;  // by any surface, of what it receives

    bool fresh = true;          // nothing has been drawn into the targets
    bool relinked = true;       // what has been drawn of points is of those of a former scene
    unsigned turns = 0;         // frames in which points will be lit after this one
    unsigned rows = 0;          // of every so many rows of points one is lit in this frame; 0: none is due
    unsigned bounces = 0;       // that are drawn in this frame
    unsigned laterBounces = 0;  // and after it
    double share = 0.0;         // of the picture's indirect light; the rest is the mean radiance of what blocks light

    /** Further frames would change the picture by themselves. */
    bool isSettling() const { return fresh || turns > 0 || laterBounces > 0 || share < 1.0; }
};

}  // namespace osgEnvLight
