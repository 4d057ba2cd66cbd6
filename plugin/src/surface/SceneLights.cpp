// SPDX-License-Identifier: MIT
#include "surface/SceneLights.h"

#include "surface/SurfaceState.h"

#include <osgUtil/StateGraph>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

namespace osgEnvLight
{

namespace
{

using Positioned = osgUtil::PositionalStateContainer::AttrMatrixPair;

// SceneView puts it first, and a head light without a matrix.
bool isOfView(const Positioned& entry, bool isFirst, const osg::View* view)
{
    if (view && view->getLightingMode() == osg::View::NO_LIGHT) return false;
    if (view && view->getLightingMode() == osg::View::SKY_LIGHT) return entry.first == view->getLight();
    const bool isHeadlight = isFirst && !entry.second && static_cast<const osg::Light&>(*entry.first).getLightNum() == 0;
    return isHeadlight || (view && entry.first == view->getLight());
}

SceneLight convert(const osg::Light& light, const osg::Matrixd& toEye)
{
    SceneLight s;
    s.number = unsigned(light.getLightNum());
    s.name = light.getName().empty() ? "GL_LIGHT" + std::to_string(s.number) : "'" + light.getName() + "'";
    const float* color = light.getDiffuse().ptr();
    for (int i = 0; i < 3; ++i) s.color[i] = std::isfinite(color[i]) && color[i] > 0.0f ? color[i] : 0.0f;
    osg::Vec4d position = osg::Vec4d(light.getPosition()) * toEye;
    osg::Vec3d xyz(position[0], position[1], position[2]);
    if (position[3] != 0.0)
        xyz /= position[3];
    else
        xyz.normalize();
    s.position = osg::Vec4f(osg::Vec3f(xyz), position[3] != 0.0 ? 1.0f : 0.0f);
    osg::Vec3d direction = osg::Matrixd::transform3x3(osg::Vec3d(light.getDirection()), toEye);
    direction.normalize();
    const bool cone = light.getSpotCutoff() <= 90.0f;  // 180: none
    s.spot =
        osg::Vec4f(osg::Vec3f(direction), cone ? float(std::cos(osg::DegreesToRadians(double(light.getSpotCutoff())))) : -2.0f);
    s.falloff = osg::Vec4f(light.getConstantAttenuation(), light.getLinearAttenuation(), light.getQuadraticAttenuation(),
                           light.getSpotExponent());
    return s;
}

// Not at a place or in a direction that is no number, nor in none.
bool isSomewhere(const SceneLight& light)
{
    const osg::Vec3f place(light.position[0], light.position[1], light.position[2]);
    const osg::Vec3f axis(light.spot[0], light.spot[1], light.spot[2]);
    const bool hasCone = light.spot[3] >= -1.0f;
    return std::isfinite(place.length2()) && (light.position[3] > 0.0f || place.length2() > 0.0f) &&
           (!hasCone || std::isfinite(axis.length2()));
}

// Modes of the eight lights as they stand after a path of state sets.
using Modes = std::array<SurfaceState::Mode, SceneLightUniforms::maximum>;

class ModeFinder
{
  public:
    LightModes found;

    void add(osgUtil::RenderBin& bin)
    {
        for (osgUtil::StateGraph* graph : bin.getStateGraphList()) add(*graph);
        for (const auto& [number, child] : bin.getRenderBinList()) add(*child);
    }

    void add(osgUtil::StateGraph& graph)
    {
        unsigned bits = 0;
        const Modes& modes = modesOf(graph);
        for (unsigned i = 0; i < modes.size(); ++i) bits |= unsigned(modes[i].on) << i;
        found.some |= bits;
        found.all &= bits;
    }

