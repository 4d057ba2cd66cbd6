// SPDX-License-Identifier: MIT
// Directions drawn from a lobe. Local frame as in lib/ggx.glsl.
#ifndef LOBESAMPLE_GLSL
#define LOBESAMPLE_GLSL

#include "lib/bsdf.glsl"
#include "lib/frame.glsl"

struct LobeSample {
    vec3 direction;
    vec3 weight;     // value times cosine over density; its mean is the lobe's directional albedo. 0 below the horizon
    float density;   // per solid angle; roughness above 0
};

#if defined(HAS_PHONG) || defined(HAS_STRAUSS)
LobeSample sampleMirrored(Bsdf b, vec3 v, vec2 u)
{
    float n = phongExponent(b.roughness);
    vec3 mirrored = vec3(-v.x, -v.y, v.z);
    LobeSample s;
    s.direction = frameAround(mirrored) * phongSample(n, u);
    s.weight = bsdfMirrored(b, v.z, s.direction.z) * ((n + 2.0) / (n + 1.0) * max(s.direction.z, 0.0));
    s.density = phongPdf(mirrored, s.direction, n);
    return s;
}
#endif

#ifdef HAS_MICROFACETS
// By GGX's visible normals, whatever the distribution: specular.md 6.
LobeSample sampleMicrofacets(Bsdf b, vec3 v, vec2 u)
{
    LOBE_ALPHA alpha = lobeAlpha(b);
    vec3 h = ggxVisibleNormalSample(v, alpha, u);
    float c = dot(v, h);
    LobeSample s;
    s.direction = 2.0 * c * h - v;
    s.density = ggxReflectionPdf(v, h, alpha);
    float share = 0.0;
    if (s.direction.z > 0.0)
        share = b.brdf == BRDF_COOK_TORRANCE
                    ? ggxUnshadowed(v.z, ggxRoot(v, alpha), s.direction.z, ggxRoot(s.direction, alpha))
                    : bsdfMicrofacets(b, v, s.direction, h) * s.direction.z / s.density;
    s.weight = b.energy * bsdfFresnel(b, c) * share;
    return s;
}
#endif

// v: to the eye, above the horizon; u in [0,1)^2.
LobeSample sampleLobe(Bsdf b, vec3 v, vec2 u)
{
#if defined(HAS_PHONG) || defined(HAS_STRAUSS)
    if (isMirrored(b.brdf)) return sampleMirrored(b, v, u);
#endif
#ifdef HAS_MICROFACETS
    if (isMicrofacets(b.brdf)) return sampleMicrofacets(b, v, u);
#endif
    LobeSample none;
    none.direction = vec3(-v.x, -v.y, v.z);
    none.weight = vec3(0.0);
    none.density = 0.0;
    return none;
}

#endif
