// SPDX-License-Identifier: MIT
// The light of virtual lights: what polished metal reflects of suns and lamps.
#ifndef VIRTUALLIGHTS_GLSL
#define VIRTUALLIGHTS_GLSL

#include "lib/limits.glsl"

// A column is a light. Row 0: its place, and the area that it stands for, over pi. Rows 1 to 3: the matrix that takes a vector from a
// receiver to the light into the cosine lobe, and red, green and blue of the power. Row 4: the plane behind which it lights nothing, as
// endOf() of pass/virtuallights.frag says, and the slope of the lobe's horizon in the cosine lobe.
uniform sampler2D virtualLightMap;

// Irradiance over pi at a place with unit normal n, in units of the map's mean. width: of what the place stands for. A lobe that is
// narrower than that and what the light stands for is as wide as both together, with the same power.
vec3 fromVirtualLight(int i, vec3 place, vec3 n, float width)
{
    vec4 at = texelFetch(virtualLightMap, ivec2(i, 0), 0);
    vec4 x = texelFetch(virtualLightMap, ivec2(i, 1), 0);
    vec4 y = texelFetch(virtualLightMap, ivec2(i, 2), 0);
    vec4 z = texelFetch(virtualLightMap, ivec2(i, 3), 0);
    vec4 end = texelFetch(virtualLightMap, ivec2(i, 4), 0);
    vec3 to = at.xyz - place;
    vec3 w = vec3(dot(x.xyz, to), dot(y.xyz, to), dot(z.xyz, to));
    float height = dot(n, to);
    float squareDistance = dot(to, to);
    bool lit = height > 0.0 && w.z > max(end.w * w.x, 0.0) && dot(end.xyz, to) >= -1.0;
    // Of a narrow lobe, the square of its half width at this distance: the matrix takes the lobe's axis to that many times +Z.
    float determinant = dot(x.xyz, cross(y.xyz, z.xyz));
    float wide = determinant * determinant * squareDistance / dot(x.xyz, x.xyz);
    float narrower = wide / (wide + width * width + at.w);
    float square = narrower * dot(w.xy, w.xy) + w.z * w.z;
    // The lobe's density, and the cosine over the squared distance.
    float share = lit ? narrower * w.z * height / (square * square) : 0.0;
    return share * vec3(x.w, y.w, z.w);
}

#endif
