/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Caster.h"

#include <cstdint>
#include <vector>

namespace osgEnvLight
{

/** A caster that is not where the frame before had it, or not of the same shape. */
struct MovedCaster {
    Caster caster;
    osg::Matrixd formerWorldFromModel;
    bool isChanged;  // its vertices are others, and where they were is not known
};

/** Finds the casters that have moved since the frame before. */
class OSGENVLIGHT_EXPORT CasterMotion
{
  public:
    /** New ones have not moved. Of several with one geometry, the first is taken for the first of the frame before.
     * @param eye  in the world: what moves by less than a hundred thousandth of its distance stands still */
    std::vector<MovedCaster> update(const std::vector<Caster>& casters, const osg::Vec3d& eye);
    void forget() { _former.clear(); }

  private:
    struct Former {
        const osg::Geometry* geometry;  // to be compared alone: it may be gone
        uint64_t shape;
        osg::Matrixd worldFromModel;
    };

    std::vector<Former> _former;  // in the casters' order
};

}  // namespace osgEnvLight
