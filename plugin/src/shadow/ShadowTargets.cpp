// SPDX-License-Identifier: MIT
#include "shadow/ShadowTargets.h"

#include "gl/TargetTexture.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

ShadowTargets::ShadowTargets(unsigned mapSize, unsigned columnCount, unsigned rows, unsigned batchSize, GLint mapFormat,
                             GLint slopeFormat)
    : size(mapSize),
      columns(columnCount),
      batch(batchSize),
      texture(targetTexture(int(columns * size), int(rows * size), mapFormat)),
      firstDepth(targetTexture(int(batch * size), int(size), GL_DEPTH_COMPONENT24)),
      firstSlope(targetTexture(int(batch * size), int(size), slopeFormat)),
      secondDepth(targetTexture(int(batch * size), int(size), GL_DEPTH_COMPONENT24)),
      maps(frameBufferOf(texture.get())),
      first(frameBufferOf(firstSlope.get(), firstDepth.get())),
      second(frameBufferOf(firstSlope.get(), secondDepth.get()))
{
}

void ShadowTargets::resizeGLObjectBuffers(unsigned maximum) const
{
    for (osg::Texture2D* t : textures()) t->resizeGLObjectBuffers(maximum);
    for (osg::FrameBufferObject* f : frameBuffers()) f->resizeGLObjectBuffers(maximum);
}

void ShadowTargets::releaseGLObjects(osg::State* state) const
{
    for (osg::Texture2D* t : textures()) t->releaseGLObjects(state);
    for (osg::FrameBufferObject* f : frameBuffers()) f->releaseGLObjects(state);
}

MapRegion MapRegion::within(unsigned size) const
{
    const int side = int(size);
    return {std::clamp(left, 0, side), std::clamp(bottom, 0, side), std::clamp(right, 0, side), std::clamp(top, 0, side)};
}

osg::Matrixd MapRegion::projection(const osg::Matrixd& whole, unsigned size) const
{
    const MapRegion r = within(size);
    const double wide = double(r.right - r.left) / size, high = double(r.top - r.bottom) / size;
    const double x = double(r.left + r.right) / size - 1.0, y = double(r.bottom + r.top) / size - 1.0;
    osg::Matrixd zoom;
    zoom(0, 0) = 1.0 / wide;
    zoom(1, 1) = 1.0 / high;
    zoom(3, 0) = -x / wide;
    zoom(3, 1) = -y / high;
    return whole * zoom;
}

MapRegion regionOf(const ChangedPart& changed, const osg::Matrixd& projection, const osg::Vec3d& origin, unsigned size)
{
    if (changed.isWhole()) return {};
    const double margin = 2.0;  // texels: of edges that graze a texel, and of what bounds are rounded to
    osg::BoundingBoxd shown;
    for (unsigned i = 0; i < 8 && changed.box().valid(); ++i) {
        const osg::Vec4d p = osg::Vec4d(changed.box().corner(i) - origin, 1.0) * projection;
        if (!(p[3] > 0.0)) return {};  // a part lies behind the light
        const osg::Vec2d texel = (osg::Vec2d(p[0], p[1]) / p[3] + osg::Vec2d(1.0, 1.0)) * 0.5 * size;
        shown.expandBy(osg::Vec3d(texel, 0.0));
    }
    if (!shown.valid()) return {0, 0, 0, 0};
    const auto texel = [&](double x) { return int(std::clamp(x, 0.0, double(size))); };
    return {texel(std::floor(shown.xMin() - margin)), texel(std::floor(shown.yMin() - margin)),
            texel(std::ceil(shown.xMax() + margin)), texel(std::ceil(shown.yMax() + margin))};
}

void KeptMap::noteChange(const ChangedPart& part, const osg::Vec3d& origin, unsigned size)
{
    if (drawn && regionOf(part, projection, origin, size).isEmpty()) return;
    outdated = true;
    changed.add(part);
}

MapRegion KeptMap::draw(const osg::Matrixd& newProjection, const osg::Vec3d& origin, unsigned size)
{
    const bool stands = drawn && projection == newProjection;
    const MapRegion region = stands ? regionOf(changed, projection, origin, size) : MapRegion();
    projection = newProjection;
    changed = ChangedPart();
    drawn = true;
    outdated = false;
    age = 0;
    return region;
}

}  // namespace osgEnvLight
