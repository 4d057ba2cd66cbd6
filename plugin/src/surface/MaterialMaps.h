/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

namespace osgEnvLight
{

/** The uniforms by which a state set has what a Material adds to its BRDF; of a map: a sampler, whose value is the texture's
 * unit; with the suffix TexCoord the array of texture coordinates (0 or 1), with Transform a mat3 for (s, t, 1). As
 * pass/materialmaps.glsl reads them.*/
struct MaterialMaps {
    static constexpr const char* normal = "envlightNormalMap";
    static constexpr const char* metalRough = "envlightMetalRoughMap";
    static constexpr const char* emissionMap = "envlightEmissionMap";
    static constexpr const char* anisotropyMap = "envlightAnisotropyMap";
    static constexpr const char* coatMap = "envlightCoatMap";
    static constexpr const char* coatRoughnessMap = "envlightCoatRoughnessMap";
    static constexpr const char* coatNormalMap = "envlightCoatNormalMap";
    /** In the order of SurfaceSorter's variants; from firstOfCoat on they are of the coat. */
    static constexpr const char* samplers[] = {normal,  metalRough,       emissionMap,  anisotropyMap,
                                               coatMap, coatRoughnessMap, coatNormalMap};
    static constexpr unsigned ofEmission = 2;
    static constexpr unsigned ofAnisotropy = 3;
    static constexpr unsigned firstOfCoat = 4;

    static constexpr const char* vertexColors = "envlightVertexColors";  // bool: in place of the base colour
    static constexpr const char* normalScale = "envlightNormalScale";
    static constexpr const char* normalUp = "envlightNormalUp";  // -1: the second coordinate is 0 at the top
    static constexpr const char* coatNormalScale = "envlightCoatNormalScale";
    static constexpr const char* coatNormalUp = "envlightCoatNormalUp";
    static constexpr const char* emission = "envlightEmission";            // linear
    static constexpr const char* light = "envlightLight";                  // radiance of an AreaLight's surface
    static constexpr const char* lightMode = "envlightLightMode";          // a Material::LightMode
    static constexpr const char* shadowCatcher = "envlightShadowCatcher";  // bool
    static constexpr const char* dielectric = "envlightDielectric";
    static constexpr const char* edge = "envlightEdge";  // of metal: the argument of edgeLoss()
    static constexpr const char* diffuseRoughness = "envlightDiffuseRoughness";
    static constexpr const char* coat = "envlightCoat";
    static constexpr const char* coatRoughness = "envlightCoatRoughness";
    static constexpr const char* anisotropy = "envlightAnisotropy";
    static constexpr const char* anisotropyDirection = "envlightAnisotropyDirection";  // cosine and sine of its rotation
    static constexpr const char* anisotropyTexCoord = "envlightAnisotropyTexCoord";    // whose tangents it goes by
    static constexpr const char* anisotropyUp = "envlightAnisotropyUp";                // as normalUp
};

}  // namespace osgEnvLight
