// SPDX-License-Identifier: MIT
#include <metrics/ScalarMap>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace osgEnvLight
{

namespace
{

// What one output reads of a row or column: the pixels first, first + 1, ..
struct Taps {
    int first;
    std::vector<double> weights;
};

std::vector<Taps> tapsOf(const std::vector<double>& kernel, int size, Border border)
{
    const int radius = int(kernel.size()) / 2;
    std::vector<Taps> taps(static_cast<size_t>(size));
    for (int i = 0; i < size; ++i) {
        Taps& t = taps[size_t(i)];
        t.first = std::max(i - radius, 0);
        const int last = std::min(i + radius, size - 1);
        t.weights.assign(size_t(last - t.first + 1), 0.0);
        for (int k = -radius; k <= radius; ++k) {
            const int inside = std::clamp(i + k, 0, size - 1);
            if (border == Border::REPLICATED || inside == i + k)
                t.weights[size_t(inside - t.first)] += kernel[size_t(k + radius)];
        }
        if (border == Border::REPLICATED) continue;
        const double sum = std::accumulate(t.weights.begin(), t.weights.end(), 0.0);
        for (double& w : t.weights) w /= sum;
    }
    return taps;
}

}  // namespace

double mean(const ScalarMap& map, const Mask& mask)
{
    requireSameSize(map, mask);
    double sum = 0.0;
    size_t pixels = 0;
    for (size_t i = 0; i < map.values.size(); ++i)
        if (mask.counts[i]) sum += map.values[i], ++pixels;
    return pixels > 0 ? sum / double(pixels) : 0.0;
}

ScalarMap filtered(const ScalarMap& map, const std::vector<double>& across, const std::vector<double>& along, Border border)
{
    const std::vector<Taps> columns = tapsOf(across, map.width, border);
    const std::vector<Taps> rows = tapsOf(along, map.height, border);
    ScalarMap half(map.width, map.height);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const Taps& t = columns[size_t(x)];
            half.at(x, y) =
                std::inner_product(t.weights.begin(), t.weights.end(), &map.values[size_t(y) * size_t(map.width)] + t.first, 0.0);
        }
    ScalarMap result(map.width, map.height);
    for (int y = 0; y < map.height; ++y)
        for (size_t k = 0; k < rows[size_t(y)].weights.size(); ++k) {
            const double weight = rows[size_t(y)].weights[k];
            const int row = rows[size_t(y)].first + int(k);
            for (int x = 0; x < map.width; ++x) result.at(x, y) += weight * half.at(x, row);
        }
    return result;
}

std::vector<double> gaussianKernel(double sigma, int radius)
{
    std::vector<double> kernel;
    for (int x = -radius; x <= radius; ++x) kernel.push_back(std::exp(-x * x / (2.0 * sigma * sigma)));
    return kernel;
}

}  // namespace osgEnvLight
