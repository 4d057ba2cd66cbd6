#version 330 compatibility
// SPDX-License-Identifier: MIT
// Second step: the sums over all blocks, one texel each.

uniform sampler2D plainMap;
uniform sampler2D alongXMap;
uniform sampler2D alongYMap;
uniform sampler2D alongZMap;
uniform sampler2D sentOnMap;

layout(location = 0) out vec4 sum;

vec4 sumOf(sampler2D map)
{
    vec4 sum = vec4(0.0);
    ivec2 size = textureSize(map, 0);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) sum += texelFetch(map, ivec2(x, y), 0);
    return sum;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    sum = vec4(0.0);
    if (p.y > 0 || p.x > 4) return;
    int which = p.x;
    if (which == 0)
        sum = sumOf(plainMap);
    else if (which == 1)
        sum = sumOf(alongXMap);
    else if (which == 2)
        sum = sumOf(alongYMap);
    else if (which == 3)
        sum = sumOf(alongZMap);
    else
        sum = sumOf(sentOnMap);
}
