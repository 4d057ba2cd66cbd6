// SPDX-License-Identifier: MIT
// Regularised maximum entropy (sampling.md 3): per channel, with fluxes w0 summing to 1 and Y_i = sqrt(4 pi) Y_lm of
// light i, b the map's same moments,
//   maximise over x:  x.b - sum_i w0_i exp(Y_i.x) - 1/2 sum_j e_j x_j^2;   w_i = w0_i exp(Y_i.x)
//   e_j = kappa / N (pi / A_l)^2,  e_0 = 1e-12
// Always solvable, always positive; Newton with step halving takes 2 to 5 steps.
#include <osgEnvLight/LightSampler>
#include "environment/SphericalHarmonics.h"

#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

constexpr size_t terms = 18;
using Vector = std::array<double, terms>;
using Matrix = std::array<Vector, terms>;

// Solve a x = b, a symmetric positive definite (lower triangle used); false if it is not.
bool solveCholesky(Matrix& a, Vector& b)
{
    for (size_t j = 0; j < terms; ++j) {
        double d = a[j][j];
        for (size_t k = 0; k < j; ++k) d -= a[j][k] * a[j][k];
        if (!(d > 0.0)) return false;
        d = std::sqrt(d);
        a[j][j] = d;
        for (size_t i = j + 1; i < terms; ++i) {
            double t = a[i][j];
            for (size_t k = 0; k < j; ++k) t -= a[i][k] * a[j][k];
            a[i][j] = t / d;
        }
    }
    for (size_t i = 0; i < terms; ++i) {
        for (size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (size_t i = terms; i-- > 0;) {
        for (size_t k = i + 1; k < terms; ++k) b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return true;
}

// The dual problem of one channel.
class Channel
{
  public:
    Channel(const std::vector<Vector>& basis, std::vector<double> w0, const Vector& moments)
        : _basis(basis), _w0(std::move(w0)), _b(moments), _w(_w0)
    {
        for (size_t j = 0; j < terms; ++j) {
            const double a = glsl::PI / cosineBand(harmonicBand(int(j)));
            _e[j] = j == 0 ? 1e-12 : 0.1 / double(_w0.size()) * a * a;
        }
    }

    const std::vector<double>& solve()
    {
        Vector x{};
        double value = evaluate(x, _w);
        for (int iteration = 0; iteration < 30; ++iteration) {
            Vector step;
            const double slope = newtonStep(x, step);
            if (slope < 0.0 || !advance(x, step, slope, value)) break;
        }
        return _w;
    }

  private:
    // The negated dual at x, and its weights.
    double evaluate(const Vector& x, std::vector<double>& w) const
    {
        double sum = 0.0;
        for (size_t i = 0; i < _w0.size(); ++i) {
            double t = 0.0;
            for (size_t j = 0; j < terms; ++j) t += x[j] * _basis[i][j];
            w[i] = _w0[i] * std::exp(std::min(t, 50.0));
            sum += w[i];
        }
        for (size_t j = 0; j < terms; ++j) sum += x[j] * (0.5 * _e[j] * x[j] - _b[j]);
        return sum;
    }

    // Newton's step and the directional derivative along it; negative when the gradient has vanished.
    double newtonStep(const Vector& x, Vector& step) const
    {
        Matrix h{};
        Vector gradient;
        for (size_t j = 0; j < terms; ++j) gradient[j] = _b[j] - _e[j] * x[j];
        for (size_t i = 0; i < _w0.size(); ++i)
            for (size_t j = 0; j < terms; ++j) {
                const double y = _w[i] * _basis[i][j];
                gradient[j] -= y;
                for (size_t k = 0; k <= j; ++k) h[j][k] += y * _basis[i][k];
            }
        double largest = 0.0;
        for (size_t j = 0; j < terms; ++j) {
            largest = std::max(largest, std::abs(gradient[j]));
            h[j][j] += _e[j] + 1e-13;
        }
        step = gradient;
        if (largest < 1e-9 || !solveCholesky(h, step)) return -1.0;
        double slope = 0.0;
        for (size_t j = 0; j < terms; ++j) slope += gradient[j] * step[j];
        return slope;
    }

    bool advance(Vector& x, const Vector& step, double slope, double& value)
    {
        std::vector<double> w(_w0.size());
        double length = 1.0;
        for (int k = 0; k < 20; ++k, length *= 0.5) {
            Vector y = x;
            for (size_t j = 0; j < terms; ++j) y[j] += length * step[j];
            const double next = evaluate(y, w);
            if (next > value - 1e-4 * length * slope + 1e-15) continue;
            x = y;
            value = next;
            _w.swap(w);
            return true;
        }
        return false;
    }

    const std::vector<Vector>& _basis;
    std::vector<double> _w0;
    Vector _b;
    Vector _e;
    std::vector<double> _w;
};

}  // namespace

void matchHarmonics(LightList& lights, const RadianceMap& map)
{
    const double scale = std::sqrt(4.0 * glsl::PI);
    std::vector<Vector> basis(lights.size());
    for (size_t i = 0; i < lights.size(); ++i) {
        const osg::Vec3d& d = lights[i].direction;
        for (size_t j = 0; j < terms; ++j) basis[i][j] = scale * glsl::shBasis18(int(j), glsl::vec3(d[0], d[1], d[2]));
    }
    for (int c = 0; c < 3; ++c) {
        const double flux = map.flux[c];
        if (!(flux > 0.0)) continue;
        std::vector<double> w0(lights.size());
        Vector b;
        for (size_t i = 0; i < lights.size(); ++i) w0[i] = lights[i].flux[c] / flux;
        for (size_t j = 0; j < terms; ++j) b[j] = scale * map.harmonics()[j][c] / flux;
        const std::vector<double> w = Channel(basis, w0, b).solve();
        double sum = 0.0;
        for (double x : w) sum += x;
        for (size_t i = 0; i < lights.size(); ++i) lights[i].flux[c] = w[i] / sum * flux;
    }
}

}  // namespace osgEnvLight
