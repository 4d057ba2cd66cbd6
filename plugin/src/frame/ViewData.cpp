// SPDX-License-Identifier: MIT
#include "frame/ViewData.h"

#include <algorithm>
#include <utility>

namespace osgEnvLight
{

Target::Target(int width, int height, const std::vector<GLint>& formats, const StageCamera& plain, Failure* failure)
    : frameBuffer(new osg::FrameBufferObject), camera(new StageCamera(plain)), viewport(new osg::Viewport(0, 0, width, height))
{
    for (size_t i = 0; i < formats.size(); ++i) {
        textures.push_back(targetTexture(width, height, formats[i]));
        frameBuffer->setAttachment(osg::Camera::BufferComponent(osg::Camera::COLOR_BUFFER0 + int(i)),
                                   osg::FrameBufferAttachment(textures.back().get()));
    }
    BindTargets::install(*camera, frameBuffer.get(), nullptr, failure);
}

size_t Target::bytes() const
{
    size_t sum = 0;
    for (const auto& t : textures) sum += bytesOf(*t);
    return sum;
}

Frame::Frame()
    : gbufferStage(new GBufferStage),
      uniforms(new osg::StateSet),
      _sceneRadius(new osg::Uniform("sceneRadius", 0.0f)),
      _radianceScale(new osg::Uniform("radianceScale", 0.0f)),
      _baseStops(new osg::Uniform("baseStops", 0.0f)),
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
    for (const Settings::Property& p : Settings::table()) {
        const bool real = std::holds_alternative<float Settings::*>(p.member);
        _settings.push_back(new osg::Uniform(real ? osg::Uniform::FLOAT : osg::Uniform::INT, p.name));
        uniforms->addUniform(_settings.back());
    }
    for (osg::Uniform* u : {_sceneRadius.get(), _radianceScale.get(), _baseStops.get(), _emittedStops.get(), _pyramidSide.get(),
                            _pyramidLastLevel.get(), _mapFromEye.get(), _sampleShift.get(), _sampleFrames.get(),
                            _frameWeight.get(), _accumulatedWeight.get(), _accumulatedShare.get(), _accumulatedFrames.get()})
        uniforms->addUniform(u);
}

