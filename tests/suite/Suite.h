// SPDX-License-Identifier: MIT
// The image suite: pictures of the nodekit beside ray-traced ones, row by row.
#pragma once

#include <metrics/Mask>
#include <metrics/Picture>

#include <array>
#include <string>
#include <vector>

namespace suite
{

/** Errors of a row: smaller is better. */
enum Figure {
    REL_MSE,        // of the picture, over geometry without edges; a thousandth of light
                    // where there is none costs a million
    TONED,          // root mean square error of the picture as a tone curve shows it,
                    // likewise
    DISSIMILARITY,  // 1 - mean SSIM of the picture over geometry
    DIFFUSE,        // root mean square error of D over the mean of D, without edges and
                    // transparent surfaces
    SPECULAR,       // that of S, unoccluded, as a tone curve shows it; 0 where nothing
                    // is glossy
    OCCLUSION,      // root mean square error of O over the mean of D
    SILHOUETTE,     // share of the pixels of which only one of the two pictures says
                    // that they show geometry
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
    double noise = 0.0;             // of the reference, in the measure of TONED, from which
                                    // it is subtracted
    double withoutOcclusion = 0.0;  // TONED without O
    double halfSteps = 0.0;         // OCCLUSION with half the occlusionSteps
    double halfSamples = 0.0;       // SPECULAR with half the specularSamples
    double seconds = 0.0;
};

/** Rendered and compared at the first call. */
const Result& result(const Row& row);

const int width = 96;
const int height = 72;

/** For the eye: a line of pictures per scene, and for each map ours, the
 * reference, and the difference (red: ours is brighter). Throws
 * std::runtime_error if it can't be written.*/
void writeContactSheet(const std::string& fileName);

/** All figures. Throws std::runtime_error if it can't be written. */
void writeTable(const std::string& fileName);

}  // namespace suite
