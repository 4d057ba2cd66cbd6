// SPDX-License-Identifier: MIT
// How far the best ambient occlusion is from the truth on each row of the image suite: all of the picture is exact, but O is D
// times the share of an even sky that is hidden, which is exact too. The image tests hold our pictures against it:
//   envlight_scalar_study tests/suite/exact_scalar_occlusion.csv
// The mean of a product of two independent estimates of a difference is its mean square: nothing need be known of their noise.
#include <metrics/Metrics>
#include <reference/Reference>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <stdexcept>

#include "SceneRenderer.h"
#include "Suite.h"

using osg::Vec3d;
using osgEnvLight::Environment;
using osgEnvLight::EnvironmentMap;
using osgEnvLight::Layer;
using osgEnvLight::MapEnvironment;
using osgEnvLight::Mask;
using osgEnvLight::RayScene;
using osgEnvLight::Reference;
using osgEnvLight::ReferenceOptions;
using osgEnvLight::ReferenceResult;
using suite::TracedRow;

namespace
{

// One of two estimates.
struct Half {
    Picture beauty, diffuse, occlusion;
    Picture evenDiffuse, evenOcclusion;

    // Of the picture with exact ambient occlusion from the truth.
    Vec3d scalarError(int x, int y) const
    {
        const Vec3d d = diffuse.color(x, y), o = occlusion.color(x, y);
        const Vec3d sky = evenDiffuse.color(x, y), hidden = evenOcclusion.color(x, y);
        Vec3d e;
        for (int k = 0; k < 3; ++k) e[k] = o[k] - (sky[k] > 0.0 ? d[k] * hidden[k] / sky[k] : 0.0);
        return e;
    }
};

struct ScalarError {
    const Half* halves;

    Vec3d operator()(int half, int x, int y) const { return halves[half].scalarError(x, y); }
};

osg::ref_ptr<const osgEnvLight::RadianceMap> evenSky()
{
    std::string error;
    osg::ref_ptr<const osgEnvLight::RadianceMap> sky = osg::ref_ptr(new EnvironmentMap(constantMap(1.0).get()))->radiance(error);
    if (!sky) throw std::runtime_error(error);
    return sky;
}

Half trace(const TracedRow& row, const RayScene& rays, unsigned seed)
{
    static const MapEnvironment even(*evenSky(), 0.0, 1.0);
    ReferenceOptions options;
    options.estimator = ReferenceOptions::MIS;
    options.samples = options.pass = 256;
    const auto render = [&](const Environment& environment, unsigned s) {
        options.seed = s;
        return Reference(rays, row.camera, environment).render(options, {Layer::DIFFUSE, Layer::OCCLUSION});
    };
    // The suite's reference has seed 0.
    const ReferenceResult lit = render(row.environment, 2 * seed + 1), sky = render(even, 2 * seed + 2);
    return {lit.mean(Layer::BEAUTY), lit.mean(Layer::DIFFUSE), lit.mean(Layer::OCCLUSION), sky.mean(Layer::DIFFUSE),
            sky.mean(Layer::OCCLUSION)};
}

struct Square {
    double mean = 0.0;
    double error = 0.0;  // standard error

    double root() const { return std::sqrt(std::max(mean, 0.0)); }
    double rootError() const { return std::sqrt(std::max(mean, 0.0) + error) - root(); }
};

// Mean over pixels and channels of a b, where a and b estimate the same difference. If both vary by s about it, which is e, then
// (a^2 - b^2) / 2 varies as a b does: by 2 e^2 s^2 + s^4. A pixel's channels count as wholly correlated.
template <class Difference>
Square meanSquare(const Mask& mask, Difference difference)
{
    double sum = 0.0, variance = 0.0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            if (!mask.at(x, y)) continue;
            const Vec3d a = difference(0, x, y), b = difference(1, x, y);
            sum += a * b;
            variance += 0.25 * (a * a - b * b) * (a * a - b * b);
        }
    const double n = 3.0 * double(mask.pixels());
    const Square square{sum / n, std::sqrt(variance) / n};
    if (square.mean < -4.0 * square.error) throw std::runtime_error("a mean square below 0 by more than its noise");
    return square;
}

