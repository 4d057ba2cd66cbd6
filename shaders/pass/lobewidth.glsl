// SPDX-License-Identifier: MIT
// By what is asked for a lobe, by its roughness.
#ifndef LOBEWIDTH_GLSL
#define LOBEWIDTH_GLSL

const float NARROW_ROUGHNESS = 0.12;     // below: one ray, in the mirror direction
const vec2 DEALT_ROUGHNESS = vec2(0.2, 0.3);  // from here on all of the map's lights are asked, by a cell of pixels
const float FAR_ROUGHNESS = 0.5;         // below: those near the lobe by each pixel
const float TRACED_ROUGHNESS = 0.5;      // below: the picture is searched for what it shows
// Pixels share what they know while their lobes turn by less than so many alphas. The map: .35 widens what floors reflect (atrium, S
// under studio and courtyard: 1.6 and 1.9 %, with .2 .9 and 1.0 %; balls gain .1 by it).
// What blocks it: .5 errs by 6.8 and 6.4 % at roughness .2 and .3 under courtyard, 1 by 5.5 and 4.9.
const float SHARED_TURN = 0.2;
const float SHARED_VISIBILITY_TURN = 1.0;

// Below alphas of this range too few of a still view's lights would fall into the lobe.
const vec2 LIGHTED_ALPHA = vec2(0.04, 0.1);

// The share of S that a still view's lights shade.
float lightedShare(float roughness)
{
    return smoothstep(LIGHTED_ALPHA.x, LIGHTED_ALPHA.y, roughness * roughness);
}

#endif
