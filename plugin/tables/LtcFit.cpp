// SPDX-License-Identifier: MIT
#include "LtcFit.h"

#include <cmath>

#include "glsl.h"

namespace
{

using glsl::vec3;
using glsl::vec4;

const double pi = std::acos(-1.0);
// Narrower lobes are mirrors, and their shape is the same.
const double leastRoughness = 0.03;
const int normals = 28;  // along each side of the square of visible normals
const int cosines = 14;  // along each side of the square of directions by their cosine

// A lobe's matrix is a turn about y by `w` of [e^x 0 z; 0 e^y 0; 0 0 1]: logarithms of its widths, shear, tilt.
vec4 inverseOf(const vec4& lobe)
{
    const double c = std::cos(lobe.w), s = std::sin(lobe.w), narrow = std::exp(lobe.y - lobe.x), y = std::exp(lobe.y);
    return vec4((c - lobe.z * s) * narrow, -(s + lobe.z * c) * narrow, s * y, c * y);
}

// The lobe's directions with y > 0, by two densities together: GGX's visible normals, and the cosine.
class Target
{
  public:
    Target(double roughness, double cosine) : _alpha(roughness * roughness), _view(std::sqrt(1.0 - cosine * cosine), 0.0, cosine)
    {
        for (int i = 0; i < normals; ++i)
            for (int j = 0; j < normals; ++j) {
                const glsl::vec2 u(0.5 * (i + 0.5) / normals, (j + 0.5) / normals);
                const vec3 h = glsl::ggxVisibleNormalSample(_view, _alpha, u);
                add(2.0 * glsl::dot(_view, h) * h - _view);
            }
        for (int i = 0; i < cosines; ++i)
            for (int j = 0; j < cosines; ++j) {
                const double angle = pi * (i + 0.5) / cosines, square = (j + 0.5) / cosines;
                const double sine = std::sqrt(square);
                add(vec3(sine * std::cos(angle), sine * std::sin(angle), std::sqrt(1.0 - square)));
            }
        double sum = 0.0;
        for (const Point& p : _points) sum += 2.0 * p.weight * p.weight * p.value;
        for (Point& p : _points) p.value /= sum;
    }

    size_t size() const { return _points.size(); }

    /** Weighed differences at the directions. @return the sum of their squares*/
    double differences(const vec4& lobe, std::vector<double>& out) const
    {
        glsl::Ltc ltc;
        ltc.inverse = inverseOf(lobe);
        const vec4& m = ltc.inverse;
        const double scale = (m.x * m.w - m.y * m.z) / pi / (1.0 - glsl::ltcLeak(m));
        double sum = 0.0;
        for (size_t i = 0; i < _points.size(); ++i) {
            const vec3 q = glsl::toCosineLobe(ltc, _points[i].direction);
            const double square = glsl::dot(q, q);
            const double fitted = scale * std::max(q.z, 0.0) / (square * square);
            out[i] = _points[i].weight * (_points[i].value - fitted);
            sum += out[i] * out[i];
        }
        return sum;
    }

  private:
    struct Point {
        vec3 direction;
        double weight;  // root of the solid angle that it stands for
        double value;
    };

    void add(const vec3& l)
    {
        if (l.z <= 0.0) return;
        const vec3 h = glsl::normalize(_view + l);
        const double density =
            2.0 * normals * normals * glsl::ggxReflectionPdf(_view, h, _alpha) + 2.0 * cosines * cosines * l.z / pi;
        _points.push_back({l, 1.0 / std::sqrt(density), glsl::ggxBrdf(_view, l, _alpha) * l.z});
    }

    double _alpha;
    vec3 _view;
    std::vector<Point> _points;
};

// The equations of least squares about a lobe whose differences are known.
struct NormalEquations {
    glsl::mat4 matrix = glsl::mat4(0.0);
    vec4 slope = vec4(0.0);

