/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "indirect/TracedScene.h"

#include <osg/BoundingBox>

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>

namespace osgEnvLight
{

/** A hierarchy of boxes over triangles, for rays: split where the surface area heuristic, over 16 bins, expects the least work
 * [Wald 2007]. Built once; rays may be traced from several threads.*/
class OSGENVLIGHT_EXPORT CasterBvh
{
  public:
    /** Triangles without an area, or with positions that are not finite, are met by no ray.
     * @param stop  set by another thread: the hierarchy is given up half made, and meets nothing */
    explicit CasterBvh(const TracedScene& scene, const std::atomic<bool>* stop = nullptr);

    struct Hit {
        float distance;
        unsigned triangle;  // its number in the scene
        bool back;          // its corners run clockwise as the ray sees them
    };

    /** The nearest triangle on a ray.
     * @param direction  of unit length, or distances are in its length
     * @param within     what lies farther away is not met */
    std::optional<Hit> nearest(const osg::Vec3f& origin, const osg::Vec3f& direction,
                               float within = std::numeric_limits<float>::max()) const;

    struct Node {
        osg::BoundingBoxf box;
        uint32_t first = 0;  // of its triangles, or of its two children
        uint32_t count = 0;  // of its triangles; 0: it has children
    };
    struct Triangle {
        osg::Vec3f corner, edge, otherEdge;
        uint32_t number;  // in the scene
    };
    /** The first is the root; the children of a node follow each other. None: no ray meets anything. */
    const std::vector<Node>& nodes() const { return _nodes; }
    /** In the order of the leaves, each of which has leafSize at most. */
    const std::vector<Triangle>& triangles() const { return _triangles; }
    static constexpr uint32_t leafSize = 4;

  private:
    struct Range;
    struct Split;
    Split bestSplit(const Range& range) const;
    uint32_t partition(const Range& range);
    void meet(const Node& leaf, const osg::Vec3f& origin, const osg::Vec3f& direction, Hit& hit) const;

    std::vector<Node> _nodes;
    std::vector<Triangle> _triangles;
    std::vector<osg::BoundingBoxf> _boxes;  // of these, while it is built
};

}  // namespace osgEnvLight
