// SPDX-License-Identifier: MIT
#include "SceneView.h"

#include "TextureImage.h"
#include "gl/TargetTexture.h"

#include <osg/GLExtensions>
#include <osgViewer/Renderer>

#include <algorithm>
#include <chrono>

SceneView::SceneView(osgEnvLight::LitScene& lit, SceneOptions options, int width, int height)
    : _lit(lit), _manipulator(new osgGA::TrackballManipulator)
{
    _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    _viewer.setUseConfigureAffinity(false);  // else this process would run on one processor
    _window = _viewer.setUpViewerAsEmbeddedInWindow(0, 0, width, height);
    _window->getState()->setCheckForGLErrors(osg::State::ONCE_PER_FRAME);
    if (const auto view = options.chosenView(lit)) lit.setHomeView(*view);
    _viewer.setSceneData(&lit);
    osg::Camera& camera = *_viewer.getCamera();
    options.width = width;
    options.height = height;
    const osgEnvLight::HomeView first = options.view(lit);
    options.setCamera(first, camera);
    _homeFovy = first.fovy;
    _fovyWithoutHome = options.openingAngle();
    // Several events of the pointer come with one time where frames are slow, and OSG would take any release for a throw.
    _manipulator->setAllowThrow(false);
    _viewer.setCameraManipulator(_manipulator);
    camera.setClearColor(osg::Vec4(0, 0, 0, 0));
    camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    makeTargets(width, height);
    _viewer.realize();
    requestRedraw();
}

SceneView::~SceneView()
{
    _lit.releaseGLObjects(_window->getState());
}

void SceneView::makeTargets(int width, int height)
{
    osg::Camera& camera = *_viewer.getCamera();
    _drawn = osgEnvLight::targetTexture(width, height, GL_RGBA32F_ARB);
    _kept = osgEnvLight::targetTexture(width, height, GL_RGBA32F_ARB);
    _drawnFrame = osgEnvLight::frameBufferOf(_drawn);
    _keptFrame = osgEnvLight::frameBufferOf(_kept);
    camera.detach(osg::Camera::COLOR_BUFFER);
    camera.attach(osg::Camera::COLOR_BUFFER, _drawn);
    // OSG makes the frame buffer of a stage once, whatever is attached to the camera later.
    auto& renderer = static_cast<osgViewer::Renderer&>(*camera.getRenderer());
    for (unsigned i = 0; i < 2; ++i)
        if (osgUtil::SceneView* view = renderer.getSceneView(i)) view->getRenderStage()->setFrameBufferObject(nullptr);
    camera.dirtyAttachmentMap();
}

void SceneView::resize(int width, int height)
{
    if (width < 1 || height < 1 || (width == this->width() && height == this->height())) return;
    _window->resized(0, 0, width, height);
    _window->getEventQueue()->windowResize(0, 0, width, height);
    // A context leaves cameras with targets of their own as they are.
    osg::Camera& camera = *_viewer.getCamera();
    camera.setViewport(new osg::Viewport(0, 0, width, height));
    double fovy, aspect, near, far;
    if (camera.getProjectionMatrixAsPerspective(fovy, aspect, near, far))
        camera.setProjectionMatrixAsPerspective(fovy, double(width) / height, near, far);
    makeTargets(width, height);
    requestRedraw();
}

void SceneView::handle(const InputEvent& event)
{
    osgGA::EventQueue& queue = *_window->getEventQueue();
    const float x = float(event.x), y = float(event.y);
    switch (event.type) {
        case InputEvent::KEY:
            queue.keyPress(event.key);
            queue.keyRelease(event.key);
            break;
        case InputEvent::PRESS:
            queue.mouseButtonPress(x, y, unsigned(event.button));
            break;
        case InputEvent::RELEASE:
            queue.mouseButtonRelease(x, y, unsigned(event.button));
            break;
        case InputEvent::MOVE:
            queue.mouseMotion(x, y);
            break;
        case InputEvent::SCROLL:
            if (event.y != 0.0)
                queue.mouseScroll(event.y > 0.0 ? osgGA::GUIEventAdapter::SCROLL_UP : osgGA::GUIEventAdapter::SCROLL_DOWN);
            break;
        case InputEvent::DROP:
        case InputEvent::REDRAW:
            return;
    }
    requestRedraw();
}

void SceneView::goHome()
{
    setOpeningAngle(_homeFovy);
    _viewer.home();
    requestRedraw();
}

void SceneView::look(const osgEnvLight::HomeView& view)
{
    setOpeningAngle(view.fovy);
    _manipulator->setTransformation(view.eye, view.target, view.up);
    requestRedraw();
}

void SceneView::setOpeningAngle(double fovy)
{
    double former, aspect, near, far;
    osg::Camera& camera = *_viewer.getCamera();
    if (camera.getProjectionMatrixAsPerspective(former, aspect, near, far))
        camera.setProjectionMatrixAsPerspective(fovy, aspect, near, far);
}

void SceneView::goTo(const std::optional<osgEnvLight::HomeView>& home)
{
    if (home) _manipulator->setHomePosition(home->eye, home->target, home->up);
    _homeFovy = home ? home->fovy : _fovyWithoutHome;
    _manipulator->setAutoComputeHomePosition(!home);
    _manipulator->setNode(&_lit);
    goHome();
}

osgEnvLight::HomeView SceneView::camera() const
{
    const osg::Camera& camera = *_viewer.getCamera();
    osgEnvLight::HomeView view;
    camera.getViewMatrixAsLookAt(view.eye, view.target, view.up, std::max(_manipulator->getDistance(), 1e-6));
    double aspect, near, far;
    camera.getProjectionMatrixAsPerspective(view.fovy, aspect, near, far);
    return view;
}

double SceneView::draw()
{
    const auto start = std::chrono::steady_clock::now();
    _viewer.frame();
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void SceneView::keep()
{
    copy(*_drawnFrame, _keptFrame);
}

void SceneView::show()
{
    copy(*_keptFrame, nullptr);
}

// Null: to the window.
void SceneView::copy(osg::FrameBufferObject& from, osg::FrameBufferObject* to)
{
    osg::State& state = *_window->getState();
    const osg::GLExtensions& gl = *state.get<osg::GLExtensions>();
    if (to)
        to->apply(state, osg::FrameBufferObject::DRAW_FRAMEBUFFER);
    else
        gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, 0);
    from.apply(state, osg::FrameBufferObject::READ_FRAMEBUFFER);
    state.applyMode(GL_SCISSOR_TEST, false);
    gl.glBlitFramebuffer(0, 0, width(), height(), 0, 0, width(), height(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, 0);
}

osg::ref_ptr<osg::Image> SceneView::read(osg::Texture2D& texture)
{
    return readTexture(texture, *_window->getState());
}
