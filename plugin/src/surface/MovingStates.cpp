// SPDX-License-Identifier: MIT
#include "surface/MovingStates.h"

#include "gl/CasterProgram.h"

#include <osgEnvLight/SurfaceProgram>

#include <osg/Texture>

namespace osgEnvLight
{

namespace
{

const osg::StateAttribute::OverrideValue kept = osg::StateAttribute::ON | osg::StateAttribute::PROTECTED;

// What the application's function may read of the path: uniforms, defines, and textures of other units than the alpha's.
void takeInputs(const MovingStates::Path& path, osg::StateSet& to)
{
    for (const osg::StateSet* s : path) {
        for (const auto& [name, uniform] : s->getUniformList()) to.addUniform(uniform.first.get(), kept);
        for (const auto& [name, define] : s->getDefineList()) to.setDefine(name, define.first, kept);
        for (const auto& [type, attribute] : s->getAttributeList())
            if (type.first == osg::StateAttribute::UNIFORMBUFFERBINDING) to.setAttribute(attribute.first.get(), kept);
        for (unsigned unit = 1; unit < s->getNumTextureAttributeLists(); ++unit)
            if (const osg::StateAttribute* texture = s->getTextureAttribute(unit, osg::StateAttribute::TEXTURE))
                to.setTextureAttribute(unit, const_cast<osg::StateAttribute*>(texture), kept);
    }
}

bool sameInputs(const osg::StateSet& a, const osg::StateSet& b)
{
    return a.getUniformList() == b.getUniformList() && a.getDefineList() == b.getDefineList() &&
           a.getAttributeList() == b.getAttributeList() && a.getTextureAttributeList() == b.getTextureAttributeList();
}

}  // namespace

const MovingStates::Drawn& MovingStates::drawnBy(const osg::Program& moving)
{
    const osg::Shader* shader = SurfaceProgram::vertexShaderOf(moving);
    Drawn& drawn = _drawn[shader];
    if (!drawn.program) drawn = {casterProgram(moving), followsTime(*shader)};
    return drawn;
}

osg::ref_ptr<osg::StateSet> MovingStates::get(const Path& path, const CasterState& state, const osg::Geometry& geometry)
{
    osg::ref_ptr<osg::StateSet> wanted = new osg::StateSet;
    if (state.perforated(geometry)) wanted = state.makeStateSet(geometry);
    takeInputs(path, *wanted);
    wanted->setAttribute(drawnBy(*state.movingProgram()).program, kept);
    osg::ref_ptr<osg::StateSet>& known = _states[path];
    if (!known || !sameInputs(*known, *wanted)) known = wanted;
    return known;
}

uint64_t MovingStates::change(const Path& path, const osg::Program& program, unsigned frame)
{
    uint64_t sum = drawnBy(program).followsTime ? frame : 0;
    for (const osg::StateSet* s : path)
        for (const auto& [name, uniform] : s->getUniformList()) sum = 31 * sum + uniform.first->getModifiedCount();
    return sum;
}

void MovingStates::resizeGLObjectBuffers(unsigned maximum)
{
    for (auto& [shader, drawn] : _drawn) drawn.program->resizeGLObjectBuffers(maximum);
}

void MovingStates::releaseGLObjects(osg::State* state) const
{
    for (const auto& [shader, drawn] : _drawn) drawn.program->releaseGLObjects(state);
}

void MovingStates::forgetUnused(const std::set<const osg::StateSet*>& used)
{
    for (auto it = _states.begin(); it != _states.end();) it = used.count(it->second.get()) ? std::next(it) : _states.erase(it);
    if (_states.empty()) _drawn.clear();
}

}  // namespace osgEnvLight
