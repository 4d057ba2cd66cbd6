#version 330 compatibility
// SPDX-License-Identifier: MIT
// First step to the mean radiosity of what blocks light, estimated from the picture where light is blocked [indirect.md 0, 2]:
// one texel for each block of the picture. No history: still frames stay the same to the bit.

#include "lib/limits.glsl"
#include "pass/gbuffer.glsl"
#include "pass/lightmark.glsl"
#include "pass/terms.glsl"

// Sums over the pixels, by weight: of radiance and 1; these times the normal's x, y, z; of the albedo of what is blocked.
layout(location = 0) out vec4 plain;
layout(location = 1) out vec4 alongX;
layout(location = 2) out vec4 alongY;
layout(location = 3) out vec4 alongZ;
layout(location = 4) out vec4 sentOn;

const int samples = 8;  // along each side of a block, at most: 65536 of a picture

void main()
{
    plain = alongX = alongY = alongZ = sentOn = vec4(0.0);
    ivec2 size = textureSize(depthMap, 0);
    ivec2 block = ivec2(gl_FragCoord.xy);
    ivec2 from = size * block / BOUNCE_BLOCKS;
    ivec2 to = size * (block + 1) / BOUNCE_BLOCKS;
    ivec2 stride = (to - from + samples - 1) / samples;
    for (int y = from.y + stride.y / 2; y < to.y; y += stride.y)
        for (int x = from.x + stride.x / 2; x < to.x; x += stride.x) {
            ivec2 p = ivec2(x, y);
            if (isBackground(p) || isAreaLight(emissionMap, p)) continue;
            float blocked = 1.0 - ambientVisibility(p);
            float weight = blocked + 0.05;
            vec3 radiance = emitted(p) + sunShaded(p) + occludedDiffuse(p);
            vec4 r = weight * vec4(radiance, 1.0);
            vec3 n = pixelNormal(p);
            plain += r;
            alongX += n.x * r;
            alongY += n.y * r;
            alongZ += n.z * r;
            sentOn += weight * blocked * vec4(pixelAlbedo(p) * texelFetch(diffuseTermMap, p, 0).a, 0.0);
        }
}
