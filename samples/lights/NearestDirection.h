// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/LightSampler>

#include <vector>

/** Which light of a list a direction is nearest to: a k-d tree over the unit vectors. */
class NearestDirection
{
  public:
    /** The list must not be empty, and stay. */
    explicit NearestDirection(const osgEnvLight::LightList& lights);

    /** @param guess  a light that may be near, to begin with */
    unsigned find(const osg::Vec3d& direction, unsigned guess) const;

  private:
    struct Best {
        unsigned light;
        double distance;  // squared
    };
    void divide(size_t first, size_t last, int axis);
    void search(size_t first, size_t last, int axis, const osg::Vec3d& direction, Best& best) const;

    const osgEnvLight::LightList& _lights;
    std::vector<unsigned> _order;  // the middle of each range divides it
};
