// SPDX-License-Identifier: MIT
// envlight-viewer: a scene lit by its environment in a window, with its settings at hand.
#include "CommandLine.h"
#include "EnvlightViewer.h"
#include "PluginPath.h"

int main(int argc, char** argv)
{
    SceneOptions options;
    options.interactive = true;
    options.size = "1024x768";
    CommandLine line(
        "envlight-viewer",
        "Shows a scene lit by a high-dynamic-range environment in a window; h lists the keys, and files may be dropped.");
    options.addTo(line);
    return line.run(argc, argv, [&] {
        options.check();
        addPluginPath();
        EnvlightViewer(options).run();
        return 0;
    });
}
