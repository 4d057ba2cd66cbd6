// SPDX-License-Identifier: MIT
// envlight-render: a scene lit by its environment, to an image, without an X server.
#include "HeadlessViewer.h"
#include "ImageFile.h"
#include "PluginPath.h"
#include "Statistics.h"

#include <metrics/Display>

#include <osgDB/FileNameUtils>

#include <stdexcept>

namespace
{

struct Arguments {
    SceneOptions scene;
    std::string output;
    std::string term;
    int frames = 2;  // the second has all textures and shaders
    std::string statistics;
};

void addOptions(CLI::App& app, Arguments& a)
{
    a.scene.addTo(app);
    app.add_option("--term", a.term,
                   "an intermediate instead of the picture: diffuse, specular, occlusion, albedo, normal, depth ...");
    app.add_option("--frames", a.frames, "frames to draw, the last is written; default 2")->check(CLI::Range(1, 1000000));
    app.add_option("--stats", a.statistics, "JSON file for plan and times");
    app.add_option("-o,--output", a.output, "OUT.exr (linear radiance) or OUT.png (exposed and tone mapped)")->required();
}

int run(Arguments& a)
{
    a.scene.check();
    addPluginPath();
    const std::string extension = osgDB::getLowerCaseFileExtension(a.output);
    if (extension != "exr" && extension != "png")
        throw BadArguments("-o is '" + a.output + "', expected a name ending in .exr or .png");
    if (!a.term.empty()) a.scene.settings.push_back("view=" + a.term);
    osg::ref_ptr<osgEnvLight::LitScene> lit = a.scene.load(extension == "exr");
    HeadlessViewer viewer(*lit, a.scene);
    Statistics statistics{a.scene.scene, a.scene.width, a.scene.height, a.frames};
    lit->setTimed(!a.statistics.empty());
    for (int i = 0; i < a.frames; ++i) (i == 0 ? statistics.firstFrame : statistics.lastFrame) = viewer.draw(i / 30.0);
    writeImageFile(extension == "exr" ? *viewer.image() : *osgEnvLight::eightBit(viewer.picture()), a.output);
    std::string error;
    if (!a.statistics.empty() && !statistics.write(a.statistics, *lit, viewer.context(), error)) throw std::runtime_error(error);
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    CLI::App app("Renders a scene lit by a high-dynamic-range environment to an image, without an X server.", "envlight-render");
    addOptions(app, arguments);
    return runCommandLine(app, argc, argv, [&] { return run(arguments); });
}
