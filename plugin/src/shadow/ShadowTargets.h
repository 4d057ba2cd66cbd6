/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include "surface/Caster.h"

#include <osg/FrameBufferObject>
#include <osg/Matrixd>
#include <osg/Texture2D>

#include <vector>

namespace osgEnvLight
{

/** Where maps of height are drawn, side by side in one texture, and what they are made from: the first and the second
 * surface of a batch of maps, beside each other.*/
struct OSGENVLIGHT_EXPORT ShadowTargets {
    ShadowTargets() = default;
    /** @param size         of a map's side [texels]
     * @param columns, rows of maps in the texture
     * @param mapFormat    of the maps; slopeFormat, of the first surface's slopes, beside them whether the
     *                     second shows its back, and which way the first rises */
    ShadowTargets(unsigned size, unsigned columns, unsigned rows, unsigned batch, GLint mapFormat, GLint slopeFormat);

    unsigned size = 0;
    unsigned columns = 0;
    unsigned batch = 0;
    osg::Vec3d origin;  // what the projections are relative to, in the world
    osg::ref_ptr<osg::Texture2D> texture, firstDepth, firstSlope, secondDepth;
    osg::ref_ptr<osg::FrameBufferObject> maps, first, second;

    std::vector<osg::Texture2D*> textures() const
    {
        return {texture.get(), firstDepth.get(), firstSlope.get(), secondDepth.get()};
    }
    std::vector<osg::FrameBufferObject*> frameBuffers() const { return {maps.get(), first.get(), second.get()}; }

    void resizeGLObjectBuffers(unsigned maximum) const;
    void releaseGLObjects(osg::State* state) const;
};

/** Texels of a map, from the lower left corner; the upper ones are outside. The default is all of them. */
struct OSGENVLIGHT_EXPORT MapRegion {
    static constexpr int most = 1 << 30;
    int left = 0, bottom = 0, right = most, top = most;

    bool isWhole() const { return right == most; }
    bool isEmpty() const { return left >= right || bottom >= top; }
    /** Within a map of that size. */
    MapRegion within(unsigned size) const;
    /** The projection that shows the region alone, of one that shows the map. */
    osg::Matrixd projection(const osg::Matrixd& whole, unsigned size) const;
};

/** Where a map shows what has changed.
 * @param origin  what the projection is relative to, in the world */
OSGENVLIGHT_EXPORT MapRegion regionOf(const ChangedPart& changed, const osg::Matrixd& projection, const osg::Vec3d& origin,
                                      unsigned size);

/** A map that stays from frame to frame, and is drawn again where casters have changed. */
struct OSGENVLIGHT_EXPORT KeptMap {
    bool drawn = false;
    bool outdated = false;
    unsigned age = 0;         // frames since it became outdated
    osg::Matrixd projection;  // that it was drawn with
    ChangedPart changed;      // since then

    /** Casters have changed: it is outdated if it shows that. */
    void noteChange(const ChangedPart& part, const osg::Vec3d& origin, unsigned size);
    /** It is drawn now, with that projection.
     * @return what of it has to be */
    MapRegion draw(const osg::Matrixd& newProjection, const osg::Vec3d& origin, unsigned size);
};

/** One map to be drawn in this frame. */
struct ShadowRefresh {
    unsigned map;
    osg::Matrixd projection;  // clip space from the world about the origin
    float texel = 0.0f;    // its side, in the map's heights; 0: the map is as high as it is wide; in perspective, at distance 1
    float octaves = 0.0f;  // in perspective, of its distances [lib/emittermap.glsl]
    MapRegion region = {};
};

}  // namespace osgEnvLight
