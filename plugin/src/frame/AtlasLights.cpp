// SPDX-License-Identifier: MIT
#include "frame/AtlasLights.h"

#include "gl/RetiredObjects.h"
#include "gl/TargetTexture.h"

#include <algorithm>
#include <utility>

namespace osgEnvLight
{

osg::Texture2D* AtlasLights::texture(const std::string& name, const ShadowAtlas& atlas, const ShadowAtlas* near, double scale)
{
    Entry& e = _entries[near ? name + ", with those about the view" : name];
    const unsigned nearVersion = near ? near->version() : 0;
    const bool same =
        e.atlas == &atlas && e.version == atlas.version() && e.near == near && e.nearVersion == nearVersion && e.scale == scale;
    if (same) return kept(e);
    const osg::ref_ptr<osg::Image> image = atlas.lightImage(scale, near);
    renew(e, *image, GL_RGBA32F_ARB);
    e.atlas = &atlas;
    e.near = near;
    e.version = atlas.version();
    e.nearVersion = nearVersion;
    e.scale = scale;
    return e.textures.back().get();
}

osg::Texture2D* AtlasLights::nearest(const std::string& name, const ShadowAtlas& atlas)
{
    Entry& e = _entries[name + ", nearest"];
    if (e.atlas == &atlas && e.version == atlas.version()) return kept(e);
    const osg::ref_ptr<osg::Image> image = atlas.nearestImage();
    renew(e, *image, GL_RGBA32UI_EXT);
    e.atlas = &atlas;
    e.version = atlas.version();
    return e.textures.back().get();
}

osg::Texture2D* AtlasLights::kept(Entry& e)
{
    if (!std::exchange(e.used, true)) e.textures.erase(e.textures.begin(), e.textures.end() - 1);
    return e.textures.back().get();
}

// While maps are drawn anew, in each frame: a texture that no draw holds any more takes the image.
void AtlasLights::renew(Entry& e, osg::Image& image, GLint format)
{
    const auto isOfOtherSize = [&](const auto& t) {
        return t->getTextureWidth() != image.s() || t->getTextureHeight() != image.t();
    };
    const auto isFree = [](const auto& t) { return t->referenceCount() == 1; };
    e.used = true;
    e.textures.erase(std::remove_if(e.textures.begin(), e.textures.end(), isOfOtherSize), e.textures.end());
    const auto free = std::find_if(e.textures.begin(), e.textures.end(), isFree);
    if (free != e.textures.end())
        std::rotate(free, free + 1, e.textures.end());
    else
        e.textures.push_back(targetTexture(image.s(), image.t(), format));
    e.textures.back()->setImage(&image);
}

void AtlasLights::endFrame()
{
    for (auto it = _entries.begin(); it != _entries.end();)
        it = std::exchange(it->second.used, false) ? std::next(it) : _entries.erase(it);
}

size_t AtlasLights::bytes() const
{
    size_t sum = 0;
    for (const auto& [name, e] : _entries)
        for (const auto& t : e.textures) sum += bytesOf(*t);
    return sum;
}

void AtlasLights::resizeGLObjectBuffers(unsigned maximum)
{
    for (auto& [name, e] : _entries)
        for (const auto& t : e.textures) t->resizeGLObjectBuffers(maximum);
}

void AtlasLights::releaseGLObjects(osg::State* state) const
{
    for (const auto& [name, e] : _entries)
        for (const auto& t : e.textures) t->releaseGLObjects(state);
}

}  // namespace osgEnvLight
