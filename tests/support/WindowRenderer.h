// SPDX-License-Identifier: MIT
#pragma once

#include <osgViewer/Viewer>

/** A viewer with a window, as applications have it: the host's own frame buffer, its post-render cameras, stereo and slaves. It
 * needs a DISPLAY.*/
class WindowRenderer
{
  public:
    WindowRenderer(int width, int height, int stencilBits = 0);
    ~WindowRenderer();

    /** The window's pixels, GL_RGBA of 8 bits from the lower left, after the n-th frame. */
    osg::ref_ptr<osg::Image> render(osg::Node* scene, int frames = 1);
    osgViewer::Viewer& viewer() { return *_viewer; }
    osg::GraphicsContext& window() { return *_window; }

  private:
    osg::ref_ptr<osgViewer::Viewer> _viewer;
    osg::ref_ptr<osg::GraphicsContext> _window;
    double _time = 0.0;
};

/** A pixel of such an image as numbers in [0,1]. */
osg::Vec4d pixelOf(const osg::Image& image, int x, int y);
