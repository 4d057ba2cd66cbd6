/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/PassBuilder.h"
#include "frame/RenderPass.h"
#include "frame/StateSets.h"
#include "frame/TexturePool.h"

#include <osgEnvLight/Plan>

#include <vector>

namespace osgEnvLight
{

/** The passes of a view. In each frame it asks them what they need, drops those whose results nobody reads, orders the others by
 * what they read and write, finds textures for them and hangs them on the host's stage.*/
class OSGENVLIGHT_EXPORT FrameGraph
{
  public:
    FrameGraph(Failure* failure, RetiredObjects* retired) : _pool(failure, retired) {}

    void add(const osg::ref_ptr<RenderPass>& pass) { _passes.push_back(pass); }

    /** During cull. Throws std::runtime_error, which names the passes, where they contradict each other or read too much. */
    void run(FrameContext& context);

    /** Of the last frame, in the order in which the passes were added; without times. */
    const std::vector<PassReport>& report() const { return _report; }
    /** Forget all programs. */
    void forgetPrograms() { _states.clear(); }

    size_t bytes() const;
    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;
    /** Hand over all textures: a draw may still use them. */
    void retire();

    /** Texture units that OpenGL 3.3 guarantees to a fragment shader. */
    static constexpr unsigned mostUnits = 16;

  private:
    friend class PassBuilder;
    struct Node {
        RenderPass* pass = nullptr;
        PassInputs inputs;
        bool draws = false;
    };
    struct Resource {
        std::string name;
        TextureDesc desc;
        osg::ref_ptr<osg::Texture2D> texture;  // one from outside, or when there is one
        bool outside = false;
        int maker = -1;
        std::vector<int> adders, lateAdders, readers;
    };

    void begin(FrameContext& context);
    void setUp(FrameContext& context);
    void import(const std::string& name, osg::Texture2D* texture);
    void dropUnread();
    std::vector<int> order() const;
    void allocate(const std::vector<int>& order, const FrameContext& context);
    void draw(const Node& node, FrameContext& context);
    void drawTriangle(const Node& node, FrameContext& context);
    void drawToHost(const Node& node, FrameContext& context);
    std::vector<StateSets::Sampler> samplers(const Node& node) const;
    osg::StateSet& stateOf(const Node& node, FrameContext& context);
    void fill(const Node& node, osg::StateSet& state) const;
    std::vector<osg::ref_ptr<osg::Texture2D>> targetsOf(const Node& node) const;
    std::vector<FullScreen::Clear> clearsOf(const Node& node) const;

    std::vector<osg::ref_ptr<RenderPass>> _passes;
    std::vector<Node> _nodes;  // of this frame, in the order of _passes
    std::vector<Resource> _resources;
    std::vector<PassReport> _report;
    TexturePool _pool;
    StateSets _states;
};

}  // namespace osgEnvLight
