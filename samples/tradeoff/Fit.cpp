// SPDX-License-Identifier: MIT
#include "Fit.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tradeoff
{

namespace
{

const double steepest = 4.0;
const double rounding = 1e-12;

// The used pairs, logarithms of both; x relative to the smallest N.
struct Data {
    std::vector<double> x;
    std::vector<double> y;
    double smallest = 0.0;  // ln N
};

// e^scale ((1 - share) N^-p + share), N relative to the smallest.
struct Trial {
    double p = 0.0;
    double share = 0.0;  // of the floor at the smallest N
    double scale = 0.0;
    double squares = 0.0;  // sum over the residuals
};

double shape(double p, double share, double x)
{
    return std::log((1.0 - share) * std::exp(-p * x) + share);
}

// The best scale is the mean of what the shape leaves.
Trial judge(const Data& data, double p, double share)
{
    Trial c{p, share, 0.0, 0.0};
    for (size_t i = 0; i < data.x.size(); ++i) c.scale += (data.y[i] - shape(p, share, data.x[i])) / double(data.x.size());
    for (size_t i = 0; i < data.x.size(); ++i) {
        const double r = data.y[i] - c.scale - shape(p, share, data.x[i]);
        c.squares += r * r;
    }
    return c;
}

// A straight line in the logarithms.
Trial withoutFloor(const Data& data)
{
    const double n = double(data.x.size());
    double meanX = 0.0;
    double meanY = 0.0;
    for (size_t i = 0; i < data.x.size(); ++i) {
        meanX += data.x[i] / n;
        meanY += data.y[i] / n;
    }
    double xx = 0.0;
    double xy = 0.0;
    for (size_t i = 0; i < data.x.size(); ++i) {
        xx += (data.x[i] - meanX) * (data.x[i] - meanX);
        xy += (data.x[i] - meanX) * (data.y[i] - meanY);
    }
    return judge(data, -xy / xx, 0.0);
}

// Grids of p and of the logit of the share, each around the best of the one before: no start value to get wrong.
Trial withFloor(const Data& data)
{
    const int steps = 24;  // each way
    double p = 0.5 * steepest;
    double logit = 0.0;
    double reachP = 0.5 * steepest;
    double reachLogit = 20.0;
    Trial best = judge(data, p, 0.5);
    for (int level = 0; level < 24; ++level) {
        const double middleP = p;
        const double middleLogit = logit;
        for (int i = -steps; i <= steps; ++i)
            for (int k = -steps; k <= steps; ++k) {
                const double tryP = std::clamp(middleP + reachP * i / steps, 0.0, steepest);
                const double tryLogit = middleLogit + reachLogit * k / steps;
                const Trial c = judge(data, tryP, 1.0 / (1.0 + std::exp(-tryLogit)));
                if (c.squares >= best.squares) continue;
                best = c;
                p = tryP;
                logit = tryLogit;
            }
        reachP *= 0.4;
        reachLogit *= 0.4;
    }
    return best;
}

Fit fitOf(const Data& data, const Trial& c)
{
    Fit fit;
    fit.p = c.p;
    fit.a = (1.0 - c.share) * std::exp(c.scale + c.p * data.smallest);
    fit.b = c.share * std::exp(c.scale);
    fit.deviation = std::sqrt(c.squares / double(data.x.size()));
    return fit;
}

}  // namespace

double Fit::at(double n) const
{
    return a * std::pow(n, -p) + b;
}

Fit fitPowerLaw(const std::vector<double>& counts, const std::vector<double>& errors)
{
    Data data;
    std::vector<size_t> used;
    for (size_t i = 0; i < counts.size() && i < errors.size(); ++i) {
        if (!(counts[i] > 0.0 && errors[i] > 0.0) || !std::isfinite(counts[i]) || !std::isfinite(errors[i])) continue;
        used.push_back(i);
        data.x.push_back(std::log(counts[i]));
        data.y.push_back(std::log(errors[i]));
    }
    const size_t distinct = std::set<double>(data.x.begin(), data.x.end()).size();
    if (distinct < 2) return {};
    data.smallest = *std::min_element(data.x.begin(), data.x.end());
    for (double& x : data.x) x -= data.smallest;
    const auto [least, most] = std::minmax_element(data.y.begin(), data.y.end());
    Trial best = withoutFloor(data);
    if (*most - *least < rounding) {
        best = judge(data, 0.0, 1.0);
    } else if (distinct > 2) {
        const Trial floored = withFloor(data);
        if (floored.squares < best.squares - rounding) best = floored;
    }
    Fit fit = fitOf(data, best);
    fit.used = used;
    return fit;
}

}  // namespace tradeoff
