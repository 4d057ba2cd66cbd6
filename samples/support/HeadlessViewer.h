// SPDX-License-Identifier: MIT
#pragma once

#include "HeadlessContext.h"
#include "SceneOptions.h"

#include <metrics/Picture>

#include <osg/Texture2D>
#include <osgViewer/Viewer>

/** Draws a LitScene as osgviewer would, without a window, into a float texture. */
class HeadlessViewer
{
  public:
    /** Throws std::runtime_error where there is no OpenGL. */
    HeadlessViewer(osgEnvLight::LitScene& lit, const SceneOptions& options);
    ~HeadlessViewer();
    HeadlessViewer(const HeadlessViewer&) = delete;
    HeadlessViewer& operator=(const HeadlessViewer&) = delete;

    /** From the next frame on. */
    void setView(const osgEnvLight::HomeView& view);

    /** One frame at the scene's own time [s], not the clock's. The milliseconds until the GPU is done. */
    double draw(double time);

    /** The last frame: RGBA floats. */
    osg::ref_ptr<osg::Image> image();
    osgEnvLight::Picture picture();

    const HeadlessContext& context() const { return _context; }

  private:
    HeadlessContext _context;
    osgEnvLight::LitScene& _lit;
    const SceneOptions _options;
    osgViewer::Viewer _viewer;
    osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> _window;
    osg::ref_ptr<osg::Texture2D> _texture;
};
