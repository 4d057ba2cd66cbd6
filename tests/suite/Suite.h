// SPDX-License-Identifier: MIT
// The image suite: pictures of the nodekit beside ray-traced ones, row by row.
#pragma once

#include <metrics/Mask>
#include <metrics/Picture>
#include <reference/Environment>
#include <reference/RayCamera>
#include <reference/TriangleScene>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suite
{

/** Errors of a row: smaller is better.
 *
 * Where hardly any light is left, as in rooms, relMSE tells nothing: a thousandth of light too much costs a million. tRMSE
 * counts such a pixel as 1 at most, and so moves with the share of the picture that is lit as it should be. O says how much of
 * that the occlusion misses: 1 is a picture without any. D and S have no occlusion: they say that the light itself is right.*/
enum Figure {
    REL_MSE,        // of the picture, over geometry without edges
    TONED,          // root mean square error of the picture as a tone curve shows it, likewise
    DISSIMILARITY,  // 1 - mean SSIM of the picture over geometry; the reference's noise is in it
    DIFFUSE,        // root mean square error of D over the mean of D, without edges and transparent surfaces
    SPECULAR,       // that of S, unoccluded, as a tone curve shows it; 0 where nothing is glossy
    OCCLUSION,      // root mean square error of O over the mean of D
    BOUNCED,        // TONED with the bounce, beside full light transport
    SILHOUETTE,     // share of the pixels of which only one of the two pictures says that they show geometry
    NUM_FIGURES
};
using Figures = std::array<double, NUM_FIGURES>;
extern const char* const figureNames[NUM_FIGURES];

/** How a row differs from its scene under its map. */
struct Variation {
    const char* name = "";
    double rotation = 0.0;  // of the map, further than the scene turns it [degrees]
    bool orthographic = false;
    std::vector<std::pair<const char*, double>> settings = {};
};

struct Row {
    const char* scene;
    const char* map;
    const char* why = "";  // it is no better
    Variation variation = Variation();

    std::string name() const;
};

/** The whole suite, rows of a scene side by side. */
const std::vector<Row>& rows();

/** What a row comes to. */
struct Result {
    bool installed = false;  // else nothing below counts
    osgEnvLight::Picture picture;
    osgEnvLight::Picture reference;
    osgEnvLight::Mask inside;  // geometry without edges
    double stops = 0.0;        // exposure
    Figures figures{};
    Figures noise{};                // what the reference's noise can add in quadrature to an error: 3 standard deviations
    double dissimilarNoise = 0.0;   // 1 - mean SSIM of the reference and the reference with as much noise again
    double withoutOcclusion = 0.0;  // TONED without O
    double withoutBounce = 0.0;     // BOUNCED without it
    double halfSamples = 0.0;       // SPECULAR with half the specularSamples
    double seconds = 0.0;
};

/** A setting of all rows that are rendered from now on: what does it cost? Throws std::runtime_error if there is no such one. */
void setForAllRows(const std::string& name, const std::string& value);

/** Rendered and compared at the first call. */
const Result& result(const Row& row);
/** Whether there was one. */
bool hasResult(const Row& row);

/** A row as it can be traced anew. */
struct TracedRow {
    osgEnvLight::TriangleScene triangles;
    osgEnvLight::RayCamera camera;
    osgEnvLight::MapEnvironment environment;
    // As of its Result.
    osgEnvLight::Picture picture;
    osgEnvLight::Picture reference;
    osgEnvLight::Mask inside;
    // Our terms D and O, and where they are compared: inside, without transparent surfaces.
    osgEnvLight::Picture diffuse;
    osgEnvLight::Picture occlusion;
    osgEnvLight::Mask deferred;
};

/** None where it is not installed. */
std::optional<TracedRow> traced(const Row& row);

const int width = 96;
const int height = 72;

/** The figures of a file that writeMeasured() wrote, by the row's name. Throws std::runtime_error if it can't be read. */
std::map<std::string, Figures> readMeasured(const std::string& fileName);

/** The figures of all rows that have a result. Other lines are kept from the file that was there. Throws
 * std::runtime_error if it can't be written.*/
void writeMeasured(const std::string& fileName);

/** REL_MSE and TONED of a row in which all is exact but O: of that there is the share of an even sky that is hidden, exact too,
 * one number a pixel and channel. Then the standard errors of both. */
using ScalarFigures = std::array<double, 4>;

/** As readMeasured() and writeMeasured(), of the rows that have figures. */
std::map<std::string, ScalarFigures> readScalar(const std::string& fileName);
void writeScalar(const std::string& fileName, const std::map<std::string, ScalarFigures>& figures);

/** The most that a figure may be, from what was measured, when the figure's noise is what it is. */
double bound(Figure figure, double measured, double noise);

/** Whether bound() means anything, see Figure. */
bool bounded(Figure figure, double measured);

/** For the eye: a line of pictures per scene, and for each map ours, the reference, and the difference (red: ours is brighter);
 * of the rows that have a result. Throws std::runtime_error if it can't be written.*/
void writeContactSheet(const std::string& fileName);

}  // namespace suite
