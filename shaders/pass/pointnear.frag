#version 330 compatibility
// SPDX-License-Identifier: MIT
// What surfaces close to a surface point sent to it a bounce ago. Each texel is a point. The colour is the radiance that a white surface
// would send on of it. Alpha is the cosine-weighted share of directions that these surfaces fill.
#include "pass/pointlink.glsl"

uniform sampler2D pointLinkMap;  // POINT_LINKS texels side by side for each point, as linkSends() reads them

layout(location = 0) out vec4 near;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    near = vec4(0.0);
    for (int k = 0; k < POINT_LINKS; ++k) near += linkSends(texelFetch(pointLinkMap, ivec2(POINT_LINKS * p.x + k, p.y), 0).r);
    near /= float(POINT_LINKS);
}
