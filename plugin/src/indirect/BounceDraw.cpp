// SPDX-License-Identifier: MIT
#include "indirect/BounceDraw.h"

#include "gl/BindTargets.h"
#include "gl/FullScreenTriangle.h"

namespace osgEnvLight
{

BounceDraw::BounceDraw(osg::Vec3Array* vertices) : _triangle(makeFullScreenTriangle(vertices))
{
    setName("osgEnvLight bounces");
    setUseDisplayList(false);
    setSupportsDisplayList(false);
    setCullingActive(false);
}

void BounceDraw::prepare(const TransportTargets& targets, const States& states, unsigned bounces, const TimedDraw& timed)
{
    _targets = targets;
    _states = states;
    _bounces = bounces;
    _timed = timed;
}

void BounceDraw::drawImplementation(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    _timed.begin(state);
    for (const auto& s : _states.uniforms) state.pushStateSet(s.get());
    for (unsigned i = 0; i < _bounces; ++i) {
        const bool isFirst = i == 0 && _states.first;
        if (_states.near && !isFirst) drawInto(renderInfo, *_targets.nearTarget, *_targets.pointNear, *_states.near);
        drawInto(renderInfo, *_targets.radianceTarget, *_targets.pointRadiance, isFirst ? *_states.first : *_states.points);
        drawInto(renderInfo, *_targets.harmonicsTarget, *_targets.probeHarmonics[0], *_states.harmonics);
        drawInto(renderInfo, *_targets.irradianceTarget, *_targets.probeIrradiance, *_states.probes);
    }
    if (_states.cells) drawInto(renderInfo, *_targets.cellTarget, *_targets.cellLight, *_states.cells);
    for (size_t i = 0; i < _states.uniforms.size(); ++i) state.popStateSet();
    _timed.end(state);
    state.haveAppliedAttribute(osg::StateAttribute::VIEWPORT);
    for (unsigned unit = 0; unit < _states.points->getNumTextureAttributeLists(); ++unit)
        state.haveAppliedTextureAttribute(unit, osg::StateAttribute::TEXTURE);
}

void BounceDraw::drawInto(osg::RenderInfo& renderInfo, osg::FrameBufferObject& target, const osg::Texture2D& texture,
                          const osg::StateSet& stateSet) const
{
    osg::State& state = *renderInfo.getState();
    bindFrameBuffer(state, target);
    state.pushStateSet(&stateSet);
    state.apply();
    if (state.getLastAppliedProgramObject()) {  // else it has reported why
        glViewport(0, 0, texture.getTextureWidth(), texture.getTextureHeight());
        _triangle->draw(renderInfo);
    }
    state.popStateSet();
}

void BounceDraw::resizeGLObjectBuffers(unsigned maximum)
{
    osg::Drawable::resizeGLObjectBuffers(maximum);
    _triangle->resizeGLObjectBuffers(maximum);
}

void BounceDraw::releaseGLObjects(osg::State* state) const
{
    osg::Drawable::releaseGLObjects(state);
    _triangle->releaseGLObjects(state);
}

}  // namespace osgEnvLight
