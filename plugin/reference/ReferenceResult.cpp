// SPDX-License-Identifier: MIT
#include <reference/Reference>

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

bool isSampled(Layer layer)
{
    return layer < Layer::ALBEDO;
}

}  // namespace

ReferenceResult::ReferenceResult(int width, int height, const std::set<Layer>& layers)
    : _width(width), _height(height), _coverage(size_t(width) * size_t(height)), _passes(size_t(width) * size_t(height))
{
    for (Layer layer : layers) {
        Sums& s = _layers[size_t(layer)];
        s.sum.resize(3 * _coverage.size());
        if (isSampled(layer)) s.square.resize(3 * _coverage.size());
    }
}

Picture ReferenceResult::mean(Layer layer) const
{
    const std::vector<double>& sum = _layers[size_t(layer)].sum;
    Picture picture(_width, _height);
    for (size_t i = 0; i < _passes.size(); ++i) {
        const double n = std::max(_passes[i], 1u);
        for (size_t k = 0; k < 3 && !sum.empty(); ++k) picture.rgba[4 * i + k] = float(sum[3 * i + k] / n);
        picture.rgba[4 * i + 3] = float(double(_coverage[i]) / n);
    }
    return picture;
}

Picture ReferenceResult::standardError(Layer layer) const
{
    const Sums& s = _layers[size_t(layer)];
    Picture picture(_width, _height);
    for (size_t i = 0; i < _passes.size(); ++i) {
        const double n = _passes[i];
        if (n < 2.0 || s.square.empty()) continue;
        for (size_t k = 0; k < 3; ++k) {
            const double mean = s.sum[3 * i + k] / n;
            const double variance = std::max(0.0, s.square[3 * i + k] / n - mean * mean) * n / (n - 1.0);
            picture.rgba[4 * i + k] = float(std::sqrt(variance / n));
        }
    }
    return picture;
}

Picture ReferenceResult::visibility() const
{
    Picture diffuse = mean(Layer::DIFFUSE);
    const Picture occlusion = mean(Layer::OCCLUSION);
    for (size_t i = 0; i < diffuse.rgba.size(); ++i)
        if (i % 4 != 3) {
            const float d = diffuse.rgba[i];
            diffuse.rgba[i] = d > 0.0f ? std::clamp(1.0f - occlusion.rgba[i] / d, 0.0f, 1.0f) : 1.0f;
        }
    return diffuse;
}

double ReferenceResult::relativeError(Layer layer) const
{
    const Sums& s = _layers[size_t(layer)];
    double variance = 0.0;
    double total = 0.0;
    size_t pixels = 0;
    for (size_t i = 0; i < _passes.size() && !s.square.empty(); ++i) {
        const double n = _passes[i];
        if (n < 2.0 || _coverage[i] <= 0.0f) continue;
        ++pixels;
        for (size_t k = 0; k < 3; ++k) {
            const double mean = s.sum[3 * i + k] / n;
            total += mean / 3.0;
            variance += std::max(0.0, s.square[3 * i + k] / n - mean * mean) / (n - 1.0) / 3.0;
        }
    }
    return total > 0.0 ? std::sqrt(variance * double(pixels)) / total : 0.0;
}

}  // namespace osgEnvLight
