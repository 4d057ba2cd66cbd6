// SPDX-License-Identifier: MIT
#include "OnScreen.h"

#include <osg/GLExtensions>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <ostream>
#include <stdexcept>

std::ostream& operator<<(std::ostream& out, const GlObjects& n)
{
    return out << n.textures << " textures, " << n.buffers << " buffers, " << n.frameBuffers << " frame buffers, " << n.programs
               << " programs, " << n.queries << " queries";
}

GlObjects countGlObjects(osg::State& state)
{
    const auto* ext = state.get<osg::GLExtensions>();
    auto isFrameBuffer = reinterpret_cast<GLboolean (*)(GLuint)>(osg::getGLExtensionFuncPtr("glIsFramebuffer"));
    GlObjects n;
    for (GLuint i = 1; i < 65536; ++i) {  // names are not used again at once
        n.textures += glIsTexture(i);
        n.buffers += ext->glIsBuffer(i);
        n.frameBuffers += isFrameBuffer(i);
        n.programs += ext->glIsProgram(i);
        n.queries += ext->glIsQuery(i);
    }
    return n;
}

long ResidentGrowth::now()
{
#ifdef __SANITIZE_ADDRESS__
    return 0;  // it keeps what is freed
#endif
    std::ifstream in("/proc/self/statm");
    long size = 0;
    long resident = 0;
    in >> size >> resident;
    return resident * 4;
}

osg::ref_ptr<osg::GraphicsContext> makeContext(int width, int height, bool coreProfile, unsigned stencilBits)
{
    if (!std::getenv("DISPLAY")) return nullptr;
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    traits->width = width;
    traits->height = height;
    traits->windowDecoration = false;
    traits->doubleBuffer = true;
    traits->red = traits->green = traits->blue = traits->alpha = 8;
    traits->depth = 24;
    traits->stencil = stencilBits;
    if (coreProfile) {
        traits->glContextVersion = "3.3";
        traits->glContextProfileMask = 1;
    }
    return osg::GraphicsContext::createGraphicsContext(traits.get());
}

void FrameReader::operator()(osg::RenderInfo& renderInfo) const
{
    image = new osg::Image;
    const osg::Viewport& v = *renderInfo.getCurrentCamera()->getViewport();
    image->readPixels(int(v.x()), int(v.y()), int(v.width()), int(v.height()), GL_RGBA, GL_UNSIGNED_BYTE);
    if (counts) objects = countGlObjects(*renderInfo.getState());
}

int largestByteDifference(const osg::Image& a, const osg::Image& b)
{
    int largest = a.getTotalSizeInBytes() == b.getTotalSizeInBytes() ? 0 : 256;
    for (unsigned i = 0; i < a.getTotalSizeInBytes() && largest < 256; ++i)
        largest = std::max(largest, std::abs(int(a.data()[i]) - int(b.data()[i])));
    return largest;
}

void OnScreen::place(osg::Camera& camera, osg::GraphicsContext* context, FrameReader* reader)
{
    if (!context) throw std::runtime_error("no context on the display");
    context->getState()->setCheckForGLErrors(osg::State::ONCE_PER_ATTRIBUTE);
    camera.setGraphicsContext(context);
    camera.setViewport(0, 0, width, height);
    camera.setProjectionMatrixAsPerspective(40, double(width) / height, 1, 10000);
    camera.setViewMatrixAsLookAt(osg::Vec3d(1.5, -6, 4), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    camera.setDrawBuffer(GL_BACK);
    camera.setReadBuffer(GL_BACK);
    camera.setFinalDrawCallback(reader);
}

OnScreen::OnScreen(osg::Node* scene, Threading threading, bool coreProfile) : _viewer(new osgViewer::Viewer)
{
    _viewer->setThreadingModel(threading);
    place(*_viewer->getCamera(), makeContext(width, height, coreProfile).get(), _reader.get());
    _viewer->setSceneData(scene);
    _viewer->realize();
}

OnScreen::~OnScreen() = default;

const osg::Image& OnScreen::draw(int frames)
{
    for (int i = 0; i < frames; ++i) _viewer->frame(_time += 1.0 / 30.0);
    // The draw threads are through with it when they are stopped.
    if (_viewer->areThreadsRunning()) {
        _viewer->stopThreading();
        _viewer->startThreading();
    }
    if (!_reader->image) throw std::runtime_error("nothing was drawn");
    return *_reader->image;
}

GlObjects OnScreen::objects()
{
    _reader->counts = true;
    draw(1);
    _reader->counts = false;
    return _reader->objects;
}

void OnScreen::reopen()
{
    _viewer->stopThreading();
    _viewer->getCamera()->getGraphicsContext()->close();
    place(*_viewer->getCamera(), makeContext(width, height).get(), _reader.get());
    _viewer->realize();
}
