// SPDX-License-Identifier: MIT
#include "frame/FrameResources.h"

#include "base/R2Points.h"
#include "indirect/ReflectiveMaps.h"

#include <utility>

namespace osgEnvLight
{

FrameResources::FrameResources()
    : uniforms(new osg::StateSet),
      _sceneRadius(new osg::Uniform("sceneRadius", 0.0f)),
      _radianceScale(new osg::Uniform("radianceScale", 0.0f)),
      _baseStops(new osg::Uniform("baseStops", 0.0f)),
      _adaptedShare(new osg::Uniform("adaptedShare", 1.0f)),
      _emittedStops(new osg::Uniform("emittedStops", 0.0f)),
      _pyramidSide(new osg::Uniform("pyramidSide", 0.0f)),
      _pyramidLastLevel(new osg::Uniform("pyramidLastLevel", 0.0f)),
      _mapFromEye(new osg::Uniform(osg::Uniform::FLOAT_MAT3, "mapFromEyeForward")),
      _sampleShift(new osg::Uniform("sampleShift", osg::Vec2())),
      _sampleFrames(new osg::Uniform("sampleFrames", 1.0f)),
      _frameWeight(new osg::Uniform("frameWeight", 0.0f)),
      _accumulatedWeight(new osg::Uniform("accumulatedWeight", 0.0f)),
      _accumulatedShare(new osg::Uniform("accumulatedShare", 0.0f)),
      _accumulatedFrames(new osg::Uniform("accumulatedFrames", 0.0f))
{
    for (osg::Uniform* u :
         {_sceneRadius.get(), _radianceScale.get(), _baseStops.get(), _adaptedShare.get(), _emittedStops.get(),
          _pyramidSide.get(), _pyramidLastLevel.get(), _mapFromEye.get(), _sampleShift.get(), _sampleFrames.get(),
          _frameWeight.get(), _accumulatedWeight.get(), _accumulatedShare.get(), _accumulatedFrames.get()})
        uniforms->addUniform(u);
}

void FrameResources::setUniforms(double sceneRadius, double radianceScale, const MapTextures& textures,
                                 const osg::Matrixd& mapFromEye, double baseStops)
{
    _sceneRadius->set(float(sceneRadius));
    _radianceScale->set(float(radianceScale));
    _baseStops->set(float(baseStops));
    _emittedStops->set(float(-baseStops));
    _pyramidSide->set(float(textures.pyramidSide()));
    _pyramidLastLevel->set(float(textures.pyramidLastLevel()));
    osg::Matrix3 m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m(i, j) = float(mapFromEye(i, j));
    _mapFromEye->set(m);
}

void FrameResources::setUniforms(const Accumulation* still)
{
    const bool adds = still && still->adds();
    // Other points than those of the picture's offset.
    const osg::Vec2d shift = adds ? r2Point(still->frames() + 4096) : osg::Vec2d();
    _sampleShift->set(osg::Vec2(shift));
    _sampleFrames->set(adds ? float(still->frames()) : 1.0f);
    _frameWeight->set(adds ? float(still->weight()) : 0.0f);
    _accumulatedWeight->set(still ? float(still->weightSum()) : 0.0f);
    _accumulatedShare->set(still ? float(still->share()) : 0.0f);
    _accumulatedFrames->set(still ? float(still->equalFrames()) : 0.0f);
}

StageDraw& FrameResources::draw(const std::string& name, const std::function<osg::ref_ptr<osg::Drawable>()>& make)
{
    osg::ref_ptr<StageDraw>& draw = _draws[name];
    if (!draw) draw = new StageDraw(make().get());
    return *draw;
}

AtlasRefresh& FrameResources::refresh(const std::string& name)
{
    osg::ref_ptr<AtlasRefresh>& refresh = _refreshes[name];
    if (!refresh) refresh = new AtlasRefresh(name, triangle.get());
    return *refresh;
}

osg::StateSet& FrameResources::settingsState(SettingsGroup group, const Settings& settings)
{
    SettingsUniforms& s = _settings[group];
    if (!s.state) {
        s.state = new osg::StateSet;
        for (const SettingsProperty& p : group()) {
            if (!p.uniform) continue;
            const bool real = std::holds_alternative<float Settings::*>(p.member);
            s.uniforms.emplace_back(p, new osg::Uniform(real ? osg::Uniform::FLOAT : osg::Uniform::INT, p.name));
            s.state->addUniform(s.uniforms.back().second.get());
        }
    }
    for (const auto& [property, uniform] : s.uniforms) {
        const double value = property.get(settings);
        uniform->getType() == osg::Uniform::FLOAT ? uniform->set(float(value)) : uniform->set(int(value));
    }
    return *s.state;
}

osg::StateSet& FrameResources::atlasState(const std::string& name, const ShadowAtlas& atlas, const ShadowAtlas* near)
{
    osg::ref_ptr<osg::StateSet>& state = _atlasStates[name];
    if (!state) {
        state = new osg::StateSet;
        state->addUniform(new osg::Uniform("atlasTexel", 0.0f));
        state->addUniform(new osg::Uniform("atlasSize", 0));  // a still view's differs from the setting
        state->addUniform(new osg::Uniform("atlasShare", 0.0f));
        state->addUniform(new osg::Uniform("neighbourhood", osg::Vec4()));
        state->addUniform(new osg::Uniform("neighbourhoodTexel", 0.0f));
    }
    state->getUniform("atlasTexel")->set(float(atlas.texel()));
    state->getUniform("atlasSize")->set(int(atlas.size));
    state->getUniform("atlasShare")->set(1.0f / float(atlas.size));
    if (near) {
        const osg::BoundingSphered shown = near->shown();
        const osg::Vec3 center = shown.center() - atlas.origin();
        state->getUniform("neighbourhood")->set(osg::Vec4(center, float(shown.radius())));
        state->getUniform("neighbourhoodTexel")->set(float(near->complete() ? near->texel() : atlas.texel()));
    }
    return *state;
}

osg::StateSet& FrameResources::placeState(const std::string& pass, const Places& places)
{
    osg::ref_ptr<osg::StateSet>& state = _placeStates[pass];
    if (!state) {
        state = new osg::StateSet;
        for (const char* name : {"placesInAtlas", "placesInEmitterMaps", "placesInSceneLightMaps"})
            state->addUniform(new osg::Uniform(name, osg::Vec3()));
        for (const char* name : {"eyeFromPlaces", "placesFromEye"}) state->addUniform(new osg::Uniform(name, osg::Matrixf()));
    }
    state->getUniform("placesInAtlas")->set(osg::Vec3(places.inAtlas));
    state->getUniform("placesInEmitterMaps")->set(osg::Vec3(places.inEmitterMaps));
    state->getUniform("placesInSceneLightMaps")->set(osg::Vec3(places.inSceneLightMaps));
    state->getUniform("eyeFromPlaces")->set(osg::Matrixf(places.inEye));
    state->getUniform("placesFromEye")->set(osg::Matrixf(osg::Matrixd::inverse(places.inEye)));
    return *state;
}

osg::StateSet& FrameResources::pointState(int rows, int turn, const osg::Vec3d& inSunMaps)
{
    if (!_pointState) {
        _pointState = new osg::StateSet;
        _pointState->addUniform(new osg::Uniform("pointRows", rows));
        _pointState->addUniform(new osg::Uniform("pointTurn", turn));
        _pointState->addUniform(new osg::Uniform("pointsInSunMaps", osg::Vec3()));
    }
    _pointState->getUniform("pointRows")->set(rows);
    _pointState->getUniform("pointTurn")->set(turn);
    _pointState->getUniform("pointsInSunMaps")->set(osg::Vec3(inSunMaps));
    return *_pointState;
}

osg::StateSet& FrameResources::causticState(const Caustics& caustics)
{
    if (!_causticState) _causticState = new osg::StateSet;
    caustics.setUniforms(*_causticState);
    return *_causticState;
}

osg::StateSet& FrameResources::probeState(double share)
{
    if (!_probeState) {
        _probeState = new osg::StateSet;
        _probeState->addUniform(new osg::Uniform("probeShare", 0.0f));
    }
    _probeState->getUniform("probeShare")->set(float(share));
    return *_probeState;
}

osg::StateSet& FrameResources::groundState(const osg::Vec4f& camera)
{
    if (!_groundState) {
        _groundState = new osg::StateSet;
        _groundState->addUniform(new osg::Uniform("mapCamera", camera));
    }
    _groundState->getUniform("mapCamera")->set(camera);
    return *_groundState;
}

osg::StateSet& FrameResources::fogState(const FogValues& fog, const osg::Vec3f& radiance)
{
    if (!_fogState) {
        _fogState = new osg::StateSet;
        _fogState->addUniform(new osg::Uniform("fogRadiance", radiance));
        for (const char* name : {"fogKind", "fogIsRadial"}) _fogState->addUniform(new osg::Uniform(name, 0));
        for (const char* name : {"fogDensity", "fogStart", "fogEnd"}) _fogState->addUniform(new osg::Uniform(name, 0.0f));
    }
    _fogState->getUniform("fogRadiance")->set(radiance);
    _fogState->getUniform("fogKind")->set(fog.kind);
    _fogState->getUniform("fogIsRadial")->set(int(fog.isRadial));
    _fogState->getUniform("fogDensity")->set(fog.density);
    _fogState->getUniform("fogStart")->set(fog.start);
    _fogState->getUniform("fogEnd")->set(fog.end);
    return *_fogState;
}

osg::StateSet& FrameResources::historyState(const osg::Matrixd& formerEyeFromEye, const osg::Matrixd& formerProjection)
{
    if (!_historyState) {
        _historyState = new osg::StateSet;
        for (const char* name : {"formerEyeFromEye", "formerProjection"})
            _historyState->addUniform(new osg::Uniform(name, osg::Matrixf()));
    }
    _historyState->getUniform("formerEyeFromEye")->set(osg::Matrixf(formerEyeFromEye));
    _historyState->getUniform("formerProjection")->set(osg::Matrixf(formerProjection));
    return *_historyState;
}

osg::StateSet& FrameResources::sceneLightState()
{
    if (!_sceneLightState) {
        _sceneLightState = new osg::StateSet;
        sceneLights.addTo(*_sceneLightState);
    }
    return *_sceneLightState;
}

osg::StateSet& FrameResources::sunState(const SunShadows& shadows)
{
    if (!_sunState) _sunState = new osg::StateSet;
    _sunUsed = true;
    if (_sunShadows != &shadows || _sunVersion != shadows.version()) {
        shadows.setUniforms(*_sunState);
        _sunShadows = &shadows;
        _sunVersion = shadows.version();
    }
    return *_sunState;
}

std::vector<osg::Drawable*> FrameResources::drawables() const
{
    std::vector<osg::Drawable*> all;
    if (composite) all.push_back(composite.get());
    all.push_back(firstUnit.get());
    for (const auto& [name, draw] : _draws) all.push_back(&draw->drawable());
    return all;
}

void FrameResources::resizeGLObjectBuffers(unsigned maximum)
{
    for (osg::Drawable* drawable : drawables()) drawable->resizeGLObjectBuffers(maximum);
    for (osg::StateSet* s : {fillState.get(), forwardState.get()})
        if (s) s->resizeGLObjectBuffers(maximum);
}

void FrameResources::releaseGLObjects(osg::State* state) const
{
    for (const osg::Drawable* drawable : drawables()) drawable->releaseGLObjects(state);
    for (const osg::StateSet* s : {fillState.get(), forwardState.get()})
        if (s) s->releaseGLObjects(state);
}

void FrameResources::retire(RetiredObjects& retired) const
{
    for (osg::Drawable* drawable : drawables()) retired.add(drawable);
}

void FrameResources::forgetUnused(RetiredObjects& retired)
{
    for (auto it = _draws.begin(); it != _draws.end();) {
        const bool used = it->second->takeAdded();
        if (!used) {
            retired.add(&it->second->drawable());
            _refreshes.erase(it->first);
        }
        it = used ? std::next(it) : _draws.erase(it);
    }
    if (!std::exchange(_sunUsed, false)) _sunShadows = nullptr;
}

}  // namespace osgEnvLight
