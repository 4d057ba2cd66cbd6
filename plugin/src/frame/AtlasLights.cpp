// SPDX-License-Identifier: MIT
#include "frame/AtlasLights.h"

#include "gl/RetiredObjects.h"
#include "gl/TargetTexture.h"

#include <utility>

namespace osgEnvLight
{

osg::Texture2D* AtlasLights::texture(const std::string& name, const ShadowAtlas& atlas, const ShadowAtlas* near, double scale)
{
    Entry& e = _entries[name];
    e.used = true;
    const unsigned nearVersion = near ? near->version() : 0;
    const bool same =
        e.atlas == &atlas && e.version == atlas.version() && e.near == near && e.nearVersion == nearVersion && e.scale == scale;
    if (same) return e.texture.get();
    const osg::ref_ptr<osg::Image> image = atlas.lightImage(scale, near);
    const osg::ref_ptr<osg::Texture2D> texture = targetTexture(image->s(), image->t(), GL_RGBA32F_ARB);
    texture->setImage(image);
    e = {texture, &atlas, near, atlas.version(), nearVersion, scale, true};
    return e.texture.get();
}

osg::Texture2D* AtlasLights::nearest(const std::string& name, const ShadowAtlas& atlas)
{
    Entry& e = _entries[name + ", nearest"];
    e.used = true;
    if (e.atlas == &atlas && e.version == atlas.version()) return e.texture.get();
    const osg::ref_ptr<osg::Image> image = atlas.nearestImage();
    const osg::ref_ptr<osg::Texture2D> texture = targetTexture(image->s(), image->t(), GL_RGBA32UI_EXT);
    texture->setImage(image);
    e = {texture, &atlas, nullptr, atlas.version(), 0, 1.0, true};
    return e.texture.get();
}

void AtlasLights::endFrame()
{
    for (auto it = _entries.begin(); it != _entries.end();)
        it = std::exchange(it->second.used, false) ? std::next(it) : _entries.erase(it);
}

size_t AtlasLights::bytes() const
{
    size_t sum = 0;
    for (const auto& [name, e] : _entries) sum += bytesOf(*e.texture);
    return sum;
}

void AtlasLights::resizeGLObjectBuffers(unsigned maximum)
{
    for (auto& [name, e] : _entries) e.texture->resizeGLObjectBuffers(maximum);
}

void AtlasLights::releaseGLObjects(osg::State* state) const
{
    for (const auto& [name, e] : _entries) e.texture->releaseGLObjects(state);
}

}  // namespace osgEnvLight
