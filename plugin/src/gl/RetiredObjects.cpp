// SPDX-License-Identifier: MIT
#include "gl/RetiredObjects.h"

#include <algorithm>

namespace osgEnvLight
{

namespace
{

size_t texelBytes(GLint format)
{
    switch (format) {
        case GL_RGBA32F_ARB:
        case GL_RGBA32UI_EXT:
            return 16;
        case GL_RGB32F_ARB:
            return 12;
        case GL_RGB16F_ARB:
            return 6;
        case GL_R32F:
        case GL_RG16:
        case GL_RG16F:
        case GL_RGBA8:
        case GL_DEPTH_COMPONENT24:
            return 4;
        case GL_DEPTH_COMPONENT16:
            return 2;
        default:
            return 8;
    }
}

}  // namespace

size_t bytesOf(const osg::Texture2D& texture)
{
    return size_t(texture.getTextureWidth()) * size_t(texture.getTextureHeight()) * texelBytes(texture.getInternalFormat());
}

void RetiredObjects::add(osg::Object* object)
{
    if (!object) return;
    std::lock_guard<std::mutex> lock(_mutex);
    _objects.erase(std::remove_if(_objects.begin(), _objects.end(), [](const auto& o) { return !o.valid(); }), _objects.end());
    _objects.emplace_back(object);
}

size_t RetiredObjects::bytes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    size_t sum = 0;
    for (const auto& object : _objects) {
        osg::ref_ptr<osg::Object> alive;
        if (!object.lock(alive)) continue;
        if (const auto* texture = dynamic_cast<const osg::Texture2D*>(alive.get())) sum += bytesOf(*texture);
    }
    return sum;
}

void RetiredObjects::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& object : _objects) {
        osg::ref_ptr<osg::Object> alive;
        if (object.lock(alive)) alive->releaseGLObjects(state);
    }
}

}  // namespace osgEnvLight
