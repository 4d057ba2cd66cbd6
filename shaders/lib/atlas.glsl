// SPDX-License-Identifier: MIT
// The sky shadow atlas: a midpoint map for each of the map's lights, and whether a light is seen [occlusion.md 3.1].
// Heights in a map: 0 to 1 along the direction to the light, over the cube about what it shows; positions in its texels.
#ifndef ATLAS_GLSL
#define ATLAS_GLSL

// Shadows are told apart from this height on: the 10^-4 of the half cube that separates a first and a second surface.
#define ATLAS_STEP 5e-5

// What a surface rises from a texel's centre to a corner at most. slope: heights per texel.
float riseToCorner(float slope)
{
    return 0.71 * abs(slope);
}

// The height half-way between the first and the second surface, by their depths; that of the first if there is no second.
// Thin bodies, and surfaces with nothing behind them, would shade themselves: they are lowered by what they rise within a texel. The most
// is limit, or three times that for sheets and for what has nothing behind it.
// A second surface that shows its front is another thing behind a sheet, as the floor at the foot of a wall. However close it is, the
// height stays above it.
// slope: of the first surface, heights per texel, negative for sheets. back: 1 if the second surface shows its back, else 0. limit: a texel
// in heights.
float midpointHeight(float firstDepth, float secondDepth, float slope, float back, float limit)
{
    if (firstDepth >= 1.0) return 0.0;
    float first = 1.0 - firstDepth;
    bool behind = secondDepth < 1.0;
    float middle = behind ? 0.5 * (first + 1.0 - secondDepth) : first;
    if (behind && back < 0.5) return max(middle, 0.0);
    float most = behind && slope >= 0.0 ? limit : 3.0 * limit;
    return max(min(middle, first - min(riseToCorner(slope), most)), 0.0);
}

// The least by which a map of the sky lowers a surface, so that it does not shade itself where normals are not exact. slope: heights
// per texel. texel: in heights.
float leastDrop(float slope, float texel)
{
    return min(riseToCorner(slope), 0.1 * texel + 0.05 * abs(slope));
}

// What a map of the sky keeps: the middle of bodies, whose second surface shows its back (1, else 0). Else what is behind may
// be the far end of the scene: no lower than a texel under the first surface, and hardly at all if that is a sheet. What a plane
// rises within a texel is the look-up's to know [planeGradient()].
float skyHeight(float firstDepth, float secondDepth, float slope, float back, float texel)
{
    if (firstDepth >= 1.0) return 0.0;
    float middle = secondDepth < 1.0 ? 0.5 * (secondDepth - firstDepth) : 0.0;
    float least = leastDrop(slope, texel);
    float most = slope < 0.0 ? least : max(least, back > 0.5 ? 1.0 : texel);
    return max(1.0 - firstDepth - clamp(middle, least, most), 0.0);
}

// Gradient of the plane of normal n, heights per texel. n: in positions and heights.
vec2 planeGradient(vec3 n)
{
    return vec2(n.x, n.y) / -max(n.z, 1e-20);
}

// Direction as a number in [0,1): the way round a square on its tip.
float turnOf(vec2 d)
{
    float x = d.x / max(abs(d.x) + abs(d.y), 1e-20);
    return d.y >= 0.0 ? 0.25 - 0.25 * x : fract(0.75 + 0.25 * x);
}

// What a texel keeps of its first surface: how steep it rises and which way, a byte each, as one number of [0,1]. Steepness by its
// logarithm, sixteen steps an octave, from the map's height in a texel down; 0 for level. slope: heights per texel.
float packedRise(float slope, float turn)
{
    float level = clamp(floor(255.5 + 16.0 * log2(max(slope, 1e-20))), 0.0, 255.0);
    return 256.0 * (level + fract(floor(256.0 * turn + 0.5) / 256.0)) / 65535.0;
}

// Back to heights per texel across and up.
vec2 unpackedRise(float rise)
{
    float level = floor(floor(65535.0 * rise + 0.5) / 256.0);
    if (level == 0.0) return vec2(0.0);
    float turn = floor(65535.0 * rise + 0.5) / 256.0 - level;
    vec2 way = vec2(abs(4.0 * turn - 2.0) - 1.0, abs(4.0 * fract(turn + 0.75) - 2.0) - 1.0);
    return way * (exp2((level - 255.0) / 16.0) / length(way));
}

// Where a point is looked up: off the surface by a tenth of a texel where the light grazes it.
vec3 atlasLookupPoint(vec3 p, vec3 n, float cosine, float texel)
{
    return p + n * (0.1 * texel * sqrt(max(1.0 - cosine * cosine, 0.0)));
}

