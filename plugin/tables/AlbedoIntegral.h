// SPDX-License-Identifier: MIT
// Makes the table of lobes' albedo: surface/AlbedoTable.h.
#pragma once

#include <array>

/** A, B and what edges of metals take, of a lobe of a distribution of brdfs.glsl: the mean over `points` of a sequence that
 * follows GGX's visible normals, which bound the weights of all distributions. */
std::array<double, 3> lobeAlbedo(int brdf, double roughness, double cosV, unsigned points);

/** The same of GGX's normals with a roughness along the view's azimuth and another across it. */
std::array<double, 3> brushedAlbedo(double along, double across, double cosV, unsigned points);
