// SPDX-License-Identifier: MIT
#include "HeadlessViewer.h"

#include "gl/TargetTexture.h"

#include <algorithm>
#include <chrono>

HeadlessViewer::HeadlessViewer(osgEnvLight::LitScene& lit, const SceneOptions& options) : _lit(lit)
{
    _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    _window = _viewer.setUpViewerAsEmbeddedInWindow(0, 0, options.width, options.height);
    _viewer.setSceneData(&lit);
    osg::Camera& camera = *_viewer.getCamera();
    options.setCamera(lit, camera);
    camera.setClearColor(osg::Vec4(0, 0, 0, 0));
    camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    _texture = osgEnvLight::targetTexture(options.width, options.height, GL_RGBA32F_ARB);
    camera.attach(osg::Camera::COLOR_BUFFER, _texture);
    _window->getState()->setCheckForGLErrors(osg::State::ONCE_PER_FRAME);
    _viewer.realize();
}

HeadlessViewer::~HeadlessViewer()
{
    _lit.releaseGLObjects(_window->getState());
}

double HeadlessViewer::draw(double time)
{
    const auto start = std::chrono::steady_clock::now();
    _viewer.frame(time);
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

osg::ref_ptr<osg::Image> HeadlessViewer::image()
{
    osg::State& state = *_window->getState();
    osg::ref_ptr<osg::Image> image = new osg::Image;
    state.setActiveTextureUnit(0);
    _texture->getTextureObject(state.getContextID())->bind();
    image->readImageFromCurrentTexture(state.getContextID(), false, GL_FLOAT);
    state.haveAppliedTextureAttribute(0, osg::StateAttribute::TEXTURE);
    return image;
}

osgEnvLight::Picture HeadlessViewer::picture()
{
    const osg::ref_ptr<osg::Image> read = image();
    osgEnvLight::Picture picture(read->s(), read->t());
    std::copy_n(reinterpret_cast<const float*>(read->data()), picture.rgba.size(), picture.rgba.begin());
    return picture;
}
