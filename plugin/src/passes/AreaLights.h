/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/RenderPass.h"
#include "passes/MapRefresh.h"
#include "shadow/PointChoice.h"

#include <osg/Texture2DArray>

namespace osgEnvLight
{

/** The shadow maps of the area lights' points, drawn when lights or casters change, a few a frame; and those of a frame of a
 * still view's average. */
class OSGENVLIGHT_EXPORT AreaMapsPass : public MapsPass<EmitterMapsOwner>
{
  public:
    AreaMapsPass(Failure* failure, RetiredObjects* retired) : MapsPass(failure, retired), _stillMaps(failure, retired) {}

    const char* name() const override { return "areamaps"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;
    size_t bytes() const override { return MapsPass::bytes() + _stillMaps.bytes(); }
    void resizeGLObjectBuffers(unsigned maximum) override;
    void releaseGLObjects(osg::State* state) const override;

  private:
    void forgetChoice();

    EmitterMapsOwner _stillMaps;
    PointChoice _choice;                             // of many lights
    osg::ref_ptr<osg::Texture2D> _lightsWithPoints;  // which these are
};

/** There are more area lights than points, so what the view shows decides which have some. */
Requirement requireChosenPoints(const FrameContext& context);

/** Each pixel of a 4x4 cell asks another sixteenth of these maps. */
class OSGENVLIGHT_EXPORT AreaShadowPass : public RenderPass
{
  public:
    const char* name() const override { return "areashadow"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** These sums, averaged over a cell along rows [area-lights.md 3, "Filter width"]. */
class OSGENVLIGHT_EXPORT AreaRowsPass : public RenderPass
{
  public:
    const char* name() const override { return "arearows"; }
    const char* shader() const override { return "filterrows"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;

  private:
    const osg::ref_ptr<osg::Uniform> _cells = new osg::Uniform("filterCells", 1);
};

/** The same along columns, and the sums' ratio. */
class OSGENVLIGHT_EXPORT AreaFilterPass : public RenderPass
{
  public:
    const char* name() const override { return "areafilter"; }
    const char* shader() const override { return "filter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;

  private:
    const osg::ref_ptr<osg::Uniform> _cells = new osg::Uniform("filterCells", 1);
};

/** What surfaces get of many lights, roughly: what is left out of the cuts through their tree is measured by it. */
class OSGENVLIGHT_EXPORT LightTotalsPass : public RenderPass
{
  public:
    const char* name() const override { return "lighttotals"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext&) override;

  private:
    osg::ref_ptr<osg::Texture2D> _tree;
    std::vector<Emitter> _list;  // that it shows, about which origin
    osg::Vec3d _origin;
};

/** Adds what surfaces reflect of the area lights to the G-buffer's emission: bounce and still views then have it too. */
class OSGENVLIGHT_EXPORT AreaLightsPass : public RenderPass
{
  public:
    const char* name() const override { return "arealights"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext&) override;

  private:
    osg::Texture2D* lightTexture(const std::vector<Emitter>& lights, const osg::Vec3d& origin);

    osg::ref_ptr<osg::Texture2D> _ltcTable;  // null: no lobe is in view
    osg::ref_ptr<osg::Texture2D> _lights;
    osg::ref_ptr<osg::Texture2DArray> _pictures;  // null: not asked for yet
    std::vector<Emitter> _list;                   // that it shows, about which origin
    osg::Vec3d _origin;
};

}  // namespace osgEnvLight
