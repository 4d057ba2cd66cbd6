// SPDX-License-Identifier: MIT
// What the mains of the programs have in common: 0 done, 1 the work failed, 2 bad arguments; one message on stderr.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <iostream>
#include <stdexcept>

struct BadArguments : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/** Parse, run, and turn what is thrown into a message and the exit status. */
inline int runCommandLine(CLI::App& app, int argc, char** argv, const std::function<int()>& run)
{
    try {
        app.parse(argc, argv);
        return run();
    } catch (const CLI::CallForHelp& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        std::cerr << app.get_name() << ": " << e.what() << "\n";
        return 2;
    } catch (const BadArguments& e) {
        std::cerr << app.get_name() << ": " << e.what() << "\n";
        return 2;
    } catch (const std::exception& e) {
        std::cerr << app.get_name() << ": " << e.what() << "\n";
        return 1;
    }
}
