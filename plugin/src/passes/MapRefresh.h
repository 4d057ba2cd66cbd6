/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Failure.h"
#include "frame/FrameContext.h"
#include "frame/PassBuilder.h"
#include "frame/RenderPass.h"
#include "frame/Requirement.h"
#include "frame/StageCamera.h"
#include "gl/BindTargets.h"
#include "gl/RetiredObjects.h"
#include "shadow/EmitterMaps.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace osgEnvLight
{

/** How shadow maps of one kind are made. */
struct MapShaders {
    const char* middles;  // the shader that makes the maps from the first two surfaces
    const char* define;   // of the surfaces' shader; null for none
};

/** The draw of shadow maps of the sky, of suns or of lamps.
 * @param pass    whose time it adds to
 * @param name    of the draw */
void drawMaps(PassBuilder& builder, FrameContext& context, const char* pass, const std::string& name, const MapShaders& shaders,
              osg::Camera& camera, const ShadowTargets& targets, const std::vector<ShadowRefresh>& refreshes,
              std::vector<Caster>&& casters);

/** Triangles that the first frame of a view may draw into the maps of the sky, and into those of lamps: 64 maps of 156 000, each
 * drawn twice. */
constexpr double firstFrameTriangles = 2e7;

/** The lights, unless nothing is to be seen of maps of their points. */
Requirement requireEmitterMaps(const FrameContext& context, Requirement lights);

/** A draw may still use them. */
void retire(const ShadowTargets& targets, RetiredObjects& retired);

/** Shadow maps of a pass, and what it takes to replace them while a draw may still use them.
 * @tparam Maps  ShadowAtlas, EmitterMaps or SunShadows */
template <class Maps>
class MapsOwner
{
  public:
    MapsOwner(Failure* failure, RetiredObjects* retired) : _failure(failure), _retired(retired) {}
    ~MapsOwner() { drop(); }

    /** Null: there are none. */
    Maps* get() const { return _maps.get(); }
    /** These take the place of those there are. */
    Maps& replace(Maps* maps)
    {
        drop();
        _maps = maps;
        _camera = new StageCamera;
        BindTargets::install(*_camera, maps->targets().maps, _failure.get());
        return *maps;
    }
    void drop()
    {
        if (_maps) retire(_maps->targets(), *_retired);
        _maps = nullptr;
        _camera = nullptr;
        refreshes.clear();
    }

    std::vector<ShadowRefresh> refreshes;  // set in update()

    /** In setup(): draw them, if there are any. */
    void draw(PassBuilder& builder, FrameContext& context, const char* pass, const std::string& name, const MapShaders& shaders,
              const std::function<std::vector<Caster>()>& casters)
    {
        const auto isEmpty = [](const ShadowRefresh& r) { return r.region.isEmpty(); };
        if (!std::all_of(refreshes.begin(), refreshes.end(), isEmpty))
            drawMaps(builder, context, pass, name, shaders, *_camera, _maps->targets(), refreshes, casters());
        refreshes.clear();
    }

    size_t bytes() const { return _maps ? _maps->bytes() : 0; }
    void resizeGLObjectBuffers(unsigned maximum)
    {
        if (_maps) _maps->resizeGLObjectBuffers(maximum);
    }
    void releaseGLObjects(osg::State* state) const
    {
        if (_maps) _maps->releaseGLObjects(state);
    }

  private:
    const osg::ref_ptr<Failure> _failure;
    const osg::ref_ptr<RetiredObjects> _retired;
    osg::ref_ptr<Maps> _maps;
    osg::ref_ptr<osg::Camera> _camera;
};

/** A pass that draws shadow maps.
 * @tparam Owner  of them */
template <class Owner>
class MapsPass : public RenderPass
{
  public:
    MapsPass(Failure* failure, RetiredObjects* retired) : _maps(failure, retired) {}

    size_t bytes() const override { return _maps.bytes(); }
    void resizeGLObjectBuffers(unsigned maximum) override { _maps.resizeGLObjectBuffers(maximum); }
    void releaseGLObjects(osg::State* state) const override { _maps.releaseGLObjects(state); }

  protected:
    Owner _maps;
};

/** Those of the sky's lights. */
class OSGENVLIGHT_EXPORT AtlasOwner : public MapsOwner<ShadowAtlas>
{
  public:
    using MapsOwner::MapsOwner;

    /** Made anew where the counts differ. */
    ShadowAtlas& make(unsigned lights, unsigned size);
    /** In update(): choose maps to be drawn in this frame, of lights in the map's frame.
     * @param budget  [ShadowAtlas::update]
     * @return what of it was needed */
    unsigned update(const FrameContext& context, const LightList& list, unsigned budget);
    /** In setup(): draw them. */
    void draw(PassBuilder& builder, FrameContext& context, const char* pass, const std::string& name);
};

/** Those of points of lights, with the table that says where they stand. */
class OSGENVLIGHT_EXPORT EmitterMapsOwner : public MapsOwner<EmitterMaps>
{
  public:
    using MapsOwner::MapsOwner;

    /** In update(): choose maps to be drawn in this frame. Made anew where the counts differ.
     * @param size  of a map's side [texels]
     * @param all   in this frame, however many there are */
    EmitterMaps& update(FrameContext& context, const std::vector<EmitterPoint>& points, unsigned size, bool all = false);
    void drop();
    /** EmitterMaps::pointImage() of update(). */
    osg::Texture2D* points() const { return _points.get(); }
    /** In setup(): draw them. */
    void draw(PassBuilder& builder, FrameContext& context, const char* pass, const std::string& name);

  private:
    osg::ref_ptr<osg::Texture2D> _points;  // at which version
    unsigned _pointVersion = 0;
};

}  // namespace osgEnvLight
