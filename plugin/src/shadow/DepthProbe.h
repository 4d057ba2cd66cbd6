/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Limits.h"

#include <osgEnvLight/Export>

#include <osg/BufferObject>
#include <osg/Matrixd>
#include <osg/Vec3d>

#include <mutex>
#include <optional>
#include <vector>

namespace osgEnvLight
{

/** Some of the points that a view shows, and from where. */
struct ProbedPoints {
    std::vector<osg::Vec3d> points;  // in the world
    std::optional<osg::Vec3d> eye;   // none in an orthographic view
    osg::Matrixd worldFromEye;
};

/** Carries what a view's draw has measured to a later cull. A measurement is read in the next frame that draws one, when the GPU
 * has long made it: nobody waits. */
class OSGENVLIGHT_EXPORT DepthProbe : public osg::Referenced
{
  public:
    static constexpr int side = limits::PROBE_SIDE;  // points measured along each side of the picture

    DepthProbe();

    /** At cull: what has been measured since the last call. */
    std::optional<ProbedPoints> take();

    /** At draw: publish the former measurement, and begin one of the bound frame buffer. */
    void exchange(osg::State& state);

    void resizeGLObjectBuffers(unsigned maximum) { _pixels->resizeGLObjectBuffers(maximum); }
    void releaseGLObjects(osg::State* state) const;

  protected:
    ~DepthProbe() override = default;

  private:
    void publish(const osg::Vec4f* pixels);

    osg::ref_ptr<osg::PixelDataBufferObject> _pixels;
    // Of the draw alone: whether _pixels holds a measurement, and from where.
    mutable bool _begun = false;
    osg::Matrixd _worldFromEye;
    bool _perspective = true;

    std::mutex _mutex;
    std::optional<ProbedPoints> _measured;
};

}  // namespace osgEnvLight
