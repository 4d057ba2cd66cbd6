/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Limits.h"

#include <osgEnvLight/Export>

#include <osg/FrameBufferObject>
#include <osg/Texture2D>

#include <array>
#include <vector>

namespace osgEnvLight
{

/** What is drawn of the light between surfaces: it stays from frame to frame. */
struct OSGENVLIGHT_EXPORT TransportTargets {
    TransportTargets() = default;
    /** @param columns, probes  of a TransportScene */
    TransportTargets(int columns, int probes);

    int columns = 0;
    int probes = 0;
    osg::ref_ptr<osg::Texture2D> pointLight;                                              // as pass/points.frag
    osg::ref_ptr<osg::Texture2D> pointMirrored;                                           // the same; null: nothing is glossy
    osg::ref_ptr<osg::Texture2D> pointRadiance;                                           // as pass/pointradiance.frag
    std::array<osg::ref_ptr<osg::Texture2D>, limits::HARMONICS_TEXTURES> probeHarmonics;  // as pass/probeharmonics.frag
    osg::ref_ptr<osg::Texture2D> probeIrradiance;                                         // as pass/probes.frag
    osg::ref_ptr<osg::Texture2D> pointNear;                                               // as pass/pointnear.frag; or null
    osg::ref_ptr<osg::Texture2D> cellLight;                                               // as pass/surfacecells.frag; or null
    osg::ref_ptr<osg::FrameBufferObject> radianceTarget, harmonicsTarget, irradianceTarget, nearTarget, cellTarget;

    void makePointMirrored();
    void makePointNear();
    /** @param width, height  of SceneRays */
    void makeCellLight(int width, int height);

    std::vector<osg::Texture2D*> textures() const;
    std::vector<osg::FrameBufferObject*> frameBuffers() const;
    size_t bytes() const;
    void resizeGLObjectBuffers(unsigned maximum) const;
    void releaseGLObjects(osg::State* state) const;
};

}  // namespace osgEnvLight
