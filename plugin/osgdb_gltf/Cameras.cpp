// SPDX-License-Identifier: MIT
#include "Cameras.h"

#include <osg/Math>

namespace osgEnvLight::gltf
{

osg::ref_ptr<osg::CameraView> makeCamera(const Asset::Camera& camera, const tinygltf::Node& node)
{
    osg::ref_ptr<osg::CameraView> view = new osg::CameraView;
    view->setName(camera.name.empty() ? node.name : camera.name);
    view->setFieldOfView(osg::RadiansToDegrees(camera.yfov));
    view->setFieldOfViewMode(osg::CameraView::VERTICAL);
    return view;
}

}  // namespace osgEnvLight::gltf
