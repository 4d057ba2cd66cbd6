// SPDX-License-Identifier: MIT
#include "passes/Inputs.h"

#include <osgEnvLight/Material>

#include "base/Limits.h"
#include "shadow/LitSides.h"

#include <algorithm>

#include "glsl.h"

namespace osgEnvLight
{

TextureDesc ofFirstFrame(const FrameContext& c, GLint format, int side)
{
    return {format, side, c.still != nullptr};
}

void drawSurfaces(PassBuilder& b)
{
    b.drawMarked(b.find("pixel marks"), limits::MARK_SURFACE);
}

void drawGlossy(PassBuilder& b)
{
    b.drawMarked(b.find("pixel marks"), limits::MARK_GLOSSY);
}

void defineLobes(PassBuilder& b, unsigned lobes)
{
    b.define("HAS_PHONG", lobes >> Material::PHONG & 1);
    b.define("HAS_COOK_TORRANCE", lobes >> Material::COOK_TORRANCE & 1);
    b.define("HAS_BLINN_PHONG", lobes >> Material::BLINN_PHONG & 1);
    b.define("HAS_BECKMANN", lobes >> Material::BECKMANN & 1);
    b.define("HAS_STRAUSS", lobes >> Material::STRAUSS & 1);
}

void readLobes(PassBuilder& b, const FrameContext& c)
{
    defineLobes(b, c.facts.surfaces.lobes);
    const unsigned microfacets = 1u << Material::COOK_TORRANCE | 1u << Material::BLINN_PHONG | 1u << Material::BECKMANN;
    if (c.facts.surfaces.lobes & (microfacets | SurfaceKinds::COATS)) b.bind(c.albedoTable, "albedoTable");
}

void readIrradiance(PassBuilder& b, FrameContext& c)
{
    const DiffuseCarrier& carrier = c.facts.carrier;
    const unsigned kinds = c.facts.surfaces.lobes | c.facts.surfaces.forwardLobes;
    if (!c.decisions.light.needed) return;
    if (carrier.lights) {
        b.define("DIFFUSE_LIGHTS");
        b.bind(c.textures->irradiance(), "irradianceMap");
    } else {
        b.define(carrier.harmonics == 9 ? "DIFFUSE_SH_9" : "DIFFUSE_SH_18");
    }
    // Rough layers ask them about the map's differences between directions, too.
    if (!carrier.lights || kinds & SurfaceKinds::ROUGH_DIFFUSE) b.uniform(c.textures->harmonics());
}

void readSuns(PassBuilder& b, FrameContext& c)
{
    b.define("ONE_SUN", c.textures->suns().size() == 1);
    std::vector<osg::ref_ptr<osg::Uniform>> uniforms;
    c.textures->addSuns(uniforms);
    for (const auto& u : uniforms) b.uniform(u.get());
}

bool readSunVisibility(PassBuilder& b)
{
    if (!b.read("sun visibility 0", "sunVisibilityMap0")) return false;
    b.define("HAS_SUN_SHADOWS");
    if (!b.read("sun visibility 1", "sunVisibilityMap1")) b.read("sun visibility 0", "sunVisibilityMap1");
    return true;
}

void readSkyMaps(PassBuilder& b, FrameContext& c, const std::string& name, ShadowAtlas& maps, ShadowAtlas* near)
{
    b.bind(maps.texture(), "atlasMap");
    if (near) {
        b.define("HAS_NEIGHBOURHOOD");
        b.bind(near->texture(), "finerAtlasMap");
    }
    b.bind(c.atlasLights.texture(name, maps, near, 1.0 / c.textures->map().mean), "atlasLightMap");
    b.frameUniforms(&c.frame.atlasState(name, maps, near));
    b.shadowOrigin(maps.origin());
}

bool readFog(PassBuilder& b, FrameContext& c)
{
    if (c.fog.kind == 0) return false;
    osg::Vec3f radiance = c.fog.color;
    for (float& v : radiance._v) {
        const double linear = c.settings.materialColors == Settings::COLORS_SRGB ? glsl::typedDecode(double(v)) : double(v);
        v = float(linear * c.emittedScale());
    }
    b.define("HAS_FOG");
    b.frameUniforms(&c.frame.fogState(c.fog, radiance));
    return true;
}

// Of areaPoints, where lights are many. From above a city of 1000 lamps, 1, 2 and 4 times 64 differ from the truth by .42, .36
// and .35 (RMS), in 26, 42 and 75 ms.
const int mostPointsOver = 2;

unsigned wholeGroups(int count)
{
    return (unsigned(count) + limits::LIGHT_GROUPS - 1) / limits::LIGHT_GROUPS * limits::LIGHT_GROUPS;
}

unsigned areaPointsOf(const FrameContext& c)
{
    const int points = c.settings.areaPoints, most = int(Settings::find("areaPoints")->maximum);
    return wholeGroups(std::clamp(int(countLitSides(c.areaLights)), points, std::min(mostPointsOver * points, most)));
}

void readEmitterPoints(PassBuilder& b, const EmitterMaps& maps, osg::Texture2D* points)
{
    b.bind(maps.targets().texture.get(), "emitterMaps");
    b.bind(points, "emitterPointMap");
}

void readSceneLightMaps(PassBuilder& b, const FrameContext& c)
{
    b.bind(c.sceneLightMaps->targets().texture.get(), "sceneLightMaps");
    b.bind(c.sceneLightPoints, "sceneLightPointMap");
}

void readSunMaps(PassBuilder& b, FrameContext& c)
{
    b.bind(c.sunMaps->texture(), "sunShadowMaps");
    b.frameUniforms(&c.frame.sunState(*c.sunMaps));
    b.shadowOrigin(c.sunMaps->targets().origin);
}

FrameResources::Places pixelPlaces(const FrameContext& c)
{
    FrameResources::Places places;
    places.inEye = osg::Matrixd::translate(c.indirect->scene->origin) * osg::Matrixd::inverse(c.worldFromEye);
    return places;
}

void readReceivedLight(PassBuilder& b, FrameContext& c, const std::string& pass, const ShadowAtlas& maps)
{
    const osg::Vec3d& origin = c.indirect->scene->origin;
    FrameResources::Places places = pixelPlaces(c);
    places.inAtlas = origin - maps.origin();
    b.define("MAP_IS_BLACK", c.facts.mapIsBlack);
    if (c.emitterMaps) {
        b.define("HAS_AREA_LIGHTS");
        readEmitterPoints(b, *c.emitterMaps, c.emitterPoints);
        places.inEmitterMaps = origin - c.emitterMaps->origin();
    }
    if (c.sceneLightMaps) {
        b.define("HAS_SCENE_LIGHT_MAPS");
        b.settings<SurfaceSettings>();
        readSceneLightMaps(b, c);
        b.frameUniforms(&c.frame.sceneLightState());
        places.inSceneLightMaps = origin - c.sceneLightMaps->origin();
    }
    b.frameUniforms(&c.frame.placeState(pass, places));
}

void readProbes(PassBuilder& b, const IndirectLight& light)
{
    b.define("HAS_PROBE_LATTICES", light.scene->lattices > 0);
    b.bind(light.scene->probePlaces, "probePlaceMap");
    b.bind(light.scene->probeDepths, "probeDepthMap");
    b.bind(light.targets.probeIrradiance, "probeIrradianceMap");
    b.frameUniforms(light.scene->uniforms);
}

void readTracedScene(PassBuilder& b, const IndirectLight& light)
{
    b.settings<SurfaceSettings>();
    b.bind(light.scene->rays->nodes, "rayNodeMap");
    b.bind(light.scene->rays->triangles, "rayTriangleMap");
    b.bind(light.surfaceColors, "surfaceColorMap");
}

void readDiffuseTerms(PassBuilder& b, const FrameContext& c)
{
    b.read("emission", "emissionMap");
    if (b.read("diffuse", "diffuseTermMap")) b.define("HAS_DIFFUSE");
    if (b.read("sun diffuse", "sunDiffuseMap")) b.define("HAS_SUNS");
    if (b.read("sun shaded", "sunShadedMap")) b.define("HAS_SUN_SHADOWS");
    if (b.read("occlusion", "occlusionTermMap")) b.define("HAS_OCCLUSION");
    b.define("COMBINE_SUBTRACT", c.settings.combine == Settings::SUBTRACT);
}

bool lobesShowScene(const FrameContext& c)
{
    return c.settings.reflections > Settings::REFLECTIONS_MAP;
}

void readTerms(PassBuilder& b, FrameContext& c)
{
    readDiffuseTerms(b, c);
    if (b.read("specular", "specularTermMap")) b.define("HAS_SPECULAR");
    const bool probes = b.read("indirect", "indirectMap");
    b.define("HAS_PROBES", probes);
    const bool bounces = probes || b.read("bounce", "bounceMap");
    b.define("HAS_BOUNCE", bounces && !probes);
    if (b.read("lobe rays", "reflectedMap") || b.read("reflected", "reflectedMap"))
        b.define("HAS_REFLECTED");
    else if (bounces && lobesShowScene(c) && b.read("blocked lobe", "blockedLobeMap")) {
        b.define("HAS_LOBES");
        b.read("blocked coat", "blockedCoatMap");
        b.read("mirrored", "mirroredMap");
    }
}

void readBackground(PassBuilder& b, FrameContext& c)
{
    b.define("BACKGROUND", c.background != Settings::BACKGROUND_OFF);
    if (c.background == Settings::BACKGROUND_BLUR) {
        b.define("BACKGROUND_BLUR");
        b.bind(c.textures->pyramid(), "pyramidMap");
        b.settings<BackgroundSettings>();
    }
    if (c.background == Settings::BACKGROUND_ON) b.bind(c.textures->latlong(), "latlongMap");
}

bool isMapOnGround(const FrameContext& c)
{
    return c.ground && c.settings.groundMapHeight > 0.0f && c.background != Settings::BACKGROUND_OFF;
}

// The map is infinitely far from so many heights of its camera on. It lies on the ground up to a quarter of that distance. What
// stands up in the map is stretched over the ground: with 16, streaks are seen on a roof and on a quay. With 7, lines bend near
// the scene.
const double heightsToFar = 10.0;

void readCatchers(PassBuilder& b, FrameContext& c)
{
    if (c.facts.surfaces.catchers == 0) return;
    b.define("HAS_CATCHERS");
    b.define("VEIL_LINEAR", c.background == Settings::BACKGROUND_OFF && c.settings.output == Settings::LINEAR);
    if (!isMapOnGround(c)) return;
    const double height = double(c.settings.groundMapHeight);
    const double reach = std::min(heightsToFar * height, c.ground->halfSide());
    const osg::Vec3d camera = c.ground->origin() + osg::Vec3d(0, 0, height);
    b.define("MAP_ON_GROUND");
    b.frameUniforms(&c.frame.groundState(osg::Vec4f(camera * osg::Matrixd::inverse(c.worldFromEye), float(reach))));
}

void readPicture(PassBuilder& b, FrameContext& c)
{
    readTerms(b, c);
    readCatchers(b, c);
    readBackground(b, c);
}

}  // namespace osgEnvLight
