/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "lights/DiffuseCarrier.h"
#include "base/Limits.h"
#include "environment/DominantLight.h"
#include "lights/LightStream.h"
#include "environment/MapPyramid.h"

#include <osg/Texture2D>
#include <osg/Uniform>

#include <array>
#include <optional>

namespace osgEnvLight
{

/** What the passes read of one state of the environment map. Each part is made when it is first asked for, and never
 * changed afterwards: a new state of the map is a new object, so that a draw thread finishes with the old one.
 * Radiance and flux are divided by the map's mean, so that half floats hold any map. Not thread-safe: LitScene asks
 * under its lock, a regeneration before it hands the object over.*/
class OSGENVLIGHT_EXPORT MapTextures : public osg::Referenced
{
  public:
    /** Suns at most; further ones stay in the map. */
    static constexpr unsigned maximumSuns = limits::MOST_SUNS;

    /** Which parts were asked for, and what the next state of the same image goes on from. A value. */
    struct Continuation {
        MapOptions options;
        bool latlong = false;
        bool pyramid = false;
        bool prefiltered = false;
        bool harmonics = false;
        bool chosen = false;  // the carrier
        bool diffuseLights = false;
        bool irradiance = false;
        unsigned occlusionLights = 0;
        std::shared_ptr<const OctahedralGrid> grid;
        // Absent for another image:
        DominantLights suns;
        DiffuseCarrier carrier;
        LightStream diffuse{LightStream::PLAIN};
        LightStream occlusion{LightStream::DEALT};
    };

    explicit MapTextures(const RadianceMap* map, const MapOptions& options = MapOptions());
    /** The map's next state: all parts that the former one had are made now, its lists go on. */
    MapTextures(const RadianceMap* map, const Continuation& former);
    /** The same parts; then settle(). */
    explicit MapTextures(const MapTextures& former);

    /** Of a map without light whose lists stand for all directions alike, as those of an even one. */
    static osg::ref_ptr<MapTextures> dark();

    /** One step of the lists towards the cold ones, of a map that no longer changes. */
    void settle();
    /** Whether they are. */
    bool settled() const { return !(_diffuseLights && !_diffuse.settled()) && !(_occlusionMade && !_occlusion.settled()); }

    /** What goes on from here; not goesOn: for another image, which has the same parts and starts cold. */
    Continuation continuation(bool goesOn) const;
    /** Drop the parts that these options would have made otherwise. */
    void use(const MapOptions& options);

    const RadianceMap& map() const { return *_map; }
    /** The map without its suns, and they; the map itself where options.suns is off or there are none. */
    const RadianceMap& residual();
    const DominantLights& suns();
    /** What D and O are made from: the residual where suns is auto, the map where they stay lights of its lists. */
    const RadianceMap& listed();
    SunShare sunShare();

    /** The map itself, top row first in v: bilinear, no mips. RGB 16F, or 32F where a texel exceeds 65504 means. */
    osg::Texture2D* latlong();

    /** The residual's solid-angle mips: an octahedral pyramid of box averages in one atlas (lib/octahedral.glsl). */
    osg::Texture2D* pyramid();
    unsigned pyramidSide() const { return _side; }
    unsigned pyramidLastLevel() const { return osgEnvLight::pyramidLastLevel(_side); }

    /** The same, filtered by lobes of GGX: prefilterPyramid(). */
    osg::Texture2D* prefiltered();

    /** shCoefficients[18]: A_l / pi times the harmonics of listed(). */
    osg::Uniform* harmonics();

    /** What carries D. */
    const DiffuseCarrier& carrier();

    /** The list of D, of listed(): as many lights as carrier() says, or options.diffuseLights where that has none. */
    osg::Texture2D* diffuseLights();
    const LightList& diffuseList();
    /** The irradiance over pi of that list, by the normal: an octahedral map with a border of one texel. */
    osg::Texture2D* irradiance();

    /** The grouped list of O, of listed(): count lights in 16 groups. */
    osg::Texture2D* occlusionLights(unsigned count);
    /** The same as a list: light i is of group i % 16. */
    const LightList& occlusionList(unsigned count);

    /** mapExposure() of the whole map. */
    double exposure();

    /** sunCount, sunDirection[8], sunRadiance[8], sunRadius[8]. */
    void addSuns(std::vector<osg::ref_ptr<osg::Uniform>>& uniforms);

    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;
    /** Bytes of texture memory made so far. */
    size_t bytes() const;

  protected:
    ~MapTextures() override = default;

  private:
    void setFormat(osg::Texture2D& texture, osg::Image* image) const;
    osg::ref_ptr<osg::Image> scaledMap() const;
    const SunSplit& split();
    std::array<osg::Texture2D*, 6> textures() const;  // null: not made
    void makeSunUniforms();

    osg::ref_ptr<const RadianceMap> _map;
    std::optional<double> _exposure;
    MapOptions _options;
    double _scale;
    unsigned _side;
    std::shared_ptr<const OctahedralGrid> _grid;
    SunSplit _split;  // residual null: not yet made
    DominantLights _formerSuns;
    osg::ref_ptr<osg::Texture2D> _latlong;
    osg::ref_ptr<osg::Texture2D> _pyramid;
    osg::ref_ptr<osg::Texture2D> _prefiltered;
    osg::ref_ptr<osg::Uniform> _harmonics;
    std::vector<osg::ref_ptr<osg::Uniform>> _sunUniforms;
    // Streams that stand at this map's state, or still at the former's.
    LightStream _diffuse{LightStream::PLAIN};
    bool _diffuseMade = false;
    osg::ref_ptr<osg::Texture2D> _diffuseLights;
    osg::ref_ptr<osg::Texture2D> _irradiance;
    LightStream _occlusion{LightStream::DEALT};
    bool _occlusionMade = false;
    osg::ref_ptr<osg::Texture2D> _occlusionLights;
    DiffuseCarrier _carrier;
    bool _carrierMade = false;  // else it is the former state's
};

}  // namespace osgEnvLight
