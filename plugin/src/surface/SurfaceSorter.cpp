// SPDX-License-Identifier: MIT
#include "surface/SurfaceSorter.h"

#include <osgEnvLight/Material>
#include "surface/MaterialMaps.h"
#include "surface/SurfaceState.h"

#include <osg/Geometry>
#include <osg/Notify>

#include <algorithm>
#include <iterator>
#include <tuple>
#include <unordered_map>

namespace osgEnvLight
{

namespace
{

bool lacksNormals(const osg::Geometry* geometry)
{
    return geometry && !geometry->getNormalArray();
}

// One for each vertex. osgAnimation moves vertices and normals, but no other attributes.
bool hasTangents(const osg::Geometry* geometry)
{
    if (!geometry || !geometry->getVertexArray() || std::string(geometry->libraryName()) == "osgAnimation") return false;
    const osg::Array* tangents = geometry->getVertexAttribArray(Material::tangentAttribute);
    return tangents && tangents->getType() == osg::Array::Vec4ArrayType &&
           tangents->getBinding() == osg::Array::BIND_PER_VERTEX &&
           tangents->getNumElements() == geometry->getVertexArray()->getNumElements();
}

const osg::Geometry* geometryOf(const osgUtil::RenderLeaf& leaf)
{
    return leaf._drawable ? leaf._drawable->asGeometry() : nullptr;
}

// Of osgSim, whose class no header shows. They are drawn by no osg::Geometry.
bool areLightPoints(const osg::Drawable& drawable)
{
    const std::string name = drawable.className();
    return name == "LightPointDrawable" || name == "LightPointSpriteDrawable";
}

// The state sets from below the ancestor down to the graph, rooted at another one.
osgUtil::StateGraph* transplanted(const osgUtil::StateGraph* graph, const osgUtil::StateGraph* ancestor,
                                  osgUtil::StateGraph* root)
{
    std::vector<const osg::StateSet*> path;
    for (const osgUtil::StateGraph* s = graph; s != ancestor; s = s->_parent) path.push_back(s->getStateSet());
    for (auto s = path.rbegin(); s != path.rend(); ++s) root = root->find_or_insert(*s);
    return root;
}

void releaseBin(osgUtil::RenderBin& bin, const osg::StateSet& ours)
{
    osgUtil::RenderBin::StateGraphList released;
    for (osgUtil::StateGraph* graph : bin.getStateGraphList()) {
        osgUtil::StateGraph* own = graph;
        while (own && own->getStateSet() != &ours) own = own->_parent;
        osgUtil::StateGraph* target = own && own->_parent ? transplanted(graph, own, own->_parent) : graph;
        released.push_back(target);
        if (target == graph) continue;
        for (auto& leaf : graph->_leaves) target->addLeaf(leaf.get());
        graph->_leaves.clear();
    }
    bin.getStateGraphList().swap(released);
    for (auto& [number, child] : bin.getRenderBinList()) releaseBin(*child, ours);
}

// What pass/texturestages.glsl reads.
void addStages(const SurfaceState::Stages& stages, osg::StateSet& stateSet)
{
    osg::ref_ptr<osg::Uniform> kinds = new osg::Uniform(osg::Uniform::INT, "textureStages", int(stages.size()));
    osg::ref_ptr<osg::Uniform> scales = new osg::Uniform(osg::Uniform::FLOAT, "textureScales", int(stages.size()));
    osg::ref_ptr<osg::Uniform> coordinates = new osg::Uniform(osg::Uniform::INT, "stageCoordinateKinds", int(stages.size()));
    osg::ref_ptr<osg::Uniform> samplers = new osg::Uniform(osg::Uniform::SAMPLER_2D, "stageMaps", int(stages.size()));
    osg::ref_ptr<osg::Uniform> units = new osg::Uniform(osg::Uniform::INT, "stageUnits", int(stages.size()));
    for (unsigned i = 0; i < stages.size(); ++i) {
        const bool used = stages[i].kind != limits::STAGE_NONE;
        kinds->setElement(i, stages[i].kind);
        scales->setElement(i, stages[i].scale);
        coordinates->setElement(i, stages[i].coordinates);
        units->setElement(i, used ? stages[i].unit : int(i));
        samplers->setElement(i, used ? stages[i].unit : int(i));
    }
    for (osg::Uniform* u : {kinds.get(), scales.get(), coordinates.get(), units.get(), samplers.get()}) stateSet.addUniform(u);
}

}  // namespace

// One sort: the states met so far, and where things go.
class SurfaceSort
{
  public:
    SurfaceSort(SurfaceSorter& sorter, const SurfaceSorter::Places& places, const SurfaceSorter::LitState& lit)
        : _sorter(sorter), _places(places), _top(places.top), _lit(lit)
    {
    }

