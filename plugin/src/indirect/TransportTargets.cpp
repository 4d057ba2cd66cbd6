// SPDX-License-Identifier: MIT
#include "indirect/TransportTargets.h"

#include "gl/RetiredObjects.h"
#include "gl/TargetTexture.h"

namespace osgEnvLight
{

namespace
{

osg::ref_ptr<osg::Texture2D> pointTarget()
{
    return targetTexture(limits::POINT_SIDE, limits::POINT_SIDE, GL_RGBA32F_ARB);
}

}  // namespace

TransportTargets::TransportTargets(int columnCount, int probeCount)
    : columns(columnCount),
      probes(probeCount),
      pointLight(pointTarget()),
      pointRadiance(pointTarget()),
      probeIrradiance(targetTexture(columns * (limits::PROBE_IRRADIANCE_SIDE + 2), columns * (limits::PROBE_IRRADIANCE_SIDE + 2),
                                    GL_RGBA32F_ARB)),
      radianceTarget(frameBufferOf(pointRadiance)),
      harmonicsTarget(new osg::FrameBufferObject),
      irradianceTarget(frameBufferOf(probeIrradiance))
{
    for (size_t i = 0; i < probeHarmonics.size(); ++i) {
        probeHarmonics[i] = targetTexture(limits::PROBE_HARMONICS / limits::HARMONICS_TEXTURES, probes, GL_RGBA32F_ARB);
        harmonicsTarget->setAttachment(osg::Camera::BufferComponent(osg::Camera::COLOR_BUFFER0 + i),
                                       osg::FrameBufferAttachment(probeHarmonics[i]));
    }
    filterLinearly(*probeIrradiance);
}

void TransportTargets::makePointMirrored()
{
    pointMirrored = pointTarget();
}

void TransportTargets::makePointNear()
{
    pointNear = pointTarget();
    nearTarget = frameBufferOf(pointNear);
}

void TransportTargets::makeCellLight(int width, int height)
{
    cellLight = targetTexture(width, height, GL_RGBA32F_ARB);
    filterLinearly(*cellLight);
    cellTarget = frameBufferOf(cellLight);
}

std::vector<osg::FrameBufferObject*> TransportTargets::frameBuffers() const
{
    std::vector<osg::FrameBufferObject*> all = {radianceTarget.get(), harmonicsTarget.get(), irradianceTarget.get()};
    for (const auto& f : {nearTarget, cellTarget})
        if (f) all.push_back(f.get());
    return all;
}

std::vector<osg::Texture2D*> TransportTargets::textures() const
{
    std::vector<osg::Texture2D*> all;
    for (const auto& t : {pointLight, pointMirrored, pointRadiance, probeHarmonics[0], probeHarmonics[1], probeHarmonics[2],
                          probeIrradiance, pointNear, cellLight})
        if (t) all.push_back(t.get());
    return all;
}

size_t TransportTargets::bytes() const
{
    size_t sum = 0;
    for (const osg::Texture2D* t : textures()) sum += bytesOf(*t);
    return sum;
}

void TransportTargets::resizeGLObjectBuffers(unsigned maximum) const
{
    if (probes == 0) return;
    for (osg::Texture2D* t : textures()) t->resizeGLObjectBuffers(maximum);
    for (osg::FrameBufferObject* f : frameBuffers()) f->resizeGLObjectBuffers(maximum);
}

void TransportTargets::releaseGLObjects(osg::State* state) const
{
    if (probes == 0) return;
    for (osg::Texture2D* t : textures()) t->releaseGLObjects(state);
    for (osg::FrameBufferObject* f : frameBuffers()) f->releaseGLObjects(state);
}

}  // namespace osgEnvLight
