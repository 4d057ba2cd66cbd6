// SPDX-License-Identifier: MIT
// The numbers by which the G-buffer names the BRDFs.
#ifndef BRDFS_GLSL
#define BRDFS_GLSL

#define BRDF_LAMBERT 0
#define BRDF_PHONG 1
#define BRDF_COOK_TORRANCE 2  // with GGX's distribution
#define BRDF_BLINN_PHONG 3
#define BRDF_BECKMANN 4       // Cook-Torrance with Beckmann's distribution
#define BRDF_STRAUSS 5
#define BRDF_COATED 6         // Cook-Torrance with GGX below a clear coat
#define BRDF_ANISOTROPIC 7    // Cook-Torrance with GGX whose highlights are drawn out along a direction

const float PAINTED_ROUGHNESS = 0.2;  // of metal whose reflection is painted on by a sphere or cube map

const float UNLIT_ROUGHNESS = 0.0;    // a mark: of a Lambert surface no lobe has it

// What GL_LIGHTING is off for.
bool isUnlit(int brdf, float roughness)
{
    return brdf == BRDF_LAMBERT && roughness == UNLIT_ROUGHNESS;
}

const float CATCHER_ROUGHNESS = 0.5;  // the mark of a shadow catcher; the G-buffer rounds it
const float CATCHER_ALBEDO = 0.5;     // a catcher shows a ratio of its terms, in which this cancels

// A shadow catcher shows the map behind it times the light on it, over the light that the map alone would send there.
bool isCatcher(int brdf, float roughness)
{
    return brdf == BRDF_LAMBERT && abs(roughness - CATCHER_ROUGHNESS) < 0.1;
}

// A number with 13 bits of parameters, as the 16 bits that the G-buffer keeps.
uint packKind(int brdf, uint parameters)
{
    return parameters >> 8 << 11 | uint(brdf) << 8 | (parameters & 255u);
}

int kindBrdf(uint kind)
{
    return int(kind >> 8 & 7u);
}

uint kindParameters(uint kind)
{
    return kind >> 11 << 8 | (kind & 255u);
}

#endif
