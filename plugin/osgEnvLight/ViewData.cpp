// SPDX-License-Identifier: MIT
#include <osgEnvLight/ViewData>

namespace osgEnvLight
{

Target::Target(int width, int height, const std::vector<GLint>& formats, Failure* failure)
    : frameBuffer(new osg::FrameBufferObject), camera(new StageCamera)
{
    for (size_t i = 0; i < formats.size(); ++i) {
        textures.push_back(targetTexture(width, height, formats[i]));
        frameBuffer->setAttachment(osg::Camera::BufferComponent(osg::Camera::COLOR_BUFFER0 + int(i)),
                                   osg::FrameBufferAttachment(textures.back().get()));
    }
    BindTargets::install(*camera, frameBuffer.get(), nullptr, failure);
}

Frame::Frame()
    : gbufferStage(new osgUtil::RenderStage),
      uniforms(new osg::StateSet),
      _sceneRadius(new osg::Uniform("sceneRadius", 0.0f)),
      _radianceScale(new osg::Uniform("radianceScale", 0.0f)),
      _pyramidSide(new osg::Uniform("pyramidSide", 0.0f)),
      _pyramidLastLevel(new osg::Uniform("pyramidLastLevel", 0.0f)),
      _mapFromEye(new osg::Uniform(osg::Uniform::FLOAT_MAT3, "mapFromEyeForward"))
{
    for (const Settings::Property& p : Settings::table()) {
        const bool real = std::holds_alternative<float Settings::*>(p.member);
        _settings.push_back(new osg::Uniform(real ? osg::Uniform::FLOAT : osg::Uniform::INT, p.name));
        uniforms->addUniform(_settings.back());
    }
    for (osg::Uniform* u :
         {_sceneRadius.get(), _radianceScale.get(), _pyramidSide.get(), _pyramidLastLevel.get(), _mapFromEye.get()})
        uniforms->addUniform(u);
}

void Frame::setUniforms(const Settings& settings, double sceneRadius, double radianceScale, const MapTextures& textures,
                        const osg::Matrixd& mapFromEye)
{
    const auto& table = Settings::table();
    for (size_t i = 0; i < table.size(); ++i) {
        const double value = table[i].get(settings);
        if (_settings[i]->getType() == osg::Uniform::FLOAT)
            _settings[i]->set(float(value));
        else
            _settings[i]->set(int(value));
    }
    _sceneRadius->set(float(sceneRadius));
    _radianceScale->set(float(radianceScale));
    _pyramidSide->set(float(textures.pyramidSide()));
    _pyramidLastLevel->set(float(textures.pyramidLastLevel()));
    osg::Matrix3 m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m(i, j) = float(mapFromEye(i, j));
    _mapFromEye->set(m);
}

osg::StateSet& Frame::atlasState(const ShadowAtlas& atlas, double scale)
{
    if (!_atlasState) {
        _atlasState = new osg::StateSet(*uniforms);
        _atlasState->addUniform(new osg::Uniform("atlasLightMap", int(atlasLightUnit)));
        _atlasState->addUniform(new osg::Uniform("atlasTexel", 0.0f));
    }
    if (_atlas != &atlas || _atlasVersion != atlas.version() || _atlasScale != scale) {
        const osg::ref_ptr<osg::Image> image = atlas.lightImage(scale);
        osg::ref_ptr<osg::Texture2D> texture = targetTexture(image->s(), image->t(), GL_RGBA32F_ARB);
        texture->setImage(image);
        _atlasState->setTextureAttribute(atlasLightUnit, texture);
        _atlasState->getUniform("atlasTexel")->set(float(atlas.texel()));
        _atlas = &atlas;
        _atlasVersion = atlas.version();
        _atlasScale = scale;
    }
    return *_atlasState;
}

void ViewData::fit(int width, int height, MapTextures* textures)
{
    const bool sizeChanged = width != _width || height != _height;
    if (sizeChanged) {
        _width = width;
        _height = height;
        _viewport = new osg::Viewport(0, 0, width, height);
        _gbuffer = nullptr;
        _targets.clear();
        _frames.clear();
    }
    if (sizeChanged || textures != _textures.get()) _states.clear();
    _textures = textures;
}

GBuffer& ViewData::gbuffer()
{
    if (!_gbuffer) _gbuffer = new GBuffer(_width, _height);
    return *_gbuffer;
}

Target& ViewData::target(const std::string& pass, const std::vector<GLint>& formats)
{
    osg::ref_ptr<Target>& target = _targets[pass];
    if (!target || (!formats.empty() && formats.size() != target->textures.size())) {
        target = new Target(_width, _height, formats, _failure.get());
        _states.clear();  // those that read the pass's former target
    }
    return *target;
}

ShadowAtlas& ViewData::atlas(unsigned lights, unsigned size)
{
    if (!_atlas || _atlas->lights != lights || _atlas->size != size) {
        _atlas = new ShadowAtlas(lights, size);
        _atlasCamera = new StageCamera;
        BindTargets::install(*_atlasCamera, _atlas->target(), nullptr, _failure.get());
        _states.clear();  // those that read the former one
    }
    return *_atlas;
}

ViewData::State ViewData::state(const std::string& key)
{
    osg::ref_ptr<osg::StateSet>& stateSet = _states[key];
    const bool isNew = !stateSet;
    if (isNew) stateSet = new osg::StateSet;
    return {*stateSet, isNew};
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
    return *frame;
}

void ViewData::resizeGLObjectBuffers(unsigned maximum)
{
    if (_gbuffer) _gbuffer->resizeGLObjectBuffers(maximum);
    if (_textures) _textures->resizeGLObjectBuffers(maximum);
    if (_atlas) _atlas->resizeGLObjectBuffers(maximum);
    for (auto& [name, target] : _targets) {
        for (auto& t : target->textures) t->resizeGLObjectBuffers(maximum);
        target->frameBuffer->resizeGLObjectBuffers(maximum);
    }
    for (auto& [key, stateSet] : _states) stateSet->resizeGLObjectBuffers(maximum);
    for (auto& [cullVisitor, frame] : _frames) {
        if (frame->composite) frame->composite->resizeGLObjectBuffers(maximum);
        for (auto& [name, pass] : frame->passes) pass->drawable().resizeGLObjectBuffers(maximum);
    }
}

void ViewData::releaseGLObjects(osg::State* state) const
{
    if (_gbuffer) _gbuffer->releaseGLObjects(state);
    if (_textures) _textures->releaseGLObjects(state);
    if (_atlas) _atlas->releaseGLObjects(state);
    for (const auto& [name, target] : _targets) {
        for (const auto& t : target->textures) t->releaseGLObjects(state);
        target->frameBuffer->releaseGLObjects(state);
    }
    for (const auto& [key, stateSet] : _states) stateSet->releaseGLObjects(state);
    for (const auto& [cullVisitor, frame] : _frames) {
        if (frame->composite) frame->composite->releaseGLObjects(state);
        for (const auto& [name, pass] : frame->passes) pass->drawable().releaseGLObjects(state);
    }
}

size_t ViewData::bytes() const
{
    const size_t pixels = size_t(_width) * size_t(_height);
    size_t sum = (_gbuffer ? 36 * pixels : 0) + (_atlas ? _atlas->bytes() : 0);
    for (const auto& [name, target] : _targets)
        for (const auto& t : target->textures) sum += pixels * (t->getInternalFormat() == GL_RGBA32F_ARB ? 16 : 8);
    return sum;
}

}  // namespace osgEnvLight
