/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/RenderPass.h"
#include "gl/RetiredObjects.h"
#include "indirect/TransportWorker.h"

#include <osg/observer_ptr>

#include <atomic>

namespace osgEnvLight
{

/** Whether the view has probes, and why. */
Requirement requireProbes(const FrameContext& context);

/** Surface points and probes of what stands still, made on a thread of its own whenever that changes. */
class OSGENVLIGHT_EXPORT LinksPass : public RenderPass
{
  public:
    explicit LinksPass(RetiredObjects* retired) : _retired(retired) {}

    const char* name() const override { return "links"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;
    size_t bytes() const override;
    void resizeGLObjectBuffers(unsigned maximum) override;
    void releaseGLObjects(osg::State* state) const override;

  protected:
    ~LinksPass() override { retireTargets(); }

  private:
    /** What a scene is made from. */
    struct Wanted {
        osg::observer_ptr<const ShadowAtlas> atlas;  // whose casters it shows
        unsigned generation = 0;                     // of these
        int probes = 0;
        double mostOpen = 0.0;  // as of TransportScene
        TransportFocus focus;   // in the world
        bool isOfSameCasters(const Wanted& o) const { return atlas == o.atlas && generation == o.generation; }
        bool operator==(const Wanted& o) const
        {
            return isOfSameCasters(o) && probes == o.probes && mostOpen == o.mostOpen && focus == o.focus;
        }
    };
    TransportFocus focusOf(const FrameContext& context) const;
    bool wantsRays(const FrameContext& context);
    double mostOpenForRays(const FrameContext& context);
    void makeScene(const FrameContext& context, const Wanted& wanted);
    void accept(const osg::ref_ptr<TransportScene>& scene);
    void showSurfaces(const StaticCasters::Parts& parts);
    void keepMirrored();
    void keepPointNear();
    void keepCells();
    std::vector<osg::Texture2D*> surfaceTextures() const;
    void retireTargets();

    const osg::ref_ptr<RetiredObjects> _retired;
    TransportWorker _worker;
    IndirectLight _light;
    Wanted _wanted;  // that a scene was last asked for
    StaticCasters::Parts _wantedParts;
    bool _hasMirrors = false;      // something in the scene is or was glossy
    unsigned _mirrorsVersion = 0;  // of the light that its surfaces send on, by which that is known
    bool _isShown = false;         // the scene is of these
    unsigned _sentVersion = 0;     // of the light that they send on
    unsigned _frames = 0;          // without a scene
    mutable std::atomic<bool> _lost{false};
};

}  // namespace osgEnvLight
