// SPDX-License-Identifier: MIT
#include "frame/TexturePool.h"

#include "gl/BindTargets.h"
#include "gl/TargetTexture.h"

#include <limits>

namespace osgEnvLight
{

namespace
{

const int always = std::numeric_limits<int>::max();

}  // namespace

void TexturePool::beginFrame()
{
    for (Entry& e : _entries) e.busyUntil = -1;
    for (auto& [textures, used] : _targets) used.used = false;
}

osg::ref_ptr<osg::Texture2D> TexturePool::make(const Size& size, int last, const std::string& name)
{
    _entries.push_back({targetTexture(size.width, size.height, size.format), size, last, name});
    if (size.linear) filterLinearly(*_entries.back().texture);
    return _entries.back().texture;
}

osg::ref_ptr<osg::Texture2D> TexturePool::transient(const Size& size, int first, int last)
{
    for (Entry& e : _entries)
        if (e.keptName.empty() && e.size == size && e.busyUntil < first) {
            e.busyUntil = last;
            return e.texture;
        }
    return make(size, last, "");
}

osg::ref_ptr<osg::Texture2D> TexturePool::kept(const std::string& name, const Size& size)
{
    for (Entry& e : _entries)
        if (e.keptName == name && e.size == size) {
            e.busyUntil = always;
            return e.texture;
        }
    return make(size, always, name);
}

RenderTarget& TexturePool::target(const std::vector<osg::ref_ptr<osg::Texture2D>>& colors,
                                  const osg::ref_ptr<osg::Texture2D>& marks)
{
    std::vector<osg::ref_ptr<osg::Texture2D>> textures = colors;
    if (marks) textures.push_back(marks);
    std::vector<osg::Texture2D*> key;
    for (const auto& t : textures) key.push_back(t.get());
    Used& used = _targets[key];
    used.used = true;
    if (used.target) return *used.target;
    used.target = new RenderTarget;
    RenderTarget& target = *used.target;
    target.textures = textures;
    target.frameBuffer = new osg::FrameBufferObject;
    for (size_t i = 0; i < colors.size(); ++i)
        target.frameBuffer->setAttachment(osg::Camera::BufferComponent(osg::Camera::COLOR_BUFFER0 + int(i)),
                                          osg::FrameBufferAttachment(colors[i].get()));
    if (marks) target.frameBuffer->setAttachment(osg::Camera::DEPTH_BUFFER, osg::FrameBufferAttachment(marks.get()));
    target.viewport = new osg::Viewport(0, 0, textures[0]->getTextureWidth(), textures[0]->getTextureHeight());
    target.state = new osg::StateSet;
    target.state->setAttribute(target.viewport.get());
    target.camera = new StageCamera;
    BindTargets::install(*target.camera, target.frameBuffer.get(), _failure.get());
    return target;
}

void TexturePool::endFrame()
{
    for (auto it = _targets.begin(); it != _targets.end();) {
        if (!it->second.used) _retired->add(it->second.target->frameBuffer.get());
        it = it->second.used ? std::next(it) : _targets.erase(it);
    }
    for (auto it = _entries.begin(); it != _entries.end();) {
        const bool used = it->busyUntil >= 0;
        if (!used) _retired->add(it->texture.get());
        it = used ? std::next(it) : _entries.erase(it);
    }
}

void TexturePool::clear()
{
    beginFrame();
    endFrame();
}

size_t TexturePool::bytes() const
{
    size_t sum = 0;
    for (const Entry& e : _entries) sum += bytesOf(*e.texture);
    return sum;
}

void TexturePool::resizeGLObjectBuffers(unsigned maximum)
{
    for (Entry& e : _entries) e.texture->resizeGLObjectBuffers(maximum);
    for (auto& [textures, used] : _targets) used.target->frameBuffer->resizeGLObjectBuffers(maximum);
}

void TexturePool::releaseGLObjects(osg::State* state) const
{
    for (const Entry& e : _entries) e.texture->releaseGLObjects(state);
    for (const auto& [textures, used] : _targets) used.target->frameBuffer->releaseGLObjects(state);
}

}  // namespace osgEnvLight
