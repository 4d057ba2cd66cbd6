/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/RenderPass.h"
#include "indirect/BounceDraw.h"

namespace osgEnvLight
{

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
        osg::ref_ptr<const osg::Referenced> scene, textures, sky, nearSky, suns, emitters, lamps, diffuse, glossy, virtualLights;
        unsigned skyVersion = 0, nearSkyVersion = 0, sunsVersion = 0, emittersVersion = 0, lampsVersion = 0;
        std::vector<osg::Vec4f> falloffs;  // of the application's lights, which their maps do not show
        std::vector<float> cones;
        osg::Matrixd mapFromWorld;
        double radianceScale = 0.0;

        bool operator==(const Key& o) const
        {
            return scene == o.scene && textures == o.textures && sky == o.sky && suns == o.suns && emitters == o.emitters &&
                   emittersVersion == o.emittersVersion && diffuse == o.diffuse && glossy == o.glossy &&
                   skyVersion == o.skyVersion && nearSky == o.nearSky && nearSkyVersion == o.nearSkyVersion && lamps == o.lamps &&
                   lampsVersion == o.lampsVersion && falloffs == o.falloffs && cones == o.cones && sunsVersion == o.sunsVersion &&
                   mapFromWorld == o.mapFromWorld && radianceScale == o.radianceScale && virtualLights == o.virtualLights;
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
