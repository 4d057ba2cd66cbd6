// SPDX-License-Identifier: MIT
#pragma once

#include <HeadlessContext.h>

#include <metrics/Picture>

#include <osgEnvLight/LitScene>

#include <osg/Geode>
#include <osg/Notify>

#include <osgViewer/Viewer>

#include <array>
#include <vector>

using osgEnvLight::Picture;

/** Root mean square and largest difference of two pictures' colours. */
double rootMeanSquare(const Picture& a, const Picture& b);
double largestDifference(const Picture& a, const Picture& b);

/** Of all channels of the pixels with geometry. */
struct Statistics {
    double least = 1e30;
    double most = -1e30;
    double mean = 0.0;
    int pixels = 0;
};
Statistics ofGeometry(const Picture& picture);

/** Draws scene graphs into float pictures, in a headless context of its own: a State of OSG's takes a fresh context for
 * granted. One at a time is current.*/
class SceneRenderer
{
  public:
    SceneRenderer(int width, int height);

    /** The picture of the n-th frame, of the size of the camera's viewport. The projection's near and far follow the scene, as in
     * any viewer. */
    Picture render(osg::Node* scene, int frames = 1);

    /** Milliseconds of each of the frames, until the GPU is done, into a texture: nothing is read back. render() can't be
     * used afterwards.*/
    std::vector<double> time(osg::Node* scene, int frames);

    void lookAt(const osg::Vec3d& eye, const osg::Vec3d& target, const osg::Vec3d& up = osg::Vec3d(0, 0, 1), double fovy = 40.0);
    /** Where a point of the world lies in the picture, in pixels from the lower left corner. */
    osg::Vec2d pixelOf(const osg::Vec3d& point) const;
    osgViewer::Viewer& viewer() { return _viewer; }
    osg::State& state() { return *_window->getState(); }

  private:
    void attachImage(int width, int height);

    HeadlessContext _context;
    osgViewer::Viewer _viewer;
    osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> _window;
    osg::ref_ptr<osg::Image> _image;
    int _width;
    int _height;
    double _time = 0.0;
};

/** An environment image from a function of the direction. */
template <class Radiance>
osg::ref_ptr<osg::Image> makeMap(int width, int height, Radiance radiance)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGB, GL_FLOAT);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            // Written out here, not taken from the library: top row +Z, centre +X, columns clockwise seen from above.
            const double theta = osg::PI * (y + 0.5) / height;
            const double phi = 2.0 * osg::PI * (0.5 - (x + 0.5) / width);
            const osg::Vec3d c =
                radiance(osg::Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
            float* p = reinterpret_cast<float*>(image->data(unsigned(x), unsigned(height - 1 - y)));
            for (int k = 0; k < 3; ++k) p[k] = float(c[k]);
        }
    return image;
}

osg::ref_ptr<osg::Image> constantMap(double radiance);

/** Bright from one side, so that shadows have a shape: a broad lobe over an even sky. */
osg::ref_ptr<osg::Image> lopsidedMap(const osg::Vec3d& sky = osg::Vec3d(0.2, 0.25, 0.3),
                                     const osg::Vec3d& lobe = osg::Vec3d(2.0, 1.8, 1.6));

/** Red +X, cyan -X, green +Y, magenta -Y, blue +Z, yellow -Z: by the largest component of the direction. */
osg::Vec3d sixDirectionColor(const osg::Vec3d& direction);

/** Geometry with normals; each with its own state set. */
osg::ref_ptr<osg::Geode> makeSphere(const osg::Vec3d& center, double radius, int segments = 128);
osg::ref_ptr<osg::Geode> makeQuad(const osg::Vec3d& corner, const osg::Vec3d& a, const osg::Vec3d& b);
/** Axis-aligned box between two corners. */
osg::ref_ptr<osg::Geode> makeBox(const osg::Vec3d& low, const osg::Vec3d& high);

/** A LitScene with linear output and that map; light between its surfaces by the mean, which needs no thread. */
osg::ref_ptr<osgEnvLight::LitScene> makeLit(osg::Image* map);

/** bounceProbes of tests that are not about the light between surfaces: in a software renderer the default's probes take longer
 * than all else of a small picture. */
constexpr int fewestProbes = 4;

/** Catches osg::notify for its life time. */
class NotifyCatcher
{
  public:
    NotifyCatcher();
    ~NotifyCatcher();
    /** All text at NOTICE and above. */
    const std::string& text() const;
    void clear();

  private:
    class Handler;
    osg::ref_ptr<osg::NotifyHandler> _former;
    osg::ref_ptr<Handler> _handler;
};
