/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterMesh.h"

#include <memory>

namespace osgEnvLight
{

/** Merges the solid casters that stand still into a few coarse geometries. So a map of the atlas takes a few draws, however many
 * drawables there are. What moves is drawn beside them as it is; it joins them when all have stood still for a while. Each
 * geometry lies in one part of the world, so that where little changes, little is drawn. */
class OSGENVLIGHT_EXPORT StaticCasters
{
  public:
    /** What the geometry is relative to, and how coarse it is [coarseMesh]. Others forget it; a cell that differs by less than a
     * factor of 2 does not. */
    void setPlace(const osg::Vec3d& origin, double cell);

    /** @param moved  whether they differ from the last ones by more than slack [world units] */
    void update(const CasterList& casters, bool moved, double slack);

    /** Those that stand still, solid or perforated: their triangles about the place's origin, and the light that they send on. */
    struct Part {
        std::shared_ptr<const CasterMesh> mesh;
        SentLight sent;
    };
    using Parts = std::vector<Part>;
    Parts parts() const;
    /** Counts the changes of their triangles; 0 before the first update. */
    unsigned generation() const { return _generation; }
    /** Counts those of their light. */
    unsigned sentVersion() const { return _sentVersion; }

    /** No caster moves or has holes: parts() leave out nothing that casts shadows. */
    bool areAll() const { return _isBuilt && _loose.empty(); }

    /** No caster moves: parts() leave out none. */
    bool noneMoves() const { return _isBuilt && _loose.size() == _perforated; }

    /** What stands for all of them. */
    std::vector<Caster> drawn() const;
    /** Triangles of drawn(). */
    size_t triangles() const { return trianglesOf(drawn()); }
    /** Share of the merged ones' triangles that a map's draw does not leave out.
     * @param projection  of the map or of a part of it, about the place's origin */
    double shareShown(const osg::Matrixd& projection) const;
    size_t bytes() const;

    void resizeGLObjectBuffers(unsigned maximum) const;
    void releaseGLObjects(osg::State* state) const;

    /** Triangles of a geometry, at most: of so many that a draw costs little more than without them. */
    static constexpr size_t mostTriangles = 4096;

    /** Frames without motion until what has moved is merged: a motion that pauses costs nothing. */
    static constexpr unsigned patience = 8;

  private:
    struct Still {
        Caster caster;
        std::shared_ptr<const CasterMesh> mesh;
    };
    class FormerPlaces;
    void sort(const std::vector<Caster>& casters, bool merges, double slack);
    void build();
    void takeSentLight(const std::vector<Caster>& casters);

    osg::Vec3d _origin;
    double _cell = 0.0;
    std::vector<Still> _still;                         // in the casters' order
    std::vector<Caster> _loose;                        // what is drawn as it is: all others, and of those the perforated ones
    size_t _perforated = 0;                            // how many of them stand still
    std::vector<osg::ref_ptr<osg::Geometry>> _merged;  // the solid ones of _still
    bool _isBuilt = false;
    unsigned _frames = 0;  // since the last motion
    unsigned _seen = 0;    // version of the casters whose light was taken
    unsigned _generation = 0;
    unsigned _sentVersion = 1;
};

}  // namespace osgEnvLight