  private:
    const Modes& modesOf(const osgUtil::StateGraph& graph)
    {
        const auto known = _modes.find(&graph);
        if (known != _modes.end()) return known->second;
        Modes modes;
        if (graph._parent) modes = modesOf(*graph._parent);
        const osg::StateSet* state = graph.getStateSet();
        if (state && !state->getModeList().empty())
            for (unsigned i = 0; i < modes.size(); ++i) modes[i].merge(state->getMode(GL_LIGHT0 + i));
        return _modes.emplace(&graph, modes).first->second;
    }

    std::unordered_map<const osgUtil::StateGraph*, Modes> _modes;
};

}  // namespace

SceneLightList findSceneLights(osgUtil::RenderStage& stage, const osg::View* view, bool withView)
{
    std::map<unsigned, SceneLight> byNumber;
    bool isFirst = true;
    const auto add = [&](osgUtil::PositionalStateContainer& container, const osg::Matrixd& after) {
        for (const Positioned& entry : container.getAttrMatrixList()) {
            const auto* light = dynamic_cast<const osg::Light*>(entry.first.get());
            const bool ofView = light && isOfView(entry, isFirst, view);
            isFirst = false;
            if (!light || unsigned(light->getLightNum()) >= SceneLightUniforms::maximum) continue;
            byNumber.erase(unsigned(light->getLightNum()));
            const osg::Matrixd toEye = (entry.second ? osg::Matrixd(*entry.second) : osg::Matrixd()) * after;
            if (ofView && !withView) continue;
            byNumber.emplace(unsigned(light->getLightNum()), convert(*light, toEye)).first->second.ofView = ofView;
        }
    };
    // A camera that draws into a texture has the lights of the one above it, too.
    if (stage.getInheritedPositionalStateContainer())
        add(*stage.getInheritedPositionalStateContainer(), stage.getInheritedPositionalStateContainerMatrix());
    add(*stage.getPositionalStateContainer(), osg::Matrixd());
    SceneLightList lights;
    for (const auto& [number, light] : byNumber)
        if (light.color != osg::Vec3f() && isSomewhere(light)) lights.push_back(light);
    return lights;
}

bool castShadows(const SceneLightList& lights)
{
    return std::any_of(lights.begin(), lights.end(), [](const SceneLight& light) { return !light.ofView; });
}

LightModes findLightModes(osgUtil::RenderBin& gbuffer, const std::vector<ForwardGraph>& forward)
{
    ModeFinder finder;
    finder.add(gbuffer);
    for (const ForwardGraph& f : forward) finder.add(*f.graph);
    return finder.found;
}

SceneLightList switchedOn(SceneLightList lights, unsigned modes)
{
    const auto off = [&](const SceneLight& l) { return !(modes >> l.number & 1); };
    lights.erase(std::remove_if(lights.begin(), lights.end(), off), lights.end());
    return lights;
}

SceneLightUniforms::SceneLightUniforms()
    : _count(new osg::Uniform("sceneLightCount", 0)),
      _color(new osg::Uniform(osg::Uniform::FLOAT_VEC3, "sceneLightColor", maximum)),
      _position(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "sceneLightPosition", maximum)),
      _spot(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "sceneLightSpot", maximum)),
      _falloff(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "sceneLightFalloff", maximum)),
      _faces(new osg::Uniform(osg::Uniform::INT_VEC2, "sceneLightFaces", maximum))
{
}

void SceneLightUniforms::set(const SceneLightList& lights)
{
    _count->set(int(lights.size()));
    for (unsigned i = 0; i < lights.size(); ++i) {
        _color->setElement(i, lights[i].color);
        _position->setElement(i, lights[i].position);
        _spot->setElement(i, lights[i].spot);
        _falloff->setElement(i, lights[i].falloff);
        const auto [first, count] = faces[lights[i].number];
        _faces->setElement(i, int(first), int(count));
    }
}

void SceneLightUniforms::addTo(osg::StateSet& state) const
{
    for (osg::Uniform* u : {_count.get(), _color.get(), _position.get(), _spot.get(), _falloff.get(), _faces.get()})
        state.addUniform(u);
}

}  // namespace osgEnvLight
