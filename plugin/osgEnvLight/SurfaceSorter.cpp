// SPDX-License-Identifier: MIT
#include <osgEnvLight/SurfaceSorter>

#include <osgEnvLight/Material>

#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/TexEnv>
#include <osg/TexGen>
#include <osg/Texture>

#include <iterator>
#include <unordered_map>

namespace osgEnvLight
{

const char* const SurfaceSorter::gbufferDefine = "OSGENVLIGHT_GBUFFER";

namespace
{

// A mode or attribute as it stands after a path of state sets, with the flags it was set with.
struct Mode {
    bool on = false;
    unsigned flags = 0;

    void merge(osg::StateAttribute::GLModeValue value)
    {
        if ((value & osg::StateAttribute::INHERIT) || !wins(value, flags)) return;
        on = (value & osg::StateAttribute::ON) != 0;
        flags = value;
    }

    static bool wins(unsigned newFlags, unsigned oldFlags)
    {
        return !(oldFlags & osg::StateAttribute::OVERRIDE) || (newFlags & osg::StateAttribute::PROTECTED);
    }
};

struct Attribute {
    const osg::StateAttribute* attribute = nullptr;
    unsigned flags = 0;

    void merge(const osg::StateSet::RefAttributePair* pair)
    {
        if (!pair || !Mode::wins(pair->second, flags)) return;
        attribute = pair->first.get();
        flags = pair->second;
    }
};

// What GLSL can't see of the state above a drawable, and what decides where it is drawn.
struct EffectiveState {
    Mode lighting{true, 0};
    Mode texturing;
    Mode texGen;
    Mode blending;
    Mode depthTest{true, 0};
    Attribute material;
    Attribute texture;
    Attribute texEnv;
    Attribute texGenMode;
    Attribute depth;
    bool ownProgram = false;  // below the G-buffer's state set
    int brdf = -1;            // of our Material, -1 when there is none

    void merge(const osg::StateSet& s)
    {
        lighting.merge(s.getMode(GL_LIGHTING));
        blending.merge(s.getMode(GL_BLEND));
        depthTest.merge(s.getMode(GL_DEPTH_TEST));
        material.merge(s.getAttributePair(osg::StateAttribute::MATERIAL));
        depth.merge(s.getAttributePair(osg::StateAttribute::DEPTH));
        if (!s.getTextureModeList().empty()) {
            texturing.merge(s.getTextureMode(0, GL_TEXTURE_2D));
            texGen.merge(s.getTextureMode(0, GL_TEXTURE_GEN_S));
        }
        if (!s.getTextureAttributeList().empty()) {
            texture.merge(s.getTextureAttributePair(0, osg::StateAttribute::TEXTURE));
            texEnv.merge(s.getTextureAttributePair(0, osg::StateAttribute::TEXENV));
            texGenMode.merge(s.getTextureAttributePair(0, osg::StateAttribute::TEXGEN));
        }
        if (s.getAttribute(osg::StateAttribute::PROGRAM)) ownProgram = !s.getDefinePair(SurfaceSorter::gbufferDefine);
        if (!s.getUniformList().empty()) brdf = Material::brdfOf(s, brdf);
    }

    const osg::Material* osgMaterial() const { return static_cast<const osg::Material*>(material.attribute); }
    const osg::Texture* osgTexture() const
    {
        return texturing.on ? dynamic_cast<const osg::Texture*>(texture.attribute) : nullptr;
    }

    // Sphere and cube mapping paint a reflection that the lighting now makes itself.
    bool paintedReflection() const
    {
        const auto* gen = texGen.on ? dynamic_cast<const osg::TexGen*>(texGenMode.attribute) : nullptr;
        return gen && (gen->getMode() == osg::TexGen::SPHERE_MAP || gen->getMode() == osg::TexGen::REFLECTION_MAP ||
                       gen->getMode() == osg::TexGen::NORMAL_MAP);
    }

