/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Failure.h"
#include "frame/RenderPass.h"
#include "gl/RetiredObjects.h"
#include "indirect/ReflectiveMaps.h"

#include <osg/Uniform>

namespace osgEnvLight
{

/** Reflective shadow maps of suns and lamps: of what polished metal they see, and what it reflects. */
class OSGENVLIGHT_EXPORT ReflectiveMapsPass : public RenderPass
{
  public:
    ReflectiveMapsPass(Failure* failure, RetiredObjects* retired) : _failure(failure), _retired(retired) {}

    const char* name() const override { return "reflectivemap"; }
    Requirement require(const FrameContext& context) const override;
    void update(FrameContext& context) override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext& context) override;
    size_t bytes() const override { return _caustics.targets.bytes(); }
    void resizeGLObjectBuffers(unsigned maximum) override { _caustics.targets.resizeGLObjectBuffers(maximum); }
    void releaseGLObjects(osg::State* state) const override { _caustics.targets.releaseGLObjects(state); }

  protected:
    ~ReflectiveMapsPass() override { drop(); }

  private:
    /** @param size  of a map's side [texels] */
    void makeTargets(unsigned size, unsigned lights);
    void drop();

    const osg::ref_ptr<Failure> _failure;
    const osg::ref_ptr<RetiredObjects> _retired;
    Caustics _caustics;
    osg::ref_ptr<osg::Camera> _camera;
};

/** Virtual lights, chosen from these maps. */
class OSGENVLIGHT_EXPORT VirtualLightsPass : public RenderPass
{
  public:
    const char* name() const override { return "virtuallights"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
    void dismiss(FrameContext&) override { _ltcTable = nullptr; }

  private:
    osg::ref_ptr<osg::Texture2D> _ltcTable;
};

/** What pixels receive of them, each of a group. */
class OSGENVLIGHT_EXPORT CausticsPass : public RenderPass
{
  public:
    const char* name() const override { return "caustics"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;
};

/** That, averaged over cells along rows. */
class OSGENVLIGHT_EXPORT CausticRowsPass : public RenderPass
{
  public:
    const char* name() const override { return "causticrows"; }
    const char* shader() const override { return "filterrows"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;

  private:
    const osg::ref_ptr<osg::Uniform> _cells = new osg::Uniform("filterCells", 2);
};

/** The same along columns. */
class OSGENVLIGHT_EXPORT CausticFilterPass : public RenderPass
{
  public:
    const char* name() const override { return "causticfilter"; }
    const char* shader() const override { return "filter"; }
    Requirement require(const FrameContext& context) const override;
    void setup(PassBuilder& builder, FrameContext& context) override;

  private:
    const osg::ref_ptr<osg::Uniform> _cells = new osg::Uniform("filterCells", 2);
};

}  // namespace osgEnvLight