    NormalEquations(const Target& target, const vec4& lobe, const std::vector<double>& differences)
    {
        const double step = 1e-5;
        const size_t n = target.size();
        std::vector<double> change[4];
        for (int j = 0; j < 4; ++j) {
            vec4 beside = lobe;
            beside[j] += step;
            change[j].resize(n);
            target.differences(beside, change[j]);
            for (size_t i = 0; i < n; ++i) change[j][i] = (change[j][i] - differences[i]) / step;
        }
        for (int j = 0; j < 4; ++j)
            for (size_t i = 0; i < n; ++i) {
                slope[j] += change[j][i] * differences[i];
                for (int k = 0; k < 4; ++k) matrix[j][k] += change[j][i] * change[k][i];
            }
    }

    vec4 step(double damping) const
    {
        glsl::mat4 damped = matrix;
        for (int j = 0; j < 4; ++j) damped[j][j] += damping * matrix[j][j] + 1e-14;
        return glsl::clamp(glm::inverse(damped) * slope, vec4(-0.5), vec4(0.5));
    }
};

// Levenberg and Marquardt's steps from a lobe on. @return the sum of squares that is left
double descend(const Target& target, vec4& lobe)
{
    std::vector<double> now(target.size()), next(target.size());
    double sum = target.differences(lobe, now);
    double damping = 1e-3;
    for (int round = 0; round < 60; ++round) {
        const NormalEquations equations(target, lobe, now);
        double gain = 0.0;
        for (int attempt = 0; attempt < 8 && gain <= 0.0; ++attempt) {
            const vec4 candidate = lobe - equations.step(damping);
            gain = sum - target.differences(candidate, next);
            damping = gain > 0.0 ? std::max(1e-9, 0.2 * damping) : 6.0 * damping;
            if (gain <= 0.0) continue;
            lobe = candidate;
            sum -= gain;
            now.swap(next);
        }
        if (gain < 1e-9 * sum) break;
    }
    return sum;
}

// What makes a lobe narrower: nothing else changes.
vec4 scaled(const vec4& lobe, double width)
{
    return lobe + vec4(std::log(width), std::log(width), 0.0, 0.0);
}

double cosineAt(int i, int count)
{
    return std::max(std::cos(0.5 * pi * i / (count - 1)), glsl::LTC_LEAST_COSINE);
}

// The lobe that narrow reflections have: twice the normals' width in the plane of incidence, across it times the cosine.
vec4 mirrored(double alpha, double cosine, double width)
{
    return vec4(std::log(width * alpha), std::log(width * alpha * std::max(cosine, 0.02)), 0.0, -std::acos(cosine));
}

std::vector<vec4> fitRow(double roughness, int count)
{
    // Shear and tilt of narrow lobes hardly matter and are not found: they stay what they are for wider ones.
    std::vector<vec4> wider;
    if (roughness < leastRoughness * 3.0) wider = fitRow(roughness * 2.0, count);
    std::vector<vec4> row;
    for (int i = 0; i < count; ++i) {
        const double alpha = roughness * roughness;
        const double cosine = cosineAt(i, count);
        const Target target(roughness, cosine);
        std::vector<vec4> starts;
        if (!wider.empty()) starts.push_back(scaled(wider[size_t(i)], 0.25));
        if (!row.empty()) starts.push_back(row.back());
        for (double width : {0.7, 1.4, 2.8}) starts.push_back(mirrored(alpha, cosine, width));
        vec4 best(0.0);
        double least = 1e300;
        for (vec4& lobe : starts) {
            const double left = descend(target, lobe);
            if (left > 0.999 * least) continue;
            best = lobe;
            least = left;
        }
        row.push_back(best);
    }
    return row;
}

}  // namespace

std::vector<std::array<double, 4>> fitLtcRow(double roughness, int count)
{
    const double r = std::max(roughness, leastRoughness);
    const std::vector<vec4> lobes = fitRow(r, count);
    std::vector<std::array<double, 4>> row;
    for (int i = 0; i < count; ++i) {
        const vec4 m = inverseOf(lobes[size_t(i)]);
        const double c = cosineAt(i, count);
        row.push_back({m.x - c * c, m.y - c * std::sqrt(1.0 - c * c), m.z / (r * r), m.w / (r * r)});
    }
    return row;
}