    void sortBin(osgUtil::RenderBin& from, osgUtil::RenderBin* to, bool isSorted)
    {
        osgUtil::RenderBin::StateGraphList& list = from.getStateGraphList();
        osgUtil::RenderBin::StateGraphList kept;
        for (osgUtil::StateGraph* sg : list) {
            const SurfaceState& state = effective(sg);
            const bool blends = isSorted && state.blending();
            const SurfaceSorter::Variation variation = variationOf(state);
            for (auto& leaf : sg->_leaves) place(*leaf, sg, state, variation, blends, kept, to);
            sg->_leaves.clear();
        }
        list.swap(kept);
        for (auto& [number, bin] : from.getRenderBinList()) {
            const bool backToFront = bin->getSortMode() == osgUtil::RenderBin::SORT_BACK_TO_FRONT;
            osgUtil::RenderBin* target = to ? to->find_or_insert(number, backToFront ? "DepthSortedBin" : "RenderBin") : nullptr;
            sortBin(*bin, target, isSorted || backToFront);
        }
    }

    SurfaceSorter::Sorted sorted;

  private:
    const SurfaceState& effective(osgUtil::StateGraph* sg)
    {
        auto found = _states.find(sg);
        if (found != _states.end()) return found->second;
        SurfaceState state(&_sorter.facts());
        if (sg->_parent) state = effective(sg->_parent);
        if (sg == &_top)
            state.enterNode();  // what our own state set says does not count
        else if (sg->getStateSet())
            state.merge(*sg->getStateSet());
        return _states.emplace(sg, state).first->second;
    }

    static uint64_t textureBits(const SurfaceState& state)
    {
        using S = SurfaceSorter;
        if (!state.texture()) return S::NO_TEXTURE;
        static const uint64_t modes[] = {0, S::TEXTURE_REPLACE, S::TEXTURE_DECAL, S::TEXTURE_BLEND, S::TEXTURE_ADD};
        static const uint64_t coordinates[] = {0, S::TEXGEN_OBJECT, S::TEXGEN_EYE};
        uint64_t bits = modes[state.textureMode()] | coordinates[state.coordinates()];
        if (state.coordinates() != SurfaceState::FROM_VERTICES && state.projected()) bits |= S::TEXGEN_PROJECTED;
        const TextureFacts facts = state.textureFacts();
        if (facts.linear) bits |= S::LINEAR_TEXTURE;
        if (facts.alphaOnly) bits |= S::ALPHA_TEXTURE;
        return bits;
    }

    // The parameters that a BRDF of ours has; its uniform says which of those it is.
    static uint64_t ownBits(int brdf)
    {
        switch (brdf) {
            case Material::PHONG:
            case Material::BLINN_PHONG:
                return SurfaceSorter::ENVLIGHT_PHONG;
            case Material::COOK_TORRANCE:
            case Material::BECKMANN:
                return SurfaceSorter::ENVLIGHT_COOK_TORRANCE;
            case Material::STRAUSS:
                return SurfaceSorter::ENVLIGHT_STRAUSS;
            default:
                return SurfaceSorter::ENVLIGHT_LAMBERT;
        }
    }

