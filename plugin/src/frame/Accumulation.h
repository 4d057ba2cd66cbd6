/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "lights/MapSequence.h"
#include "surface/Emitter.h"
#include "surface/FogValues.h"
#include "surface/SceneLights.h"
#include <osgEnvLight/Settings>

#include <osg/Matrixd>
#include <osg/Viewport>

#include <atomic>
#include <cstdint>
#include <optional>

namespace osgUtil
{
class RenderBin;
}

namespace osgEnvLight
{

/** True if they differ in near and far alone, which OSG goes on adjusting in the last digits. */
OSGENVLIGHT_EXPORT bool sameProjection(const osg::Matrixd& a, const osg::Matrixd& b);

/** The average of a still view [occlusion.md 5.1]: how many frames are in it, what the next one adds, and when it starts
 * anew. The pixels are in a Target of the view, the shadow maps of a frame's lights in a ShadowAtlas of its own.*/
class OSGENVLIGHT_EXPORT Accumulation : public osg::Referenced
{
  public:
    /** All that a picture follows from; two frames of one key show the same. */
    struct Key {
        osg::Matrixd view;
        osg::Matrixd projection;
        osg::Matrixd mapFromWorld;
        double radianceScale = 0.0;
        osg::ref_ptr<const Settings> settings;
        SceneLightList lights;
        std::vector<Emitter> areaLights;
        FogValues fog;
        int background = 0;                          // that settings.background comes to
        osg::ref_ptr<const osg::Viewport> viewport;  // another one for another size
        osg::ref_ptr<const osg::Referenced> textures;
        uint64_t surfaces = 0;  // surfacesOf()

        bool operator==(const Key& other) const;
    };

    /** Frames over which the picture goes over from the normal one to the average. */
    static constexpr unsigned fadeFrames = 16;

    /** A frame of this key. It adds to the average if it stands still since the last one, and the average has fewer frames than
     * Settings::accumulateFrames; the first frame of a key is the normal one. */
    void advance(const Key& key, bool still, const RadianceMap& map);

    /** In the average, with this one; 0: this is a normal frame. */
    unsigned frames() const { return _frames; }
    /** Whether this frame adds to it. */
    bool adds() const { return _adds; }

    /** This frame's lights, in the map's frame: as many as Settings::accumulateLights. */
    const LightList& lights() const { return _lights; }
    /** Those of all frames. */
    unsigned lightCount() const { return _frames * unsigned(_lights.size()); }
    /** Side of its shadow maps: half as large in the first frames, when what few lights do hides what coarse maps do. */
    unsigned mapSize() const { return _mapSize; }
    /** The frame's weight: coarse maps count for less. */
    double weight() const { return _weight; }
    double weightSum() const { return _weightSum; }
    /** Frames of equal weight that would average as well. */
    double equalFrames() const { return _squareSum > 0.0 ? _weightSum * _weightSum / _squareSum : 0.0; }
    /** Of the average in the picture; the rest is the first frame. */
    double share() const;

    /** Estimated standard error of the average over its mean, both over the pixels with geometry; negative: not known yet.
     * Written by the draw. */
    double standardError() const { return _error; }
    /** @param run  that was measured; a former one is ignored */
    void setStandardError(unsigned run, double error) const;
    /** Counts the keys. */
    unsigned run() const { return _run; }

  protected:
    ~Accumulation() override = default;

  private:
    void begin(const Key& key);
    void add(const RadianceMap& map);

    Key _key;
    std::optional<MapSequence> _sequence;
    LightList _lights;
    unsigned _frames = 0;
    bool _adds = false;
    unsigned _mapSize = 0;
    double _weight = 0.0;
    double _weightSum = 0.0;
    double _squareSum = 0.0;
    std::atomic<unsigned> _run{0};
    mutable std::atomic<double> _error{-1.0};
};

/** A number that changes with what the bin and those inside it draw: which drawables, where, with which vertices, materials,
 * textures and uniforms. In-place changes of other state attributes don't count.
 * @param top    not counted itself, nor the uniforms above it: the program below has its own
 * @param frame  its number, which counts where a SurfaceProgram follows time */
OSGENVLIGHT_EXPORT uint64_t surfacesOf(const osgUtil::RenderBin& bin, const osg::StateSet* top, unsigned frame);

}  // namespace osgEnvLight
