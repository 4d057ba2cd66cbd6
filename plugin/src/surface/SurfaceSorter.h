/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include <osgEnvLight/Plan>

#include "surface/FogValues.h"
#include "surface/SurfaceFacts.h"
#include "surface/SurfaceState.h"

#include <osg/StateSet>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace osgEnvLight
{

/** A part of the state graph and the host's bin that draws it after the composite. */
struct ForwardGraph {
    osgUtil::RenderBin* bin;
    osgUtil::StateGraph* graph;
};

/** After cull, sorts the drawables of a G-buffer's bins by their effective state: those that a G-buffer can hold get the
 * variant of its program that reads their state; the others move to the host's bins, to be drawn forward after the
 * composite: lit where that is possible, else exactly as without the node, which is said once (NOTICE). No state set of the
 * user's is touched (osg.md 3). Thread-safe.*/
class OSGENVLIGHT_EXPORT SurfaceSorter : public osg::Referenced
{
  public:
    explicit SurfaceSorter(SurfaceFacts* facts = nullptr) : _facts(facts ? facts : new SurfaceFacts) {}

    /** Where drawables go. */
    struct Places {
        osgUtil::RenderBin& gbuffer;
        osgUtil::RenderBin* forward;       // the host's bin for what is drawn forward; null drops it
        osgUtil::StateGraph& top;          // of the G-buffer's own state set, as the children were culled under it
        const osg::RefMatrix* projection;  // that the G-buffer is drawn with
        LampRule lamps;
        std::vector<ForwardGraph>& moved;  // receives what is drawn forward, for the caller to add after the composite
    };
    /** @param lit  asked for the state set to push above forward surfaces that the environment lights, only when there are
     *              any; it may return null*/
    using LitState = std::function<const osg::StateSet*()>;
    struct Sorted {
        SurfaceKinds kinds;
        FogValues fog;  // of what is lit, the first met
    };
    Sorted sort(const Places& places, const LitState& lit);

    /** Make a stage that a camera below the node has culled what it is without the node: its drawables' state without ours.*/
    static void release(osgUtil::RenderStage& stage, const osg::StateSet& ours);

    SurfaceFacts& facts() { return *_facts; }

  protected:
    ~SurfaceSorter() override = default;

  private:
    friend class SurfaceSort;
    /** Defines of the surface's shader; maps in the order of MaterialMaps::samplers. */
    enum Variant : uint64_t {
        NO_TEXTURE = uint64_t(1) << 0,
        LINEAR_TEXTURE = uint64_t(1) << 1,
        TEXTURE_REPLACE = uint64_t(1) << 2,
        TEXTURE_DECAL = uint64_t(1) << 3,
        TEXTURE_BLEND = uint64_t(1) << 4,
        TEXTURE_ADD = uint64_t(1) << 5,
        ALPHA_TEXTURE = uint64_t(1) << 6,
        TEXGEN_OBJECT = uint64_t(1) << 7,
        TEXGEN_EYE = uint64_t(1) << 8,
        TEXGEN_PROJECTED = uint64_t(1) << 9,
        PAINTED_REFLECTION = uint64_t(1) << 10,
        UNLIT = uint64_t(1) << 11,
        VERTEX_COLOR = uint64_t(1) << 12,
        FACE_NORMAL = uint64_t(1) << 13,
        VERTEX_TANGENTS = uint64_t(1) << 14,
        PHONG_MATERIAL = uint64_t(1) << 15,
        TWO_SIDED = uint64_t(1) << 16,
        ENVLIGHT_LAMBERT = uint64_t(1) << 17,
        ENVLIGHT_PHONG = uint64_t(1) << 18,
        ENVLIGHT_COOK_TORRANCE = uint64_t(1) << 19,
        ENVLIGHT_STRAUSS = uint64_t(1) << 20,
        ENVLIGHT_EMISSION = uint64_t(1) << 21,
        ENVLIGHT_DIELECTRIC = uint64_t(1) << 22,
        ENVLIGHT_ANISOTROPY = uint64_t(1) << 23,
        ENVLIGHT_COAT = uint64_t(1) << 24,
        ENVLIGHT_EDGE = uint64_t(1) << 25,
        ENVLIGHT_ROUGH_DIFFUSE = uint64_t(1) << 26,
        ENVLIGHT_LIGHT = uint64_t(1) << 27,
        CLIP_PLANES = uint64_t(1) << 28,
        TEXTURE_STAGES = uint64_t(1) << 29,
        WHITE = uint64_t(1) << 30,
        NORMAL_MAP = uint64_t(1) << 31,
        METAL_ROUGH_MAP = uint64_t(1) << 32,
        EMISSION_MAP = uint64_t(1) << 33,
        ANISOTROPY_MAP = uint64_t(1) << 34,
        COAT_MAP = uint64_t(1) << 35,
        COAT_ROUGHNESS_MAP = uint64_t(1) << 36,
        COAT_NORMAL_MAP = uint64_t(1) << 37,
        ENVLIGHT_LAMP = uint64_t(1) << 38,
        FOGGED = uint64_t(1) << 39,
        ENVLIGHT_CATCHER = uint64_t(1) << 40
    };
    struct Variation {
        uint64_t bits = 0;
        SurfaceState::Stages stages;
        bool operator<(const Variation& other) const;
    };
    const osg::StateSet* variant(const Variation& variation);
    void say(const char* what, const char* how, const osg::Drawable* drawable);

    const osg::ref_ptr<SurfaceFacts> _facts;
    std::mutex _mutex;
    std::map<Variation, osg::ref_ptr<osg::StateSet>> _variants;
    std::set<std::string> _said;
};

}  // namespace osgEnvLight
