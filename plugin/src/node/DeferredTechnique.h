/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "gl/ContextWatch.h"
#include <osgEnvLight/Export>
#include "lights/MapRegenerator.h"
#include "gl/ShaderLibrary.h"
#include <osgEnvLight/LitScene>
#include "node/LitView.h"

#include <osg/Notify>

#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <tuple>

namespace osgUtil
{
class CullVisitor;
}

namespace osgEnvLight
{

/** How a LitScene lights: G-buffer, diffuse, specular, occlusion, filter, composite, as stages hung on the host's own
 * stage (osg.md 1). One view's data is keyed by (CullVisitor::Identifier, the host stage's camera, the context's State, the n-th
 * visit of these in this frame), and freed when its context ends, or at the next cull after the view has died.*/
class OSGENVLIGHT_EXPORT DeferredTechnique : public ContextWatch::Listener
{
  public:
    DeferredTechnique();

    /** Cull the node's children for lighting. False if this traversal is not to be lit (a depth-only pass, a LitScene
     * inside another, an unreadable map, a shader that does not compile): the caller then traverses plainly.*/
    bool cull(LitScene& node, osgUtil::CullVisitor& cv);

    /** Read the shaders again and clear a failure. */
    void reloadShaders();

    unsigned numViews() const;
    Plan plan() const;
    Average average() const;
    size_t bytes() const;
    /** True while a change of the map or the scene is being made into light and shadow. */
    bool regenerating() const { return _regenerator.busy() || _waiting > 0; }

    /** Whether further frames would change a view's picture by themselves. One that is no longer culled soon does not count. */
    bool unsettled() const;
    /** In each update traversal. */
    void countUpdate();

    /** Shadow maps of suns that the last culled frame drew: none while nothing moves. */
    unsigned drawnSunMaps() const { return _drawnSunMaps; }

    /** Read what is about to be uploaded below the node, and then perhaps given away. */
    void lookBeforeUpload(osg::Node& node) { _facts->look(node); }

    void resizeGLObjectBuffers(unsigned maximum);
    /** Of all contexts where state is null. What its views hold is freed; the next cull makes it anew. */
    void releaseGLObjects(osg::State* state) const;
    void contextLost(unsigned contextID) override;

  protected:
    ~DeferredTechnique() override = default;

  private:
    struct Key {
        const osg::Referenced* identifier;
        const osg::Referenced* camera;
        const osg::Referenced* context;
        unsigned visit;
        bool operator<(const Key& o) const
        {
            return std::tie(identifier, camera, context, visit) < std::tie(o.identifier, o.camera, o.context, o.visit);
        }
    };
    struct Visit {
        osg::observer_ptr<osg::Referenced> cullVisitor;
        unsigned frame = ~0u;
        unsigned count = 0;
    };

    osg::ref_ptr<const Settings> currentSettings(const LitScene& node);
    osg::ref_ptr<MapTextures> currentTextures(const LitScene& node, const Settings& settings, osgUtil::CullVisitor& cv);
    void regenerate(const MapState& state, const Settings& settings, const std::shared_ptr<const LightList>& lights);
    void accept(const MapRegenerator::Result& result);
    LitView& view(LitScene& node, osgUtil::CullVisitor& cv, osgUtil::RenderStage& host);
    GBuffer* gbufferOf(LitScene& node, LitView& view);
    FrameContext contextOf(LitScene& node, LitView& view, const Settings& settings, MapTextures& textures, GBuffer& gbuffer,
                           osgUtil::CullVisitor& cv, osgUtil::RenderStage& host);
    void light(FrameContext& context, LitView& view, bool needsCarrier);
    void reportOnce(const std::string& message, osg::NotifySeverity severity = osg::WARN);
    bool hasSettled(const FrameContext& context) const;
    template <class Condition>
    void release(osg::State* state, Condition drops) const;
    osg::Texture* albedoTable(bool anisotropic);

    mutable std::mutex _mutex;
    osg::ref_ptr<ShaderLibrary> _library;
    osg::ref_ptr<SurfaceFacts> _facts;
    osg::ref_ptr<SurfaceSorter> _sorter;
    osg::ref_ptr<Failure> _failure;
    osg::ref_ptr<MapTextures> _darkTextures;  // null until a scene under a black map has area lights
    osg::ref_ptr<MapTextures> _textures;      // null before the first frame, and while the map can't serve
    MapState _state;                          // that was last asked for
    bool _started = false;
    unsigned _checkedFrame = ~0u;              // all views of a frame see the same light
    unsigned _stillFrames = 0;                 // since the map last changed
    osg::ref_ptr<const osg::Image> _repaired;  // whose repairs were reported
    MapRegenerator _regenerator;
    std::atomic<unsigned> _waiting{0};  // for frames: shadow maps and bounces of the last view
    std::atomic<unsigned> _drawnSunMaps{0};
    osg::ref_ptr<osg::Texture2D> _albedoTables[2];  // without and with blocks for brushed surfaces
    osg::ref_ptr<const Settings> _settings;         // the last valid ones
    osg::ref_ptr<RetiredObjects> _retired;
    mutable std::map<Key, osg::ref_ptr<LitView>> _views;
    std::map<std::pair<const osg::Referenced*, const osg::Referenced*>, Visit> _visits;
    std::set<std::string> _reported;
    unsigned _updates = 0;
    osg::observer_ptr<LitView> _lastView;
};

}  // namespace osgEnvLight
