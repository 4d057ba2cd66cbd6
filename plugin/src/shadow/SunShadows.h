/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Limits.h"
#include "surface/Caster.h"
#include "environment/DominantLight.h"
#include "shadow/ShadowTargets.h"
#include "shadow/VisibleBoxes.h"

#include <osg/Texture2D>
#include <osg/Uniform>

#include <array>
#include <atomic>

namespace osgEnvLight
{

/** The shadow maps of a view's suns: for each, one of the whole scene, and where its texels are wider than a pixel of the
 * view, smaller ones about what the view shows near the eye, each of at most a quarter of the last one's area.
 * In a large scene they shrink faster, so that the last one is fine enough for what is nearest. Each holds heights along the
 * direction to the sun, of the first surface and half-way to the second.
 *
 * A map stands in the world, on whole texels. It is drawn again when what casts shadows or the sun has moved, or the view
 * has left what it shows; not when the view moves within that. Its parts are never replaced: other counts are other maps. */
class OSGENVLIGHT_EXPORT SunShadows : public osg::Referenced
{
  public:
    static constexpr unsigned maximumLevels = limits::MOST_SUN_LEVELS;

    /** @param size  of a map's side [texels] */
    SunShadows(unsigned suns, unsigned levels, unsigned size);

    const unsigned suns;
    const unsigned levels;  // maps of a sun at most
    const unsigned size;

    /** Side of a map where there are so many: more than four share the memory of four. */
    static unsigned sizeOf(unsigned maps, unsigned wanted);
    /** How many levels the view asks for. */
    static unsigned wantedLevels(const osg::BoundingBoxd& scene, const ShadowView& view, const VisibleBoxes& boxes,
                                 unsigned size);

    /** What to draw in this frame.
     * @param list   the suns, in the world
     * @param boxes  of the casters */
    std::vector<ShadowRefresh> update(const CasterList& casters, const DominantLights& list, const ShadowView& view,
                                      const VisibleBoxes& boxes);

    /** What casts shadows, as it was at the last update(). */
    const std::vector<Caster>& casters() const { return _casters.all(); }
    /** Maps of the last update(). */
    unsigned drawn() const { return _drawn; }
    /** Changes whenever the values of setUniforms() do. */
    unsigned version() const { return _version; }

    const ShadowTargets& targets() const { return _targets; }
    osg::Texture2D* texture() { return _targets.texture.get(); }

    /** Of pass/sunshadow.glsl. */
    void setUniforms(osg::StateSet& stateSet) const;

    void resizeGLObjectBuffers(unsigned maximum);
    /** All maps are lost. */
    void releaseGLObjects(osg::State* state) const;
    size_t bytes() const;

  protected:
    ~SunShadows() override = default;

  private:
    // What a map shows across the direction to the sun, in the first two of its axes.
    struct Rectangle {
        osg::Vec2d center;
        osg::Vec2d sides;  // 0: none
        bool exists() const { return sides.x() > 0.0; }
        double area() const { return sides.x() * sides.y(); }
        double texel(unsigned texels) const { return std::max(sides.x(), sides.y()) / texels; }
        bool operator==(const Rectangle& o) const { return center == o.center && sides == o.sides; }
        bool contains(const osg::BoundingBoxd& rectangle) const;
    };
    using Rectangles = std::array<Rectangle, maximumLevels>;
    struct Sun {
        std::array<osg::Vec3d, 3> axes;  // across, up, towards it
        double low = 0.0, high = 0.0;    // of the scene along the third
        Rectangles rectangles;
        bool lost = true;
    };
    bool fitScene(const osg::BoundingBoxd& bound);
    void fitNarrowing(const ShadowView& view);
    void place(Sun& sun, const osg::Vec3d& direction) const;
    void fitLevels(const Sun& sun, const ShadowView& view, const VisibleBoxes& boxes, Rectangles& rectangles) const;
    osg::BoundingBoxd nearPart(const Sun& sun, const ShadowView& view, const VisibleBoxes& boxes, const Rectangle& whole,
                               const Rectangle& former) const;
    Rectangle snapped(const osg::BoundingBoxd& needed, const osg::Vec2d& sides) const;
    ShadowRefresh refresh(unsigned index, unsigned level, const ChangedPart& changed) const;

    std::vector<Sun> _suns;
    ShownCasters _casters;
    osg::BoundingBoxd _box;
    double _narrowing = 0.5;  // a level's width, in widths of the last, at most
    unsigned _drawn = 0;
    unsigned _version = 0;
    mutable std::atomic<bool> _lost{false};
    ShadowTargets _targets;
};

}  // namespace osgEnvLight