    // The bits of the lobes of a surface, and of its diffuse layer.
    static unsigned kindBits(const SurfaceState& state)
    {
        return lobeBits(state) | (state.roughDiffuse() ? SurfaceKinds::ROUGH_DIFFUSE : 0u);
    }

    // None if it has none.
    static unsigned lobeBits(const SurfaceState& state)
    {
        if (state.shadowCatcher()) return 0u;
        if (state.litProgram()) return 1u << Material::COOK_TORRANCE;
        if (state.coated()) return 1u << Material::COOK_TORRANCE | SurfaceKinds::COATS;
        if (state.anisotropic()) return 1u << Material::COOK_TORRANCE | SurfaceKinds::ANISOTROPY;
        if (state.edged()) return 1u << state.brdf() | SurfaceKinds::EDGES;
        if (state.brdf() >= 0) return state.brdf() == Material::LAMBERT ? 0u : 1u << state.brdf();
        if (state.paintedReflection()) return 1u << Material::COOK_TORRANCE;
        return state.phongMaterial() ? 1u << Material::BLINN_PHONG : 0u;
    }

    SurfaceSorter::Variation variationOf(const SurfaceState& state) const
    {
        using S = SurfaceSorter;
        if (state.shadowCatcher())
            return {S::ENVLIGHT_CATCHER | S::NO_TEXTURE | (state.clipped() ? uint64_t(S::CLIP_PLANES) : 0u), {}};
        uint64_t bits = textureBits(state);
        if (state.paintedReflection()) bits |= S::PAINTED_REFLECTION;
        if (state.paintedHighlight()) bits |= S::TEXTURE_ADD;
        if (state.unlit()) bits |= S::UNLIT;
        if (state.white()) bits |= S::WHITE;
        if (state.vertexColored()) bits |= S::VERTEX_COLOR;
        if (state.phongMaterial()) bits |= S::PHONG_MATERIAL;
        if (state.twoSided()) bits |= S::TWO_SIDED;
        if (state.clipped()) bits |= S::CLIP_PLANES;
        if (state.brdf() >= 0) bits |= ownBits(state.brdf());
        for (unsigned map = 0; map < std::size(MaterialMaps::samplers); ++map)
            if (state.mapped(map)) bits |= uint64_t(S::NORMAL_MAP) << map;
        if (state.dielectric()) bits |= S::ENVLIGHT_DIELECTRIC;
        if (state.anisotropic()) bits |= S::ENVLIGHT_ANISOTROPY;
        if (state.edged()) bits |= S::ENVLIGHT_EDGE;
        if (state.roughDiffuse()) bits |= S::ENVLIGHT_ROUGH_DIFFUSE;
        if (state.coated()) bits |= S::ENVLIGHT_COAT;
        if (state.isAreaLight()) bits |= S::ENVLIGHT_LIGHT;
        if (state.lampEmission(_places.lamps) != osg::Vec3f()) bits |= S::ENVLIGHT_LAMP;
        if (state.brdf() >= 0 && state.emits()) bits |= S::ENVLIGHT_EMISSION;
        if (state.fog()) bits |= S::FOGGED;
        return {bits, {}};
    }

    static void addStages(SurfaceSorter::Variation& variation, const SurfaceState& state, const osg::Geometry* geometry)
    {
        variation.stages = state.stages(geometry);
        for (const TextureStage& stage : variation.stages)
            if (stage.kind != limits::STAGE_NONE) variation.bits |= SurfaceSorter::TEXTURE_STAGES;
    }

