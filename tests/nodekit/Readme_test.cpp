// SPDX-License-Identifier: MIT
// Every command of the README works as it is written, from the project's folder.
#include <VirtualDisplay.h>

#include <gtest/gtest.h>

#include <sstream>

namespace
{

// The lines of all ```sh blocks.
std::vector<std::string> commands()
{
    std::istringstream in(readFile(ENVLIGHT_SOURCE_DIR "/README.md"));
    std::vector<std::string> result;
    bool inside = false;
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("```", 0) == 0)
            inside = line == "```sh";
        else if (inside && !line.empty())
            result.push_back(line);
    }
    return result;
}

}  // namespace

TEST(Readme, EveryCommandWorks)
{
    const VirtualDisplay display(1280, 1024);
    if (!display.running()) GTEST_SKIP() << "no Xvfb";
    const TemporaryFolder folder;
    std::string exports = "cd " ENVLIGHT_SOURCE_DIR "\n";
    int run = 0;
    for (const std::string& command : commands()) {
        SCOPED_TRACE(command);
        if (command.rfind("export ", 0) == 0) {
            exports += command + "\n";
            continue;
        }
        if (command == "tests/run") continue;  // this is it
        ++run;
        if (command.rfind("osgviewer ", 0) == 0) {
            const VirtualDisplay own(1280, 1024);
            const BackgroundProgram viewer({"bash", "-c", exports + "exec " + command}, folder.file("log"),
                                           {"DISPLAY=" + own.name()});
            EXPECT_FALSE(own.waitForPicture(1000, 700, 180).rgb.empty()) << readFile(folder.file("log"));
            continue;
        }
        // Without a display: what needs one says so or does without.
        const Outcome o = runProgram({"bash", "-c", "unset DISPLAY\n" + exports + command});
        EXPECT_EQ(0, o.status) << o.out << o.err;
    }
    EXPECT_GE(run, 6);
}
