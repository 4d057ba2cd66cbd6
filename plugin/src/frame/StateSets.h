/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/StateSet>
#include <osg/Texture>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace osgEnvLight
{

/** Flags of what a pass sets: no state set of the host's changes it. */
const unsigned fixedOn = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;
const unsigned fixedOff = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;

/** The state sets of a view's passes. Each is known by what it is made from and never changes: a draw thread may be reading it.
 */
class OSGENVLIGHT_EXPORT StateSets
{
  public:
    struct Sampler {
        std::string name;
        osg::ref_ptr<osg::Texture> texture;
    };
    /** What a state set is made from. It must hold the objects, so that none of them can be another one at the same address. */
    struct Key {
        std::string name;
        std::vector<std::string> defines = {};
        std::vector<const osg::Referenced*> objects = {};
        bool operator<(const Key& o) const { return std::tie(name, defines, objects) < std::tie(o.name, o.defines, o.objects); }
    };
    struct State {
        osg::StateSet& stateSet;
        bool isNew;
    };
    /** The state set of that key, empty when new: then fill it, and never change it. */
    State get(const Key& key);

    /** Bind the texture to the unit, and the sampler of its name. */
    static void bind(osg::StateSet& stateSet, unsigned unit, const Sampler& sampler);

    /** Forget those that were not asked for since the last call: they hold textures. */
    void endFrame();
    void clear() { _states.clear(); }
    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;

  private:
    struct Kept {
        osg::ref_ptr<osg::StateSet> stateSet;
        bool used = false;
    };
    std::map<Key, Kept> _states;
};

}  // namespace osgEnvLight
