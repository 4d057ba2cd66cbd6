// SPDX-License-Identifier: MIT
// envlight-tradeoff: what every setting costs and how exact it is, on the user's own scene and machine.
#include "Hardware.h"
#include "Interruption.h"
#include "Measurement.h"
#include "Pareto.h"
#include "PluginPath.h"
#include "ProgressBar.h"
#include "Summary.h"
#include "Text.h"

#include <metrics/Display>

#include <chrono>
#include <iostream>
#include <sstream>

namespace
{

using namespace tradeoff;

using Clock = std::chrono::steady_clock;

struct Arguments {
    SceneOptions scene;
    std::vector<std::string> sweeps;
    std::vector<std::string> only;
    double referenceError = 0.0;
    std::string output;
    std::string paths = "direct";
    double targetError = 0.0;
    double targetMilliseconds = 0.0;
    bool quick = false;
    bool quiet = false;
    std::string command;
};

// As it would be typed.
std::string commandOf(int argc, char** argv)
{
    std::string text;
    for (int i = 0; i < argc; ++i) {
        const std::string word = argv[i];
        const bool plain = !word.empty() && word.find_first_not_of(
                                                "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                                "_-./=,:+@%") == std::string::npos;
        std::string quoted = word;
        for (size_t at = 0; (at = quoted.find('\'', at)) != std::string::npos; at += 4) quoted.replace(at, 1, "'\\''");
        text += (i ? " " : "") + (plain ? word : "'" + quoted + "'");
    }
    return text;
}

Texts textsOf(const osgEnvLight::Settings& settings)
{
    Texts texts;
    for (const auto& p : osgEnvLight::Settings::table()) texts.emplace_back(p.name, p.getString(settings));
    return texts;
}

// The default's own measurement where the sweep only repeats it: a second timing would be another sample of the noise.
bool repeats(const Candidate& c, const osgEnvLight::Settings& base, const std::vector<Point>& points, Point& point)
{
    const osg::ref_ptr<osgEnvLight::Settings> settings = new osgEnvLight::Settings;
    Texts changed;
    apply(c, base, *settings, changed);
    for (const Point& known : points)
        if (!known.failed && known.settings == changed) {
            point = known;
            point.sweep = c.sweep;
            point.value = c.value;
            point.number = c.number;
            return true;
        }
    return false;
}

std::string stops(double exposure)
{
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(2);
    text << std::showpos << exposure << " stops";
    return text.str();
}

void printAnswers(const Report& report)
{
    for (const Target& target : report.targets) {
        const Choice choice = answerTo(target, report.points);
        const bool error = target.kind == Target::ERROR;
        std::cout << (error ? "Cheapest within an error of " + percent(target.value)
                            : "Most exact within " + milliseconds(target.value))
                  << ": ";
        if (choice)
            std::cout << nameOf(report.points[*choice]) << "\n" << settingsJson(report.points[*choice]) << "\n";
        else
            std::cout << "none was found; more values can be tried by --sweep\n";
    }
}

// What is shown of the default settings beside their figures.
void keepPictures(const Measurement& measurement, const Truth& truth, Report& report)
{
    report.ours = measurement.pictures().beauty;
    report.reference = truth[osgEnvLight::Layer::BEAUTY];
    // Where both differ widely, neither is to be all black or white.
    report.exposure = 0.5 * (truth.exposure + osgEnvLight::automaticExposure(report.ours, truth.mask));
    report.pictures = attribute(measurement.pictures(), truth);
}

// Up to the deadline; what is left then is named in the report, which has them in the order of the candidates.
void measureAll(const std::vector<Candidate>& all, Measurement& measurement, const Truth& truth, Report& report, ProgressBar& bar,
                double done, Clock::time_point deadline)
{
    const std::vector<size_t> order = measuringOrder(all);
    std::vector<Point> points;
    while (points.size() < all.size() && !Interruption::requested() && (points.empty() || Clock::now() < deadline)) {
        const Candidate& c = all[order[points.size()]];
        bar.show(done + (1.0 - done) * double(points.size()) / double(all.size()), c.sweep + " " + c.value);
        Point point;
        if (!repeats(c, measurement.settings(), points, point)) point = measurement.measure(c);
        points.push_back(point);
        if (points.size() == 1 && !point.failed) keepPictures(measurement, truth, report);
    }
    std::vector<const Point*> byCandidate(all.size(), nullptr);
    for (size_t i = 0; i < points.size(); ++i) byCandidate[order[i]] = &points[i];
    for (const Point* point : byCandidate)
        if (point) report.points.push_back(*point);

    const std::string share = std::to_string(points.size()) + " of " + std::to_string(all.size()) + " settings";
    if (Interruption::requested()) {
        report.interrupted = true;
        report.interruption = "Interrupted after " + share + ".";
    } else if (points.size() < all.size()) {
        report.notes.push_back("The time was up after " + share + "; a smaller --size or fewer settings by --sweep fit into it.");
    }
}

int run(Arguments& a)
{
    const Clock::time_point start = Clock::now();
    a.scene.check();
    // What is measured against direct light has no other.
    if (a.paths == "direct") a.scene.settings.insert(a.scene.settings.begin(), {"bounce=off", "reflections=map"});
    addPluginPath();
    Selection selection;
    selection.only = a.only;
    selection.quick = a.quick;
    selection.full = a.paths == "full";
    try {
        for (const std::string& s : a.sweeps) selection.sweeps.push_back(parseSweep(s));
        candidates(selection);
    } catch (const std::invalid_argument& error) {
        throw BadArguments(error.what());
    }
    const osg::ref_ptr<osgEnvLight::LitScene> lit = a.scene.load(true);
    const ReferenceScene reference(*lit, a.scene);
    if (reference.triangles().triangles == 0)
        throw std::runtime_error(a.scene.scene + ": the scene has no surface: there is nothing to measure");
    // A folder that can't be written should be known before the minutes of measuring.
    makeReportFolder(a.output);
    HeadlessViewer viewer(*lit, a.scene);
    const Interruption interruption;

    ProgressBar bar(a.quiet);
    const double referenceShare = 0.4;  // of the time, roughly
    TruthOptions options;
    options.full = a.paths == "full";
    options.error = a.referenceError > 0.0 ? a.referenceError : a.quick ? 0.01 : 0.003;
    options.seconds = a.quick ? 35.0 : 360.0;
    options.reach = double(lit->getSettings()->occlusionRadius) * reference.radius();
    const Truth truth = makeTruth(reference, options, [&](double fraction, double error) {
        bar.show(referenceShare * fraction, "reference, error " + percent(error));
        return !Interruption::requested();
    });
    if (truth.mask.pixels() == 0)
        throw std::runtime_error(a.scene.scene + ": no surface is in the view: there is nothing to measure");

    Measurement measurement(*lit, viewer, truth, a.quick ? 5 : 9);
    Report report;
    report.scene = a.scene.scene;
    report.map = lit->getEnvironmentMap()->getMap();
    report.width = a.scene.width;
    report.height = a.scene.height;
    report.date = today();
    report.command = a.command;
    report.hardware = describeHardware(viewer.context());
    report.defaults = textsOf(measurement.settings());
    report.timeStatement = measurement.statement();
    report.referenceStatement = truth.statement;
    report.errorStatement =
        "Error is the RMSE of v / (v + mean of the reference), over the pixels of the scene's surfaces that are not on an edge: "
        "0 is "
        "exact, and neither a highlight nor a dark corner outweighs the picture. SSIM and FLIP are of pictures exposed by " +
        stops(truth.exposure) + ".";
    report.quick = a.quick;
    report.notes = reference.triangles().leftOut;
    for (std::string& note : report.notes) note = "The reference leaves out: " + note;
    if (a.targetError > 0.0) report.targets.push_back({Target::ERROR, a.targetError});
    if (a.targetMilliseconds > 0.0) report.targets.push_back({Target::MILLISECONDS, a.targetMilliseconds});
    selection.specular = lit->plan().runs("specular");
    selection.areaLights = lit->plan().runs("areamaps");
    measureAll(candidates(selection), measurement, truth, report, bar, referenceShare,
               start + std::chrono::seconds(a.quick ? 105 : 1100));
    bar.finish();
    writeReport(report, a.output);
    if (!a.quiet) std::cout << headline(report, Summary(report)) << "\n" << a.output << "/index.html\n";
    printAnswers(report);
    if (report.interrupted) throw std::runtime_error("interrupted; " + a.output + "/index.html holds what was measured");
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    Arguments a;
    a.command = commandOf(argc, argv);
    CommandLine line("envlight-tradeoff",
                     "Measures what every setting costs and how exact it is, on this scene and machine, and writes a report.");
    a.scene.addTo(line);
    line.add("--sweep", a.sweeps, "name=value,value,...: measure these values of a setting too; repeatable").repeatable();
    line.add("--paths", a.paths, "what the reference has: direct (default) light, or full transport from surface to surface")
        .oneOf({"direct", "full"});
    line.add("--only", a.only, "of the presets and sweeps only those of these names: preset,occlusionLights").separatedBy(',');
    line.add("--reference-error", a.referenceError,
             "the reference's standard error, as a share of its mean; default .003, with --quick .01, or what six minutes, "
             "with --quick 35 seconds, allow")
        .within(1e-6, 1.0);
    line.addFlag("--quick", a.quick, "fewer settings and frames and a coarser reference: under two minutes");
    line.add("--target-error", a.targetError, "print the cheapest settings with at most this error: .02 is 2 %")
        .within(1e-6, 10.0);
    line.add("--target-ms", a.targetMilliseconds, "print the most exact settings within these milliseconds").within(1e-3, 1e6);
    line.addFlag("--quiet", a.quiet, "no progress, no headline");
    line.add("-o,--output", a.output, "folder of the report: index.html, tradeoff.csv, tradeoff.json").required();
    return line.run(argc, argv, [&] { return run(a); });
}
