/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Caster.h"

#include <osgUtil/CullVisitor>

#include <limits>

namespace osgEnvLight
{

/** The shadow catcher that Settings::ground puts below a scene: a level rectangle in the world, wide enough for a low sun's
 * shadows. It never rises, so that what leaves it casts its shadow from above.*/
class OSGENVLIGHT_EXPORT Ground
{
  public:
    /** Lie below these. */
    void update(const CasterList& casters);
    /** Lie nowhere, until the next update. */
    void clear() { *this = Ground(); }
    /** Null: no caster has a place yet. */
    const osg::Geometry* geometry() const { return _geometry.get(); }
    /** Of its vertices, in the world. */
    const osg::Vec3d& origin() const { return _origin; }
    /** In units of the world. */
    double halfSide() const { return _halfSide; }

    /** Cull it as if it were below the node that the traversal stands at. From below it is not seen. The near and far planes move
     * as far as it shows within the view, not by its bounds: those reach behind the eye, and would bring the near plane to it.*/
    void cull(osgUtil::CullVisitor& cv, const osg::Matrixd& worldFromEye) const;

  private:
    osg::ref_ptr<osg::Geometry> _geometry;  // another one when it grows: a draw thread may still draw the last one
    osg::Vec3d _origin;
    double _lowest = std::numeric_limits<double>::infinity();  // that the scene has been
    double _halfSide = 0.0;
    double _radius = 0.0;   // of what is above it
    unsigned _version = 0;  // of the casters
};

}  // namespace osgEnvLight
