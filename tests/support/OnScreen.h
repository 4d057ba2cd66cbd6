// SPDX-License-Identifier: MIT
#pragma once

#include <osgViewer/Viewer>

#include <algorithm>
#include <limits>

/** How many objects of OpenGL there are. */
struct GlObjects {
    int textures = 0;
    int buffers = 0;
    int frameBuffers = 0;
    int programs = 0;
    int queries = 0;

    bool operator==(const GlObjects& o) const
    {
        return textures == o.textures && buffers == o.buffers && frameBuffers == o.frameBuffers && programs == o.programs &&
               queries == o.queries;
    }
};
std::ostream& operator<<(std::ostream& out, const GlObjects& n);

/** Those of the current context. */
GlObjects countGlObjects(osg::State& state);

/** Growth of this process's resident memory from some points in time to later ones. The driver frees in bursts of tens of MB, so
 * that it is the least of the later ones less the most of the former. */
class ResidentGrowth
{
  public:
    void before() { _before = std::max(_before, now()); }
    void after() { _after = std::min(_after, now()); }
    long kilobytes() const { return _after - _before; }
    /** What the driver's allocators may hold by chance: they free in bursts of about 40 MB. */
    static constexpr long chance = 60000;

  private:
    static long now();
    long _before = 0;
    long _after = std::numeric_limits<long>::max();
};

/** A new window on the display that DISPLAY names, with a context of its own; null if there is none. */
osg::ref_ptr<osg::GraphicsContext> makeContext(int width, int height, bool coreProfile = false, unsigned stencilBits = 0);

/** Reads the picture at the end of each frame, and counts the context's objects when asked to. */
class FrameReader : public osg::Camera::DrawCallback
{
  public:
    void operator()(osg::RenderInfo& renderInfo) const override;

    bool counts = false;
    mutable osg::ref_ptr<osg::Image> image;
    mutable GlObjects objects;
};

/** Largest difference of two pictures' bytes; 256 if their sizes differ. */
int largestByteDifference(const osg::Image& a, const osg::Image& b);

/** A viewer of the user's, with a window of its own on the display. Errors of OpenGL reach osg::notify. */
class OnScreen
{
  public:
    static constexpr int width = 64;
    static constexpr int height = 48;
    using Threading = osgViewer::ViewerBase::ThreadingModel;

    explicit OnScreen(osg::Node* scene, Threading threading = osgViewer::ViewerBase::SingleThreaded, bool coreProfile = false);
    ~OnScreen();

    /** Draws frames; the last one's picture. */
    const osg::Image& draw(int frames);
    /** Draws a frame; what its context then has. */
    GlObjects objects();

    /** Close the window, and go on in a new one. */
    void reopen();

    osgViewer::Viewer& viewer() { return *_viewer; }
    osg::State& state() { return *_viewer->getCamera()->getGraphicsContext()->getState(); }

    /** Show the scene of a camera at eye in a context. */
    static void place(osg::Camera& camera, osg::GraphicsContext* context, FrameReader* reader);

  private:
    osg::ref_ptr<osgViewer::Viewer> _viewer;
    osg::ref_ptr<FrameReader> _reader = new FrameReader;
    double _time = 0.0;
};
