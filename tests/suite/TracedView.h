// SPDX-License-Identifier: MIT
// What a renderer's picture of a scene should be.
#pragma once

#include <SceneRenderer.h>

#include <metrics/Mask>
#include <reference/Reference>

/** The scene as the renderer's camera sees it now, by that many samples a pixel.
 * @param antialias  over the pixel, as a still view's average; else at its middle, as a normal frame */
inline osgEnvLight::ReferenceResult tracedView(osgEnvLight::LitScene& lit, SceneRenderer& renderer, unsigned samples,
                                               const std::set<osgEnvLight::Layer>& layers, bool antialias = true,
                                               osgEnvLight::ReferenceOptions::Paths paths = osgEnvLight::ReferenceOptions::DIRECT)
{
    osg::Camera& camera = *renderer.viewer().getCamera();
    std::string error;
    const osg::ref_ptr<const osgEnvLight::RadianceMap> map = lit.getEnvironmentMap()->radiance(error);
    osgEnvLight::SceneReading reading;
    reading.linearColors = lit.getSettings()->materialColors == osgEnvLight::Settings::COLORS_LINEAR;
    reading.sceneLights = lit.getSettings()->sceneLights != osgEnvLight::Settings::SCENE_LIGHTS_OFF;
    if (lit.getSettings()->emissiveMeshes) reading.leastLamp = map->mean;
    const osgEnvLight::TriangleScene triangles =
        osgEnvLight::flattenScene(lit, camera, renderer.viewer().getFrameStamp(), reading);
    const osgEnvLight::RayScene rays(triangles);
    const osgEnvLight::RayCamera eye(camera, lit.getBound());
    const osgEnvLight::EnvironmentMap& turned = *lit.getEnvironmentMap();
    const osgEnvLight::MapEnvironment environment(*map, turned.getRotation(), turned.getIntensity());
    osgEnvLight::ReferenceOptions options;
    options.estimator = osgEnvLight::ReferenceOptions::MIS;
    options.samples = samples;
    options.paths = paths;
    options.antialias = antialias;
    return osgEnvLight::Reference(rays, eye, environment).render(options, layers);
}

/** Of those pixels the ones that no edge crosses. traced: with Layer::BEAUTY, NORMAL and DEPTH. */
inline osgEnvLight::Mask awayFromEdges(const osgEnvLight::Mask& pixels, const osgEnvLight::ReferenceResult& traced)
{
    using osgEnvLight::Layer;
    const Picture beauty = traced.mean(Layer::BEAUTY);
    Picture surface = traced.mean(Layer::NORMAL);
    for (size_t i = 0; i < surface.pixels(); ++i) surface.rgba[4 * i + 3] = beauty.rgba[4 * i + 3];
    return osgEnvLight::withoutEdges(pixels, surface, traced.mean(Layer::DEPTH));
}
