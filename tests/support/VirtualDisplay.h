// SPDX-License-Identifier: MIT
#pragma once

#include <Process.h>

#include <memory>

/** An 8-bit picture, rows from the top. */
struct Screen {
    int width = 0;
    int height = 0;
    std::vector<unsigned char> rgb;
};

/** An X server without a screen, whose picture can be read from the file it keeps it in. */
class VirtualDisplay
{
  public:
    VirtualDisplay(int width, int height);

    /** False if there is no Xvfb or it did not start. */
    bool running() const { return !_name.empty(); }
    /** ":93" */
    const std::string& name() const { return _name; }
    /** The top left corner as it is now; empty if it can't be read. */
    Screen read(int width, int height) const;
    /** The corner once it is not of one colour and has stopped changing; empty after that many seconds without. */
    Screen waitForPicture(int width, int height, int seconds) const;

  private:
    TemporaryFolder _folder;
    std::unique_ptr<BackgroundProgram> _server;
    std::string _name;
};
