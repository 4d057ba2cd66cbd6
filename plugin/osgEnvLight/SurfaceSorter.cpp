// SPDX-License-Identifier: MIT
#include <osgEnvLight/SurfaceSorter>

#include <osgEnvLight/Material>
#include <osgEnvLight/SurfaceState>

#include <osg/Geometry>

#include <iterator>
#include <unordered_map>

namespace osgEnvLight
{

namespace
{

bool lacksNormals(const osgUtil::RenderLeaf& leaf)
{
    const osg::Geometry* geometry = leaf._drawable ? leaf._drawable->asGeometry() : nullptr;
    return geometry && !geometry->getNormalArray();
}

}  // namespace

// One sort: the states met so far, and where things go.
class SurfaceSort
{
  public:
    SurfaceSort(SurfaceSorter& sorter, osgUtil::StateGraph& top, const SurfaceSorter::LitState& lit,
                std::vector<ForwardGraph>& moved)
        : _sorter(sorter), _top(top), _lit(lit), _moved(moved)
    {
    }

    void sortBin(osgUtil::RenderBin& from, osgUtil::RenderBin* to, bool allForward)
    {
        osgUtil::RenderBin::StateGraphList& list = from.getStateGraphList();
        osgUtil::RenderBin::StateGraphList kept;
        for (osgUtil::StateGraph* sg : list) {
            const SurfaceState& state = effective(sg);
            if (allForward || state.drawnForward())
                moveForward(sg, state, to);
            else
                keep(sg, state, kept);
        }
        list.swap(kept);
        for (auto& [number, bin] : from.getRenderBinList()) {
            const bool sorted = bin->getSortMode() == osgUtil::RenderBin::SORT_BACK_TO_FRONT;
            osgUtil::RenderBin* target = to ? to->find_or_insert(number, sorted ? "DepthSortedBin" : "RenderBin") : nullptr;
            sortBin(*bin, target, allForward || sorted);
        }
    }

    SurfaceKinds kinds;

  private:
    const SurfaceState& effective(osgUtil::StateGraph* sg)
    {
        auto found = _states.find(sg);
        if (found != _states.end()) return found->second;
        SurfaceState state;
        if (sg->_parent) state = effective(sg->_parent);
        if (sg == &_top)
            state.forgetProgram();  // a program above us does not matter, and neither does our blending off
        else if (sg->getStateSet())
            state.merge(*sg->getStateSet());
        return _states.emplace(sg, state).first->second;
    }

    unsigned variantBits(const SurfaceState& state) const
    {
        unsigned bits = 0;
        if (!state.texture()) bits |= SurfaceSorter::NO_TEXTURE;
        if (state.linearTexture()) bits |= SurfaceSorter::LINEAR_TEXTURE;
        if (state.replacedByTexture()) bits |= SurfaceSorter::TEXTURE_REPLACE;
        if (state.unlit()) bits |= SurfaceSorter::UNLIT;
        if (state.vertexColored()) bits |= SurfaceSorter::VERTEX_COLOR;
        if (state.phongMaterial()) bits |= SurfaceSorter::PHONG_MATERIAL;
        if (state.brdf() >= 0) bits |= unsigned(SurfaceSorter::ENVLIGHT_LAMBERT) << state.brdf();
        return bits;
    }

    // Each leaf one level down, under the variant that reads its state.
    void keep(osgUtil::StateGraph* sg, const SurfaceState& state, osgUtil::RenderBin::StateGraphList& kept)
    {
        const unsigned bits = variantBits(state);
        if ((bits & SurfaceSorter::PHONG_MATERIAL) || state.brdf() == Material::PHONG) kinds.phong = true;
        if (state.brdf() == Material::COOK_TORRANCE) kinds.cookTorrance = true;
        kinds.deferred += unsigned(sg->_leaves.size());
        for (auto& leaf : sg->_leaves) {
            const unsigned faceNormal = lacksNormals(*leaf) ? unsigned(SurfaceSorter::FACE_NORMAL) : 0u;
            osgUtil::StateGraph* n = sg->find_or_insert(_sorter.variant(bits | faceNormal));
            if (n->leaves_empty()) kept.push_back(n);
            n->addLeaf(leaf.get());
        }
        sg->_leaves.clear();
    }

    // The same path, rooted beside our state set instead of below it, and below the forward one where that lights it.
    void moveForward(osgUtil::StateGraph* sg, const SurfaceState& state, osgUtil::RenderBin* to)
    {
        kinds.forward += unsigned(sg->_leaves.size());
        const osg::StateSet* lit = to && state.litForward() ? _lit() : nullptr;
        if (lit) kinds.litForward += unsigned(sg->_leaves.size());
        std::vector<const osg::StateSet*> path;
        for (osgUtil::StateGraph* s = sg; s != &_top; s = s->_parent) path.push_back(s->getStateSet());
        osgUtil::StateGraph* base = lit ? _top._parent->find_or_insert(lit) : _top._parent;
        for (auto s = path.rbegin(); s != path.rend(); ++s) base = base->find_or_insert(*s);
        const unsigned bits = variantBits(state);
        for (auto& leaf : sg->_leaves) {
            if (!to) continue;
            const unsigned faceNormal = lacksNormals(*leaf) ? unsigned(SurfaceSorter::FACE_NORMAL) : 0u;
            osgUtil::StateGraph* n = lit ? base->find_or_insert(_sorter.variant(bits | faceNormal)) : base;
            if (n->leaves_empty()) _moved.push_back({to, n});
            n->addLeaf(leaf.get());
        }
        sg->_leaves.clear();
    }

    SurfaceSorter& _sorter;
    osgUtil::StateGraph& _top;
    const SurfaceSorter::LitState& _lit;
    std::vector<ForwardGraph>& _moved;
    std::unordered_map<osgUtil::StateGraph*, SurfaceState> _states;
};

const osg::StateSet* SurfaceSorter::variant(unsigned bits)
{
    static const char* const defines[] = {"NO_TEXTURE",     "LINEAR_TEXTURE",        "TEXTURE_REPLACE", "UNLIT",
                                          "VERTEX_COLOR",   "FACE_NORMAL",           "PHONG_MATERIAL",  "ENVLIGHT_LAMBERT",
                                          "ENVLIGHT_PHONG", "ENVLIGHT_COOK_TORRANCE"};
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<osg::StateSet>& stateSet = _variants[bits];
    if (!stateSet) {
        stateSet = new osg::StateSet;
        for (unsigned i = 0; i < std::size(defines); ++i)
            if (bits >> i & 1) stateSet->setDefine(defines[i]);
    }
    return stateSet.get();
}

SurfaceKinds SurfaceSorter::sort(osgUtil::RenderBin& gbuffer, osgUtil::RenderBin* forward, osgUtil::StateGraph& top,
                                 const LitState& lit, std::vector<ForwardGraph>& moved)
{
    SurfaceSort sort(*this, top, lit, moved);
    sort.sortBin(gbuffer, forward, false);
    return sort.kinds;
}

}  // namespace osgEnvLight
