/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Caster.h"
#include <osgEnvLight/DirectionalLight>
#include "shadow/ShadowTargets.h"
#include "surface/StaticCasters.h"

#include <osg/BoundingSphere>
#include <osg/Texture2D>

#include <atomic>

namespace osgEnvLight
{

/** The sky shadow atlas of one view: a midpoint map [occlusion.md 3.1] for each light of O's list, and the first surface's
 * slopes, side by side in one texture. It stands in the world, so that a moving camera costs nothing; maps are drawn again,
 * some each frame, when what casts shadows or where a light stands has changed, and until then show what they last showed.
 *
 * Its parts are never replaced: other counts are another atlas. update() decides at cull what the same frame's draw
 * (AtlasRefresh) makes true. */
class OSGENVLIGHT_EXPORT ShadowAtlas : public osg::Referenced
{
  public:
    /** @param lights  a multiple of 16
     * @param size    of a map's side [texels] */
    ShadowAtlas(unsigned lights, unsigned size);

    const unsigned lights;
    const unsigned size;

    /** What a frame draws.
     * @param list    O's lights, in the world; its order is the maps'
     * @param budget  of maps, or of parts of more maps that take about as long. Lights without a map come first, as far apart as
     *                can be. Then flux and age decide */
    std::vector<ShadowRefresh> update(const LightList& list, unsigned budget);
    /** What of the last budget was needed. */
    unsigned spent() const { return _spent; }

    /** Turn the maps by another angle, and shift them by another part of a texel, when they are next drawn. */
    void turn(unsigned sequence) { _turn = sequence; }

    /** Show what lies within the sphere, instead of all that casts shadows; before setCasters(). */
    void setFocus(const osg::BoundingSphered& sphere);
    const osg::BoundingSphered& focus() const { return _focus; }
    /** What the maps show: on its way from the former focus to this one as they are drawn. */
    osg::BoundingSphered shown() const;

    /** What casts shadows now; before update(). */
    void setCasters(const CasterList& casters);

    /** What the maps of update() show: the casters, those that stand still and are solid merged into one; with a focus as they
     * are, for most lie beyond it. */
    std::vector<Caster> drawn() const { return _focus.valid() ? _casters.all() : _still.drawn(); }
    /** The casters that stand still; without a focus. */
    const StaticCasters& still() const { return _still; }
    /** Triangles of drawn(). */
    size_t triangles() const { return trianglesOf(drawn()); }

    /** Whether they threw other shadows the frame before. */
    bool moved() const { return _moved; }

    /** Lights that have no map yet, or an outdated one. */
    unsigned waiting() const { return _waiting; }
    /** Changes whenever lightImage() does; 0 before the first update(). */
    unsigned version() const { return _version; }
    /** What everything below is relative to, in the world. */
    const osg::Vec3d& origin() const { return _targets.origin; }

    /** The largest side of a texel in the world. */
    double texel() const;
    /** Whether any light has a map, outdated or not. */
    bool hasMap() const;
    /** Whether all lights have one. */
    bool complete() const;

    /** Four rows a group: across, up and along in the map's texels and heights, flux [pass/atlas.glsl]; RGBA 32F. Where some
     * lights have no map yet, the nearest one that has takes their flux.
     * @param finer  atlas of the same lights with a focus, of which as many rows follow; null: none */
    osg::ref_ptr<osg::Image> lightImage(double scale, const ShadowAtlas* finer) const;

    /** By direction in the world, an octahedral map of two texels a cell: the numbers of the lights nearest to it, the nearest
     * first, 16 i + q of light i of group q, each in half of one of the 32-bit integers of RGBA.*/
    osg::ref_ptr<osg::Image> nearestImage() const;

    osg::Texture2D* texture() { return _targets.texture.get(); }
    const ShadowTargets& targets() const { return _targets; }

    void resizeGLObjectBuffers(unsigned maximum);
    /** All maps are lost. */
    void releaseGLObjects(osg::State* state) const;
    size_t bytes() const;

  protected:
    ~ShadowAtlas() override = default;

  private:
    // Where a map stands: the cube about center of half-side radius, seen along the direction to the light. What lies above it
    // casts shadows into it.
    struct Map : KeptMap {
        osg::Vec3d across, up, along;
        osg::Vec3d center;
        double radius = 0.0;
        bool former = false;  // what is drawn is of a light that is elsewhere now
        osg::Vec3d flux;      // of the light it shows
        double solidAngle = 0.0;
    };
    void setLights(const LightList& list);
    std::vector<unsigned> servingLights() const;
    bool fit(const osg::BoundingBoxd& bound);
    void place(Map& map, unsigned index, const osg::Vec3d& direction) const;
    void writePlace(osg::Image& image, unsigned index, unsigned firstRow, const osg::Vec3d& origin) const;
    bool showsAs(const ShadowAtlas& other, unsigned index) const;
    double priority(const Map& map, const osg::Vec3d& flux) const;
    double cost(const ShadowRefresh& refresh) const;
    ShadowRefresh draw(unsigned index);
    osg::Matrixd projection(const Map& map) const;

    std::vector<Map> _maps;
    LightList _list;
    std::vector<double> _solidAngles;
    std::vector<unsigned> _rank;  // of each light, by when its first map is drawn
    ShownCasters _casters;
    StaticCasters _still;
    bool _moved = false;
    bool _fitted = false;  // the maps are to show another part of the world
    unsigned _turn = 0;
    osg::BoundingBoxd _box;
    osg::BoundingSphered _focus;  // invalid: all of it
    osg::BoundingSphered _formerFocus;
    unsigned _waiting = 0;
    unsigned _spent = 0;
    unsigned _version = 0;
    mutable std::atomic<bool> _lost{false};
    ShadowTargets _targets;
};

}  // namespace osgEnvLight