// A row by compare()'s measures, with the same reference in their denominators.
class Study
{
  public:
    Study(const TracedRow& row) : _row(row), _rays(row.triangles), _halves{trace(row, _rays, 0), trace(row, _rays, 1)}
    {
        _mean = osgEnvLight::compare(row.reference, row.reference, row.inside).meanLuminance;
    }

    Square scalarRelative() const { return relative(_row.inside, ScalarError{_halves}); }
    Square scalarToned() const
    {
        return meanSquare(_row.inside, [&](int half, int x, int y) {
            const Vec3d truth = _halves[half].beauty.color(x, y);
            return toned(truth + _halves[half].scalarError(x, y)) - toned(truth);
        });
    }

    // Of our picture.
    Square relative() const
    {
        return relative(_row.inside,
                        [&](int half, int x, int y) { return _row.picture.color(x, y) - _halves[half].beauty.color(x, y); });
    }
    Square toned() const
    {
        return meanSquare(_row.inside, [&](int half, int x, int y) {
            return toned(_row.picture.color(x, y)) - toned(_halves[half].beauty.color(x, y));
        });
    }

    // Of D - O alone: relMSE, over the picture's squares all the same, and RMSE over its mean.
    void printVisible() const
    {
        const auto ours = [&](int half, int x, int y) {
            const Half& truth = _halves[half];
            return _row.diffuse.color(x, y) - _row.occlusion.color(x, y) - truth.diffuse.color(x, y) +
                   truth.occlusion.color(x, y);
        };
        const auto e = osgEnvLight::compare(_halves[0].occlusion, _halves[0].diffuse, _row.deferred);
        const double visible = -e.bias * e.mean;
        std::cout << "D - O: " << relative(_row.deferred, ScalarError{_halves}).mean << " rr "
                  << meanSquare(_row.deferred, ScalarError{_halves}).root() / visible << ", ours "
                  << relative(_row.deferred, ours).mean << " rr " << meanSquare(_row.deferred, ours).root() / visible;
    }

  private:
    template <class Difference>
    Square relative(const Mask& mask, Difference difference) const
    {
        return meanSquare(mask, [&](int half, int x, int y) {
            const Vec3d r = _row.reference.color(x, y);
            Vec3d d = difference(half, x, y);
            for (int k = 0; k < 3; ++k) d[k] /= std::hypot(r[k], 0.01 * _mean);
            return d;
        });
    }

    Vec3d toned(const Vec3d& v) const
    {
        return Vec3d(osgEnvLight::toned(v[0], _mean), osgEnvLight::toned(v[1], _mean), osgEnvLight::toned(v[2], _mean));
    }

    const TracedRow& _row;
    const RayScene _rays;
    const Half _halves[2];
    double _mean;
};

std::ostream& operator<<(std::ostream& out, const Square& square)
{
    return out << square.mean << " +- " << square.error;
}

suite::ScalarFigures run(const std::string& name, const TracedRow& row)
{
    const auto start = std::chrono::steady_clock::now();
    const Study study(row);
    const Square relative = study.scalarRelative(), toned = study.scalarToned();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    std::cout << std::left << std::setw(24) << name << std::setprecision(3) << "relMSE " << relative << ", ours "
              << study.relative() << "; tRMSE " << toned.root() << " +- " << toned.rootError() << ", ours "
              << study.toned().root() << " +- " << study.toned().rootError() << "; ";
    study.printVisible();
    std::cout << "; " << time.count() << " s" << std::endl;
    return {std::max(relative.mean, 0.0), toned.root(), relative.error, toned.rootError()};
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: envlight_scalar_study FILE\n";
        return 2;
    }
    try {
        std::map<std::string, suite::ScalarFigures> figures;
        for (const suite::Row& row : suite::rows())
            if (const auto traced = suite::traced(row)) figures[row.name()] = run(row.name(), *traced);
        suite::writeScalar(argv[1], figures);
    } catch (const std::exception& e) {
        std::cerr << e.what() << '\n';
        return 1;
    }
    return 0;
}
