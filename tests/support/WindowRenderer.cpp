// SPDX-License-Identifier: MIT
#include "WindowRenderer.h"

#include "OnScreen.h"

#include <stdexcept>

namespace
{

// Reads what is about to be shown.
class ReadBeforeSwap : public osg::GraphicsContext::SwapCallback
{
  public:
    ReadBeforeSwap(int width, int height) : _width(width), _height(height) {}
    void swapBuffersImplementation(osg::GraphicsContext* context) override
    {
        image = new osg::Image;
        image->readPixels(0, 0, _width, _height, GL_RGBA, GL_UNSIGNED_BYTE);
        context->swapBuffersImplementation();
    }
    osg::ref_ptr<osg::Image> image;

  private:
    const int _width, _height;
};

}  // namespace

WindowRenderer::WindowRenderer(int width, int height, int stencilBits) : _viewer(new osgViewer::Viewer)
{
    _window = makeContext(width, height, false, unsigned(stencilBits));
    if (!_window) throw std::runtime_error("no window: is DISPLAY set?");
    _window->setSwapCallback(new ReadBeforeSwap(width, height));
    _viewer->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    osg::Camera& camera = *_viewer->getCamera();
    camera.setGraphicsContext(_window.get());
    camera.setViewport(0, 0, width, height);
    camera.setDrawBuffer(GL_BACK);
    camera.setReadBuffer(GL_BACK);
    camera.setClearColor(osg::Vec4(0, 0, 0, 0));
    camera.setProjectionMatrixAsPerspective(40.0, double(width) / height, 1.0, 100.0);
    camera.setViewMatrixAsLookAt(osg::Vec3d(0, -4, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1));
}

WindowRenderer::~WindowRenderer() = default;

osg::ref_ptr<osg::Image> WindowRenderer::render(osg::Node* scene, int frames)
{
    if (_viewer->getSceneData() != scene) _viewer->setSceneData(scene);
    if (!_viewer->isRealized()) {
        _viewer->realize();
        _window->getState()->setCheckForGLErrors(osg::State::ONCE_PER_ATTRIBUTE);
    }
    for (int i = 0; i < frames; ++i) _viewer->frame(_time += 1.0 / 30.0);
    return static_cast<ReadBeforeSwap*>(_window->getSwapCallback())->image;
}

osg::Vec4d pixelOf(const osg::Image& image, int x, int y)
{
    const unsigned char* p = image.data(unsigned(x), unsigned(y));
    return osg::Vec4d(p[0], p[1], p[2], p[3]) / 255.0;
}
