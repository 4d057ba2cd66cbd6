// SPDX-License-Identifier: MIT
#include "surface/StateValue.h"

namespace osgEnvLight
{

bool stateWins(unsigned newFlags, unsigned oldFlags)
{
    return !(oldFlags & osg::StateAttribute::OVERRIDE) || (newFlags & osg::StateAttribute::PROTECTED);
}

void StateMode::merge(osg::StateAttribute::GLModeValue value)
{
    if ((value & osg::StateAttribute::INHERIT) || !stateWins(value, flags)) return;
    on = (value & osg::StateAttribute::ON) != 0;
    flags = value;
}

void StateValue::merge(const osg::StateSet::RefAttributePair* pair)
{
    if (!pair || !stateWins(pair->second, flags)) return;
    attribute = pair->first.get();
    flags = pair->second;
}

}  // namespace osgEnvLight
