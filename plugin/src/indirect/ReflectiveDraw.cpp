// SPDX-License-Identifier: MIT
#include "indirect/ReflectiveDraw.h"

#include "gl/BindTargets.h"

#include <osg/GLExtensions>
#include <osg/Program>

#include <algorithm>

namespace osgEnvLight
{

ReflectiveDraw::ReflectiveDraw()
{
    setName("osgEnvLight reflective maps");
    setUseDisplayList(false);
    setSupportsDisplayList(false);
    setCullingActive(false);
}

void ReflectiveDraw::prepare(const ReflectiveTargets& targets, const std::vector<ReflectiveMap>& maps,
                             const std::vector<Caster>& casters, const std::vector<osg::ref_ptr<osg::StateSet>>& uniforms,
                             const osg::ref_ptr<osg::StateSet>& program, const osg::Vec3d& origin, const TimedDraw& timed)
{
    _targets = targets;
    _timed = timed;
    _states = uniforms;
    _states.push_back(program);
    _projections.clear();
    for (const ReflectiveMap& map : maps) _projections.push_back(new osg::RefMatrix(map.projection));
    _casters.clear();
    const osg::Matrixd toOrigin = osg::Matrixd::translate(-origin);
    bool dynamic = false;
    for (const Caster& caster : casters) {
        if (caster.moves) continue;  // its program writes other values
        osg::BoundingBoxd bound = boundOf(caster);
        bound._min -= origin;
        bound._max -= origin;
        const osg::Vec3f reflects = isPolished(caster.sent) ? caster.sent.glossy : osg::Vec3f();
        _casters.push_back({caster.geometry, new osg::RefMatrix(caster.worldFromModel * toOrigin), caster.state, bound,
                            osg::Vec4f(reflects, caster.sent.roughness)});
        dynamic = dynamic || caster.geometry->getDataVariance() == osg::Object::DYNAMIC;
    }
    std::stable_sort(_casters.begin(), _casters.end(), [](const Placed& a, const Placed& b) { return a.state < b.state; });
    setDataVariance(dynamic ? osg::Object::DYNAMIC : osg::Object::STATIC);  // as AtlasRefresh says
}

void ReflectiveDraw::drawImplementation(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    _timed.begin(state);
    bindFrameBuffer(state, *_targets.target);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (const auto& s : _states) state.pushStateSet(s.get());
    for (size_t i = 0; i < _casters.size();) {
        size_t next = i + 1;
        while (next < _casters.size() && _casters[next].state == _casters[i].state) ++next;
        if (_casters[i].state) state.pushStateSet(_casters[i].state.get());
        state.apply();
        if (state.getLastAppliedProgramObject()) drawCasters(renderInfo, i, next);  // else it has reported why
        if (_casters[i].state) state.popStateSet();
        i = next;
    }
    for (size_t i = 0; i < _states.size(); ++i) state.popStateSet();
    state.setActiveTextureUnit(0);
    state.applyTextureAttribute(0, _targets.flux.get());
    state.get<osg::GLExtensions>()->glGenerateMipmap(GL_TEXTURE_2D);
    _timed.end(state);
    state.haveAppliedAttribute(osg::StateAttribute::VIEWPORT);
    state.haveAppliedTextureAttribute(0, osg::StateAttribute::TEXTURE);
}

void ReflectiveDraw::drawCasters(osg::RenderInfo& renderInfo, size_t begin, size_t end) const
{
    osg::State& state = *renderInfo.getState();
    const osg::Program::PerContextProgram& program = *state.getLastAppliedProgramObject();
    const auto* gl = state.get<osg::GLExtensions>();
    const GLint number = program.getUniformLocation("mapNumber"), reflects = program.getUniformLocation("casterReflects");
    const auto size = GLsizei(_targets.size);
    for (size_t k = 0; k < _projections.size(); ++k) {
        glViewport(GLint(k % _targets.columns) * size, GLint(k / _targets.columns) * size, size, size);
        if (number >= 0) gl->glUniform1i(number, GLint(k));
        state.applyProjectionMatrix(_projections[k].get());
        for (size_t i = begin; i < end; ++i) {
            const Placed& caster = _casters[i];
            if (!mapShows(*_projections[k], caster.bound)) continue;
            if (reflects >= 0) gl->glUniform4fv(reflects, 1, caster.reflects.ptr());
            state.applyModelViewMatrix(caster.modelView.get());
            if (state.getUseModelViewAndProjectionUniforms()) state.applyModelViewAndProjectionUniformsIfRequired();
            caster.geometry->draw(renderInfo);
        }
    }
}

}  // namespace osgEnvLight
