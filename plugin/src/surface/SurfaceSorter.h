/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>
#include <osgEnvLight/Plan>

#include "surface/SurfaceFacts.h"
#include "surface/SurfaceState.h"

#include <osg/StateSet>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

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
        std::vector<ForwardGraph>& moved;  // receives what is drawn forward, for the caller to add after the composite
    };
    /** @param lit  asked for the state set to push above forward surfaces that the environment lights, only when there are
     *              any; it may return null*/
    using LitState = std::function<const osg::StateSet*()>;
    SurfaceKinds sort(const Places& places, const LitState& lit);

    /** Make a stage that a camera below the node has culled what it is without the node: its drawables' state without ours.*/
    static void release(osgUtil::RenderStage& stage, const osg::StateSet& ours);

    SurfaceFacts& facts() { return *_facts; }

  protected:
    ~SurfaceSorter() override = default;

  private:
    friend class SurfaceSort;
    enum Variant : unsigned {
        NO_TEXTURE = 1u << 0,
        LINEAR_TEXTURE = 1u << 1,
        TEXTURE_REPLACE = 1u << 2,
        TEXTURE_DECAL = 1u << 3,
        TEXTURE_BLEND = 1u << 4,
        TEXTURE_ADD = 1u << 5,
        ALPHA_TEXTURE = 1u << 6,
        TEXGEN_OBJECT = 1u << 7,
        TEXGEN_EYE = 1u << 8,
        TEXGEN_PROJECTED = 1u << 9,
        PAINTED_REFLECTION = 1u << 10,
        UNLIT = 1u << 11,
        VERTEX_COLOR = 1u << 12,
        FACE_NORMAL = 1u << 13,
        PHONG_MATERIAL = 1u << 14,
        TWO_SIDED = 1u << 15,
        ENVLIGHT_LAMBERT = 1u << 16,
        ENVLIGHT_PHONG = 1u << 17,
        ENVLIGHT_COOK_TORRANCE = 1u << 18,
        CLIP_PLANES = 1u << 19,
        NORMAL_MAP = 1u << 20,
        METAL_ROUGH_MAP = 1u << 21,
        EMISSION_MAP = 1u << 22,
        COAT_MAP = 1u << 23,
        COAT_ROUGHNESS_MAP = 1u << 24,
        COAT_NORMAL_MAP = 1u << 25,
        ENVLIGHT_EMISSION = 1u << 26,
        ENVLIGHT_STRAUSS = 1u << 27,
        ENVLIGHT_DIELECTRIC = 1u << 28,
        ENVLIGHT_COAT = 1u << 29,
        TEXTURE_STAGES = 1u << 30,
        WHITE = 1u << 31
    };
    struct Variation {
        unsigned bits = 0;
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