    void place(osgUtil::RenderLeaf& leaf, osgUtil::StateGraph* sg, const SurfaceState& state, SurfaceSorter::Variation variation,
               bool blends, osgUtil::RenderBin::StateGraphList& kept, osgUtil::RenderBin* to)
    {
        const osg::Geometry* geometry = geometryOf(leaf);
        if (lacksNormals(geometry))
            variation.bits |= SurfaceSorter::FACE_NORMAL;
        else if (variation.bits & takesTangents && hasTangents(geometry))
            variation.bits |= SurfaceSorter::VERTEX_TANGENTS;
        addStages(variation, state, geometry);
        if (state.leavesMapsOut(geometry))
            _sorter.say("textures after the first without texture coordinates, neither normal map nor mask", "left out",
                        leaf._drawable);
        const bool foreign = leaf._projection.get() != _places.projection;
        const bool points = !geometry && areLightPoints(*leaf._drawable);
        if (!foreign && !blends && !points && !state.drawnForward(geometry)) return keep(leaf, sg, state, variation, kept);
        const char* unsupported = foreign ? nullptr : points ? "points and lines" : state.unsupported(geometry);
        const bool lit = !foreign && !unsupported && state.litForward();
        if (lit) {
            sorted.kinds.forwardLobes |= kindBits(state);
            addFog(state, leaf);
        }
        moveForward(leaf, sg, variation, lit, to);
        if (unsupported) _sorter.say(unsupported, "drawn as without the node, not lit by the environment", leaf._drawable);
    }

    // One level down, under the variant that reads its state.
    void keep(osgUtil::RenderLeaf& leaf, osgUtil::StateGraph* sg, const SurfaceState& state,
              const SurfaceSorter::Variation& variation, osgUtil::RenderBin::StateGraphList& kept)
    {
        sorted.kinds.lobes |= kindBits(state);
        ++sorted.kinds.deferred;
        if (variation.bits & SurfaceSorter::UNLIT) ++sorted.kinds.unlit;
        if (variation.bits & SurfaceSorter::ENVLIGHT_CATCHER) ++sorted.kinds.catchers;
        if (variation.bits & SurfaceSorter::ENVLIGHT_LAMP) ++sorted.kinds.lamps;
        addFog(state, leaf);
        osgUtil::StateGraph* n = sg->find_or_insert(_sorter.variant(variation));
        if (n->leaves_empty()) kept.push_back(n);
        n->addLeaf(&leaf);
    }

    // All that is lit has one.
    void addFog(const SurfaceState& state, const osgUtil::RenderLeaf& leaf)
    {
        if (!state.fog()) return;
        const FogValues fog(*state.fog());
        if (sorted.fog.kind == 0) sorted.fog = fog;
        if (!(sorted.fog == fog)) _sorter.say("a second fog", "the first one met is drawn in its place", leaf._drawable);
        if (state.fog()->getFogCoordinateSource() == GL_FOG_COORDINATE)
            _sorter.say("fog coordinates", "the distance from the eye is taken", leaf._drawable);
    }

    // The same path, rooted beside our state set instead of below it, and below the forward one where that lights it.
    void moveForward(osgUtil::RenderLeaf& leaf, osgUtil::StateGraph* sg, const SurfaceSorter::Variation& variation, bool isLit,
                     osgUtil::RenderBin* to)
    {
        ++sorted.kinds.forward;
        if (!to) return;
        const osg::StateSet* lit = isLit ? _lit() : nullptr;
        if (lit) ++sorted.kinds.litForward;
        osgUtil::StateGraph* n = transplanted(sg, &_top, lit ? _top._parent->find_or_insert(lit) : _top._parent);
        if (lit) n = n->find_or_insert(_sorter.variant(variation));
        if (n->leaves_empty()) _places.moved.push_back({to, n});
        n->addLeaf(&leaf);
    }

    static constexpr uint64_t takesTangents =
        SurfaceSorter::NORMAL_MAP | SurfaceSorter::COAT_NORMAL_MAP | SurfaceSorter::ENVLIGHT_ANISOTROPY;

