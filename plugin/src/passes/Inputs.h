/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/FrameContext.h"
#include "frame/PassBuilder.h"

#include <string>

namespace osgEnvLight
{

// What several passes read alike. The textures of a frame:
//   albedo, normal, specular properties, depth, emission   the G-buffer
//   pixel marks                         where there is a surface, where one with a lobe
//   diffuse, sun diffuse, sun shaded    D of the map and of the suns, and what the scene leaves of the latter
//   lobe estimate, sun glint            sums of the map's radiance in a pixel's lobe, and what it reflects of the suns
//   lobe lights                         sums over a group of lights, of those it sees and all, by the lobe
//   row estimate, row lobe lights       the same, filtered along rows
//   specular, blocked lobe              S, and the part of the lobe's albedo that surfaces take from the map
//   coat, blocked coat                  the same of clear coats
//   reflection, reflected               what rays through the picture meet, and what the scene sends into the lobes
//   light sums, light places            sums over a group of lights, where they are from
//   row sums, row places                the same, filtered along rows
//   occlusion                           their filtered ratio
//   area sums, area places, area row sums, area row places   the same of the area lights' points
//   light totals                        what 2x2 pixels receive of many area lights, roughly
//   area visibility                     the filtered ratio of these, of the diffuse layer and, alpha, of the lobe
//   sun points 0 .. 3                   what a pixel's own points see of the suns
//   sun visibility 0 and 1, penumbrae   how much a pixel sees of them, and the marks of those that must look closer
//   bounce                              sums of the radiance of what blocks light
//   point light                         light of the map and its suns at surface points
//   virtual lights                      places on polished metal, and what they send
//   caustic sums, caustic places, caustic row sums, caustic row places   sums over a group of these, filtered as the lights' are
//   caustics                            what a pixel receives of them
//   indirect, mirrored                  what other surfaces send to a pixel, and from about the mirror direction
//   radiance                            the sum of the terms over what is behind the scene
//   average, average of squares         of a still view's frames
//   display                             the picture in display values
//   motion                              where the frame before showed what has moved since
//   history, other history              the average of the display over frames; they take turns
//   history places, other history places   the distances of its surfaces, and in how many frames each was seen

/** A texture that a still view's later frames read again as its first one left it. */
TextureDesc ofFirstFrame(const FrameContext& context, GLint format, int side = 0);
/** Draw the pixels that show a surface. */
void drawSurfaces(PassBuilder& builder);
/** Pixels with a lobe alone. */
void drawGlossy(PassBuilder& builder);
/** HAS_PHONG, HAS_COOK_TORRANCE and so on: the lobes of these bits [SurfaceKinds]. */
void defineLobes(PassBuilder& b, unsigned lobes);

/** Those that are in view, with their albedo. */
void readLobes(PassBuilder& builder, const FrameContext& context);
/** What pass/irradiance.glsl reads: nothing where the map gives no diffuse light. */
void readIrradiance(PassBuilder& builder, FrameContext& context);
/** The uniforms of pass/suns.glsl. */
void readSuns(PassBuilder& builder, FrameContext& context);
/** HAS_SUN_SHADOWS and what each pixel sees of the suns, where a pass makes that; else false. */
bool readSunVisibility(PassBuilder& builder);
/** Maps and lights of a sky shadow atlas.
 * @param name  of the atlas
 * @param near  the maps of the same lights about the view, or null */
void readSkyMaps(PassBuilder& builder, FrameContext& context, const std::string& name, ShadowAtlas& maps, ShadowAtlas* near);
/** A count, rounded up to whole groups of the pixels of a 4x4 cell. */
unsigned wholeGroups(int count);
/** How many points area lights have together: where there are more sides that send light than areaPoints, up to twice as many. */
unsigned areaPointsOf(const FrameContext& context);
/** The fog. False if what is lit has none. */
bool readFog(PassBuilder& builder, FrameContext& context);
/** The area lights' points and their shadow maps. */
void readEmitterPoints(PassBuilder& builder, const EmitterMaps& maps, osg::Texture2D* points);
/** The application's lights' shadow maps, and where these stand. */
void readSceneLightMaps(PassBuilder& builder, const FrameContext& context);
/** The shadow maps of the suns. */
void readSunMaps(PassBuilder& builder, FrameContext& context);
/** For passes that begin at pixels: places are told about the surface points' origin. */
FrameResources::Places pixelPlaces(const FrameContext& context);
/** The lamps and, of the map's lights, their place: for pass/receivedlight.glsl. Places are told about the surface points'
 * origin.
 * @param maps  of the map's lights */
void readReceivedLight(PassBuilder& builder, FrameContext& context, const std::string& pass, const ShadowAtlas& maps);
/** What pass/probegrid.glsl reads. */
void readProbes(PassBuilder& builder, const IndirectLight& light);
/** What pass/tracedscene.glsl reads; the scene has rays. */
void readTracedScene(PassBuilder& builder, const IndirectLight& light);
/** What pass/terms.glsl reads. */
void readDiffuseTerms(PassBuilder& builder, const FrameContext& context);
/** Whether lobes show the scene's indirect light where the scene hides the map. */
bool lobesShowScene(const FrameContext& context);
/** What pass/terms.glsl reads, with S and the bounce. */
void readTerms(PassBuilder& builder, FrameContext& context);
/** What is behind the scene. */
void readBackground(PassBuilder& builder, FrameContext& context);
/** Whether the map lies on the ground of Settings::ground; else it is infinitely far. */
bool isMapOnGround(const FrameContext& context);
/** What pass/catchers.glsl reads besides. */
void readCatchers(PassBuilder& builder, FrameContext& context);
/** What pass/picture.glsl reads: the terms, and what is behind the scene. */
void readPicture(PassBuilder& builder, FrameContext& context);

}  // namespace osgEnvLight
