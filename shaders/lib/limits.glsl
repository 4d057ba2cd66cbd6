// SPDX-License-Identifier: MIT
// What shaders and C++ share: the lengths of arrays and textures that one fills and the other reads, the marks of pixels, and how
// texture units join.
#ifndef LIMITS_GLSL
#define LIMITS_GLSL

const int LIGHT_GROUPS = 16;      // that the pixels of a 4x4 cell take in turn
const int NEAREST_LIGHTS = 16;    // to a direction that are known of a sky shadow atlas
const int MOST_SUNS = 8;          // cut from a map
const int MOST_SUN_LEVELS = 4;    // shadow maps of a sun
const int MOST_SCENE_LIGHTS = 8;  // of OpenGL's fixed function
const int AREA_LIGHT_ROWS = 4;    // of what pass/arealights.glsl knows of a light, but for its vertices
const int CLUSTER_ROWS = 3;       // of what pass/lightcuts.glsl knows of a cluster of lights
const int LIGHT_COLUMNS = 2048;   // of lights and clusters side by side
const int MOST_LIGHT_VERTICES = 32;  // of a polygon
const int EMITTER_POINT_ROWS = 8; // of what pass/pointmap.glsl and pass/emitterpoints.glsl know of a point
const int BOUNCE_BLOCKS = 32;     // along each side of the picture
const int ERROR_BLOCKS = 32;      // along each side of the picture
const int ALBEDO_BLOCKS = 3;      // of the table of lobes' albedo, one for each distribution
const int ANISOTROPY_BLOCKS = 9;  // that follow where surfaces are brushed
const int METER_SIDE = 16;        // parts along each side of the picture whose light is metered,
const int METER_POINTS = 4;       // and points along each side of a part
const int PROBE_SIDE = 16;        // points that are read back along each side of the picture
const int MOST_PROBES = 32;       // along each axis of their grid
const int PROBE_LATTICES = 2;     // finer grids of probes about the view, in a scene far larger
const int POINT_SIDE = 64;        // surface points along each side of the textures that have a texel for each
const int POINT_LINKS = 16;        // directions in which a surface point looks for others close by
const int GUIDE_POINTS = 4;        // that are a guide, to which a still view's rays are aimed
const int GUIDES = 8;              // that a probe knows
const int GUIDE_ROWS = 32;         // of their texture, beside as many as the probes have: as many texels as there are guides
const int POINT_PART_SIDE = 4;    // parts of what a point stands for along each side of the square of their texels
const int PROBE_FACE_SIDE = 8;         // directions along each side of a cube's face in which a probe looks
const int PROBE_DEPTH_SIDE = 12;       // of the octahedral map of what a probe knows of distances [texels]
const int PROBE_HARMONICS = 9;         // in which a probe adds up what it sees
const int HARMONICS_TEXTURES = 3;      // that share them: a texel has a third of one's
const int PROBE_IRRADIANCE_SIDE = 6;   // of that of the light that it gets
const int BVH_DEPTH = 64;         // most levels of the hierarchy of triangles
const int RAY_COLUMNS = 2048;     // texels in each row of the tables that rays through the scene read
const int CELL_POINTS = 8;        // surface points that a cell knows of each facing
const float LEAST_POLISHED = 0.25f;          // share of light that the lobe of polished metal reflects of at least one colour
const float MOST_POLISHED_ROUGHNESS = 0.75f; // of such lobes
const int MOST_REFLECTED_LIGHTS = 4;  // whose reflections by polished metal are followed
const int VIRTUAL_LIGHT_ROWS = 5;     // of what pass/virtuallights.glsl knows of one
const int SURFACE_TEXELS = 3;     // of the table of what a surface does with light
const int TRIANGLE_TEXELS = 4;    // of the table of triangles
const int RAY_LEAF = 8;           // more than the triangles of a leaf

// A texture of 16 bits keeps the marks. Each mark lies a quarter of a step above a number of 16 bits. It becomes that number whether
// OpenGL rounds it or cuts it off, so a pass can ask for one mark alone.
const float MARK_STEP = 8192.0f / 65535.0f;
const float MARK_COATED = 8192.25f / 65535.0f;   // a surface with a clear coat
const float MARK_TRACED = 16384.25f / 65535.0f;  // a surface with a lobe that is narrow enough to search the picture for what it shows
const float MARK_GLOSSY = 24576.25f / 65535.0f;  // a surface with a lobe
const float MARK_SURFACE = 32768.25f / 65535.0f;
const float MARK_NONE = 1.0;

// In the emission's alpha, of the surface of an area light: what it sends is in the light's own terms. Else that is below .5, or 1.
const float LIGHT_MARK = 0.75;
// It is negative where the application's fog lies before the surface. A half float that is rounded to 0 would lose the sign, so the alpha
// of such a surface is at most minus this.
const float LEAST_FOGGED = 1.0f / 16384.0f;

// How the texture of a unit joins the colour below it: as TexEnv and the forms of TexEnvCombine that say the same.
const int STAGE_NONE = 0;
const int STAGE_MODULATE = 1;
const int STAGE_REPLACE = 2;
const int STAGE_DECAL = 3;
const int STAGE_BLEND = 4;
const int STAGE_ADD = 5;
const int STAGE_ADD_SIGNED = 6;
const int STAGE_NORMALS = 7;      // it is a normal map (DOT3)
const int STAGE_MASK = 8;         // it is black where the surface has holes
const int STAGE_OTHER = 9;        // drawn as without us
const int STAGED_UNITS = 4;
// Where the coordinates of a unit after the first come from.
const int STAGE_GIVEN = 0;      // from the vertices
const int STAGE_OF_OBJECT = 1;  // from planes in the space of the model
const int STAGE_OF_EYE = 2;     // from planes in eye space
const int STAGE_PROJECTED = 4;  // plus this: the fourth, too
const int STAGE_OF_FIRST = 8;   // from the vertices, those of the first unit

#endif
