// SPDX-License-Identifier: MIT
#include <metrics/Metrics>

#include <algorithm>

#include <metrics/Display>

namespace osgEnvLight
{

namespace
{

struct Sample {
    int x;
    int y;
    osg::Vec3d value;
    osg::Vec3d reference;
    osg::Vec3d variance;
};

bool finite(const osg::Vec3d& v)
{
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

double sum(const osg::Vec3d& v)
{
    return v[0] + v[1] + v[2];
}

// 0 of nothing is nothing.
double ratio(double a, double b)
{
    return a == 0.0 ? 0.0 : a / b;
}

std::vector<Sample> samplesOf(const Picture& picture, const Picture& reference, const Picture* standardError, const Mask& mask,
                              size_t& notFinite)
{
    std::vector<Sample> samples;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            if (!mask.at(x, y)) continue;
            Sample s = {x, y, picture.color(x, y), reference.color(x, y), osg::Vec3d()};
            if (standardError) s.variance = osg::componentMultiply(standardError->color(x, y), standardError->color(x, y));
            if (finite(s.value) && finite(s.reference) && finite(s.variance))
                samples.push_back(s);
            else
                ++notFinite;
        }
    return samples;
}

void measureToned(const std::vector<Sample>& samples, ErrorFigures& figures)
{
    const double mean = figures.meanLuminance;
    double square = 0.0, noise = 0.0;
    for (const Sample& s : samples)
        for (int k = 0; k < 3; ++k) {
            const double r = s.reference[k];
            const double d = toned(s.value[k], mean) - toned(r, mean);
            const double slope = ratio(mean, (std::abs(r) + mean) * (std::abs(r) + mean));
            square += d * d - slope * slope * s.variance[k];
            noise += slope * slope * s.variance[k];
        }
    const double n = 3.0 * double(samples.size());
    figures.tRmse = std::sqrt(std::max(square / n, 0.0));
    figures.tNoise = std::sqrt(noise / n);
}

void measureSquares(const std::vector<Sample>& samples, ErrorFigures& figures)
{
    const double eps = 0.01 * figures.meanLuminance;
    double square = 0.0, relative = 0.0, noise = 0.0, noiseSquare = 0.0;
    for (const Sample& s : samples) {
        for (int k = 0; k < 3; ++k) {
            const double r = s.reference[k];
            const double d = s.value[k] - r;
            square += d * d - s.variance[k];
            relative += ratio(d * d - s.variance[k], r * r + eps * eps);
        }
        noise += sum(s.variance);
        noiseSquare += 2.0 * sum(s.variance) * sum(s.variance);
    }
    const double n = 3.0 * double(samples.size());
    figures.rmse = std::sqrt(std::max(square / n, 0.0));
    figures.relMse = std::max(relative / n, 0.0);
    figures.noise = std::sqrt(noise / n);
    figures.resolved = square > 3.0 * std::sqrt(noiseSquare);
}

void measureTail(const std::vector<Sample>& samples, ErrorFigures& figures)
{
    std::vector<double> errors;
    for (const Sample& s : samples) {
        const double error = std::abs(luminance(s.value - s.reference));
        errors.push_back(error);
        if (error <= figures.worst) continue;
        figures.worst = error;
        figures.worstX = s.x;
        figures.worstY = s.y;
    }
    figures.p99 = ratio(percentile(errors, 990), figures.meanLuminance);
    figures.p999 = ratio(percentile(errors, 999), figures.meanLuminance);
}

ErrorFigures measure(const Picture& picture, const Picture& reference, const Picture* standardError, const Mask& mask)
{
    requireSameSize(picture, reference);
    requireSameSize(picture, mask);
    if (standardError) requireSameSize(picture, *standardError);
    ErrorFigures figures;
    const std::vector<Sample> samples = samplesOf(picture, reference, standardError, mask, figures.notFinite);
    figures.pixels = samples.size();
    if (samples.empty()) return figures;
    osg::Vec3d value, truth;
    for (const Sample& s : samples) {
        value += s.value - s.reference;
        truth += s.reference;
    }
    const double n = double(samples.size());
    figures.mean = sum(truth) / (3.0 * n);
    figures.meanLuminance = luminance(truth) / n;
    figures.bias = ratio(sum(value), sum(truth));
    measureSquares(samples, figures);
    measureToned(samples, figures);
    measureTail(samples, figures);
    return figures;
}

}  // namespace

ErrorFigures compare(const Picture& picture, const Picture& reference, const Mask& mask)
{
    return measure(picture, reference, nullptr, mask);
}

ErrorFigures compare(const Picture& picture, const Picture& reference, const Picture& standardError, const Mask& mask)
{
    return measure(picture, reference, &standardError, mask);
}

double toned(double v, double mean)
{
    return v == 0.0 ? 0.0 : v / (std::abs(v) + mean);
}

double percentile(std::vector<double>& values, unsigned perMille)
{
    if (values.empty()) return 0.0;
    const size_t rank = std::max((values.size() * perMille + 999) / 1000, size_t(1)) - 1;
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
    return values[rank];
}

}  // namespace osgEnvLight
