/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

/** While it lives, Ctrl-C (SIGINT) and SIGTERM ask the program to write what there is and end. A second such signal ends it at
 * once. One at a time. */
class Interruption
{
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    static bool requested();
};
