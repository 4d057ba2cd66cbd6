// SPDX-License-Identifier: MIT
#include "HeadlessViewer.h"

#include "TextureImage.h"
#include "gl/TargetTexture.h"

#include <chrono>

HeadlessViewer::HeadlessViewer(osgEnvLight::LitScene& lit, const SceneOptions& options) : _lit(lit), _options(options)
{
    _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    _viewer.setUseConfigureAffinity(false);  // else this process would run on one processor
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

void HeadlessViewer::setView(const osgEnvLight::HomeView& view)
{
    _options.setCamera(view, *_viewer.getCamera());
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
    return readTexture(*_texture, *_window->getState());
}

osgEnvLight::Picture HeadlessViewer::picture()
{
    return pictureOf(*image());
}
