/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "gl/ContextWatch.h"
#include <osgEnvLight/Export>
#include "lights/MapRegenerator.h"
#include "gl/ShaderLibrary.h"
#include <osgEnvLight/LitScene>
#include "frame/ViewData.h"

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
    bool regenerating() const { return _regenerator.busy() || _waitingMaps > 0; }

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

    // What one cull needs, gathered before it starts.
    struct Cull {
        ViewData& view;
        Frame& frame;
        osgUtil::RenderStage& host;
        const Settings& settings;
        GBuffer& gbuffer;
        osg::Matrixd mapFromWorld;
        double radianceScale;  // the map's mean radiance times its intensity
        bool timed;
        bool ownGBuffer;  // not the application's
        double mapStops;  // MapTextures::exposure()
        std::vector<Caster> casters = {};
        osg::Matrixd worldFromEye = {};
        ShadowAtlas* finer = nullptr;         // of the view's neighbourhood; null: its maps are the scene's
        bool measures = false;                // what the view shows
        bool away = false;                    // it shows nothing of what there is: the scene's maps wait for it
        const Accumulation* still = nullptr;  // null where none was asked for
        osg::Vec2d subpixel = {};
        DepthConvention depth = {};                // the host's
        SceneLightList lights = {};                // of the application that are switched on
        int background = Settings::BACKGROUND_ON;  // never AUTO

        /** The exposure that the picture has before the setting's stops. */
        double baseStops() const
        {
            const bool follows = settings.output == Settings::DISPLAY && settings.exposureBase == Settings::EXPOSURE_MAP;
            return follows ? mapStops : 0.0;
        }
        bool adds() const { return still && still->adds(); }
        /** A still view's average asks the maps of its own lights. */
        bool asksSunMaps() const { return !still || still->frames() == 0; }
        bool shadesSuns() const { return view.plan.sunShadows && asksSunMaps(); }
        /** Nothing has changed since a view that has all its frames was drawn. */
        bool rests() const { return still && still->frames() > 0 && !still->adds(); }
    };

    // Where shadow maps stand in this frame: what a pass that asks them needs.
    struct ShadowPlaces {
        osg::StateSet* uniforms = nullptr;
        osg::Vec3d origin;
    };
    struct Sampler {
        const char* name;
        osg::Texture* texture;
    };
    // What a pass's state set is made from, and known by: it never changes, since a draw thread may be reading it.
    struct PassInputs {
        std::vector<std::string> defines;
        std::vector<Sampler> samplers;
        std::vector<osg::ref_ptr<osg::Uniform>> uniforms;  // whose values do not change
        osg::Viewport* viewport = nullptr;                 // the view's
        bool adds = false;                                 // to what is there
    };

    osg::ref_ptr<const Settings> currentSettings(const LitScene& node);
    osg::ref_ptr<MapTextures> currentTextures(const LitScene& node, const Settings& settings, osgUtil::CullVisitor& cv);
    void regenerate(const MapState& state, const Settings& settings, const std::shared_ptr<const LightList>& lights);
    void accept(const MapRegenerator::Result& result);
    ViewData& view(osgUtil::CullVisitor& cv, osgUtil::RenderStage& host);
    void reportOnce(const std::string& message, osg::NotifySeverity severity = osg::WARN);
    bool hasSettled(const Cull& c) const;
    template <class Condition>
    void release(osg::State* state, Condition drops) const;

    void fillGBuffer(Cull& c, LitScene& node, osgUtil::CullVisitor& cv, std::vector<ForwardGraph>& forward);
    static void handOverCameras(Cull& c);
    std::string chooseBackground(Cull& c, const std::vector<ForwardGraph>& forward) const;
    void findLights(Cull& c, const std::vector<ForwardGraph>& forward);
    static void awaitLights(Cull& c);
    static Target& lightTarget(Cull& c);
    void addSceneLights(Cull& c, osgUtil::CullVisitor& cv, Target& target);
    void addPasses(Cull& c, osgUtil::CullVisitor& cv);
    void addComposite(Cull& c, osgUtil::CullVisitor& cv);
    void addPass(Cull& c, osgUtil::CullVisitor& cv, const std::string& name, Target& target, osg::StateSet& state,
                 const ShadowPlaces& places = {nullptr, osg::Vec3d()});
    void addAtlas(Cull& c, osgUtil::CullVisitor& cv);
    unsigned refreshAtlas(Cull& c, osgUtil::CullVisitor& cv, const std::string& name, ViewData::Atlas& atlas,
                          const LightList& list, unsigned budget);
    ViewData::Atlas& skyAtlas(Cull& c);
    ViewData::Atlas* finerAtlas(Cull& c, const osg::Matrixd& projection);
    static void addMaps(PassInputs& inputs, ShadowAtlas& atlas, ShadowAtlas* finer);
    void addSeenPoints(Cull& c, osgUtil::CullVisitor& cv, Target& points);
    static ShadowPlaces placesOf(Cull& c, const std::string& name, const ShadowAtlas& atlas, const ShadowAtlas* finer);
    AtlasRefresh::States mapStates(Cull& c, const std::string& name, const std::string& shader, const ShadowTargets& targets);
    void addRefresh(Cull& c, osgUtil::CullVisitor& cv, const std::string& name, const std::string& shader, osg::Camera& camera,
                    const ShadowTargets& targets, const std::vector<ShadowRefresh>& refreshes, std::vector<Caster>&& casters);
    template <class Lights>
    static Lights inWorld(const Cull& c, Lights lights)
    {
        const osg::Matrixd worldFromMap = osg::Matrixd::inverse(c.mapFromWorld);
        for (auto& light : lights) {
            light.direction = light.direction * worldFromMap;
            light.direction.normalize();
        }
        return lights;
    }
    void addSunMaps(Cull& c, osgUtil::CullVisitor& cv);
    void addSunShadows(Cull& c, osgUtil::CullVisitor& cv, Target& seen, Target& visibility);
    static void addSunVisibility(Cull& c, PassInputs& inputs);
    Accumulation::Key stillKey(Cull& c, osgUtil::CullVisitor& cv);
    void advanceStillView(Cull& c, osgUtil::CullVisitor& cv);
    void addStillPicture(Cull& c, osgUtil::CullVisitor& cv);
    void addAccumulation(Cull& c, osgUtil::CullVisitor& cv);
    void addStillError(Cull& c, osgUtil::CullVisitor& cv, Target& average);
    void addBounce(Cull& c, osgUtil::CullVisitor& cv, Target& blocks, Target& sums);
    void addLobes(const Cull& c, PassInputs& inputs);
    PassInputs diffuseTerms(Cull& c);
    void addOcclusion(Cull& c, osgUtil::CullVisitor& cv, Target& sums, Target& filtered);
    void prepare(FullScreen& triangle, const osg::StateSet& state, const Cull& c) const;
    void setForwardState(Cull& c);

    static void bind(osg::StateSet& stateSet, unsigned unit, const Sampler& sampler);
    osg::StateSet& passState(Cull& c, const std::string& name, const PassInputs& inputs);
    PassInputs pictureInputs(Cull& c);
    PassInputs compositeInputs(Cull& c);
    osg::StateSet& gbufferState(Cull& c);
    osg::Texture* albedoTable();

    mutable std::mutex _mutex;
    osg::ref_ptr<ShaderLibrary> _library;
    osg::ref_ptr<SurfaceFacts> _facts;
    osg::ref_ptr<SurfaceSorter> _sorter;
    osg::ref_ptr<Failure> _failure;
    osg::ref_ptr<MapTextures> _textures;  // null before the first frame, and while the map can't serve
    MapState _state;                      // that was last asked for
    bool _started = false;
    unsigned _checkedFrame = ~0u;              // all views of a frame see the same light
    unsigned _stillFrames = 0;                 // since the map last changed
    osg::ref_ptr<const osg::Image> _repaired;  // whose repairs were reported
    MapRegenerator _regenerator;
    std::atomic<unsigned> _waitingMaps{0};  // of the last view's atlas
    std::atomic<unsigned> _drawnSunMaps{0};
    osg::ref_ptr<osg::Texture2D> _albedoTable;
    osg::ref_ptr<const Settings> _settings;  // the last valid ones
    osg::ref_ptr<RetiredObjects> _retired;
    mutable std::map<Key, osg::ref_ptr<ViewData>> _views;
    std::map<std::pair<const osg::Referenced*, const osg::Referenced*>, Visit> _visits;
    std::set<std::string> _reported;
    unsigned _updates = 0;
    osg::observer_ptr<ViewData> _lastView;
};

}  // namespace osgEnvLight
