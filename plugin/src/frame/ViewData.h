/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/GBuffer>
#include "frame/Accumulation.h"
#include "shadow/AtlasRefresh.h"
#include "gl/BindTargets.h"
#include "gl/TargetTexture.h"
#include "surface/GBufferFill.h"
#include "lights/MapTextures.h"
#include "shadow/NearCascade.h"
#include "frame/GBufferStage.h"
#include "frame/Pass.h"
#include "frame/FramePlan.h"
#include "gl/RetiredObjects.h"
#include "shadow/ShadowAtlas.h"
#include "shadow/SunShadows.h"

#include <osg/observer_ptr>
#include <osg/Viewport>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace osgEnvLight
{

/** A camera of ours, off the graph; a LitScene met under it is inside another one. */
class StageCamera : public osg::Camera
{
  public:
    StageCamera() = default;
    /** One that is made as a copy does not read the environment's variables, nor print that it does. */
    explicit StageCamera(const StageCamera& plain) : osg::Camera(plain) {}
};

/** Textures that one pass draws into, and the camera whose callbacks bind them. */
struct Target : public osg::Referenced {
    Target(int width, int height, const std::vector<GLint>& formats, const StageCamera& plain, Failure* failure);
    size_t bytes() const;

    std::vector<osg::ref_ptr<osg::Texture2D>> textures;
    osg::ref_ptr<osg::FrameBufferObject> frameBuffer;
    osg::ref_ptr<osg::Camera> camera;
    osg::ref_ptr<osg::Viewport> viewport;
};

/** What one CullVisitor fills and one draw traversal reads: a SceneView is never culled while it is drawn, so it needs no
 * lock. The uniforms' values belong to it for the same reason.*/
class Frame : public osg::Referenced
{
  public:
    Frame();

    /** The values of this frame, for every pass and the forward surfaces: all of Settings by name, and what follows. */
    void setUniforms(const Settings& settings, double sceneRadius, double radianceScale, const MapTextures& textures,
                     const osg::Matrixd& mapFromEye, double baseStops);
    /** Where a still view stands; null: none. */
    void setUniforms(const Accumulation* still);

    osg::ref_ptr<GBufferStage> gbufferStage;
    SceneLightUniforms sceneLights;  // set when the view has been culled
    osg::ref_ptr<StageCamera> gbufferCamera;
    bool gbufferTimed = false;
    osg::ref_ptr<GBufferFill> fill;
    osg::ref_ptr<osg::StateSet> fillState;  // what fill was made from
    osg::ref_ptr<osg::StateSet> uniforms;
    osg::ref_ptr<osg::StateSet> forwardState;
    /** The vertices of all its triangles, in one buffer. */
    const osg::ref_ptr<osg::Vec3Array> triangle = fullScreenVertices();
    osg::ref_ptr<FullScreen> composite;
    std::map<std::string, osg::ref_ptr<Pass>> passes;
    /** By pass: those of the sky, of the suns, and those of a still view's frame. */
    std::map<std::string, osg::ref_ptr<AtlasRefresh>> atlasRefreshes;
    osg::ref_ptr<osg::Uniform> subpixel, materialColors, emittedStops;  // of the G-buffer

    static constexpr unsigned atlasLightUnit = 15;  // behind all others
    /** The uniforms with the lights of an atlas as they stand in this frame, bound to atlasLightUnit.
     * @param name   of the atlas, as in ViewData
     * @param finer  of the neighbourhood, or null */
    osg::StateSet& atlasState(const std::string& name, const ShadowAtlas& atlas, const ShadowAtlas* finer, double scale);
    /** The uniforms with those of the application's lights. */
    osg::StateSet& sceneLightState();
    /** The uniforms with those of the suns' maps as they stand in this frame. */
    osg::StateSet& sunState(const SunShadows& shadows);

    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;
    size_t bytes() const;
    /** Hand over what a draw may still refer to. */
    void retire(RetiredObjects& retired) const;
    /** Forget what this frame did not use: it would keep maps that the view has replaced. */
    void forgetUnused(RetiredObjects& retired);
    unsigned lastCull = 0;  // of its view

  private:
    std::vector<osg::Drawable*> drawables() const;

    struct AtlasState {
        osg::ref_ptr<osg::StateSet> uniforms;
        osg::ref_ptr<const ShadowAtlas> atlas, finer;  // that they are of, at which versions and scale
        unsigned version = 0, finerVersion = 0;
        double scale = 0.0;
        bool used = false;  // in this frame
    };
    std::map<std::string, AtlasState> _atlasStates;
    osg::ref_ptr<osg::StateSet> _sceneLightState;
    osg::ref_ptr<osg::StateSet> _sunState;
    osg::ref_ptr<const SunShadows> _sunShadows;  // that it is of, at which version
    unsigned _sunVersion = 0;
    bool _sunUsed = false;
    std::vector<osg::ref_ptr<osg::Uniform>> _settings;  // in the table's order
    osg::ref_ptr<osg::Uniform> _sceneRadius;
    osg::ref_ptr<osg::Uniform> _radianceScale;
    osg::ref_ptr<osg::Uniform> _baseStops;
    osg::ref_ptr<osg::Uniform> _emittedStops;
    osg::ref_ptr<osg::Uniform> _pyramidSide;
    osg::ref_ptr<osg::Uniform> _pyramidLastLevel;
    osg::ref_ptr<osg::Uniform> _mapFromEye;
    osg::ref_ptr<osg::Uniform> _sampleShift;
    osg::ref_ptr<osg::Uniform> _sampleFrames;
    osg::ref_ptr<osg::Uniform> _frameWeight;
    osg::ref_ptr<osg::Uniform> _accumulatedWeight;
    osg::ref_ptr<osg::Uniform> _accumulatedShare;
    osg::ref_ptr<osg::Uniform> _accumulatedFrames;
};

/** All that one view owns. Its parts are made when a plan first asks for them and never changed afterwards: another size
 * or another map makes new ones, and a draw thread finishes with the old, which its stages hold.*/
class ViewData : public osg::Referenced
{
  public:
    ViewData(Failure* failure, RetiredObjects* retired) : _failure(failure), _retired(retired) {}

    /** Without callbacks: what the others are copied from. */
    const StageCamera& plainCamera() const { return *_plainCamera; }

    /** Forget the targets if the size differs. */
    void fit(int width, int height, MapTextures* textures);
    /** Forget the state sets: the programs are to be made again. */
    void forgetPrograms() { _states.clear(); }
    /** At the end of a cull: forget what it did not use. */
    void forgetUnused(Frame& current);

    int width() const { return _width; }
    int height() const { return _height; }
    osg::Viewport* viewport() { return _viewport.get(); }
    MapTextures& textures() { return *_textures; }

    GBuffer& gbuffer();
    /** Targets by pass, one texture a format; with no formats, the one there is. Freed when the pass no longer runs.
     * @param side  of a square one; 0: as large as the view*/
    Target& target(const std::string& pass, const std::vector<GLint>& formats, int side = 0);
    void dropTarget(const std::string& pass);

    /** A ShadowAtlas and the camera whose callbacks bind it. */
    struct Atlas {
        osg::ref_ptr<ShadowAtlas> maps;
        osg::ref_ptr<osg::Camera> camera;
    };
    /** By pass, made anew where the counts differ: the sky's, and that of a still view's frame. */
    Atlas& atlas(const std::string& pass, unsigned lights, unsigned size);
    void dropAtlas(const std::string& pass);

    /** What of a large scene the view shows, and how that is found out. */
    struct Surroundings {
        NearCascade neighbourhood;
        osg::ref_ptr<DepthProbe> seen;
        osg::Matrixd worldFromEye, projection;  // that were last measured
        unsigned frames = 0;                    // since, up to known
        /** The second frame publishes what the first has measured; the third's cull knows it or, where the draw runs behind, the
         * fourth's. */
        static constexpr unsigned known = 4;
    };
    Surroundings surroundings;

    /** Made when first asked for. */
    Accumulation& accumulation();
    const Accumulation* still() const { return _accumulation.get(); }
    void dropAccumulation() { _accumulation = nullptr; }

    /** Made anew where the counts differ; levels once there stay. */
    SunShadows& sunShadows(unsigned suns, unsigned levels, unsigned size);
    SunShadows* sunShadows() { return _sunShadows.get(); }
    /** Its callbacks bind their maps. */
    osg::Camera& sunCamera() { return *_sunCamera; }
    void dropSunShadows();

    /** What a state set is made from. It holds the objects, so that none of them can be another one at the same address. */
    struct StateKey {
        std::string name;
        std::vector<std::string> defines = {};
        std::vector<const osg::Referenced*> objects = {};
        bool operator<(const StateKey& o) const
        {
            return std::tie(name, defines, objects) < std::tie(o.name, o.defines, o.objects);
        }
    };
    /** The state set of that key, empty when new: then fill it, and never change it. */
    struct State {
        osg::StateSet& stateSet;
        bool isNew;
    };
    State state(const StateKey& key);

    GpuTimer& timer(const std::string& pass);
    const std::map<std::string, osg::ref_ptr<GpuTimer>>& timers() const { return _timers; }

    /** The frame of a CullVisitor. */
    Frame& frame(const osg::Referenced* cullVisitor);

    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;
    /** Bytes of its targets. */
    size_t bytes() const;

    osg::observer_ptr<osg::Referenced> identifier;
    osg::observer_ptr<osg::Referenced> camera;
    bool hasCamera = false;
    osg::observer_ptr<osg::State> context;  // that it is drawn in
    bool hasContext = false;
    unsigned contextID = 0;
    FramePlan plan;
    bool unsettled = false;    // further frames would change the picture by themselves
    unsigned seenUpdates = 0;  // of the node, at the last cull
    CasterCollector::StateSets casterStates;
    SceneLightList lateLights;  // of LightSources behind the node in the graph

  protected:
    ~ViewData() override;

  private:
    void retireAll() const;
    void retire(const Target& target) const;
    void retire(const ShadowTargets& targets) const;

    const osg::ref_ptr<Failure> _failure;
    const osg::ref_ptr<StageCamera> _plainCamera = new StageCamera;
    const osg::ref_ptr<RetiredObjects> _retired;
    int _width = 0;
    int _height = 0;
    osg::ref_ptr<osg::Viewport> _viewport;
    osg::ref_ptr<MapTextures> _textures;
    osg::ref_ptr<GBuffer> _gbuffer;
    std::map<std::string, Atlas> _atlases;
    osg::ref_ptr<Accumulation> _accumulation;
    osg::ref_ptr<SunShadows> _sunShadows;
    osg::ref_ptr<osg::Camera> _sunCamera;
    std::map<std::string, osg::ref_ptr<Target>> _targets;
    struct KeptState {
        osg::ref_ptr<osg::StateSet> stateSet;
        unsigned lastCull = 0;
    };
    std::map<StateKey, KeptState> _states;
    std::map<std::string, osg::ref_ptr<GpuTimer>> _timers;
    std::map<const osg::Referenced*, osg::ref_ptr<Frame>> _frames;
    unsigned _cull = 0;
};

}  // namespace osgEnvLight
