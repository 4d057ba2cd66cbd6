/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/Accumulation.h"
#include "frame/FullScreen.h"
#include "frame/GBufferStage.h"
#include "frame/StageCamera.h"
#include "frame/StageDraw.h"
#include "gl/FirstUnit.h"
#include "gl/RetiredObjects.h"
#include "lights/MapTextures.h"
#include "shadow/AtlasRefresh.h"
#include "shadow/ShadowAtlas.h"
#include "shadow/SunShadows.h"
#include "surface/FogValues.h"
#include "surface/GBufferFill.h"
#include "surface/SceneLights.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace osgEnvLight
{

struct Caustics;

/** What one CullVisitor fills and one draw traversal reads: a SceneView is never culled while it is drawn, so it needs no
 * lock. The uniforms' values belong to it for the same reason.*/
class OSGENVLIGHT_EXPORT FrameResources : public osg::Referenced
{
  public:
    FrameResources();

    /** The values of this frame, for every pass and the forward surfaces. */
    void setUniforms(double sceneRadius, double radianceScale, const MapTextures& textures, const osg::Matrixd& mapFromEye,
                     double baseStops);
    /** Of the way to the exposure of what is shown. */
    void setAdaptedShare(double share) { _adaptedShare->set(float(share)); }
    /** Where a still view stands; null: none. */
    void setUniforms(const Accumulation* still);

    const osg::ref_ptr<osg::StateSet> uniforms;
    /** The vertices of all its triangles, in one buffer. */
    const osg::ref_ptr<osg::Vec3Array> triangle = fullScreenVertices();

    // Of the G-buffer:
    osg::ref_ptr<GBufferStage> gbufferStage;
    osg::ref_ptr<StageCamera> gbufferCamera;
    const std::shared_ptr<TimedDraw> gbufferTimes = std::make_shared<TimedDraw>();
    osg::ref_ptr<GBufferFill> fill;
    osg::ref_ptr<osg::StateSet> fillState;  // what fill was made from
    osg::ref_ptr<osg::Uniform> subpixel, materialColors, emittedStops;

    SceneLightUniforms sceneLights;  // set when the view has been culled
    osg::ref_ptr<osg::StateSet> forwardState;
    osg::ref_ptr<FullScreen> composite;
    const osg::ref_ptr<FirstUnit> firstUnit = new FirstUnit;
    const osg::ref_ptr<osg::StateSet> afterComposite = new osg::StateSet;

    /** The draw of that name, made when it is first asked for. */
    StageDraw& draw(const std::string& name, const std::function<osg::ref_ptr<osg::Drawable>()>& make);
    /** What draws the shadow maps of that name. */
    AtlasRefresh& refresh(const std::string& name);

    /** Uniforms of those of a group that shaders read, with the values of this frame. */
    osg::StateSet& settingsState(SettingsGroup group, const Settings& settings);
    /** Uniforms of an atlas and its lights as they stand in this frame.
     * @param name  of the atlas
     * @param near  the atlas of the same lights about the view, or null */
    osg::StateSet& atlasState(const std::string& name, const ShadowAtlas& atlas, const ShadowAtlas* near);
    /** Where the origin of places on surfaces lies about those of shadow maps, and the places before the eye. */
    struct Places {
        osg::Vec3d inAtlas, inEmitterMaps, inSceneLightMaps;
        osg::Matrixd inEye;
    };
    /** Uniforms of pass/receivedlight.glsl. */
    osg::StateSet& placeState(const std::string& pass, const Places& places);
    /** Uniforms of pass/points.frag: which rows are due, where the points' origin lies about that of the suns' maps. */
    osg::StateSet& pointState(int rows, int turn, const osg::Vec3d& inSunMaps);
    /** Uniforms of what reads the virtual lights, and of what they are made from. */
    osg::StateSet& causticState(const Caustics& caustics);
    /** Uniforms of pass/indirect.frag. */
    osg::StateSet& probeState(double share);
    /** Uniforms of pass/catchers.glsl. camera: of the map, in eye space, and the distance from where on the map is infinitely
     * far. */
    osg::StateSet& groundState(const osg::Vec4f& camera);
    /** Uniforms of pass/fog.glsl. radiance: of the fog, as what is typed is shown. */
    osg::StateSet& fogState(const FogValues& fog, const osg::Vec3f& radiance);
    /** Uniforms of pass/temporal.frag: where the frame before looked from. */
    osg::StateSet& historyState(const osg::Matrixd& formerEyeFromEye, const osg::Matrixd& formerProjection);
    /** Uniforms of the application's lights. */
    osg::StateSet& sceneLightState();
    /** Uniforms of the suns' maps as they stand in this frame. */
    osg::StateSet& sunState(const SunShadows& shadows);

    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;
    /** Hand over what a draw may still refer to. */
    void retire(RetiredObjects& retired) const;
    /** Forget what this frame did not use: it would keep maps that the view has replaced. */
    void forgetUnused(RetiredObjects& retired);
    unsigned lastCull = 0;  // of its view

  private:
    struct SettingsUniforms {
        osg::ref_ptr<osg::StateSet> state;
        std::vector<std::pair<SettingsProperty, osg::ref_ptr<osg::Uniform>>> uniforms;
    };

    std::vector<osg::Drawable*> drawables() const;

    std::map<std::string, osg::ref_ptr<StageDraw>> _draws;
    std::map<std::string, osg::ref_ptr<AtlasRefresh>> _refreshes;
    std::map<SettingsGroup, SettingsUniforms> _settings;
    std::map<std::string, osg::ref_ptr<osg::StateSet>> _atlasStates;
    std::map<std::string, osg::ref_ptr<osg::StateSet>> _placeStates;
    osg::ref_ptr<osg::StateSet> _pointState;
    osg::ref_ptr<osg::StateSet> _causticState;
    osg::ref_ptr<osg::StateSet> _probeState;
    osg::ref_ptr<osg::StateSet> _groundState;
    osg::ref_ptr<osg::StateSet> _fogState;
    osg::ref_ptr<osg::StateSet> _historyState;
    osg::ref_ptr<osg::StateSet> _sceneLightState;
    osg::ref_ptr<osg::StateSet> _sunState;
    osg::ref_ptr<const SunShadows> _sunShadows;  // that it is of, at which version
    unsigned _sunVersion = 0;
    bool _sunUsed = false;
    osg::ref_ptr<osg::Uniform> _sceneRadius;
    osg::ref_ptr<osg::Uniform> _radianceScale;
    osg::ref_ptr<osg::Uniform> _baseStops;
    osg::ref_ptr<osg::Uniform> _adaptedShare;
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

}  // namespace osgEnvLight
