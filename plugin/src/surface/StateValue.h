/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/StateSet>

namespace osgEnvLight
{

/** Whether what a state set says, with these flags, takes the place of what one above it said: OVERRIDE and PROTECTED. */
OSGENVLIGHT_EXPORT bool stateWins(unsigned newFlags, unsigned oldFlags);

/** A mode as it stands after a path of state sets, with the flags it was set with. */
struct OSGENVLIGHT_EXPORT StateMode {
    bool on = false;
    unsigned flags = 0;
    void merge(osg::StateAttribute::GLModeValue value);
};

/** The same of an attribute; null where nothing was said. */
struct OSGENVLIGHT_EXPORT StateValue {
    const osg::StateAttribute* attribute = nullptr;
    unsigned flags = 0;
    void merge(const osg::StateSet::RefAttributePair* pair);
    void merge(const osg::StateSet::RefAttributePair& pair) { merge(&pair); }
    template <class T>
    const T* as() const
    {
        return dynamic_cast<const T*>(attribute);
    }
};

}  // namespace osgEnvLight
