// SPDX-License-Identifier: MIT
#include "node/DarkMap.h"

#include <algorithm>

namespace osgEnvLight
{

namespace
{

// The radiance that a white surface in the middle of the scene has of lamps, about: what half floats count in.
double unitOf(const FrameContext& c)
{
    const double r = c.facts.sceneRadius;
    double sum = 0.0;
    for (const Emitter& light : c.areaLights) sum += light.flux() / (osg::PI * (osg::PI * r * r + light.area));
    for (const SceneLight& light : c.lights) {
        const osg::Vec4f& k = light.falloff;
        const double attenuation = light.position[3] > 0.0f ? std::max(k[0] + r * (k[1] + r * k[2]), 1e-6) : 1.0;
        sum += (light.color[0] + light.color[1] + light.color[2]) / (3.0 * attenuation);
    }
    return std::max(sum, 1e-30);
}

}  // namespace

void darken(FrameContext& c, osg::ref_ptr<MapTextures>& textures)
{
    if (!textures) textures = MapTextures::dark();
    textures->use(MapOptions(c.settings));
    c.textures = textures;
    c.radianceScale = unitOf(c);
    c.frame.setUniforms(c.facts.sceneRadius, c.radianceScale, *c.textures, c.worldFromEye * c.mapFromWorld, c.baseStops);
}

}  // namespace osgEnvLight