// The first surface that a texel shows, beside a point that is not at the texel's centre. A sheet's height is exact; a body's is too low,
// since the map keeps the body's middle.
struct TexelSurface {
    float slope;      // of the surface, heights per texel
    vec2 apart;       // gradient by which the surface rises above the point's own plane
    float own;        // height of the point's own plane at the centre
    float height;     // of the surface there
    float overPoint;  // height of the surface's plane where the point is
    float slack;      // of both planes, whose normals are not exact
};

// toCentre: from the point at height to the texel's centre. plane: gradient of the point's own plane.
TexelSurface texelSurface(vec4 texel, vec2 toCentre, float height, vec2 plane, int size)
{
    vec2 gradient = unpackedRise(texel.y);
    TexelSurface s;
    s.slope = length(gradient);
    s.apart = gradient - plane;
    s.own = height + dot(plane, toCentre);
    s.height = texel.x + leastDrop(s.slope, 1.0 / float(size));
    s.overPoint = s.height - dot(gradient, toCentre);
    s.slack = 0.01 * (1.0 / float(size) + s.slope) + ATLAS_STEP;
    return s;
}

// How far the surface parts from the point's own plane within a texel.
float partsWithinTexel(TexelSurface s)
{
    return max(abs(s.apart.x), abs(s.apart.y));
}

// Whether the surface covers the point at height. Its plane lies above the point then, and the surface lies above the point's own
// plane, by more than a low rim beside the point would.
bool coversPoint(TexelSurface s, float height, int size)
{
    float step = 0.3 * (1.0 / float(size) + partsWithinTexel(s));
    return s.overPoint > height + s.slack && s.height > s.own + s.slack + step;
}

// Whether the surface may be the point's own, further round the body: of a body the map keeps less than its height.
bool isOwnSurface(TexelSurface s, int size)
{
    return partsWithinTexel(s) <= 0.25 * (1.0 / float(size) + s.slope);
}

// The neighbour of a texel in that direction.
ivec2 neighbourTowards(vec2 way)
{
    return abs(way.x) > abs(way.y) ? ivec2(way.x < 0.0 ? -1 : 1, 0) : ivec2(0, way.y < 0.0 ? -1 : 1);
}

// 1 if the point at texel position xy and height sees the light of the map that starts at corner, else 0. plane: gradient of the point's
// own plane. It counts up to what the texel's first surface rises to a corner: a steeper plane is another surface's.
// A wall stands on a floor, and light from below the floor must not reach the wall's foot. The map keeps the middle of the floor, which
// is lower than the foot, but the floor's plane covers the foot. This texel shows the floor, or the neighbour does towards which the
// floor rises from the wall. If this texel shows neither floor nor wall, the nearest neighbour shows the floor, and the two planes meet
// within a texel.
// The other sides of a body do not cover a point at its edge: their planes pass above the point, but the sides lie below its own plane.
float atlasVisible(sampler2D atlasMap, ivec2 corner, int size, vec2 xy, float height, vec2 plane)
{
    if (min(xy.x, xy.y) < 0.0 || max(xy.x, xy.y) >= float(size)) return 1.0;
    ivec2 p = ivec2(xy);
    vec4 texel = texelFetch(atlasMap, corner + p, 0);
    if (height < 0.0) return texel.x > 0.0 ? 0.0 : 1.0;  // below all that the map shows; 0 is where it shows nothing
    vec2 toCentre = vec2(p) + 0.5 - xy;
    TexelSurface here = texelSurface(texel, toCentre, height, plane, size);
    if (texel.x > height + clamp(here.own - height, 0.0, riseToCorner(here.slope)) + ATLAS_STEP) return 0.0;
    bool over = here.overPoint > height + here.slack;
    if (!over && ((texel.x > 0.0 && isOwnSurface(here, size)) || here.height >= here.own - here.slack)) return 1.0;
    if (coversPoint(here, height, size)) return 0.0;
    ivec2 next = neighbourTowards(over ? here.apart : -toCentre);
    ivec2 q = p + next;
    if (min(q.x, q.y) < 0 || max(q.x, q.y) >= size) return 1.0;
    TexelSurface beside = texelSurface(texelFetch(atlasMap, corner + q, 0), toCentre + vec2(next), height, plane, size);
    bool meets = over || beside.overPoint - height <= partsWithinTexel(beside);
    return meets && coversPoint(beside, height, size) ? 0.0 : 1.0;
}

#endif
