// SPDX-License-Identifier: MIT
#include "Maths.h"

namespace testmaths
{

std::vector<glsl::vec3> spiral(int n)
{
    std::vector<glsl::vec3> result;
    for (int i = 0; i < n; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / n;
        const double phi = i * pi * (3.0 - std::sqrt(5.0));
        const double s = std::sqrt(1.0 - z * z);
        result.emplace_back(s * std::cos(phi), s * std::sin(phi), z);
    }
    return result;
}

Gauss gauss(int n, double low, double high)
{
    Gauss g;
    for (int i = 0; i < n; ++i) {
        double x = std::cos(pi * (i + 0.75) / (n + 0.5));
        double slope = 1.0;
        for (int iteration = 0; iteration < 50; ++iteration) {
            double p0 = 1.0;
            double p1 = x;
            for (int k = 2; k <= n; ++k) {
                const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            slope = n * (x * p1 - p0) / (x * x - 1.0);
            const double step = p1 / slope;
            x -= step;
            if (std::abs(step) < 1e-15) break;
        }
        g.x.push_back(0.5 * (low + high) + 0.5 * (high - low) * x);
        g.w.push_back((high - low) / ((1.0 - x * x) * slope * slope));
    }
    return g;
}

double integrateBand(const std::function<double(const glsl::vec3&)>& f, double z0, double z1, int nz, int nphi)
{
    const Gauss g = gauss(nz, z0, z1);
    double sum = 0.0;
    for (int i = 0; i < nz; ++i) {
        const double z = g.x[size_t(i)];
        const double s = std::sqrt(std::max(0.0, 1.0 - z * z));
        double ring = 0.0;
        for (int j = 0; j < nphi; ++j) {
            const double phi = 2.0 * pi * (j + 0.5) / nphi;
            ring += f(glsl::vec3(s * std::cos(phi), s * std::sin(phi), z));
        }
        sum += g.w[size_t(i)] * ring * 2.0 * pi / nphi;
    }
    return sum;
}

glsl::vec3 fromSlope(double slope, double phi)
{
    const double c = 1.0 / std::sqrt(1.0 + slope * slope);
    return glsl::vec3(c * slope * std::cos(phi), c * slope * std::sin(phi), c);
}

double integratePeak(const std::function<double(const glsl::vec3&)>& f, double alpha, int nt, int nphi)
{
    const Gauss g = gauss(nt, 0.0, 1.0);
    double sum = 0.0;
    for (int i = 0; i < nt; ++i) {
        const double t = g.x[size_t(i)];
        const double slope = alpha * t / (1.0 - t);
        // d(slope) = alpha / (1-t)^2 dt; solid angle = slope cos^3 d(slope) d(phi)
        const double jacobian = alpha / ((1.0 - t) * (1.0 - t)) * slope * std::pow(1.0 + slope * slope, -1.5);
        double ring = 0.0;
        for (int j = 0; j < nphi; ++j) ring += f(fromSlope(slope, 2.0 * pi * (j + 0.5) / nphi));
        sum += g.w[size_t(i)] * jacobian * ring * 2.0 * pi / nphi;
    }
    return sum;
}

glsl::vec2 microfacetAlbedo(int brdf, const glsl::vec3& v, double roughness,
                            const std::function<double(const Integrand&)>& integrate)
{
    const glsl::Bsdf b = glsl::makeBsdf(brdf, glsl::vec3(0), roughness, glsl::vec2(1, 0));
    const auto part = [&](bool offset) {
        return integrate([&](const glsl::vec3& l) {
            const glsl::vec3 h = glm::normalize(v + l);
            const double grazing = glsl::fresnelShare(glm::dot(h, v));
            return glsl::bsdfMicrofacets(b, v, l, h) * l.z * (offset ? grazing : 1.0 - grazing);
        });
    };
    return glsl::vec2(part(false), part(true));
}

double chiSquaredTail(double x, int degrees)
{
    // Regularised upper incomplete gamma function of (degrees/2, x/2): series below the mean, continued fraction above.
    const double a = 0.5 * degrees;
    const double y = 0.5 * x;
    if (y <= 0.0) return 1.0;
    const double scale = std::exp(a * std::log(y) - y - std::lgamma(a));
    if (y < a + 1.0) {
        double term = 1.0 / a;
        double sum = term;
        for (int n = 1; n < 10000 && term > 1e-16 * sum; ++n) sum += term *= y / (a + n);
        return 1.0 - scale * sum;
    }
    double b = y + 1.0 - a;
    double c = 1e300;
    double d = 1.0 / b;
    double h = d;
    for (int n = 1; n < 10000; ++n) {
        const double k = -n * (n - a);
        b += 2.0;
        d = 1.0 / (k * d + b);
        c = b + k / c;
        h *= c * d;
        if (std::abs(c * d - 1.0) < 1e-15) break;
    }
    return scale * h;
}

double chiSquaredTest(const std::vector<double>& observed, const std::vector<double>& expected)
{
    double statistic = 0.0;
    double pooledObserved = 0.0;
    double pooledExpected = 0.0;
    int bins = 0;
    auto add = [&](double o, double e) {
        statistic += (o - e) * (o - e) / e;
        ++bins;
    };
    for (size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] >= 5.0) {
            add(observed[i], expected[i]);
        } else {
            pooledObserved += observed[i];
            pooledExpected += expected[i];
        }
    }
    if (pooledExpected >= 5.0)
        add(pooledObserved, pooledExpected);
    else if (pooledObserved > 5.0 + 5.0 * std::sqrt(5.0))
        return 0.0;  // five standard deviations more than fall into bins that expect next to nothing
    return bins > 1 ? chiSquaredTail(statistic, bins - 1) : 0.0;
}

}  // namespace testmaths
