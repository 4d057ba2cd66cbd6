// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

/** A line on stderr with what is done and how long the rest will take; nothing where stderr is not a terminal. */
class ProgressBar
{
  public:
    explicit ProgressBar(bool quiet);
    ~ProgressBar() { finish(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(double fraction, const std::string& what);
    /** Takes the line away. */
    void finish();

  private:
    bool _on;
    bool _shown = false;
    std::chrono::steady_clock::time_point _start;
};
