// SPDX-License-Identifier: MIT
// By what is asked for a lobe, by its roughness.
#ifndef LOBEWIDTH_GLSL
#define LOBEWIDTH_GLSL

const float NARROW_ROUGHNESS = 0.12;     // below: one ray, in the mirror direction
// Each pixel evaluates the lights that are near the direction of a lobe below the first. The pixels of a cell share out the other lights;
// their part fades in over the second.
const float NEAR_LIGHTS_ROUGHNESS = 0.5;
const vec2 DEALT_ROUGHNESS = vec2(0.2, 0.3);
const float TRACED_ROUGHNESS = 0.5;      // below: the picture is searched for what it shows
// Pixels average their samples while their lobes turn by less than this, in alphas.
// SHARED_TURN is for the map's radiance. With .35, S of the atrium errs by 1.6 % under studio and 1.9 % under courtyard, with .2 by .9
// and 1.0 %: a wider average blurs what floors reflect. S of balls errs by .1 % less with .35.
// SHARED_VISIBILITY_TURN is for what blocks it. Under courtyard, .5 errs by 6.8 and 6.4 % at roughness .2 and .3, 1 by 5.5 and 4.9 %.
const float SHARED_TURN = 0.2;
const float SHARED_VISIBILITY_TURN = 1.0;

// Occlusion treats a brushed lobe as at least this rough across its direction. A narrower lobe holds few of the lights. Each pixel of a cell
// has other lights, and pixels whose narrow lobes differ can't share them: the result would be noise.
const float LEAST_LIT_BRUSHED = 0.3;

// Below alphas of this range too few of a still view's lights would fall into the lobe.
const vec2 LIGHTED_ALPHA = vec2(0.04, 0.1);

// The share of S that a still view's lights shade.
float lightedShare(float roughness)
{
    return smoothstep(LIGHTED_ALPHA.x, LIGHTED_ALPHA.y, roughness * roughness);
}

#endif
