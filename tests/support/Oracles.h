// SPDX-License-Identifier: MIT
// Closed forms that the tests compare with (systems.md 1.7). Angles in radians; lengths in any one unit. An irradiance is
// given as E / (pi L), of a Lambertian emitter the same as E / M: the form factor from the receiver's point. Receivers look
// along +Z. Nothing here uses what it judges.
#pragma once

#include <utility>
#include <vector>

namespace testmaths::oracle
{

// Skies and emitters ------------------------------------------------------------------------------------------------

/** Sky L cos^k about the normal, k > -2; k = 0 is the constant environment: 1. */
double powerSky(double k);
/** Constant sky above a horizon whose plane is tilted by that angle [0, pi] from the receiver's. */
double halfSky(double tilt);
/** Disk that faces the receiver from straight above. */
double coaxialDisk(double radius, double height);
/** Sphere of that angular radius [0, pi/2] at that angle from the zenith [0, pi], clear of, crossing or below the horizon. */
double sphere(double angularRadius, double zenith);
/** Rectangle [0,a] x [0,b] that faces the receiver from that height above one of its corners. Height 0: the limit from in
 * front.*/
double rectangleCorner(double a, double b, double height);
/** Rectangle [-a/2,a/2] x [-b/2,b/2] that faces the receiver below its centre. */
double centredRectangle(double a, double b, double height);
/** Vertical rectangle in the plane x = distance, |y| <= halfWidth, 0 <= z <= height; what is below the horizon counts
 * nothing. Distance 0: the limit from in front.*/
double verticalRectangle(double distance, double halfWidth, double height);
/** Between two rectangles a x b that face each other. All > 0. */
double parallelRectangles(double a, double b, double distance);
/** From a rectangle edge x depth to one edge x height that stands on its edge. All > 0. */
double perpendicularRectangles(double edge, double depth, double height);
/** What an infinitely long vertical wall takes from a constant sky. */
double wallOcclusion(double distance, double height);
/** The same from the sky cos about the normal, over pi times its L at the zenith; the whole sky gives 2/3. */
double wallOcclusionOfCosineSky(double distance, double height);
/** Half plane that meets the receiver's plane at this angle [0, pi], close to their edge. */
double halfPlaneAtEdge(double angle);

// Reflection ----------------------------------------------------------------------------------------------------------

/** Integral of cos^n over the hemisphere about the lobe's axis; n > -1. */
double cosineLobe(double n);
/** Integral of cos^n cos, the lobe about the normal; n > -2. */
double cosineLobeWithCosine(double n);
/** GGX's D along the normal, alpha = roughness^2. */
double ggxPeak(double alpha);
/** GGX's D where the tangent is alpha. */
double ggxAtWidth(double alpha);
/** Directional albedo of GGX of alpha 1 with height-correlated Smith masking and F = 1, at that cosine in [0,1]. */
double roughestAlbedo(double cosine);

// Bases ---------------------------------------------------------------------------------------------------------------

/** A_l: the factor of band l that turns radiance into irradiance. */
double cosineBand(int l);
/** Coefficient (l, 0) of the clamped cosine about +Z. */
double cosineCoefficient(int l);
/** Irradiance under one directional light of irradiance 1 from its bands below `bands`, at that cosine. */
double reconstructedCosine(int bands, double cosine);
/** Integral over the sphere of e^(sharpness (cos - 1)). */
double sphericalGaussian(double sharpness);
/** Integral over the sphere of the product of two, whose axes are that angle apart. */
double sphericalGaussianProduct(double sharpness1, double sharpness2, double angle);
/** Element `position` of the orthonormal Haar function `index` of a power of two of elements: constant, then from coarse
 * to fine.*/
double haarFunction(int index, int position, int size);
std::vector<double> haarCoefficients(const std::vector<double>& values);
std::vector<double> haarValues(const std::vector<double>& coefficients);
/** Of texel (x, y) of a face of size x size of a cube map [sr]. */
double cubeTexelSolidAngle(int x, int y, int size);

// Radiosity: exitances of emitted E and reflectance rho < 1 ---------------------------------------------------------

/** Two infinite plates that face each other. */
std::pair<double, double> parallelPlates(double e1, double e2, double rho1, double rho2);
/** The sphere inside, and the one around it. */
std::pair<double, double> concentricSpheres(double r1, double r2, double e1, double e2, double rho1, double rho2);
/** Where the wall of a closed sphere emits e, and all of it meanE on average. */
double integratingSphere(double e, double meanE, double rho);
/** Any closed surface of one E and rho. */
double closedBox(double e, double rho);
/** Wall of a sphere that sees a constant sky L through an opening of this half angle about the sphere's centre, as
 * B / (pi L).*/
double sphericalCavity(double rho, double openingAngle);
/** What is missing of closedBox() after so many bounces, over closedBox(). */
double missingAfter(int bounces, double rho);

// Virtual point lights ------------------------------------------------------------------------------------------------

/** E / M below the centre of a disk of ever more point lights whose 1/d^2 is cut off at 1/clamp^2. */
double clampedDisk(double radius, double height, double clamp);
/** The same with the kernel cos cos' / (pi d^2 + area): each light a disk of its own area. */
double diskKernel(double radius, double height, double area);
/** E / M below an infinite square grid of point lights of this spacing; (x, y) the place between four lights, in [0,1]^2. */
double pointGrid(double height, double spacing, double x, double y);
/** Variance of what a light adds that adds x >= 0 without it, when accepted with the probability min(1, x / delta) and
 * weighed by its inverse.*/
double stochasticCulling(double x, double delta);

}  // namespace testmaths::oracle
