/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "indirect/ProbeGrid.h"
#include "indirect/SceneRays.h"

#include <osg/StateSet>
#include <osg/Texture2D>

namespace osgEnvLight
{

/** What light does between the surfaces of a scene that stands still, for the GPU: surface points, and probes that know which of
 * them they see. Light and reflectance may change; nothing of this does. */
class OSGENVLIGHT_EXPORT TransportScene : public osg::Referenced
{
  public:
    /** Takes from milliseconds to seconds: for a thread of its own.
     * @param scene   about an origin
     * @param view    about the same
     * @param origin  of the scene, in the world
     * @param most    as of ProbeGrid
     * @param mostOpen  rays are to meet it if openShare is that at most; 0: none are
     * @param stop    set by another thread: empty() */
    TransportScene(const TracedScene& scene, const osg::Vec3d& origin, int most, double mostOpen, const TransportFocus& view = {},
                   const std::atomic<bool>* stop = nullptr);

    /** There is no surface that could send light on, or it was stopped. */
    bool empty() const { return !pointPlaces; }

    const osg::Vec3d origin;
    const size_t triangles;
    double pointSpacing = 0.0;   // side of the square that a surface point stands for
    std::array<int, 3> count{};  // probes along each axis, of each level
    int lattices = 0;            // levels about the view, besides that of all the scene
    int probes() const { return (1 + lattices) * count[0] * count[1] * count[2]; }
    double openShare = 1.0;  // of directions in which ProbeGrid::closedPart of the probes see no surface, at most
    int columns = 0;         // probes side by side in the textures of probes

    // POINT_SIDE x POINT_SIDE, one texel a point: position; normal and 1.
    osg::ref_ptr<osg::Texture2D> pointPlaces, pointNormals;
    // POINT_LINKS x POINT_SIDE wide: of each point, side by side, linkPoints() in the same codes; null: no surface is close to
    // another.
    osg::ref_ptr<osg::Texture2D> pointLinks;
    // The same of their parts, POINT_PART_SIDE x POINT_PART_SIDE texels in the place of a point's.
    osg::ref_ptr<osg::Texture2D> partPlaces, partNormals;
    // columns x columns: position, and how much it counts: less than 1 where another stands for a probe within a body.
    osg::ref_ptr<osg::Texture2D> probePlaces;
    // One row a probe, one texel a direction: its ProbeGrid::Links, as pass/pointlink.glsl reads them.
    osg::ref_ptr<osg::Texture2D> probeLinks;
    // One row for three spherical harmonics, one texel a direction: their values there, times the direction's share of the sphere
    // and what a cosine leaves of the harmonic's band, over pi.
    osg::ref_ptr<osg::Texture2D> probeBasis;
    // columns x columns octahedral maps, each with a border of one texel: distance and its square.
    osg::ref_ptr<osg::Texture2D> probeDepths;

    /** Null: none were asked for, or it has more than SceneRays::mostTriangles. */
    osg::ref_ptr<SceneRays> rays;

    /** The above as pass/probegrid.glsl takes it. */
    osg::ref_ptr<osg::StateSet> uniforms;

    /** What the points send on, texels as pointPlaces; alpha is 1 where the surface is isPolished(). parts: those that the scene
     * was made from, as they are now. */
    osg::ref_ptr<osg::Texture2D> diffuse(const StaticCasters::Parts& parts) const;
    /** Of the points' surfaces the share that isPolished(). */
    double polishedShare(const StaticCasters::Parts& parts) const;
    /** Null: nothing is glossy. */
    osg::ref_ptr<osg::Texture2D> glossy(const StaticCasters::Parts& parts) const;
    /** Null: nothing emits. */
    osg::ref_ptr<osg::Texture2D> emissions(const StaticCasters::Parts& parts) const;

    size_t bytes() const;
    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;

  protected:
    ~TransportScene() override = default;

  private:
    void writePoints(const std::vector<SurfacePoint>& points);
    void writePointLinks(const std::vector<int>& links);
    void writeParts(const std::vector<SurfacePart>& parts);
    void writeProbes(const ProbeGrid& grid);
    void writeLevels(const std::vector<ProbeGrid::Level>& levels);
    osg::ref_ptr<osg::Texture2D> ofPoints(const StaticCasters::Parts& parts, osg::Vec3f SentLight::*member) const;
    osg::ref_ptr<osg::Texture2D> ofSome(const StaticCasters::Parts& parts, osg::Vec3f SentLight::*member) const;
    std::vector<osg::Texture2D*> textures() const;

    std::vector<unsigned> _surfaceOf;  // of each point
};

}  // namespace osgEnvLight
