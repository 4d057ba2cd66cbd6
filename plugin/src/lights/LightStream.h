/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "lights/MapOptions.h"

namespace osgEnvLight
{

class MomentTable;

/** The light list of a map that changes: under smooth changes its lights move smoothly, each keeping its place in the list
 * and so its group (sampling.md 4). A value: a copy goes on from where the original stood.
 *
 * Lists start cold: then they are the sampler's own, a function of the map. After that, for the sampler auto, generators
 * are kept: one round of k-means a state, at most one of them sent elsewhere, weights. When the map changes by a quarter of
 * its flux, or has stopped changing (settle), the cold list takes over by eighths.*/
class OSGENVLIGHT_EXPORT LightStream
{
  public:
    /** For D in the sampler's order; for O dealt to 16 groups, filled up with dark lights. */
    enum Order { PLAIN, DEALT };

    explicit LightStream(Order order = PLAIN) : _order(order) {}

    /** The list of the map's next state. */
    const LightList& next(const RadianceMap& map, unsigned count, const MapOptions& options);

    /** A step towards the cold list of a map that no longer changes. */
    const LightList& settle(const RadianceMap& map, unsigned count, const MapOptions& options);

    /** Whether the list is the cold one of the map last seen. */
    bool settled() const { return _settled; }

    const LightList& lights() const { return _lights; }
    unsigned count() const { return _count; }
    /** Of the last step: the light that was sent elsewhere, or -1. */
    int teleported() const { return _teleported; }

  private:
    LightList cold(const RadianceMap& map, unsigned count, const MapOptions& options) const;
    void start(const RadianceMap& map, unsigned count, const MapOptions& options);
    void step(const RadianceMap& map, const MomentTable& table, bool still);
    bool goesOn(const RadianceMap& map, unsigned count, const MapOptions& options) const;

    Order _order;
    LightList _lights;
    std::vector<osg::Vec3d> _generators;
    unsigned _count = 0;
    MapOptions _options;
    std::vector<double> _coarse;  // the map's flux, coarsely, to tell how much it changes
    LightList _target;            // a cold list that is taking over
    unsigned _taken = 0;          // eighths of it
    osg::ref_ptr<const RadianceMap> _targetMap;
    int _teleported = -1;
    bool _settled = true;
};

}  // namespace osgEnvLight
