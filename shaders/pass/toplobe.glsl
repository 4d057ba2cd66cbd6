// SPDX-License-Identifier: MIT
// The lobe in which a pixel is searched for what it shows of the picture: that of its coat, if it has one, or of its surface.
#ifndef TOPLOBE_GLSL
#define TOPLOBE_GLSL

#include "pass/pixelbsdf.glsl"

struct TopLobe {
    vec3 normal;
    mat3 eyeFromLocal;
    Bsdf bsdf;
};

TopLobe topLobe(ivec2 p)
{
#ifdef HAS_COATS
    if (isCoated(p)) {
        PixelCoat coat = pixelCoat(p);
        return TopLobe(coat.normal, coat.eyeFromLocal, coat.bsdf);
    }
#endif
    vec3 n = pixelNormal(p);
    return TopLobe(n, pixelFrame(p, n), pixelBsdf(p, lobeView(p, n)));
}

#endif
