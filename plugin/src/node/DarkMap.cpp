// SPDX-License-Identifier: MIT
#include "node/DarkMap.h"

#include <algorithm>

namespace osgEnvLight
{

namespace
{

// The radiance that a white surface in the middle of the scene has of area lights, about: what half floats count in.
double unitOf(const std::vector<Emitter>& lights, double sceneRadius)
{
    double sum = 0.0;
    for (const Emitter& light : lights) sum += light.flux() / (osg::PI * (osg::PI * sceneRadius * sceneRadius + light.area));
    return std::max(sum, 1e-30);
}

}  // namespace

void darken(FrameContext& c, osg::ref_ptr<MapTextures>& textures)
{
    if (!textures) textures = MapTextures::dark();
    textures->use(MapOptions(c.settings));
    c.textures = textures;
    c.radianceScale = unitOf(c.areaLights, c.facts.sceneRadius);
    c.frame.setUniforms(c.facts.sceneRadius, c.radianceScale, *c.textures, c.worldFromEye * c.mapFromWorld, c.baseStops);
}

}  // namespace osgEnvLight
