/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/Accumulation.h"
#include "frame/AtlasLights.h"
#include "frame/FrameResources.h"
#include "frame/IndirectLight.h"
#include "frame/PassBuilder.h"
#include "frame/SceneFacts.h"
#include "gl/ShaderLibrary.h"
#include "lights/MapTextures.h"
#include "shadow/EmitterMaps.h"
#include "shadow/ShadowAtlas.h"
#include "shadow/SunShadows.h"
#include "surface/CasterMotion.h"
#include "surface/FogValues.h"
#include "surface/Ground.h"

#include <osgEnvLight/GBuffer>

#include <cmath>
#include <utility>

namespace osgUtil
{
class CullVisitor;
}

namespace osgEnvLight
{

struct ProbedPoints;
struct Caustics;

/** How the view saw the frame before. */
struct FormerFrame {
    osg::Matrixd worldFromEye, projection;
    osg::ref_ptr<const osg::Viewport> viewport;  // of FrameContext; null: there was none
};

/** One frame of one view, while it is culled: what the host gives, what the scene needs, and what passes have found for those
 * after them. */
struct FrameContext {
    osgUtil::CullVisitor& cv;
    osgUtil::RenderStage& host;
    FrameResources& frame;
    const Settings& settings;
    osg::ref_ptr<MapTextures> textures;
    GBuffer& gbuffer;
    ShaderLibrary& shaders;
    AtlasLights& atlasLights;
    osg::Viewport* viewport;  // of the view, from 0 on
    osg::Texture* albedoTable;
    ContextWatch::Listener* contextListener;
    FrameTimer* timer;  // null: times are not measured
    unsigned number;    // of the frame, in its view
    const CasterList& casters;

    osg::Matrixd mapFromWorld = {};
    osg::Matrixd worldFromEye = {};
    double radianceScale = 0.0;                // the map's mean radiance times its intensity
    double baseStops = 0.0;                    // the exposure that the picture has before the setting's stops
    DepthConvention depth = {};                // the host's
    const FormerFrame* former = nullptr;       // null: there was none of this size
    std::vector<MovedCaster> moved = {};       // where the picture is averaged over frames
    SceneLightList lights = {};                // of the application that are switched on
    std::vector<Emitter> areaLights = {};      // in the world
    int background = Settings::BACKGROUND_ON;  // never AUTO
    FogValues fog = {};                        // before what is lit
    std::string behind = {};                   // what is behind the scene, in words
    const Ground* ground = nullptr;            // of Settings::ground; null: there is none
    bool showsNothing = false;                 // of the scene there is: its shadow maps are kept for when it does

    SceneFacts facts = {};
    Decisions decisions = {};

    // Set in update(), by the passes that own them.
    ShadowAtlas* skyMaps = nullptr;      // of the map's lights; null: there is no atlas
    ShadowAtlas* nearSkyMaps = nullptr;  // of the same lights, about the view; null: skyMaps are fine enough
    const ProbedPoints* seen = nullptr;  // what the view shows, where that has been measured since the last frame
    unsigned waitingMaps = 0;            // to be drawn in later frames, or not known yet
    IndirectLight* indirect = nullptr;   // by probes; null: there are none
    const Caustics* caustics = nullptr;  // what polished metal reflects of suns and lamps; null: there is nothing of that kind
    bool adapts = false;                 // the exposure may still change, though nothing else does
    unsigned waitingBounces = 0;         // further frames would change what surfaces send each other
    EmitterMaps* emitterMaps = nullptr;  // of the area lights' points; null: nothing hides them
    osg::Texture2D* emitterPoints = nullptr;     // EmitterMaps::pointImage()
    osg::Texture2D* lightsWithPoints = nullptr;  // which area lights have points; null: all
    osg::Texture2D* lightTree = nullptr;         // of many area lights
    EmitterMaps* sceneLightMaps = nullptr;       // of the application's lights; null: nothing hides them
    osg::Texture2D* sceneLightPoints = nullptr;
    SunShadows* sunMaps = nullptr;            // null: suns have none
    unsigned drawnSunMaps = 0;                // in this frame
    const Accumulation* still = nullptr;      // null where none was asked for
    ShadowAtlas* stillMaps = nullptr;         // of the lights of a frame of its average
    ShadowAtlas* stillNearMaps = nullptr;     // of the same lights, about the view
    EmitterMaps* stillEmitterMaps = nullptr;  // of points of the area lights of its own
    osg::Texture2D* stillEmitterPoints = nullptr;
    osg::Vec2d subpixel = {};     // shift of the picture in clip space over w
    TextureId shownPicture = {};  // averaged over frames; invalid: none is
    TextureId shownPlaces = {};   // packPlace() of pass/history.glsl
    TextureId adaptedStops = {};  // that the exposure has beyond the map's; invalid: it does not follow the picture

    /** The picture may be shifted by a part of a pixel: what is drawn forward, a background of the host's and the application's
     * own G-buffer are not. */
    bool canShift() const { return facts.surfaces.forward == 0 && background != Settings::BACKGROUND_OFF && facts.ownGBuffer; }
    void shift(const osg::Vec2d& point)
    {
        subpixel = osg::Vec2d((2.0 * point[0] - 1.0) / width(), (2.0 * point[1] - 1.0) / height());
    }

    int width() const { return int(viewport->width()); }
    int height() const { return int(viewport->height()); }

    /** Radiance of an emission of 1 as typed: what emits is shown as typed whatever the map's exposure. */
    double emittedScale() const { return settings.materialColors == Settings::COLORS_SRGB ? std::exp2(-baseStops) : 1.0; }
    LampRule lampRule() const
    {
        return {settings.emissiveMeshes && facts.ownGBuffer, float(radianceScale / emittedScale()),
                settings.materialColors == Settings::COLORS_SRGB};
    }

    /** This frame adds to a still view's average. */
    bool isAccumulating() const { return still && still->adds(); }
    /** A still view's terms are drawn, and stay: this frame adds to the average, whose lights have maps of their own, or shows
     * it. */
    bool hasFirstFrame() const { return still && still->frames() > 0; }
    /** Of the points by which the area lights are seen in this frame. */
    EmitterMaps* shownEmitterMaps() const { return stillEmitterMaps ? stillEmitterMaps : emitterMaps; }
    osg::Texture2D* shownEmitterPoints() const { return stillEmitterMaps ? stillEmitterPoints : emitterPoints; }
    /** Nothing has changed since a view that has all its frames was drawn. */
    bool isConverged() const { return hasFirstFrame() && !still->adds(); }

    TimedDraw timed(const std::string& pass) const { return {timer, pass, number}; }
    /** Give a full-screen triangle what changes from frame to frame. */
    void prepare(FullScreen& triangle, const std::string& pass) const
    {
        triangle.mapFromWorld = mapFromWorld;
        triangle.subpixel = subpixel;
        triangle.depth = depth;
        triangle.timed = timed(pass);
    }

    /** Add to the plan's line of the pass that is being set up. */
    void remark(const std::string& text) { _remark += text; }
    std::string takeRemark() { return std::exchange(_remark, std::string()); }

    /** Lights of the map, turned into the world. */
    template <class Lights>
    Lights inWorld(Lights list) const
    {
        const osg::Matrixd worldFromMap = osg::Matrixd::inverse(mapFromWorld);
        for (auto& light : list) {
            light.direction = light.direction * worldFromMap;
            light.direction.normalize();
        }
        return list;
    }

    std::string _remark = {};
};

}  // namespace osgEnvLight