    bool translucent() const
    {
        const osg::Texture* t = osgTexture();
        if (t && t->getNumImages() > 0 && t->getImage(0) && t->getImage(0)->isImageTranslucent()) return true;
        return osgMaterial() && osgMaterial()->getDiffuse(osg::Material::FRONT).a() < 1.0f;
    }

    bool drawnForward() const
    {
        const auto* d = static_cast<const osg::Depth*>(depth.attribute);
        return ownProgram || !depthTest.on || (d && !d->getWriteMask()) || (blending.on && translucent());
    }
};

bool hasLobe(const osg::Material& m)
{
    const osg::Vec4& s = m.getSpecular(osg::Material::FRONT);
    return s.r() > 0.0f || s.g() > 0.0f || s.b() > 0.0f;
}

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
            const EffectiveState& state = effective(sg);
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
    const EffectiveState& effective(osgUtil::StateGraph* sg)
    {
        auto found = _states.find(sg);
        if (found != _states.end()) return found->second;
        EffectiveState state;
        if (sg->_parent) state = effective(sg->_parent);
        if (sg == &_top)
            state.ownProgram = false;  // a program above us does not matter, and neither does our blending off
        else if (sg->getStateSet())
            state.merge(*sg->getStateSet());
        return _states.emplace(sg, state).first->second;
    }

    unsigned variantBits(const EffectiveState& state) const
    {
        unsigned bits = 0;
        const osg::Texture* texture = state.osgTexture();
        if (!texture || state.paintedReflection()) {
            bits |= SurfaceSorter::NO_TEXTURE;
        } else {
            const osg::Image* image = texture->getNumImages() > 0 ? texture->getImage(0) : nullptr;
            const GLint format = texture->getInternalFormat();
            if ((image && image->getDataType() != GL_UNSIGNED_BYTE) || format == GL_SRGB8 || format == GL_SRGB8_ALPHA8)
                bits |= SurfaceSorter::LINEAR_TEXTURE;
            const auto* env = dynamic_cast<const osg::TexEnv*>(state.texEnv.attribute);
            if (env && (env->getMode() == osg::TexEnv::REPLACE || env->getMode() == osg::TexEnv::DECAL))
                bits |= SurfaceSorter::TEXTURE_REPLACE;
        }
        const osg::Material* material = state.osgMaterial();
        const bool unlit = !state.lighting.on && state.brdf < 0;
        if (unlit) bits |= SurfaceSorter::UNLIT;
        const bool colorMode = material && (material->getColorMode() == osg::Material::DIFFUSE ||
                                            material->getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE);
        if (state.brdf < 0 && (unlit || !material || colorMode)) bits |= SurfaceSorter::VERTEX_COLOR;
        if (state.brdf < 0 && !unlit && material && hasLobe(*material)) bits |= SurfaceSorter::PHONG_MATERIAL;
        if (state.brdf >= 0) bits |= unsigned(SurfaceSorter::ENVLIGHT_LAMBERT) << state.brdf;
        return bits;
    }

    // Each leaf one level down, under the variant that reads its state.
    void keep(osgUtil::StateGraph* sg, const EffectiveState& state, osgUtil::RenderBin::StateGraphList& kept)
    {
        const unsigned bits = variantBits(state);
        if ((bits & SurfaceSorter::PHONG_MATERIAL) || state.brdf == Material::PHONG) kinds.phong = true;
        if (state.brdf == Material::COOK_TORRANCE) kinds.cookTorrance = true;
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
    void moveForward(osgUtil::StateGraph* sg, const EffectiveState& state, osgUtil::RenderBin* to)
    {
        kinds.forward += unsigned(sg->_leaves.size());
        const osg::StateSet* lit = to && !state.ownProgram && state.lighting.on ? _lit() : nullptr;
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
    std::unordered_map<osgUtil::StateGraph*, EffectiveState> _states;
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
