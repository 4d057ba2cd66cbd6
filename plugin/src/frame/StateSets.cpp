// SPDX-License-Identifier: MIT
#include "frame/StateSets.h"

#include <utility>

namespace osgEnvLight
{

StateSets::State StateSets::get(const Key& key)
{
    Kept& kept = _states[key];
    const bool isNew = !kept.stateSet;
    if (isNew) kept.stateSet = new osg::StateSet;
    kept.used = true;
    return {*kept.stateSet, isNew};
}

void StateSets::bind(osg::StateSet& stateSet, unsigned unit, const Sampler& sampler)
{
    stateSet.setTextureAttribute(unit, sampler.texture.get(), fixedOn);
    stateSet.addUniform(new osg::Uniform(sampler.name.c_str(), int(unit)), fixedOn);
}

void StateSets::endFrame()
{
    for (auto it = _states.begin(); it != _states.end();)
        it = std::exchange(it->second.used, false) ? std::next(it) : _states.erase(it);
}

void StateSets::resizeGLObjectBuffers(unsigned maximum)
{
    for (auto& [key, kept] : _states) kept.stateSet->resizeGLObjectBuffers(maximum);
}

void StateSets::releaseGLObjects(osg::State* state) const
{
    for (const auto& [key, kept] : _states) kept.stateSet->releaseGLObjects(state);
}

}  // namespace osgEnvLight
