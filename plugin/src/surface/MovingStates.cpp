// SPDX-License-Identifier: MIT
#include "surface/MovingStates.h"

#include "gl/CasterProgram.h"

#include <osgEnvLight/SurfaceProgram>

#include <osg/Texture>

#include <cctype>

namespace osgEnvLight
{

namespace
{

const osg::StateAttribute::OverrideValue kept = osg::StateAttribute::ON | osg::StateAttribute::PROTECTED;

std::set<std::string> wordsOf(const std::string& text)
{
    std::set<std::string> words;
    std::string word;
    for (const char c : text + " ") {
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
            word += c;
        } else if (!word.empty()) {
            words.insert(word);
            word.clear();
        }
    }
    return words;
}

// An element of an array goes by the array's name.
bool reads(const std::set<std::string>& words, const std::string& uniform)
{
    return words.count(uniform.substr(0, uniform.find('['))) > 0;
}

void takeInputs(const MovingStates::Path& path, const std::set<std::string>& words, osg::StateSet& to)
{
    for (const osg::StateSet* s : path) {
        for (const auto& [name, uniform] : s->getUniformList())
            if (reads(words, name)) to.addUniform(uniform.first.get(), kept);
        for (const auto& [name, define] : s->getDefineList())
            if (words.count(name)) to.setDefine(name, define.first, kept);
        for (const auto& [type, attribute] : s->getAttributeList())
            if (type.first == osg::StateAttribute::UNIFORMBUFFERBINDING) to.setAttribute(attribute.first.get(), kept);
        for (unsigned unit = 1; unit < s->getNumTextureAttributeLists(); ++unit)
            if (const osg::StateAttribute* texture = s->getTextureAttribute(unit, osg::StateAttribute::TEXTURE))
                to.setTextureAttribute(unit, const_cast<osg::StateAttribute*>(texture), kept);
    }
}

}  // namespace

const MovingStates::Drawn& MovingStates::drawnBy(const osg::Program& moving)
{
    const osg::Shader* shader = SurfaceProgram::vertexShaderOf(moving);
    Drawn& drawn = _drawn[shader];
    if (!drawn.program) drawn = {passProgram(moving, "caster"), wordsOf(shader->getShaderSource()), followsTime(*shader)};
    return drawn;
}

MovingStates::Key MovingStates::keyOf(const osg::StateSet& inputs, const CasterState& state, const osg::Geometry& geometry)
{
    Key key;
    std::vector<const void*>& objects = key.first;
    for (const auto& [name, uniform] : inputs.getUniformList()) objects.push_back(uniform.first.get());
    for (const auto& [type, attribute] : inputs.getAttributeList()) objects.push_back(attribute.first.get());
    for (const auto& list : inputs.getTextureAttributeList())
        for (const auto& [type, attribute] : list) objects.push_back(attribute.first.get());
    for (const auto& [name, define] : inputs.getDefineList()) key.second += name + ' ' + define.first + '\n';
    if (!state.perforated(geometry)) return key;
    const auto [texture, matrix, alphaFunction, material, flags] = state.key(geometry);
    for (const osg::StateAttribute* a : {texture, matrix, alphaFunction, material}) objects.push_back(a);
    key.second += std::to_string(flags);
    return key;
}

osg::ref_ptr<osg::StateSet> MovingStates::get(const Path& path, const CasterState& state, const osg::Geometry& geometry)
{
    const Drawn& drawn = drawnBy(*state.movingProgram());
    const auto take = [&](osg::StateSet* s) {
        takeInputs(path, drawn.words, *s);
        s->setAttribute(drawn.program, kept);
        return osg::ref_ptr<osg::StateSet>(s);
    };
    const osg::ref_ptr<osg::StateSet> inputs = take(new osg::StateSet);
    osg::ref_ptr<osg::StateSet>& known = _states[keyOf(*inputs, state, geometry)];
    if (!known) known = state.perforated(geometry) ? take(state.makeStateSet(geometry)) : inputs;
    return known;
}

uint64_t MovingStates::change(const Path& path, const osg::Program& program, unsigned frame)
{
    const Drawn& drawn = drawnBy(program);
    uint64_t sum = drawn.followsTime ? frame : 0;
    for (const osg::StateSet* s : path)
        for (const auto& [name, uniform] : s->getUniformList())
            if (reads(drawn.words, name)) sum = 31 * sum + uniform.first->getModifiedCount();
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
