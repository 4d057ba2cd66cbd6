// SPDX-License-Identifier: MIT
#include <metrics/Flip>

#include <algorithm>
#include <cmath>
#include <functional>

#include <metrics/Display>
#include <metrics/Metrics>

namespace osgEnvLight
{

namespace
{

using osg::Vec3d;
using Kernel = std::vector<double>;
const double pi = std::acos(-1.0);

struct Matrix {
    Vec3d row[3];
    Vec3d operator*(const Vec3d& v) const { return Vec3d(row[0] * v, row[1] * v, row[2] * v); }
};

Matrix inverse(const Matrix& m)
{
    const Vec3d c[3] = {m.row[1] ^ m.row[2], m.row[2] ^ m.row[0], m.row[0] ^ m.row[1]};
    const double d = m.row[0] * c[0];
    return {{Vec3d(c[0][0], c[1][0], c[2][0]) / d, Vec3d(c[0][1], c[1][1], c[2][1]) / d, Vec3d(c[0][2], c[1][2], c[2][2]) / d}};
}

// From linear sRGB to XYZ over that of white (D65, of which the rows' sums are 1).
const Matrix& toXyz()
{
    static const Matrix matrix = [] {
        Matrix m = {{Vec3d(10135552.0, 8788810.0, 4435075.0) / 24577794.0, Vec3d(2613072.0, 8788810.0, 887015.0) / 12288897.0,
                     Vec3d(1425312.0, 8788810.0, 70074185.0) / 73733382.0}};
        for (Vec3d& row : m.row) row /= row[0] + row[1] + row[2];
        return m;
    }();
    return matrix;
}

const Matrix& fromXyz()
{
    static const Matrix matrix = inverse(toXyz());
    return matrix;
}

// The linear opponent space: luminance, red-green, blue-yellow. Without the offset of Y, which no filter changes.
Vec3d opponent(const Vec3d& rgb)
{
    const Vec3d xyz = toXyz() * rgb;
    return Vec3d(xyz[1], xyz[0] - xyz[1], xyz[1] - xyz[2]);
}

Vec3d fromOpponent(const Vec3d& o)
{
    return fromXyz() * Vec3d(o[0] + o[1], o[0], o[0] - o[2]);
}

double labCurve(double t)
{
    const double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

// L*a*b*, colour weighed by lightness (Hunt).
Vec3d huntLab(const Vec3d& rgb)
{
    const Vec3d xyz = toXyz() * rgb;
    const double x = labCurve(xyz[0]), y = labCurve(xyz[1]), z = labCurve(xyz[2]);
    const double lightness = 116.0 * y - 16.0;
    return Vec3d(lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z));
}

double hyab(const Vec3d& a, const Vec3d& b)
{
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// To [0,1]: p_c of the largest distance is p_t.
double colourError(const Vec3d& lab, const Vec3d& reference)
{
    const double qc = 0.7, pc = 0.4, pt = 0.95;
    static const double largest = std::pow(hyab(huntLab(Vec3d(0.0, 1.0, 0.0)), huntLab(Vec3d(0.0, 0.0, 1.0))), qc);
    const double error = std::pow(hyab(lab, reference), qc);
    const double knee = pc * largest;
    return error < knee ? pt * error / knee : pt + (error - knee) / (largest - knee) * (1.0 - pt);
}

double sum(const Kernel& kernel)
{
    double s = 0.0;
    for (double k : kernel) s += k;
    return s;
}

void scale(Kernel& kernel, double factor)
{
    for (double& k : kernel) k *= factor;
}

struct Gaussian {
    double a;
    double b;
};

// The contrast sensitivity of a channel: a sum of Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees.
ScalarMap contrastFiltered(const ScalarMap& channel, const std::vector<Gaussian>& gaussians, double pixelsPerDegree)
{
    const double widest = 0.04;
    const int radius = int(std::ceil(3.0 * std::sqrt(widest / (2.0 * pi * pi)) * pixelsPerDegree));
    std::vector<Kernel> kernels;
    double total = 0.0;
    for (const Gaussian& g : gaussians) {
        kernels.push_back(gaussianKernel(std::sqrt(g.b / 2.0) / pi * pixelsPerDegree, radius));
        scale(kernels.back(), std::sqrt(g.a * std::sqrt(pi / g.b)));
        total += sum(kernels.back()) * sum(kernels.back());
    }
    ScalarMap result(channel.width, channel.height);
    for (Kernel& k : kernels) {
        scale(k, 1.0 / std::sqrt(total));
        const ScalarMap part = filtered(channel, k, k, Border::REPLICATED);
        for (size_t i = 0; i < result.values.size(); ++i) result.values[i] += part.values[i];
    }
    return result;
}

ScalarMap magnitude(const ScalarMap& luminance, const Kernel& detector, const Kernel& smoothing)
{
    ScalarMap x = filtered(luminance, detector, smoothing, Border::REPLICATED);
    const ScalarMap y = filtered(luminance, smoothing, detector, Border::REPLICATED);
    for (size_t i = 0; i < x.values.size(); ++i) x.values[i] = std::hypot(x.values[i], y.values[i]);
    return x;
}

// Weights above 0 sum to 1, those below to -1.
void balance(Kernel& kernel)
{
    double above = 0.0, below = 0.0;
    for (double k : kernel) (k > 0.0 ? above : below) += k;
    for (double& k : kernel) k /= k > 0.0 ? above : -below;
}

// A picture as FLIP sees it.
struct View {
    ScalarMap luminance;
    std::vector<Vec3d> lab;
    ScalarMap edges;
    ScalarMap points;
};

void detectFeatures(View& view, double pixelsPerDegree)
{
    const double sigma = 0.5 * 0.082 * pixelsPerDegree;
    const int radius = int(std::ceil(3.0 * sigma));
    Kernel smoothing = gaussianKernel(sigma, radius);
    Kernel edge = smoothing;
    Kernel point = smoothing;
    for (int x = -radius; x <= radius; ++x) {
        edge[size_t(x + radius)] *= -x;
        point[size_t(x + radius)] *= x * x / (sigma * sigma) - 1.0;
    }
    balance(edge);
    balance(point);
    scale(smoothing, 1.0 / sum(smoothing));
    view.edges = magnitude(view.luminance, edge, smoothing);
    view.points = magnitude(view.luminance, point, smoothing);
}

using Displayed = std::function<Vec3d(const Vec3d&)>;

View viewOf(const Picture& picture, const Displayed& displayed, double pixelsPerDegree)
{
    ScalarMap channels[3];
    for (ScalarMap& c : channels) c = ScalarMap(picture.width, picture.height);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const Vec3d o = opponent(displayed(picture.color(x, y)));
            for (int k = 0; k < 3; ++k) channels[k].at(x, y) = o[k];
        }
    View view;
    view.luminance = channels[0];
    channels[0] = contrastFiltered(channels[0], {{1.0, 0.0047}}, pixelsPerDegree);
    channels[1] = contrastFiltered(channels[1], {{1.0, 0.0053}}, pixelsPerDegree);
    channels[2] = contrastFiltered(channels[2], {{34.1, 0.04}, {13.5, 0.025}}, pixelsPerDegree);
    for (size_t i = 0; i < picture.pixels(); ++i) {
        const Vec3d o(channels[0].values[i], channels[1].values[i], channels[2].values[i]);
        view.lab.push_back(huntLab(exposed(fromOpponent(o), 0.0)));
    }
    detectFeatures(view, pixelsPerDegree);
    return view;
}

ScalarMap difference(const Picture& picture, const Picture& reference, const Displayed& displayed, double pixelsPerDegree)
{
    requireSameSize(picture, reference);
    const View x = viewOf(picture, displayed, pixelsPerDegree);
    const View r = viewOf(reference, displayed, pixelsPerDegree);
    ScalarMap result(picture.width, picture.height);
    for (size_t i = 0; i < result.values.size(); ++i) {
        const double edge = std::abs(x.edges.values[i] - r.edges.values[i]);
        const double point = std::abs(x.points.values[i] - r.points.values[i]);
        const double feature = std::sqrt(std::max(edge, point) / std::sqrt(2.0));  // q_f = .5
        result.values[i] = std::pow(colourError(x.lab[i], r.lab[i]), 1.0 - feature);
    }
    return result;
}

// The ACES fit (a x^2 + b x) / (c x^2 + d x + e), its exposure of .6 taken in.
namespace aces
{
const double a = 0.36 * 2.51, b = 0.6 * 0.03, c = 0.36 * 2.43, d = 0.6 * 0.59, e = 0.14;
}

double toneMapped(double x)
{
    if (!(x > 0.0)) return 0.0;
    return std::min((aces::a + aces::b / x) / (aces::c + (aces::d + aces::e / x) / x), 1.0);
}

double toneInverse(double y)
{
    const double square = aces::a - aces::c * y;
    const double half = 0.5 * (aces::b - aces::d * y) / square;
    return -half + std::sqrt(half * half + aces::e * y / square);
}

}  // namespace

ScalarMap flip(const Picture& picture, const Picture& reference, double stops, double pixelsPerDegree)
{
    return difference(
        picture, reference, [stops](const Vec3d& v) { return exposed(v, stops); }, pixelsPerDegree);
}

ExposureRange flipExposures(const Picture& reference)
{
    std::vector<double> luminances;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x) {
            const double l = luminance(reference.color(x, y));
            if (l > 0.0 && std::isfinite(l)) luminances.push_back(l);
        }
    if (luminances.empty()) return {0.0, 0.0, 1};
    const double bright = toneInverse(0.85);
    const double start = std::log2(bright / percentile(luminances, 1000));
    const double stop = std::log2(bright / percentile(luminances, 500));
    return {start, stop, std::max(2, int(std::ceil(stop - start)))};
}

ScalarMap hdrFlip(const Picture& picture, const Picture& reference, double pixelsPerDegree)
{
    const ExposureRange range = flipExposures(reference);
    ScalarMap result(reference.width, reference.height);
    for (int i = 0; i < range.count; ++i) {
        const double factor = std::exp2(range.start + (range.stop - range.start) * i / std::max(range.count - 1, 1));
        const Displayed displayed = [factor](const Vec3d& v) {
            return Vec3d(toneMapped(factor * v[0]), toneMapped(factor * v[1]), toneMapped(factor * v[2]));
        };
        const ScalarMap error = difference(picture, reference, displayed, pixelsPerDegree);
        for (size_t k = 0; k < result.values.size(); ++k) result.values[k] = std::max(result.values[k], error.values[k]);
    }
    return result;
}

}  // namespace osgEnvLight
