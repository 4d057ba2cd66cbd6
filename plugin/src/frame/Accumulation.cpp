// SPDX-License-Identifier: MIT
#include "frame/Accumulation.h"

#include "gl/CasterProgram.h"

#include <osgEnvLight/SurfaceProgram>

#include <osg/Geometry>
#include <osg/Material>
#include <osg/Program>
#include <osg/TexMat>
#include <osg/Texture>
#include <osgUtil/RenderBin>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace osgEnvLight
{

namespace
{

// A number of all that is fed to it.
class Mixer
{
  public:
    template <class T>
    void add(const T& value)
    {
        static_assert(!std::is_polymorphic_v<T>);
        unsigned char bytes[(sizeof(T) + 7) / 8 * 8] = {};
        std::memcpy(bytes, &value, sizeof(T));
        for (size_t i = 0; i < sizeof(bytes); i += 8) {
            uint64_t word;
            std::memcpy(&word, bytes + i, 8);
            _state = (_state ^ word) * 0x9E3779B97F4A7C15u;
            _state ^= _state >> 32;
        }
    }
    uint64_t get() const { return _state; }

  private:
    uint64_t _state = 1;
};

void addArray(Mixer& mixer, const osg::Array* array)
{
    mixer.add(array);
    if (array) mixer.add(array->getModifiedCount());
}

void addAttribute(Mixer& mixer, const osg::StateAttribute& attribute)
{
    mixer.add(&attribute);
    if (const auto* material = dynamic_cast<const osg::Material*>(&attribute)) {
        for (const osg::Vec4& color : {material->getDiffuse(osg::Material::FRONT), material->getSpecular(osg::Material::FRONT),
                                       material->getEmission(osg::Material::FRONT)})
            mixer.add(color);
        mixer.add(material->getShininess(osg::Material::FRONT));
    } else if (const osg::Texture* texture = attribute.asTexture()) {
        for (unsigned i = 0; i < texture->getNumImages(); ++i) {
            mixer.add(texture->getImage(i));
            if (texture->getImage(i)) mixer.add(texture->getImage(i)->getModifiedCount());
        }
    } else if (const auto* matrix = dynamic_cast<const osg::TexMat*>(&attribute)) {
        mixer.add(matrix->getMatrix());
    }
}

// Above the top, each of a view's two SceneViews has a state set of its own, with its colour mask and viewport.
uint64_t numberOf(const osg::StateSet& state, bool below)
{
    Mixer mixer;
    if (below) mixer.add(&state);
    for (const auto& [type, attribute] : state.getAttributeList()) {
        const bool ofSceneView =
            !below && (type.first == osg::StateAttribute::COLORMASK || type.first == osg::StateAttribute::VIEWPORT);
        if (!ofSceneView) addAttribute(mixer, *attribute.first);
    }
    for (const auto& list : state.getTextureAttributeList())
        for (const auto& [type, attribute] : list) addAttribute(mixer, *attribute.first);
    for (const auto& [name, uniform] : state.getUniformList()) {
        if (!below) break;
        mixer.add(uniform.first.get());
        mixer.add(uniform.first->getModifiedCount());
    }
    return mixer.get();
}

class SurfaceMixer
{
  public:
    SurfaceMixer(const osg::StateSet* top, unsigned frame) : _top(top), _frame(frame) {}

    void add(const osgUtil::RenderBin& bin)
    {
        for (const osgUtil::StateGraph* graph : const_cast<osgUtil::RenderBin&>(bin).getStateGraphList()) {
            bool above = false;
            for (const osgUtil::StateGraph* g = graph; g; g = g->_parent) {
                above = above || g->getStateSet() == _top;
                if (g->getStateSet() && g->getStateSet() != _top) _mixer.add(stateNumber(*g->getStateSet(), !above));
            }
            for (const auto& leaf : graph->_leaves) add(*leaf);
        }
        for (const auto& [number, inner] : const_cast<osgUtil::RenderBin&>(bin).getRenderBinList()) add(*inner);
    }
    uint64_t get() const { return _mixer.get(); }

  private:
    void add(const osgUtil::RenderLeaf& leaf)
    {
        _mixer.add(leaf.getDrawable());
        if (leaf._modelview) _mixer.add(static_cast<const osg::Matrixd&>(*leaf._modelview));
        const osg::Geometry* geometry = leaf.getDrawable() ? leaf.getDrawable()->asGeometry() : nullptr;
        if (!geometry) return;
        addArray(_mixer, geometry->getVertexArray());
        addArray(_mixer, geometry->getNormalArray());
        addArray(_mixer, geometry->getColorArray());
        addArray(_mixer, geometry->getTexCoordArray(0));
        for (const auto& set : geometry->getPrimitiveSetList()) _mixer.add(set->getModifiedCount());
    }

    uint64_t stateNumber(const osg::StateSet& state, bool below)
    {
        const auto [found, isNew] = _states.emplace(&state, 0);
        if (!isNew) return found->second;
        found->second = numberOf(state, below);
        const auto* program =
            below ? dynamic_cast<const osg::Program*>(state.getAttribute(osg::StateAttribute::PROGRAM)) : nullptr;
        const osg::Shader* moving = program ? SurfaceProgram::vertexShaderOf(*program) : nullptr;
        if (moving && followsTime(*moving)) found->second += _frame;
        return found->second;
    }

    const osg::StateSet* _top;
    const unsigned _frame;
    Mixer _mixer;
    std::unordered_map<const osg::StateSet*, uint64_t> _states;
};

bool sameLight(const Settings* a, const Settings* b)
{
    if (a == b || !a || !b) return a == b;
    const std::vector<Settings::Property>& table = Settings::table();
    return std::all_of(table.begin(), table.end(),
                       [&](const Settings::Property& p) { return p.shown || p.get(*a) == p.get(*b); });
}

}  // namespace

// Column 2 alone has near and far.
bool sameProjection(const osg::Matrixd& a, const osg::Matrixd& b)
{
    for (int row = 0; row < 4; ++row)
        for (int column : {0, 1, 3})
            if (a(row, column) != b(row, column)) return false;
    return true;
}

bool Accumulation::Key::operator==(const Key& o) const
{
    return view == o.view && sameProjection(projection, o.projection) && mapFromWorld == o.mapFromWorld &&
           radianceScale == o.radianceScale && sameLight(settings.get(), o.settings.get()) && background == o.background &&
           lights == o.lights && areaLights == o.areaLights && fog == o.fog && textures == o.textures && viewport == o.viewport &&
           surfaces == o.surfaces;
}

void Accumulation::advance(const Key& key, bool still, const RadianceMap& map)
{
    if (_run == 0 || !still || !(key == _key))
        begin(key);
    else
        add(map);
}

void Accumulation::begin(const Key& key)
{
    if (_key.textures != key.textures) _sequence.reset();
    if (_sequence) _sequence->restart();
    _key = key;
    _frames = 0;
    _adds = false;
    _weightSum = 0.0;
    _squareSum = 0.0;
    ++_run;
    _error = -1.0;
}

void Accumulation::add(const RadianceMap& map)
{
    _adds = _frames < unsigned(_key.settings->accumulateFrames);
    if (!_adds) return;
    ++_frames;
    if (!_sequence) _sequence.emplace(map);
    _lights = _sequence->next((unsigned(_key.settings->accumulateLights) + 15) / 16 * 16);
    const unsigned largest = unsigned(_key.settings->accumulateSize);
    _mapSize = _frames < fadeFrames ? std::max(largest / 2, 1u) : largest;
    _weight = std::sqrt(double(_mapSize) / largest);  // the error of a map falls like that
    _weightSum += _weight;
    _squareSum += _weight * _weight;
}

double Accumulation::share() const
{
    return std::min(1.0, double(_frames) / fadeFrames);
}

void Accumulation::setStandardError(unsigned run, double error) const
{
    if (run == _run) _error = error;
}

uint64_t surfacesOf(const osgUtil::RenderBin& bin, const osg::StateSet* top, unsigned frame)
{
    SurfaceMixer mixer(top, frame);
    mixer.add(bin);
    return mixer.get();
}

}  // namespace osgEnvLight
