/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/BoundingBox>
#include <osg/Matrixd>

#include <array>
#include <vector>

namespace osgEnvLight
{

struct CasterList;

/** What a view asks of its shadow maps. */
struct OSGENVLIGHT_EXPORT ShadowView {
    osg::Matrixd worldFromEye;
    osg::Matrixd projection;  // its near and far don't count
    int height = 1;           // of the picture [pixels]
    double nearDepth = 0.0;   // before which it shows little; 0: not measured anew

    /** A point of the view ray through ndc, at that depth along the view's axis. */
    osg::Vec3d at(double x, double y, double depth) const;
    /** Side of a pixel in the picture's middle at that depth [world units]. */
    double footprint(double depth) const;
};

/** Where surfaces may be that a view shows: the bounds of what there is, cut by the view's sides. */
class OSGENVLIGHT_EXPORT VisibleBoxes
{
  public:
    VisibleBoxes(const CasterList& casters, const ShadowView& view);

    bool empty() const { return _polygons.empty(); }
    /** Along the view's axis; of nothing, nearest is greater. */
    double nearest() const { return _nearest; }
    double farthest() const { return _farthest; }

    /** Bound along the first two axes of all that is no deeper than that; without extent along the third. */
    osg::BoundingBoxd rectangle(const std::array<osg::Vec3d, 3>& axes, double depth) const;

  private:
    struct Corner {
        osg::Vec3d point;
        double depth;
    };
    using Polygon = std::vector<Corner>;
    struct Pyramid;
    void add(const osg::BoundingBoxd& box, const Pyramid& pyramid);
    void keep(const Polygon& polygon);
    Corner corner(const osg::Vec3d& point) const;

    std::vector<Polygon> _polygons;  // the surfaces of boxes cut by the view, but for the cuts at depth 0
    osg::Matrixd _eyeFromWorld;
    double _nearest = 1e300;
    double _farthest = -1e300;
};

}  // namespace osgEnvLight
