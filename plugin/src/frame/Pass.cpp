// SPDX-License-Identifier: MIT
#include "frame/Pass.h"

#include <osg/GLExtensions>
#include <osg/Program>
#include <osg/Viewport>

namespace osgEnvLight
{

namespace
{

// Uploads to the program in use; names that it lacks are skipped.
class Uploader
{
  public:
    Uploader(const osg::Program::PerContextProgram& program, const osg::GLExtensions& ext) : _program(program), _ext(ext) {}

    void matrix4(const char* name, const osg::Matrixd& m) const
    {
        const osg::Matrixf f(m);
        if (const GLint l = location(name); l >= 0) _ext.glUniformMatrix4fv(l, 1, GL_FALSE, f.ptr());
    }

    // Rotation only. OSG multiplies row vectors, so its rows are GLSL's columns.
    void matrix3(const char* name, const osg::Matrixd& m) const
    {
        float f[9];
        for (int i = 0; i < 3; ++i) {
            osg::Vec3d row(m(i, 0), m(i, 1), m(i, 2));
            row.normalize();
            for (int j = 0; j < 3; ++j) f[3 * i + j] = float(row[j]);
        }
        if (const GLint l = location(name); l >= 0) _ext.glUniformMatrix3fv(l, 1, GL_FALSE, f);
    }

    void vec2(const char* name, double x, double y) const
    {
        if (const GLint l = location(name); l >= 0) _ext.glUniform2f(l, float(x), float(y));
    }

  private:
    GLint location(const char* name) const { return _program.getUniformLocation(name); }

    const osg::Program::PerContextProgram& _program;
    const osg::GLExtensions& _ext;
};

}  // namespace

FullScreen::FullScreen(const std::string& name, GpuTimer* timer, osg::Vec3Array* vertices) : _timer(timer)
{
    setName(name);
    setFullScreenTriangle(*this, vertices ? vertices : fullScreenVertices().get());
}

void FullScreen::drawImplementation(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    osg::ref_ptr<ContextWatch::Listener> listener;
    if (owner.lock(listener)) ContextWatch::add(state, listener.get());
    const osg::Program::PerContextProgram* program = state.getLastAppliedProgramObject();
    if (!program) return;  // it has reported why
    const Uploader upload(*program, *state.get<osg::GLExtensions>());
    const osg::Matrixd projection =
        osg::Matrixd(state.getProjectionMatrix()) * depth.fromHostClip() * osg::Matrixd::translate(subpixel[0], subpixel[1], 0.0);
    const osg::Matrixd eyeToWorld = osg::Matrixd::inverse(state.getInitialViewMatrix());
    const auto* viewport = static_cast<const osg::Viewport*>(state.getLastAppliedAttribute(osg::StateAttribute::VIEWPORT));
    upload.matrix4("projection", projection);
    upload.matrix4("inverseProjection", osg::Matrixd::inverse(projection));
    upload.matrix3("mapFromEye", eyeToWorld * mapFromWorld);
    upload.matrix4("atlasFromEye", eyeToWorld * osg::Matrixd::translate(-atlasOrigin));
    upload.vec2("viewportSize", viewport->width(), viewport->height());
    upload.vec2("viewportOrigin", viewport->x(), viewport->y());
    upload.vec2("hostDepth", depth.toHostDepth()[0], depth.toHostDepth()[1]);
    if (timed) _timer->begin(state);
    osg::Geometry::drawImplementation(renderInfo);
    if (timed) _timer->end(state);
    // State knows what is bound by its address alone, and would take a later texture at a freed one's for it.
    for (unsigned unit = 0; unit < textureUnits; ++unit) state.haveAppliedTextureAttribute(unit, osg::StateAttribute::TEXTURE);
}

void prepareStage(PassStage& stage, osgUtil::RenderStage& host, osg::Camera& camera, osg::Viewport& viewport,
                  GLbitfield clearMask)
{
    stage.setPositionalStateContainer(nullptr);  // reset() would empty it, and below it may be the host's
    stage.reset();
    // The stage observes its camera, and does not take a new one at a dead one's address for another.
    stage.setCamera(nullptr);
    stage.setCamera(&camera);
    stage.setCameraRequiresSetUp(false);  // its callbacks bind the target: OSG would only print that it sets up a frame buffer
    stage.ownCamera = &camera;
    stage.setViewport(&viewport);
    // State caches one draw buffer for all frame buffers, so none is set here.
    stage.setDrawBuffer(GL_NONE, false);
    stage.setReadBuffer(GL_NONE, false);
    stage.setClearMask(clearMask);
    stage.setClearColor(osg::Vec4(0, 0, 0, 0));
    stage.setClearDepth(1.0);
    stage.setColorMask(nullptr);
    stage.setInitialViewMatrix(host.getInitialViewMatrix());
}

Pass::Pass(osg::Drawable* drawable) : _stage(new PassStage), _drawable(drawable)
{
    _stage->root = new osgUtil::StateGraph;
    _stage->setStateGraph(_stage->root.get());
}

void Pass::add(osgUtil::RenderStage& host, osg::Camera& camera, osg::Viewport& viewport, osg::StateSet& state,
               osg::StateSet& uniforms, osg::RefMatrix* projection, osg::RefMatrix* modelView)
{
    prepareStage(*_stage, host, camera, viewport, 0);
    _stage->root->clean();
    _stage->root->prune();  // of the former frame's state sets, which hold textures
    _added = true;
    osgUtil::StateGraph* graph = _stage->root->find_or_insert(&state)->find_or_insert(&uniforms);
    if (!_stage->leaf)
        _stage->leaf = new osgUtil::RenderLeaf(_drawable.get(), projection, modelView);
    else
        _stage->leaf->set(_drawable.get(), projection, modelView);
    _stage->addStateGraph(graph);
    graph->addLeaf(_stage->leaf.get());
    host.addPreRenderStage(_stage.get(), afterHosts);
}

}  // namespace osgEnvLight