    SurfaceSorter& _sorter;
    const SurfaceSorter::Places& _places;
    osgUtil::StateGraph& _top;
    const SurfaceSorter::LitState& _lit;
    std::unordered_map<const osgUtil::StateGraph*, SurfaceState> _states;
};

bool SurfaceSorter::Variation::operator<(const Variation& other) const
{
    if (bits != other.bits) return bits < other.bits;
    return std::lexicographical_compare(
        stages.begin(), stages.end(), other.stages.begin(), other.stages.end(), [](const TextureStage& a, const TextureStage& b) {
            return std::tie(a.kind, a.scale, a.coordinates, a.unit) < std::tie(b.kind, b.scale, b.coordinates, b.unit);
        });
}

const osg::StateSet* SurfaceSorter::variant(const Variation& variation)
{
    static const char* const defines[] = {"NO_TEXTURE",
                                          "LINEAR_TEXTURE",
                                          "TEXTURE_REPLACE",
                                          "TEXTURE_DECAL",
                                          "TEXTURE_BLEND",
                                          "TEXTURE_ADD",
                                          "ALPHA_TEXTURE",
                                          "TEXGEN_OBJECT",
                                          "TEXGEN_EYE",
                                          "TEXGEN_PROJECTED",
                                          "PAINTED_REFLECTION",
                                          "UNLIT",
                                          "VERTEX_COLOR",
                                          "FACE_NORMAL",
                                          "VERTEX_TANGENTS",
                                          "PHONG_MATERIAL",
                                          "TWO_SIDED",
                                          "ENVLIGHT_LAMBERT",
                                          "ENVLIGHT_PHONG",
                                          "ENVLIGHT_COOK_TORRANCE",
                                          "ENVLIGHT_STRAUSS",
                                          "ENVLIGHT_EMISSION",
                                          "ENVLIGHT_DIELECTRIC",
                                          "ENVLIGHT_ANISOTROPY",
                                          "ENVLIGHT_COAT",
                                          "ENVLIGHT_EDGE",
                                          "ENVLIGHT_ROUGH_DIFFUSE",
                                          "ENVLIGHT_LIGHT",
                                          "CLIP_PLANES",
                                          "TEXTURE_STAGES",
                                          "WHITE",
                                          "NORMAL_MAP",
                                          "METAL_ROUGH_MAP",
                                          "EMISSION_MAP",
                                          "ANISOTROPY_MAP",
                                          "COAT_MAP",
                                          "COAT_ROUGHNESS_MAP",
                                          "COAT_NORMAL_MAP",
                                          "ENVLIGHT_LAMP",
                                          "FOGGED",
                                          "ENVLIGHT_CATCHER"};
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<osg::StateSet>& stateSet = _variants[variation];
    if (!stateSet) {
        stateSet = new osg::StateSet;
        for (unsigned i = 0; i < std::size(defines); ++i)
            if (variation.bits >> i & 1) stateSet->setDefine(defines[i]);
        if (variation.bits & TEXTURE_STAGES) addStages(variation.stages, *stateSet);
    }
    return stateSet.get();
}

void SurfaceSorter::say(const char* what, const char* how, const osg::Drawable* drawable)
{
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (!_said.insert(what).second) return;
    }
    std::string first;
    if (drawable && drawable->getNumParents() > 0 && drawable->getName().empty()) first = drawable->getParent(0)->getName();
    if (drawable && first.empty()) first = drawable->getName();
    OSG_NOTICE << "osgEnvLight: " << what << ": " << how << (first.empty() ? "" : " (first '" + first + "')") << std::endl;
}

SurfaceSorter::Sorted SurfaceSorter::sort(const Places& places, const LitState& lit)
{
    SurfaceSort sort(*this, places, lit);
    sort.sortBin(places.gbuffer, places.forward, false);
    return sort.sorted;
}

void SurfaceSorter::release(osgUtil::RenderStage& stage, const osg::StateSet& ours)
{
    releaseBin(stage, ours);
    for (auto& [order, before] : stage.getPreRenderList()) release(*before, ours);
    for (auto& [order, after] : stage.getPostRenderList()) release(*after, ours);
}

}  // namespace osgEnvLight
