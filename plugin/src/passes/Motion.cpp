// SPDX-License-Identifier: MIT
#include "passes/Motion.h"

#include "gl/CasterProgram.h"
#include "passes/Inputs.h"

#include <osgEnvLight/SurfaceProgram>

#include <osg/GLExtensions>
#include <osgUtil/CullVisitor>

#include <utility>

namespace osgEnvLight
{

namespace
{

// Draws the casters that have moved; the shader drops what other surfaces hide.
class MotionDraw : public FullScreen
{
  public:
    using FullScreen::FullScreen;

    struct Moved {
        osg::ref_ptr<const osg::Geometry> geometry;
        osg::ref_ptr<osg::RefMatrix> eyeFromModel;
        osg::Matrixd formerEyeFromModel;
        bool isChanged = false;
        osg::ref_ptr<osg::StateSet> inputs, program;  // where a program of the application's moves the vertices
    };

    /** Written at cull by the frame that owns this. */
    std::vector<Moved> moved;
    osg::Matrixd formerProjection;

  protected:
    void drawShapes(osg::RenderInfo& renderInfo) const override
    {
        osg::State& state = *renderInfo.getState();
        bool wasOwn = false;
        for (const Moved& m : moved) {
            const bool isOwn = m.inputs.valid();
            for (const auto& s : {m.inputs, m.program})
                if (isOwn) state.pushStateSet(s.get());
            if (isOwn || wasOwn) state.apply();
            wasOwn = isOwn;
            state.applyModelViewMatrix(m.eyeFromModel.get());
            if (state.getUseModelViewAndProjectionUniforms()) state.applyModelViewAndProjectionUniformsIfRequired();
            if (state.getLastAppliedProgramObject()) {
                if (isOwn) uploadUniforms(state);
                upload(state, m);
                m.geometry->draw(renderInfo);
            }
            for (int i = 0; isOwn && i < 2; ++i) state.popStateSet();
        }
    }

  private:
    void upload(osg::State& state, const Moved& m) const
    {
        const osg::Program::PerContextProgram& program = *state.getLastAppliedProgramObject();
        const auto* gl = state.get<osg::GLExtensions>();
        const auto matrix = [&](const char* name, const osg::Matrixd& value) {
            const osg::Matrixf f(value);
            if (const GLint l = program.getUniformLocation(name); l >= 0) gl->glUniformMatrix4fv(l, 1, GL_FALSE, f.ptr());
        };
        matrix("eyeFromModel", *m.eyeFromModel);
        matrix("formerEyeFromModel", m.formerEyeFromModel);
        matrix("formerProjection", formerProjection);
        if (const GLint l = program.getUniformLocation("isChanged"); l >= 0) gl->glUniform1f(l, m.isChanged ? 1.0f : 0.0f);
    }
};

}  // namespace

Requirement MotionPass::require(const FrameContext& c) const
{
    Requirement motion = c.decisions.average;
    motion.unless(c.moved.empty() || !c.former, "nothing has moved since the frame before");
    return motion.because(counted(c.moved.size(), "drawable") + " that moved since the frame before");
}

osg::StateSet* MotionPass::programOf(const osg::StateSet& caster)
{
    const auto* shadow = static_cast<const osg::Program*>(caster.getAttribute(osg::StateAttribute::PROGRAM));
    osg::ref_ptr<osg::StateSet>& known = _programs[SurfaceProgram::vertexShaderOf(*shadow)];
    if (!known) {
        known = new osg::StateSet;
        known->setAttribute(passProgram(*shadow, name()), fixedOn);
        known->setMode(GL_ALPHA_TEST, fixedOff);
    }
    return known.get();
}

void MotionPass::setup(PassBuilder& b, FrameContext& c)
{
    std::vector<MotionDraw::Moved> moved;
    bool isDynamic = false;
    const osg::Matrixd eyeFromWorld = osg::Matrixd::inverse(c.worldFromEye);
    const osg::Matrixd formerEyeFromWorld = osg::Matrixd::inverse(c.former->worldFromEye);
    const osg::Matrixd clipFromWorld = eyeFromWorld * *c.cv.getProjectionMatrix();
    for (const MovedCaster& m : c.moved) {
        const Caster& caster = m.caster;
        if (!mapShows(clipFromWorld, boundOf(caster))) continue;
        MotionDraw::Moved drawn;
        drawn.geometry = caster.geometry;
        drawn.eyeFromModel = new osg::RefMatrix(caster.worldFromModel * eyeFromWorld);
        drawn.formerEyeFromModel = m.formerWorldFromModel * formerEyeFromWorld;
        drawn.isChanged = m.isChanged;
        if (caster.moves) {
            drawn.inputs = caster.state;
            drawn.program = programOf(*caster.state);
        }
        moved.push_back(drawn);
        isDynamic = isDynamic || caster.geometry->getDataVariance() == osg::Object::DYNAMIC;
    }
    b.read("depth", "depthMap");
    b.write(b.create("motion"));
    b.triangle([vertices = c.frame.triangle] { return new MotionDraw(vertices.get()); },
               [&c, moved = std::move(moved), isDynamic](FullScreen& triangle) {
                   auto& draw = static_cast<MotionDraw&>(triangle);
                   draw.moved = moved;
                   draw.formerProjection = c.former->projection;
                   draw.clears = {{0, {}, false}};
                   draw.setDataVariance(isDynamic ? osg::Object::DYNAMIC : osg::Object::STATIC);
               });
}

// A motion that pauses compiles nothing anew.
void MotionPass::dismiss(FrameContext& c)
{
    if (!c.decisions.average.needed) _programs.clear();
}

void MotionPass::resizeGLObjectBuffers(unsigned maximum)
{
    for (const auto& [shader, program] : _programs) program->resizeGLObjectBuffers(maximum);
}

void MotionPass::releaseGLObjects(osg::State* state) const
{
    for (const auto& [shader, program] : _programs) program->releaseGLObjects(state);
}

}  // namespace osgEnvLight
