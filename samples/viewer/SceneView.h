// SPDX-License-Identifier: MIT
#pragma once

#include "InputEvent.h"
#include "SceneOptions.h"

#include <osg/FrameBufferObject>
#include <osg/Texture2D>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>

/** A LitScene as osgviewer shows it, drawn into a texture of floats: what lies over it is drawn again without it. */
class SceneView
{
  public:
    /** The view that the options choose, in a picture of that size; an OpenGL context is current. */
    SceneView(osgEnvLight::LitScene& lit, SceneOptions options, int width, int height);
    ~SceneView();
    SceneView(const SceneView&) = delete;
    SceneView& operator=(const SceneView&) = delete;

    int width() const { return _drawn->getTextureWidth(); }
    int height() const { return _drawn->getTextureHeight(); }
    void resize(int width, int height);

    /** For the manipulator of the camera and the scene; keys as pressed and released. */
    void handle(const InputEvent& event);
    /** To the home position. */
    void goHome();
    /** Moves the camera to a view. The home position stays as it is. */
    void look(const osgEnvLight::HomeView& view);
    /** To the scene as it is now, which has this home position, or OSG's. */
    void goTo(const std::optional<osgEnvLight::HomeView>& home);
    osgEnvLight::HomeView camera() const;

    void requestRedraw() { _viewer.requestRedraw(); }
    /** Whether something has changed or goes on: an animation, the light of a new map, a still view that converges. */
    bool needsFrame() { return _viewer.checkNeedToDoFrame(); }
    /** The milliseconds until the GPU is done. */
    double draw();
    /** What was drawn last is what show() shows from now on. */
    void keep();
    /** Copy what was kept to the window. */
    void show();

    /** RGBA floats: what was drawn, and what was kept. */
    osg::ref_ptr<osg::Image> drawnImage() { return read(*_drawn); }
    osg::ref_ptr<osg::Image> keptImage() { return read(*_kept); }

  private:
    void setOpeningAngle(double fovy);
    void makeTargets(int width, int height);
    void copy(osg::FrameBufferObject& from, osg::FrameBufferObject* to);
    osg::ref_ptr<osg::Image> read(osg::Texture2D& texture);

    osgEnvLight::LitScene& _lit;
    osgViewer::Viewer _viewer;
    osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> _window;
    osg::ref_ptr<osgGA::TrackballManipulator> _manipulator;
    double _homeFovy = 0.0;
    double _fovyWithoutHome = 0.0;  // degrees, of scenes that bring no view
    osg::ref_ptr<osg::Texture2D> _drawn;
    osg::ref_ptr<osg::Texture2D> _kept;
    osg::ref_ptr<osg::FrameBufferObject> _drawnFrame;
    osg::ref_ptr<osg::FrameBufferObject> _keptFrame;
};
