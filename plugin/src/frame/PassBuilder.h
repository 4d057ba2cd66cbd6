/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FullScreen.h"
#include "frame/StateSets.h"

#include <osgEnvLight/Export>
#include <osgEnvLight/SettingsGroups>

#include <osg/Depth>
#include <osg/StateSet>
#include <osg/Texture2D>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace osgEnvLight
{

class FrameGraph;
struct FrameContext;

/** A texture of a frame: what passes hand on. */
class TextureId
{
  public:
    bool valid() const { return _index >= 0; }

  private:
    friend class PassBuilder;
    friend class FrameGraph;
    int _index = -1;
};

struct TextureDesc {
    GLint format = GL_RGBA16F_ARB;
    int side = 0;         // of a square one [pixels]; 0: as large as the view
    bool kept = false;    // what is in it stays from frame to frame
    bool half = false;    // a texel for each 2x2 pixels of the view
    bool linear = false;  // look-ups between texels interpolate
};

/** A draw of something else than a triangle over the target, with the camera whose callbacks bind what it draws into. */
struct CustomDraw {
    std::string name;
    osg::ref_ptr<osg::Drawable> drawable;
    osg::ref_ptr<osg::Camera> camera;
};

/** What a pass asks for in one frame. */
struct PassInputs {
    struct Sampler {
        std::string name;
        TextureId id;                      // a texture of the frame, or
        osg::ref_ptr<osg::Texture> bound;  // one of somebody's own
    };
    struct Target {
        TextureId id;
        std::array<float, 4> elsewhere;  // what pixels have that are not drawn; of integers, the bits
        bool cleared;                    // to that before
    };
    std::vector<Sampler> samplers;
    std::vector<Target> targets;
    TextureId marks;  // depth texture of the targets
    bool writesMarks = false;
    osg::Depth::Function markTest = osg::Depth::GREATER;  // of drawnDepth against the marks
    float drawnDepth = 0.0f;
    std::vector<std::string> defines;
    std::vector<osg::ref_ptr<osg::Uniform>> uniforms;
    std::vector<osg::ref_ptr<osg::StateSet>> frameUniforms;
    std::vector<CustomDraw> customDraws;
    std::function<osg::ref_ptr<FullScreen>()> makeTriangle;
    std::function<void(FullScreen&)> prepareTriangle;
    osg::Vec3d shadowOrigin;
    osg::StateSet* filled = nullptr;
    bool adds = false;
    bool toHost = false;
    bool blendsOverHost = false;
    bool drawsAlways = false;
    bool keepsContents = false;

    bool drawsMarked() const { return marks.valid() && !writesMarks; }
};

/** How a pass says what it reads, writes and draws. Textures are known by name to the passes of a frame, and only there. */
class OSGENVLIGHT_EXPORT PassBuilder
{
  public:
    PassBuilder(FrameGraph& graph, FrameContext& context, int pass, PassInputs& inputs)
        : _graph(graph), _context(context), _pass(pass), _inputs(inputs)
    {
    }

    /** A texture that this pass makes. Throws if another pass of the frame makes one of that name. */
    TextureId create(const std::string& name, const TextureDesc& desc = TextureDesc());
    /** One that a pass before this one makes, or that comes from outside; invalid if there is none in this frame. */
    TextureId find(const std::string& name) const;

    /** A texture of somebody's own, to be drawn into. */
    TextureId import(const std::string& name, osg::Texture2D* texture);

    /** Read a texture by that sampler, from a unit that the graph assigns. Throws if it is invalid. */
    void read(TextureId texture, const std::string& sampler);
    /** The same by name; false, and nothing is read, if there is none. */
    bool read(const std::string& texture, const std::string& sampler);
    /** Read a texture that is not of the frame. */
    void bind(osg::Texture* texture, const std::string& sampler);

    /** Draw into textures of one size: into outputs 0, 1, ... in the order of the calls.
     * @param elsewhere  of pixels that drawMarked() leaves out; of a texture of integers, the bits of these floats */
    void write(TextureId texture, const std::array<float, 4>& elsewhere = {});
    /** Add to what a pass before this one, or this one in a former frame, has drawn. */
    void addTo(TextureId texture);
    /** The same, but only the passes after this one read the sum: those before it read what there was. */
    void addLaterTo(TextureId texture);
    /** Draw over what a pass before this one has drawn; pixels that drawMarked() leaves out stay. */
    void drawOver(TextureId texture);
    /** Mark pixels for the passes after this one, in a depth texture: the shader writes a mark of lib/limits.glsl as
     * gl_FragDepth, or 1 for none. */
    void mark(TextureId marks);
    /** Draw only the pixels that have this mark or a lower one: the depth test drops the others before their shader runs. */
    void drawMarked(TextureId marks, float mark);
    /** Draw only those that have this mark. */
    void drawOnly(TextureId marks, float mark);
    /** Draw only those that have none. */
    void drawUnmarked(TextureId marks);
    /** Draw into the host's colour and depth. */
    void writeHost() { _inputs.toHost = true; }
    /** The colours, multiplied by their alpha before, lie over what the host has drawn. */
    void blendOverHost() { _inputs.blendsOverHost = true; }
    /** Draw whether or not another pass reads it in this frame. */
    void drawAlways() { _inputs.drawsAlways = true; }
    /** Draw nothing in this frame: what was drawn into kept textures stays. */
    void keepContents() { _inputs.keepsContents = true; }
    /** Draw nothing, but give a state set of the host's what a draw would have: the samplers, defines and uniforms. */
    void fill(osg::StateSet& state) { _inputs.filled = &state; }
    /** Draw something else than a triangle. Such a pass draws whether or not another one reads it. */
    void draw(const CustomDraw& draw) { _inputs.customDraws.push_back(draw); }
    /** Draw a triangle of a class of its own, made once for each of the frames that are in flight and prepared in each. Such a
     * pass draws whether or not another one reads it. */
    void triangle(const std::function<osg::ref_ptr<FullScreen>()>& make, const std::function<void(FullScreen&)>& prepare);

    void define(const std::string& name) { _inputs.defines.push_back(name); }
    void define(const std::string& name, bool on)
    {
        if (on) define(name);
    }
    /** A uniform whose value never changes. */
    void uniform(osg::Uniform* uniform) { _inputs.uniforms.emplace_back(uniform); }
    /** Uniforms whose values belong to this frame. */
    void frameUniforms(osg::StateSet* state) { _inputs.frameUniforms.emplace_back(state); }
    /** The settings of a struct that the shader reads, as uniforms of their names: settings<OcclusionSettings>(). */
    template <class Group>
    void settings()
    {
        settings(Group::properties);
    }
    /** The point in the world that atlasFromEye leads to. */
    void shadowOrigin(const osg::Vec3d& origin) { _inputs.shadowOrigin = origin; }

    /** albedoMap, normalMap, specularMap and depthMap of the G-buffer. */
    void readGBuffer();
    /** Define which kinds of SurfaceKinds::lobes there are beside BRDFs. */
    void defineKinds(unsigned lobes);
    /** The state sets of the view's passes, for custom draws. */
    StateSets& states();

  private:
    void settings(SettingsGroup group);
    void testMarks(TextureId marks, osg::Depth::Function test, float depth);

    FrameGraph& _graph;
    FrameContext& _context;
    int _pass;
    PassInputs& _inputs;
};

}  // namespace osgEnvLight
