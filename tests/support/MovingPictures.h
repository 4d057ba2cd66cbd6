// SPDX-License-Identifier: MIT
// Pictures of a motion, and how far they are off its coverage.
#pragma once

#include <metrics/Picture>

#include <algorithm>
#include <cmath>
#include <vector>

/** Means over squares of pixels. */
inline osgEnvLight::Picture shrunk(const osgEnvLight::Picture& large, int factor)
{
    osgEnvLight::Picture p(large.width / factor, large.height / factor);
    for (int y = 0; y < large.height; ++y)
        for (int x = 0; x < large.width; ++x)
            for (int k = 0; k < 4; ++k) p.at(x / factor, y / factor)[k] += large.at(x, y)[k] / float(factor * factor);
    return p;
}

struct MovingErrors {
    double error;   // root mean square over colours, pixels and frames
    double change;  // of that, what differs from frame to frame: a standard deviation
};

inline MovingErrors errorsOf(const std::vector<osgEnvLight::Picture>& shown, const std::vector<osgEnvLight::Picture>& truth)
{
    const auto frames = double(shown.size());
    double squares = 0.0, variances = 0.0;
    for (size_t i = 0; i < shown[0].rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        double sum = 0.0, sum2 = 0.0;
        for (size_t k = 0; k < shown.size(); ++k) {
            const double d = double(shown[k].rgba[i]) - double(truth[k].rgba[i]);
            sum += d / frames;
            sum2 += d * d / frames;
        }
        squares += sum2;
        variances += std::max(0.0, sum2 - sum * sum);
    }
    const auto colours = double(3 * shown[0].pixels());
    return {std::sqrt(squares / colours), std::sqrt(variances / colours)};
}
