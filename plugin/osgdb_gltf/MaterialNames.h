// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/Material>

namespace osgEnvLight::gltf
{

/** Where the reader puts what a material of a glTF file says: the one list of units, uniforms and vertex attributes.
 *
 * A lit surface has an osg::Material (diffuse: base colour, emission: emissive colour, both as display values; alpha) and the
 * uniforms of osgEnvLight::Material::setCookTorrance (linear base colour, metalness, roughness). If a
 * primitive has vertex colours, the reader multiplies them by the base colour, stores display values as the geometry's colours,
 * and calls osgEnvLight::Material::setVertexColors(). KHR_materials_unlit has neither: GL_LIGHTING is off and the colours are the
 * vertices'.
 *
 * unit  texture (attribute)          colours  mode  sampler uniform
 *    0  base colour                  sRGB     on    -
 *    1  normals, tangent space       linear   off   envlightNormalMap
 *    2  G roughness, B metalness     linear   off   envlightMetalRoughMap
 *    3  R occlusion                  linear   off   envlightOcclusionMap
 *    4  emission                     sRGB     off   envlightEmissionMap
 *    5  R clear coat                 linear   off   envlightCoatMap
 *    6  G roughness of the coat      linear   off   envlightCoatRoughnessMap
 *    7  normals of the coat          linear   off   envlightCoatNormalMap
 *    8  RG direction, B strength of  linear   off   envlightAnisotropyMap
 *       anisotropy
 *
 * Units without a mode are invisible to fixed function. sRGB: the texels are display values, which the shader decodes. A one or
 * two channel image is GL_LUMINANCE or GL_LUMINANCE_ALPHA. Row 0 of an image is the top of the picture, where the second
 * coordinate is 0; green of a normal map points to the top.
 *
 * Each map has beside its sampler X an int XTexCoord, the array of texture coordinates (osg::Geometry::getTexCoordArray) that it
 * takes, and a mat3 XTransform for (s, t, 1) (KHR_texture_transform; the identity without). The array that unit 0 takes is array
 * 0, so that fixed function reads it; its transform is an osg::TexMat.
 *
 * uniform                   type   factor of
 * envlightNormalScale       float  x and y of the normal map; with envlightNormalMap
 * envlightNormalUp          float  -1: green points to where the second coordinate is 0; with envlightNormalMap
 * envlightCoatNormalScale   float  as envlightNormalScale, with envlightCoatNormalMap
 * envlightCoatNormalUp      float  as envlightNormalUp, with envlightCoatNormalMap
 * envlightOcclusionStrength float  with envlightOcclusionMap
 * envlightEmission          vec3   envlightEmissionMap; linear radiance: emissiveFactor times emissiveStrength
 * envlightCoat              float  KHR_materials_clearcoat, as osgEnvLight::Material::setCoat() sets it
 * envlightCoatRoughness     float  KHR_materials_clearcoat
 * envlightAnisotropy...            KHR_materials_anisotropy, as osgEnvLight::Material::setAnisotropy() sets it
 * envlightDielectric        vec3   KHR_materials_ior and KHR_materials_specular, as osgEnvLight::Material::setDielectric() sets
 * it
 *
 * With envlightEmissionMap the osg::Material emits nothing, or all of the surface would glow where the map is not read.
 *
 * A uniform is there only where the file says something: that is how to see which features a surface has.
 *
 * Vertex attribute 6 is the tangent, vec4, w the sign of the bitangent cross(normal, tangent). Skins and morph targets leave it
 * as it is at rest. Files without tangents have none: derive them from the coordinates of the normal map. Without normals there
 * is no normal array: faces are flat. */
struct MaterialNames {
    enum Unit { BASE_COLOR, NORMAL, METAL_ROUGH, OCCLUSION, EMISSION, COAT, COAT_ROUGHNESS, COAT_NORMAL, ANISOTROPY };
    static constexpr const char* sampler[] = {
        nullptr,           "envlightNormalMap",        "envlightMetalRoughMap", "envlightOcclusionMap", "envlightEmissionMap",
        "envlightCoatMap", "envlightCoatRoughnessMap", "envlightCoatNormalMap", "envlightAnisotropyMap"};
    static constexpr const char* texCoordSuffix = "TexCoord";
    static constexpr const char* transformSuffix = "Transform";

    static constexpr const char* normalScale = "envlightNormalScale";
    static constexpr const char* normalUp = "envlightNormalUp";
    static constexpr const char* coatNormalScale = "envlightCoatNormalScale";
    static constexpr const char* coatNormalUp = "envlightCoatNormalUp";
    static constexpr const char* occlusionStrength = "envlightOcclusionStrength";
    static constexpr const char* emission = "envlightEmission";

    static constexpr unsigned tangentAttribute = Material::tangentAttribute;
};

}  // namespace osgEnvLight::gltf
