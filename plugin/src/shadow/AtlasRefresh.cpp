// SPDX-License-Identifier: MIT
#include "shadow/AtlasRefresh.h"

#include "gl/BindTargets.h"
#include "gl/FullScreenTriangle.h"

#include <osg/GLExtensions>
#include <osg/Program>

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

GLint locationOf(osg::State& state, const char* name)
{
    const osg::Program::PerContextProgram* program = state.getLastAppliedProgramObject();
    return program ? program->getUniformLocation(name) : -1;
}

void setUniform(osg::State& state, const char* name, int x, int y)
{
    const GLint location = locationOf(state, name);
    if (location >= 0) state.get<osg::GLExtensions>()->glUniform2i(location, x, y);
}

void setUniform(osg::State& state, const char* name, float x)
{
    const GLint location = locationOf(state, name);
    if (location >= 0) state.get<osg::GLExtensions>()->glUniform1f(location, x);
}

}  // namespace

AtlasRefresh::AtlasRefresh(const std::string& name, osg::Vec3Array* vertices) : _triangle(makeFullScreenTriangle(vertices))
{
    setName(name);
    setUseDisplayList(false);
    setSupportsDisplayList(false);
    setCullingActive(false);
}

void AtlasRefresh::prepare(const ShadowTargets& targets, const std::vector<ShadowRefresh>& refreshes,
                           std::vector<Caster>&& casters, const States& states, const TimedDraw& timed)
{
    _targets = targets;
    _states = states;
    _timed = timed;
    _maps.clear();
    for (const ShadowRefresh& r : refreshes) {
        if (r.region.isEmpty()) continue;
        const MapRegion region = r.region.within(targets.size);
        _maps.push_back(
            {r.map, new osg::RefMatrix(r.projection), region.projection(r.projection, targets.size), r.texel, r.octaves, region});
    }
    const auto byState = [](const Caster& a, const Caster& b) { return a.state < b.state; };
    if (!std::is_sorted(casters.begin(), casters.end(), byState)) std::stable_sort(casters.begin(), casters.end(), byState);
    _casters.clear();
    const osg::Matrixd toOrigin = osg::Matrixd::translate(-targets.origin);
    bool dynamic = false;
    for (const Caster& caster : casters) {
        osg::BoundingBoxd bound = boundOf(caster);
        bound._min -= targets.origin;
        bound._max -= targets.origin;
        _casters.push_back({caster.geometry, new osg::RefMatrix(caster.worldFromModel * toOrigin), caster.state, bound});
        dynamic = dynamic || caster.geometry->getDataVariance() == osg::Object::DYNAMIC;
    }
    // The draw of what changes must be over before the next update: OSG counts this drawable instead of the casters.
    setDataVariance(dynamic ? osg::Object::DYNAMIC : osg::Object::STATIC);
}

void AtlasRefresh::drawImplementation(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    _timed.begin(state);
    for (size_t begin = 0; begin < _maps.size(); begin += _targets.batch) {
        const size_t end = std::min<size_t>(begin + _targets.batch, _maps.size());
        drawCasters(renderInfo, *_targets.first, *_states.first, begin, end);
        drawCasters(renderInfo, *_targets.second, *_states.second, begin, end);
        storeMidpoints(renderInfo, begin, end);
    }
    _timed.end(state);
    glDisable(GL_SCISSOR_TEST);
    state.haveAppliedMode(GL_SCISSOR_TEST, osg::StateAttribute::OFF);
    state.haveAppliedAttribute(osg::StateAttribute::SCISSOR);
    state.haveAppliedAttribute(osg::StateAttribute::VIEWPORT);
    for (unsigned unit = 0; unit < _states.second->getNumTextureAttributeLists(); ++unit)
        state.haveAppliedTextureAttribute(unit, osg::StateAttribute::TEXTURE);
}

void AtlasRefresh::drawCasters(osg::RenderInfo& renderInfo, osg::FrameBufferObject& target, const osg::StateSet& stateSet,
                               size_t begin, size_t end) const
{
    osg::State& state = *renderInfo.getState();
    bindFrameBuffer(state, target);
    state.pushStateSet(&stateSet);
    state.apply();
    for (size_t k = begin; k < end; ++k) {
        scissor(_maps[k], int(k - begin) * int(_targets.size), 0);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }
    for (size_t i = 0; i < _casters.size();) {
        size_t next = i + 1;
        while (next < _casters.size() && _casters[next].state == _casters[i].state) ++next;
        if (_casters[i].state) state.pushStateSet(_casters[i].state.get());
        state.apply();
        drawRun(renderInfo, i, next, begin, end);
        if (_casters[i].state) state.popStateSet();
        i = next;
    }
    state.popStateSet();
}

void AtlasRefresh::drawRun(osg::RenderInfo& renderInfo, size_t caster, size_t casterEnd, size_t begin, size_t end) const
{
    osg::State& state = *renderInfo.getState();
    if (!state.getLastAppliedProgramObject()) return;  // it has reported why
    const GLsizei size = GLsizei(_targets.size);
    for (size_t k = begin; k < end; ++k) {
        glViewport(GLint(k - begin) * size, 0, size, size);
        scissor(_maps[k], int(k - begin) * size, 0);
        setUniform(state, "atlasMapIndex", int(_maps[k].index), 0);
        setUniform(state, "mapTexel", _maps[k].texel);
        state.applyProjectionMatrix(_maps[k].projection.get());
        for (size_t i = caster; i < casterEnd; ++i) {
            if (!mapShows(_maps[k].ofRegion, _casters[i].bound)) continue;
            state.applyModelViewMatrix(_casters[i].modelView.get());
            if (state.getUseModelViewAndProjectionUniforms()) state.applyModelViewAndProjectionUniformsIfRequired();
            _casters[i].geometry->draw(renderInfo);
        }
    }
}

// @param x, y  of the map's lower left texel
void AtlasRefresh::scissor(const Map& map, int x, int y) const
{
    const MapRegion& r = map.region;
    glEnable(GL_SCISSOR_TEST);
    glScissor(x + r.left, y + r.bottom, r.right - r.left, r.top - r.bottom);
}

void AtlasRefresh::storeMidpoints(osg::RenderInfo& renderInfo, size_t begin, size_t end) const
{
    osg::State& state = *renderInfo.getState();
    bindFrameBuffer(state, *_targets.maps);
    state.pushStateSet(_states.midpoints.get());
    state.apply();
    const int size = int(_targets.size);
    for (size_t k = begin; state.getLastAppliedProgramObject() && k < end; ++k) {
        const int x = int(_maps[k].index % _targets.columns) * size;
        const int y = int(_maps[k].index / _targets.columns) * size;
        glViewport(x, y, size, size);
        scissor(_maps[k], x, y);
        setUniform(state, "batchFromAtlas", int(k - begin) * size - x, -y);
        setUniform(state, "mapTexel", _maps[k].texel);
        setUniform(state, "mapOctaves", _maps[k].octaves);
        _triangle->draw(renderInfo);
    }
    state.popStateSet();
}

void AtlasRefresh::resizeGLObjectBuffers(unsigned maximum)
{
    osg::Drawable::resizeGLObjectBuffers(maximum);
    _triangle->resizeGLObjectBuffers(maximum);
}

void AtlasRefresh::releaseGLObjects(osg::State* state) const
{
    osg::Drawable::releaseGLObjects(state);
    _triangle->releaseGLObjects(state);
}

}  // namespace osgEnvLight
