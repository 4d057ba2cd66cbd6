/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/RenderPass.h"
#include "gl/RetiredObjects.h"
#include "indirect/BounceDraw.h"
#include "indirect/TransportWorker.h"

#include <osg/observer_ptr>

#include <atomic>

namespace osgEnvLight
{

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
        bool operator==(const Wanted& o) const { return atlas == o.atlas && generation == o.generation && probes == o.probes; }
    };
    void makeScene(const FrameContext& context, const Wanted& wanted);
    void accept(const osg::ref_ptr<TransportScene>& scene);
    void showSurfaces(const StaticCasters::Parts& parts);
    void keepMirrored();
    void retireTargets();

    const osg::ref_ptr<RetiredObjects> _retired;
    TransportWorker _worker;
    IndirectLight _light;
    Wanted _wanted;  // that a scene was last asked for
    StaticCasters::Parts _wantedParts;
    bool _isShown = false;      // the scene is of these
    unsigned _sentVersion = 0;  // of the light that they send on
    unsigned _frames = 0;       // without a scene
    mutable std::atomic<bool> _lost{false};
};

/** The light of map and suns at the surface points, where it has changed. */
class OSGENVLIGHT_EXPORT PointsPass : public RenderPass
{
  public:
    const char* name() const override { return "points"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext&) override { _key = {}; }

  private:
    /** What the points' light depends on. */
    struct Key {
        osg::ref_ptr<const osg::Referenced> scene, textures, sky, suns, emitters, lamps, diffuse, glossy;
        unsigned skyVersion = 0, sunsVersion = 0, emittersVersion = 0, lampsVersion = 0;
        std::vector<osg::Vec4f> falloffs;  // of the application's lights, which their maps do not show
        std::vector<float> cones;
        osg::Matrixd mapFromWorld;
        double radianceScale = 0.0;

        bool operator==(const Key& o) const
        {
            return scene == o.scene && textures == o.textures && sky == o.sky && suns == o.suns && emitters == o.emitters &&
                   emittersVersion == o.emittersVersion && diffuse == o.diffuse && glossy == o.glossy &&
                   skyVersion == o.skyVersion && lamps == o.lamps && lampsVersion == o.lampsVersion && falloffs == o.falloffs &&
                   cones == o.cones && sunsVersion == o.sunsVersion && mapFromWorld == o.mapFromWorld &&
                   radianceScale == o.radianceScale;
        }
    };
    static Key keyOf(const FrameContext& context);

    Key _key;
};

/** What the points send on, and the probes see of it, bounce after bounce. */
class OSGENVLIGHT_EXPORT BouncesPass : public RenderPass
{
  public:
    explicit BouncesPass(Failure* failure) : _failure(failure) {}

    const char* name() const override { return "bounces"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext&) override { _camera = nullptr, _target = nullptr; }

  private:
    BounceDraw::States statesOf(PassBuilder& builder, FrameContext& context) const;

    const osg::ref_ptr<Failure> _failure;
    osg::ref_ptr<osg::Camera> _camera;
    osg::ref_ptr<const osg::FrameBufferObject> _target;  // that it binds
};

/** What each pixel receives from other surfaces, by the probes about it. */
class OSGENVLIGHT_EXPORT IndirectPass : public RenderPass
{
  public:
    const char* name() const override { return "indirect"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

}  // namespace osgEnvLight
