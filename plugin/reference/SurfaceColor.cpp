// SPDX-License-Identifier: MIT
#include <reference/RayScene>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// Of display values, as OpenGL's fixed function combines them.
glm::dvec4 combined(const SurfaceMaterial& m, const glm::dvec4& base, const glm::dvec4& texel)
{
    const glm::dvec3 below(glsl::srgbEncode3(glsl::vec3(base))), above(glsl::srgbEncode3(glsl::vec3(texel)));
    glm::dvec3 sum;
    if (m.textureMode == SurfaceState::TEXTURE_DECAL) sum = below + (above - below) * texel.a;
    if (m.textureMode == SurfaceState::TEXTURE_BLENDS) sum = below * (1.0 - above) + m.textureColor * above;
    if (m.textureMode == SurfaceState::TEXTURE_ADDS) sum = glm::min(below + above, 1.0);
    const double alpha = m.textureMode == SurfaceState::TEXTURE_DECAL ? base.a : base.a * texel.a;
    return glm::dvec4(glm::dvec3(glsl::srgbDecode3(glsl::vec3(sum))), alpha);
}

}  // namespace

glm::dvec4 surfaceColor(const SurfaceHit& hit, const glm::dvec2& dx, const glm::dvec2& dy)
{
    const TriangleMesh& mesh = *hit.mesh;
    const SurfaceMaterial& m = mesh.material;
    glm::dvec4 base = m.vertexColored ? hit.interpolate(mesh.colors) : m.color;
    if (m.encoded) base = glm::dvec4(glsl::typedDecode3(glsl::vec3(base)), base.a);
    if (!m.texture) return base;
    const glm::dvec4 texel = m.texture->sample(hit.interpolate(mesh.texCoords), dx, dy);
    if (m.textureMode == SurfaceState::TEXTURE_REPLACES) return texel;
    if (m.textureMode == SurfaceState::TEXTURE_MODULATES) return base * texel;
    return combined(m, base, texel);
}

}  // namespace osgEnvLight
