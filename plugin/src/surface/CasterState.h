/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/SentLightState.h"

#include <map>
#include <tuple>

namespace osgEnvLight
{

/** What the state sets above a drawable say of the shadow that it casts, and of the light that it sends on. */
class OSGENVLIGHT_EXPORT CasterState : public SentLightState
{
  public:
    explicit CasterState(SurfaceFacts* facts = nullptr) : SentLightState(facts) {}

    void merge(const osg::StateSet& stateSet);

    /** Holes by the alpha test or a mask, or a blended surface: its alpha decides what passes. */
    bool perforated(const osg::Geometry& geometry) const
    {
        return blended(&geometry) || (_alphaTest.on && _alphaFunction.attribute) || mask(&geometry);
    }

    /** What a perforated caster is drawn with: its texture, alpha test, material; and, as defines, how its alpha is found. A
     * key by value, to keep one state set for all alike. */
    using Key = std::tuple<const osg::StateAttribute*, const osg::StateAttribute*, const osg::StateAttribute*,
                           const osg::StateAttribute*, unsigned>;
    Key key(const osg::Geometry& geometry) const;
    osg::ref_ptr<osg::StateSet> makeStateSet(const osg::Geometry& geometry) const;

  private:
    enum Flag : unsigned { BLENDED = 1, TEXTURE_REPLACES_ALPHA = 2, COLORED_VERTICES = 4, MASKED = 8 };
    unsigned flags(const osg::Geometry& geometry) const;

    Mode _alphaTest;
    Attribute _alphaFunction;
};

}  // namespace osgEnvLight
