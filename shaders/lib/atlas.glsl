// SPDX-License-Identifier: MIT
// The sky shadow atlas: a midpoint map for each of the map's lights, and whether a light is seen [occlusion.md 3.1].
// Heights in a map: 0 to 1 along the direction to the light, over the cube about what it shows; positions in its texels.
#ifndef ATLAS_GLSL
#define ATLAS_GLSL

// Shadows are told apart from this height on: the 10^-4 of the half cube that separates a first and a second surface.
#define ATLAS_STEP 5e-5

// Height half-way between the first and the second surface, by their depths; the first where none is behind it. Open surfaces
// are let down by what they rise within a texel, not to shade themselves: by limit at most, or three times that where nothing
// is behind or leaves and grilles are known to be sheets. slope: of the first surface, heights per texel, negative for those.
// limit: a texel of a sun's map, in heights; those of the sky have none.
float midpointHeight(float firstDepth, float secondDepth, float slope, float limit)
{
    if (firstDepth >= 1.0) return 0.0;
    float first = 1.0 - firstDepth;
    bool behind = secondDepth < 1.0;
    float middle = behind ? 0.5 * (first + 1.0 - secondDepth) : first;
    float most = behind && slope >= 0.0 ? limit : 3.0 * limit;
    return max(min(middle, first - min(0.71 * abs(slope), most)), 0.0);
}

// Where a point is looked up: off the surface by a tenth of a texel where the light grazes it.
vec3 atlasLookupPoint(vec3 p, vec3 n, float cosine, float texel)
{
    return p + n * (0.1 * texel * sqrt(max(1.0 - cosine * cosine, 0.0)));
}

// 1 if the point at texel position xy and height sees the light of the map that starts at corner, else 0.
float atlasVisible(sampler2D atlasMap, ivec2 corner, int size, vec2 xy, float height)
{
    if (min(xy.x, xy.y) < 0.0 || max(xy.x, xy.y) >= float(size)) return 1.0;
    float middle = texelFetch(atlasMap, corner + ivec2(xy), 0).x;
    return middle <= height + ATLAS_STEP ? 1.0 : 0.0;
}

#endif
