// SPDX-License-Identifier: MIT
// What envlight-tradeoff has measured, as plain data, and its report: index.html, tradeoff.csv, tradeoff.json.
#pragma once

#include <metrics/Picture>

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tradeoff
{

const double unknown = std::numeric_limits<double>::quiet_NaN();

/** Names with texts, in the order of appearance. */
using Texts = std::vector<std::pair<std::string, std::string>>;

/** The times of one thing over several frames [ms]. */
struct Spread {
    double median = unknown;
    double low = unknown;   // 10th percentile
    double high = unknown;  // 90th percentile
    int frames = 0;
};

/** How far a picture, or one term of it, is from the reference. What was not measured is NaN. */
struct Figures {
    double tRMSE = unknown;   // of v / (|v| + mean of the reference): what error() is
    double relMSE = unknown;  // squared error relative to the reference's square, with 1 % of its mean added
    double rmse = unknown;    // [radiance], as bias and p99
    double bias = unknown;    // mean of ours - reference
    double p99 = unknown;     // 99th percentile of the absolute error
    double ssim = unknown;    // 1: alike
    double flip = unknown;    // 0: alike
    double noise = 0.0;       // of the reference itself, in units of error()
    bool resolved = true;     // false: less than the reference can tell

    /** tRMSE; of an unresolved one its bound, the noise. */
    double error() const;
};

/** One set of settings that was measured. */
struct Point {
    std::string sweep;        // "preset", or the name of the setting that varies
    std::string value;        // the preset's name, or the value of that setting
    double number = unknown;  // the value, if it is a number
    Texts settings;           // that differ from the defaults, by name; none: these are the defaults
    Spread frame;             // wall clock, until the GPU is done
    std::vector<std::pair<std::string, Spread>> passes;
    Figures beauty;
    std::map<std::string, Figures> terms;  // "diffuse", "specular", "occlusion"
    bool failed = false;                   // then only the settings and the failure are of interest
    std::string failure;

    /** Both time and error are known. */
    bool measured() const;
};

/** Pictures are linear; the page shows them times 2^Report::exposure, in sRGB, with white where that is more than 1. */
struct TermPictures {
    std::string term;
    osgEnvLight::Picture ours;
    osgEnvLight::Picture reference;
    osgEnvLight::Picture difference;                     // false colours of ours - reference, sRGB in 0..1
    std::string differenceLegend;                        // "red: too bright, blue: too dark, full colour from 0.2"
    std::string sentence;                                // "72 % of the squared error is occlusion by what is outside the view"
    std::vector<std::pair<std::string, double>> shares;  // of the squared error, 0..1
};

/** What the user asked for; the page names the point that answers it. */
struct Target {
    enum Kind { ERROR, MILLISECONDS } kind;
    double value;  // of Figures::error(), or milliseconds
};

struct Report {
    std::string title = "Speed against accuracy";
    std::string scene;
    std::string map;
    int width = 0;
    int height = 0;
    std::string date;
    std::string command;             // that makes the report again
    Texts hardware;                  // renderer, version, driver, CPU, cores, software or hardware
    Texts defaults;                  // all settings, by name
    std::string timeStatement;       // how many frames warm up and count, what a pass's time is
    std::string referenceStatement;  // paths, samples a pixel, the noise
    std::string errorStatement;      // what error is relative to
    double exposure = 0.0;           // of the pictures [stops]
    bool quick = false;
    bool interrupted = false;
    std::string interruption;        // "after 12 of 48 settings, by Ctrl-C"
    std::vector<std::string> notes;  // what the reference leaves out, and other limits
    std::vector<Point> points;
    std::vector<Target> targets;
    osgEnvLight::Picture ours;  // with the default settings; empty: no pictures
    osgEnvLight::Picture reference;
    std::vector<TermPictures> pictures;
};

/** Make the folder if it is missing, and see that it can be written; an earlier report in it stays. Throws as writeReport(). */
void makeReportFolder(const std::string& folder);

/** Write the three files; the folder is made if it is missing. None is ever seen half written. Throws std::runtime_error
 * that names the file and the reason.*/
void writeReport(const Report& report, const std::string& folder);

}  // namespace tradeoff
