/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/Camera>

namespace osgEnvLight
{

/** A camera of ours, off the graph; a LitScene met under it is inside another one. */
class StageCamera : public osg::Camera
{
  public:
    /** A copy of a plain one, since a camera made by itself reads the environment's variables and prints that it does. */
    StageCamera() : osg::Camera(plain()) {}

  private:
    static const osg::Camera& plain()
    {
        static const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
        return *camera;
    }
};

}  // namespace osgEnvLight
