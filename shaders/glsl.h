// SPDX-License-Identifier: MIT
// Compiles the function files of lib/ as C++: GLSL's names come from GLM, its float is a double. The CPU's side of every
// formula, and the more precise twin that the GPU's is tested against. Include with this folder on the path.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-const-variable"
#ifdef __clang__
#pragma clang diagnostic ignored "-Wkeyword-macro"
#endif
namespace glsl
{
namespace
{

using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
using ivec2 = glm::ivec2;
using mat3 = glm::dmat3;
using mat4 = glm::dmat4;
using uint = glm::uint;
using uvec3 = glm::uvec3;
using glm::abs;
using glm::acos;
using glm::atan;
using glm::ceil;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::exp2;
using glm::floor;
using glm::fract;
using glm::inversesqrt;
using glm::length;
using glm::log;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::pow;
using glm::sign;
using glm::sin;
using glm::sqrt;
using glm::tan;
using glm::transpose;

// A texture of RGBA floats, row 0 at the bottom, clamped to its edge.
struct sampler2D {
    const float* texels;
    int width;
    int height;
};

inline ivec2 textureSize(const sampler2D& s, int)
{
    return ivec2(s.width, s.height);
}

inline vec4 texelFetch(const sampler2D& s, ivec2 p, int)
{
    int x = std::min(std::max(p.x, 0), s.width - 1);
    int y = std::min(std::max(p.y, 0), s.height - 1);
    const float* t = s.texels + 4 * (y * s.width + x);
    return vec4(t[0], t[1], t[2], t[3]);
}

inline vec4 textureLod(const sampler2D& s, vec2 st, double)
{
    vec2 p = st * vec2(s.width, s.height) - 0.5;
    ivec2 i(floor(p));
    vec2 f = p - vec2(i);
    vec4 below = mix(texelFetch(s, i, 0), texelFetch(s, ivec2(i.x + 1, i.y), 0), f.x);
    vec4 above = mix(texelFetch(s, ivec2(i.x, i.y + 1), 0), texelFetch(s, ivec2(i.x + 1, i.y + 1), 0), f.x);
    return mix(below, above, f.y);
}

// Confined to these lines, after every standard header: GLSL's float is the oracle's double.
#define float double
#define HAS_PHONG
#define HAS_COOK_TORRANCE
#define HAS_BLINN_PHONG
#define HAS_BECKMANN
#define HAS_STRAUSS
#define HAS_COATS
#define HAS_ANISOTROPY
#define HAS_EDGES
#include "lib/anisotropy.glsl"
#include "lib/antialias.glsl"
#include "lib/atlas.glsl"
#include "lib/bilateral.glsl"
#include "lib/beckmann.glsl"
#include "lib/blinn.glsl"
#include "lib/bsdf.glsl"
#include "lib/bulge.glsl"
#include "lib/coat.glsl"
#include "lib/colorbox.glsl"
#include "lib/constants.glsl"
#include "lib/depth.glsl"
#include "lib/disc.glsl"
#include "lib/emittermap.glsl"
#include "lib/farlight.glsl"
#include "lib/fog.glsl"
#include "lib/frame.glsl"
#include "lib/errorfunction.glsl"
#include "lib/fresnel.glsl"
#include "lib/ggx.glsl"
#include "lib/glint.glsl"
#include "lib/guide.glsl"
#include "lib/latlong.glsl"
#include "lib/lightcut.glsl"
#include "lib/lobesample.glsl"
#include "lib/ltc.glsl"
#include "lib/march.glsl"
#include "lib/metering.glsl"
#include "lib/octahedral.glsl"
#include "lib/opensky.glsl"
#include "lib/phong.glsl"
#include "lib/polygon.glsl"
#include "lib/prefiltered.glsl"
#include "lib/roughdiffuse.glsl"
#include "lib/roughdiffusesky.glsl"
#include "lib/scenelight.glsl"
#include "lib/sequence.glsl"
#include "lib/sharedexponent.glsl"
#include "lib/sh.glsl"
#include "lib/slices.glsl"
#include "lib/strauss.glsl"
#include "lib/sun.glsl"
#include "lib/sunshadow.glsl"
#include "lib/tone.glsl"
#include "lib/visibility.glsl"
#undef float
#undef HAS_ANISOTROPY
#undef HAS_EDGES
#undef HAS_PHONG
#undef HAS_COOK_TORRANCE
#undef HAS_BLINN_PHONG
#undef HAS_BECKMANN
#undef HAS_STRAUSS
#undef HAS_COATS

}  // namespace
}  // namespace glsl
#pragma GCC diagnostic pop
