#version 330 compatibility
// SPDX-License-Identifier: MIT
// A surface whose vertices a function of the application's moves [osgEnvLight/SurfaceProgram]: into the G-buffer, or lit after the
// composite. Without a LitScene above, a lamp at the eye lights the colour of its material.
#pragma import_defines(ENVLIGHT_GBUFFER, ENVLIGHT_LIT)

#include "pass/forwardlight.glsl"
#include "pass/fillgbuffer.glsl"

void main()
{
#if defined(ENVLIGHT_GBUFFER)
    fillGBuffer(readSurface());
#elif defined(ENVLIGHT_LIT)
    albedo = forwardColor(readSurface());
#else
    vec3 n = normalize(cross(dFdx(eyePosition), dFdy(eyePosition)));
    albedo = vec4(gl_FrontMaterial.diffuse.rgb * abs(dot(n, normalize(eyePosition))), gl_FrontMaterial.diffuse.a);
#endif
}