void Frame::setUniforms(const Settings& settings, double sceneRadius, double radianceScale, const MapTextures& textures,
                        const osg::Matrixd& mapFromEye, double baseStops)
{
    const auto& table = Settings::table();
    for (size_t i = 0; i < table.size(); ++i) {
        const double value = table[i].get(settings);
        const bool real = _settings[i]->getType() == osg::Uniform::FLOAT;
        real ? _settings[i]->set(float(value)) : _settings[i]->set(int(value));
    }
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

void Frame::setUniforms(const Accumulation* still)
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

osg::StateSet& Frame::atlasState(const std::string& name, const ShadowAtlas& atlas, const ShadowAtlas* finer, double scale)
{
    AtlasState& a = _atlasStates[name];
    a.used = true;
    if (!a.uniforms) {
        a.uniforms = new osg::StateSet(*uniforms);
        a.uniforms->addUniform(new osg::Uniform("atlasLightMap", int(atlasLightUnit)));
        a.uniforms->addUniform(new osg::Uniform("atlasTexel", 0.0f));
        a.uniforms->addUniform(new osg::Uniform("atlasSize", 0));  // a still view's differs from the setting
        a.uniforms->addUniform(new osg::Uniform("neighbourhood", osg::Vec4()));
        a.uniforms->addUniform(new osg::Uniform("neighbourhoodTexel", 0.0f));
    }
    const unsigned finerVersion = finer ? finer->version() : 0;
    if (a.atlas != &atlas || a.version != atlas.version() || a.finer != finer || a.finerVersion != finerVersion ||
        a.scale != scale) {
        const osg::ref_ptr<osg::Image> image = atlas.lightImage(scale, finer);
        osg::ref_ptr<osg::Texture2D> texture = targetTexture(image->s(), image->t(), GL_RGBA32F_ARB);
        texture->setImage(image);
        a.uniforms->setTextureAttribute(atlasLightUnit, texture);
        a.uniforms->getUniform("atlasTexel")->set(float(atlas.texel()));
        a.uniforms->getUniform("atlasSize")->set(int(atlas.size));
        if (finer) {
            const osg::BoundingSphered shown = finer->shown();
            const osg::Vec3 center = shown.center() - atlas.origin();
            a.uniforms->getUniform("neighbourhood")->set(osg::Vec4(center, float(shown.radius())));
            a.uniforms->getUniform("neighbourhoodTexel")->set(float(finer->complete() ? finer->texel() : atlas.texel()));
        }
        a.atlas = &atlas;
        a.version = atlas.version();
        a.finer = finer;
        a.finerVersion = finerVersion;
        a.scale = scale;
    }
    return *a.uniforms;
}

osg::StateSet& Frame::sceneLightState()
{
    if (!_sceneLightState) {
        _sceneLightState = new osg::StateSet(*uniforms);
        sceneLights.addTo(*_sceneLightState);
    }
    return *_sceneLightState;
}

osg::StateSet& Frame::sunState(const SunShadows& shadows)
{
    if (!_sunState) _sunState = new osg::StateSet(*uniforms);
    _sunUsed = true;
    if (_sunShadows != &shadows || _sunVersion != shadows.version()) {
        shadows.setUniforms(*_sunState);
        _sunShadows = &shadows;
        _sunVersion = shadows.version();
    }
    return *_sunState;
}

std::vector<osg::Drawable*> Frame::drawables() const
{
    std::vector<osg::Drawable*> all;
    if (composite) all.push_back(composite.get());
    for (const auto& [name, pass] : passes) all.push_back(&pass->drawable());
    return all;
}

void Frame::resizeGLObjectBuffers(unsigned maximum)
{
    for (osg::Drawable* drawable : drawables()) drawable->resizeGLObjectBuffers(maximum);
    for (osg::StateSet* s : {fillState.get(), forwardState.get()})
        if (s) s->resizeGLObjectBuffers(maximum);
    for (auto& [name, atlas] : _atlasStates) atlas.uniforms->resizeGLObjectBuffers(maximum);
}

void Frame::releaseGLObjects(osg::State* state) const
{
    for (const osg::Drawable* drawable : drawables()) drawable->releaseGLObjects(state);
    for (const osg::StateSet* s : {fillState.get(), forwardState.get()})
        if (s) s->releaseGLObjects(state);
    for (const auto& [name, atlas] : _atlasStates) atlas.uniforms->releaseGLObjects(state);
}

size_t Frame::bytes() const
{
    size_t sum = 0;
    for (const auto& [name, atlas] : _atlasStates) {
        const osg::StateAttribute* lights = atlas.uniforms->getTextureAttribute(atlasLightUnit, osg::StateAttribute::TEXTURE);
        if (lights) sum += bytesOf(static_cast<const osg::Texture2D&>(*lights));
    }
    return sum;
}

void Frame::retire(RetiredObjects& retired) const
{
    for (osg::Drawable* drawable : drawables()) retired.add(drawable);
}

void Frame::forgetUnused(RetiredObjects& retired)
{
    for (auto it = passes.begin(); it != passes.end();) {
        const bool used = it->second->takeAdded();
        if (!used) {
            retired.add(&it->second->drawable());
            atlasRefreshes.erase(it->first);
        }
        it = used ? std::next(it) : passes.erase(it);
    }
    for (auto it = _atlasStates.begin(); it != _atlasStates.end();)
        it = std::exchange(it->second.used, false) ? std::next(it) : _atlasStates.erase(it);
    if (!std::exchange(_sunUsed, false)) _sunShadows = nullptr;
}

void ViewData::fit(int width, int height, MapTextures* textures)
{
    const bool sizeChanged = width != _width || height != _height;
    if (sizeChanged) {
        _width = width;
        _height = height;
        _viewport = new osg::Viewport(0, 0, width, height);
        retireAll();
        _gbuffer = nullptr;
        _targets.clear();
        _frames.clear();
        _accumulation = nullptr;
    }
    _textures = textures;
}

GBuffer& ViewData::gbuffer()
{
    if (!_gbuffer) _gbuffer = new GBuffer(_width, _height);
    return *_gbuffer;
}

Target& ViewData::target(const std::string& pass, const std::vector<GLint>& formats, int side)
{
    osg::ref_ptr<Target>& target = _targets[pass];
    if (!target || (!formats.empty() && formats.size() != target->textures.size())) {
        if (target) retire(*target);
        target = new Target(side ? side : _width, side ? side : _height, formats, *_plainCamera, _failure.get());
    }
    return *target;
}

void ViewData::dropTarget(const std::string& pass)
{
    const auto found = _targets.find(pass);
    if (found == _targets.end()) return;
    retire(*found->second);
    _targets.erase(found);
}

ViewData::Atlas& ViewData::atlas(const std::string& pass, unsigned lights, unsigned size)
{
    Atlas& atlas = _atlases[pass];
    if (!atlas.maps || atlas.maps->lights != lights || atlas.maps->size != size) {
        if (atlas.maps) retire(atlas.maps->targets());
        atlas.maps = new ShadowAtlas(lights, size);
        atlas.camera = new StageCamera(*_plainCamera);
        BindTargets::install(*atlas.camera, atlas.maps->targets().maps, nullptr, _failure.get());
    }
    return atlas;
}

void ViewData::dropAtlas(const std::string& pass)
{
    const auto found = _atlases.find(pass);
    if (found == _atlases.end()) return;
    retire(found->second.maps->targets());
    _atlases.erase(found);
}

Accumulation& ViewData::accumulation()
{
    if (!_accumulation) _accumulation = new Accumulation;
    return *_accumulation;
}

SunShadows& ViewData::sunShadows(unsigned suns, unsigned levels, unsigned size)
{
    if (_sunShadows && _sunShadows->suns == suns) levels = std::max(levels, _sunShadows->levels);
    size = SunShadows::sizeOf(suns * levels, size);
    if (!_sunShadows || _sunShadows->suns != suns || _sunShadows->levels != levels || _sunShadows->size != size) {
        dropSunShadows();
        _sunShadows = new SunShadows(suns, levels, size);
        _sunCamera = new StageCamera(*_plainCamera);
        BindTargets::install(*_sunCamera, _sunShadows->targets().maps, nullptr, _failure.get());
    }
    return *_sunShadows;
}

void ViewData::dropSunShadows()
{
    if (_sunShadows) retire(_sunShadows->targets());
    _sunShadows = nullptr;
}

ViewData::State ViewData::state(const StateKey& key)
{
    KeptState& kept = _states[key];
    const bool isNew = !kept.stateSet;
    if (isNew) kept.stateSet = new osg::StateSet;
    kept.lastCull = _cull;
    return {*kept.stateSet, isNew};
}

GpuTimer& ViewData::timer(const std::string& pass)
{
    osg::ref_ptr<GpuTimer>& timer = _timers[pass];
    if (!timer) timer = new GpuTimer;
    return *timer;
}

Frame& ViewData::frame(const osg::Referenced* cullVisitor)
{
    osg::ref_ptr<Frame>& frame = _frames[cullVisitor];
    if (!frame) frame = new Frame;
    frame->lastCull = _cull;
    return *frame;
}

void ViewData::forgetUnused(Frame& current)
{
    const unsigned idle = 4;  // culls; the frames of a view take turns
    current.forgetUnused(*_retired);
    for (auto it = _states.begin(); it != _states.end();) it = it->second.lastCull == _cull ? std::next(it) : _states.erase(it);
    for (auto it = _frames.begin(); it != _frames.end();) {
        const bool used = _cull - it->second->lastCull < idle;
        if (!used) it->second->retire(*_retired);
        it = used ? std::next(it) : _frames.erase(it);
    }
    ++_cull;
}

ViewData::~ViewData()
{
    retireAll();
    for (const auto& [pass, atlas] : _atlases) retire(atlas.maps->targets());
    dropSunShadows();
}

// All that is of the view's size.
void ViewData::retireAll() const
{
    if (_gbuffer) {
        for (const auto* t : {&_gbuffer->albedo, &_gbuffer->normal, &_gbuffer->specular, &_gbuffer->emission, &_gbuffer->depth})
            _retired->add(t->get());
        _retired->add(_gbuffer->frameBuffer());
    }
    for (const auto& [pass, target] : _targets) retire(*target);
    for (const auto& [cullVisitor, frame] : _frames) frame->retire(*_retired);
}

void ViewData::retire(const Target& target) const
{
    for (const auto& t : target.textures) _retired->add(t.get());
    _retired->add(target.frameBuffer.get());
}

void ViewData::retire(const ShadowTargets& targets) const
{
    for (osg::Texture2D* t : targets.textures()) _retired->add(t);
    for (osg::FrameBufferObject* f : targets.frameBuffers()) _retired->add(f);
}

void ViewData::resizeGLObjectBuffers(unsigned maximum)
{
    if (_gbuffer) _gbuffer->resizeGLObjectBuffers(maximum);
    if (_textures) _textures->resizeGLObjectBuffers(maximum);
    for (auto& [pass, atlas] : _atlases) atlas.maps->resizeGLObjectBuffers(maximum);
    if (_sunShadows) _sunShadows->resizeGLObjectBuffers(maximum);
    if (surroundings.seen) surroundings.seen->resizeGLObjectBuffers(maximum);
    for (auto& [name, target] : _targets) {
        for (auto& t : target->textures) t->resizeGLObjectBuffers(maximum);
        target->frameBuffer->resizeGLObjectBuffers(maximum);
    }
    for (auto& [key, kept] : _states) kept.stateSet->resizeGLObjectBuffers(maximum);
    for (auto& [cullVisitor, frame] : _frames) frame->resizeGLObjectBuffers(maximum);
}

void ViewData::releaseGLObjects(osg::State* state) const
{
    if (_gbuffer) _gbuffer->releaseGLObjects(state);
    if (_textures) _textures->releaseGLObjects(state);
    for (const auto& [pass, atlas] : _atlases) atlas.maps->releaseGLObjects(state);
    if (_sunShadows) _sunShadows->releaseGLObjects(state);
    if (surroundings.seen) surroundings.seen->releaseGLObjects(state);
    for (const auto& [name, target] : _targets) {
        for (const auto& t : target->textures) t->releaseGLObjects(state);
        target->frameBuffer->releaseGLObjects(state);
    }
    for (const auto& [key, kept] : _states) kept.stateSet->releaseGLObjects(state);
    for (const auto& [pass, timer] : _timers) timer->releaseGLObjects(state);
    for (const auto& [cullVisitor, frame] : _frames) frame->releaseGLObjects(state);
}

size_t ViewData::bytes() const
{
    const size_t pixels = size_t(_width) * size_t(_height);
    size_t sum = (_gbuffer ? 36 * pixels : 0) + (_sunShadows ? _sunShadows->bytes() : 0);
    for (const auto& [pass, atlas] : _atlases) sum += atlas.maps->bytes();
    for (const auto& [name, target] : _targets) sum += target->bytes();
    for (const auto& [cullVisitor, frame] : _frames) sum += frame->bytes();
    return sum;
}

}  // namespace osgEnvLight
