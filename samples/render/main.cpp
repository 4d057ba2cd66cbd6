// SPDX-License-Identifier: MIT
// envlight-render: a scene lit by its environment, to an image, without an X server.
#include "HeadlessViewer.h"
#include "ImageFile.h"
#include "Interruption.h"
#include "PluginPath.h"
#include "ProgressBar.h"
#include "Statistics.h"
#include "Views.h"

#include <metrics/Display>

#include <osgDB/FileNameUtils>

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>

namespace
{

struct Arguments {
    SceneOptions scene;
    std::string output;
    std::string term;
    int frames = 0;
    double error = 0.0;
    Views views;
    std::string statistics;
};

void addOptions(CommandLine& line, Arguments& a)
{
    a.scene.addTo(line);
    line.add("--term", a.term, "an intermediate instead of the picture: diffuse, specular, occlusion, albedo, normal, depth ...");
    line.add("--frames", a.frames,
             "let the still picture converge (accumulate=on) over so many frames: the first is the normal one, each further "
             "one adds 64 lights with shadow maps of their own. Ctrl-C ends it earlier, with the picture that there is")
        .within(1, 65536);
    line.add("--error", a.error,
             "let it converge until its estimated standard error is this share of its mean, or for --frames, or 4096, frames")
        .within(1e-6, 1.0);
    a.views.addTo(line);
    line.add("--stats", a.statistics, "JSON file for plan and times");
    line.add("-o,--output", a.output,
             "OUT.exr (linear radiance) or OUT.png (exposed and tone mapped, transparent with background=off)")
        .required();
}

bool converges(const Arguments& a)
{
    return a.frames > 0 || a.error > 0.0;
}

// Draws what is to be written. False if a signal stopped it before the last frame. progress: the share that is done, after so
// many frames.
bool draw(HeadlessViewer& viewer, const osgEnvLight::LitScene& lit, const Arguments& a, Statistics& statistics,
          const std::function<void(double, int)>& progress)
{
    const bool still = lit.getSettings()->accumulate;
    const int normalFrames = 2;    // the second has all textures and shaders
    const int settledFrames = 16;  // at most: what a large scene's view shows is known some frames later
    const bool normal = !converges(a);
    const int most = a.frames > 0 ? a.frames : normal ? normalFrames : 4096;
    while (statistics.frames < most || (normal && lit.regenerating() && statistics.frames < settledFrames)) {
        const double time = still ? 0.0 : std::min(statistics.frames, normalFrames - 1) / 30.0;
        (statistics.frames == 0 ? statistics.firstFrame : statistics.lastFrame) = viewer.draw(time);
        ++statistics.frames;
        const double error = lit.average().standardError;
        if (a.error > 0.0 && error >= 0.0 && error <= a.error) return true;
        if (statistics.frames < most && Interruption::requested()) return false;
        // The error falls with the root of the number of frames.
        const double ofError = a.error > 0.0 && error > 0.0 ? a.error * a.error / (error * error) : 0.0;
        progress(std::max(double(statistics.frames) / most, ofError), statistics.frames);
    }
    return true;
}

// Where no map is to be behind the scene, a PNG is transparent.
osg::ref_ptr<osg::Image> imageFor(const std::string& file, HeadlessViewer& viewer, const osgEnvLight::Settings& settings)
{
    if (osgDB::getLowerCaseFileExtension(file) == "exr") return viewer.image();
    const bool covers = settings.background == osgEnvLight::Settings::BACKGROUND_OFF;
    return covers ? osgEnvLight::eightBitCovered(viewer.picture()) : osgEnvLight::eightBit(viewer.picture());
}

// False if the only picture is not complete.
bool drawViews(HeadlessViewer& viewer, osgEnvLight::LitScene& lit, const Arguments& a, Statistics& statistics)
{
    const std::vector<osgEnvLight::HomeView> views = a.views.of(lit, a.scene);
    const auto fileOf = [&a](size_t i) { return a.views.several() ? numbered(a.output, i) : a.output; };
    std::vector<size_t> wanted;
    for (size_t i = 0; i < views.size(); ++i)
        if (a.views.makes(i, fileOf(i))) wanted.push_back(i);
    ProgressBar bar(wanted.size() < 2 && !converges(a));
    for (size_t k = 0; k < wanted.size(); ++k) {
        const std::string file = fileOf(wanted[k]);
        const auto show = [&](double share, int frames) {
            const std::string after = frames > 0 && converges(a) ? ", " + std::to_string(frames) + " frames" : "";
            bar.show((double(k) + share) / double(wanted.size()), file + after);
        };
        show(0.0, 0);
        viewer.setView(views[wanted[k]]);
        statistics.frames = 0;
        const bool complete = draw(viewer, lit, a, statistics, show);
        // --resume makes the pictures that are not there, so of several only complete ones are written.
        if (!complete && wanted.size() > 1) throw std::runtime_error("interrupted before " + file);
        writeWholeImageFile(*imageFor(file, viewer, *lit.getSettings()), file);
        if (!complete) return false;
        if (Interruption::requested() && k + 1 < wanted.size()) throw std::runtime_error("interrupted after " + file);
    }
    return true;
}

int run(Arguments& a)
{
    a.scene.check();
    addPluginPath();
    const std::string extension = osgDB::getLowerCaseFileExtension(a.output);
    if (extension != "exr" && extension != "png")
        throw BadArguments("-o is '" + a.output + "', expected a name ending in .exr or .png");
    if (!a.term.empty()) a.scene.settings.push_back("view=" + a.term);
    if (converges(a)) a.scene.settings.insert(a.scene.settings.begin(), {"accumulate=on", "accumulateFrames=65536"});
    osg::ref_ptr<osgEnvLight::LitScene> lit = a.scene.load(extension == "exr");
    HeadlessViewer viewer(*lit, a.scene);
    Statistics statistics{a.scene.scene, a.scene.width, a.scene.height};
    lit->setTimed(!a.statistics.empty());
    std::optional<Interruption> interruption;
    if (converges(a)) interruption.emplace();
    const bool complete = drawViews(viewer, *lit, a, statistics);
    std::string error;
    if (!a.statistics.empty() && !statistics.write(a.statistics, *lit, viewer.context(), error)) throw std::runtime_error(error);
    if (!complete)
        throw std::runtime_error("interrupted; " + a.output + " holds what " + std::to_string(statistics.frames) +
                                 " frames made");
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    CommandLine line("envlight-render",
                     "Renders a scene lit by a high-dynamic-range environment to an image, without an X server.");
    addOptions(line, arguments);
    return line.run(argc, argv, [&] { return run(arguments); });
}
