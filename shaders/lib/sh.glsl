// SPDX-License-Identifier: MIT
// Irradiance from real orthonormal spherical harmonics of bands 0, 1, 2 and 4: the odd bands above 1 carry no
// irradiance, so these 18 terms are exact to band 5 [Ramamoorthi, Hanrahan 2001]. No Condon-Shortley sign.
#ifndef SH_GLSL
#define SH_GLSL

// Basis function i of the 18, at the unit direction d; order: l = 0, l = 1 (m = -1..1), l = 2 (-2..2), l = 4 (-4..4).
float shBasis18(int i, vec3 d)
{
    float x = d.x;
    float y = d.y;
    float z = d.z;
    float x2 = x * x;
    float y2 = y * y;
    float z2 = z * z;
    if (i == 0) return 0.28209479177387814;
    if (i == 1) return 0.48860251190291992 * y;
    if (i == 2) return 0.48860251190291992 * z;
    if (i == 3) return 0.48860251190291992 * x;
    if (i == 4) return 1.09254843059207907 * x * y;
    if (i == 5) return 1.09254843059207907 * y * z;
    if (i == 6) return 0.31539156525252001 * (3.0 * z2 - 1.0);
    if (i == 7) return 1.09254843059207907 * x * z;
    if (i == 8) return 0.54627421529603953 * (x2 - y2);
    if (i == 9) return 2.50334294179670454 * x * y * (x2 - y2);
    if (i == 10) return 1.77013076977993053 * y * z * (3.0 * x2 - y2);
    if (i == 11) return 0.94617469575756001 * x * y * (7.0 * z2 - 1.0);
    if (i == 12) return 0.66904654355728916 * y * z * (7.0 * z2 - 3.0);
    if (i == 13) return 0.10578554691520430 * (35.0 * z2 * z2 - 30.0 * z2 + 3.0);
    if (i == 14) return 0.66904654355728916 * x * z * (7.0 * z2 - 3.0);
    if (i == 15) return 0.47308734787878000 * (x2 - y2) * (7.0 * z2 - 1.0);
    if (i == 16) return 1.77013076977993053 * x * z * (x2 - 3.0 * y2);
    return 0.62583573544917613 * (x2 * (x2 - 3.0 * y2) - y2 * (3.0 * x2 - y2));
}

// Sum of c[i] times basis i: with c = A_l / pi times the map's coefficients, the irradiance over pi about n.
// Ringing may take it below zero opposite a small lamp, where the truth is near zero: hence the clamp.
vec3 shIrradiance(vec3 c[18], vec3 n)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 18; ++i) sum += c[i] * shBasis18(i, n);
    return max(sum, vec3(0.0));
}

// The same from bands 0 to 2 alone.
vec3 shIrradiance9(vec3 c[18], vec3 n)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 9; ++i) sum += c[i] * shBasis18(i, n);
    return max(sum, vec3(0.0));
}

// Radiance in bands 1 and 2 of the same c, in the unit direction d. That of band 1 is linear in d.
vec3 shRadiance1(vec3 c[18], vec3 d)
{
    return 1.5 * (c[1] * shBasis18(1, d) + c[2] * shBasis18(2, d) + c[3] * shBasis18(3, d));
}

vec3 shRadiance2(vec3 c[18], vec3 d)
{
    vec3 sum = vec3(0.0);
    for (int i = 4; i < 9; ++i) sum += c[i] * shBasis18(i, d);
    return 4.0 * sum;
}

#endif
