/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Failure.h"
#include "frame/FrameContext.h"
#include "frame/PassBuilder.h"
#include "frame/Requirement.h"
#include "gl/RetiredObjects.h"
#include "shadow/EmitterMaps.h"

#include <string>
#include <vector>

namespace osgEnvLight
{

/** The draw of shadow maps of the sky or of suns.
 * @param pass    whose time it adds to
 * @param name    of the draw
 * @param shader  that makes the maps from the first two surfaces */
void drawMaps(PassBuilder& builder, FrameContext& context, const char* pass, const std::string& name, const char* shader,
              osg::Camera& camera, const ShadowTargets& targets, const std::vector<ShadowRefresh>& refreshes,
              std::vector<Caster>&& casters);

/** Whether a frame draws all maps instead of a few: as settings.regeneration says, and the first frame unless the model is large.
 * @param known  whether an earlier frame has drawn any
 * @param triangles  in each map */
bool drawsAllAtOnce(const Settings& settings, unsigned maps, bool known, size_t triangles);

/** The lights, unless nothing is to be seen of maps of their points. */
Requirement requireEmitterMaps(const FrameContext& context, Requirement lights);

/** A draw may still use them. */
void retire(const ShadowTargets& targets, RetiredObjects& retired);

/** The shadow atlas of a pass, and what it takes to replace it while a draw may still use it. */
class OSGENVLIGHT_EXPORT AtlasOwner
{
  public:
    AtlasOwner(Failure* failure, RetiredObjects* retired) : _failure(failure), _retired(retired) {}
    ~AtlasOwner() { drop(); }

    /** Made anew where the counts differ. */
    ShadowAtlas& make(unsigned lights, unsigned size);
    void drop();

    /** In update(): choose maps to be drawn in this frame, of lights in the map's frame. How many.
     * @param budget  at most */
    unsigned update(const FrameContext& context, const LightList& list, unsigned budget);
    /** In setup(): draw them. */
    void draw(PassBuilder& builder, FrameContext& context, const char* pass, const std::string& name);

    size_t bytes() const { return _maps ? _maps->bytes() : 0; }
    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;

  private:
    const osg::ref_ptr<Failure> _failure;
    const osg::ref_ptr<RetiredObjects> _retired;
    osg::ref_ptr<ShadowAtlas> _maps;
    osg::ref_ptr<osg::Camera> _camera;
    std::vector<ShadowRefresh> _refreshes;
};

/** The same of maps of points of lights, with the table that says where they stand. */
class OSGENVLIGHT_EXPORT EmitterMapsOwner
{
  public:
    EmitterMapsOwner(Failure* failure, RetiredObjects* retired) : _failure(failure), _retired(retired) {}
    ~EmitterMapsOwner() { drop(); }

    /** In update(): choose maps to be drawn in this frame. Made anew where the counts differ.
     * @param size  of a map's side [texels] */
    EmitterMaps& update(FrameContext& context, const std::vector<EmitterPoint>& points, unsigned size);
    /** EmitterMaps::pointImage() of update(). */
    osg::Texture2D* points() const { return _points.get(); }
    void drop();

    /** In setup(): draw them. */
    void draw(PassBuilder& builder, FrameContext& context, const char* pass);

    size_t bytes() const { return _maps ? _maps->bytes() : 0; }
    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;

  private:
    EmitterMaps& make(unsigned points, unsigned size);

    const osg::ref_ptr<Failure> _failure;
    const osg::ref_ptr<RetiredObjects> _retired;
    osg::ref_ptr<EmitterMaps> _maps;
    osg::ref_ptr<osg::Camera> _camera;
    std::vector<ShadowRefresh> _refreshes;
    osg::ref_ptr<osg::Texture2D> _points;  // at which version
    unsigned _pointVersion = 0;
};

}  // namespace osgEnvLight
