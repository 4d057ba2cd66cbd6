// SPDX-License-Identifier: MIT
#include "ProgressBar.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <unistd.h>

ProgressBar::ProgressBar(bool quiet) : _on(!quiet && isatty(STDERR_FILENO)), _start(std::chrono::steady_clock::now()) {}

void ProgressBar::show(double fraction, const std::string& what)
{
    if (!_on) return;
    _shown = true;
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - _start).count();
    const double left = fraction > 0.0 ? elapsed * (1.0 - fraction) / fraction : 0.0;
    const int width = 24;
    const int full = int(std::lround(std::clamp(fraction, 0.0, 1.0) * width));
    std::cerr << "\r[" << std::string(size_t(full), '#') << std::string(size_t(width - full), '.') << "] "
              << std::lround(100.0 * fraction) << " %, " << std::lround(left) << " s left, " << what << "\033[K" << std::flush;
}

void ProgressBar::finish()
{
    if (_shown) std::cerr << "\r\033[K" << std::flush;
    _shown = false;
}
