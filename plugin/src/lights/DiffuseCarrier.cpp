// SPDX-License-Identifier: MIT
#include "lights/DiffuseCarrier.h"

#include "lights/LightRegions.h"
#include "environment/SphericalHarmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double hysteresis = 1.2;

// The map as the lights of cells of 2.8 degrees, each at its flux centroid: the error of a cell's own irradiance is of
// second order, 1e-4 to 2.4e-4 (under small hard lamps).
LightList cells(const RadianceMap& map)
{
    const MomentTable table(map, 128);
    LightList lights;
    for (int y = 0; y < table.height(); ++y)
        for (int x = 0; x < table.width(); ++x) {
            LightRegion r{double(x), double(y), double(x + 1), double(y + 1), {}, {}};
            r.light = table.region(r.u0, r.v0, r.u1, r.v1);
            if (r.light.flux > 0.0) lights.push_back(regionLight(r, table));
        }
    return lights;
}

osg::Vec3d irradiance(const LightList& lights, const osg::Vec3d& n)
{
    osg::Vec3d sum;
    for (const DirectionalLight& l : lights) {
        const double c = l.direction * n;
        if (c > 0.0) sum += l.flux * c;
    }
    return sum;
}

HarmonicsError predict(const LightList& map)
{
    const int lastBand = 8;
    std::array<osg::Vec3d, 81> coefficients;
    std::array<double, 81> basis;
    for (const DirectionalLight& l : map) {
        evaluateHarmonics(lastBand, l.direction, basis.data());
        for (size_t i = 0; i < basis.size(); ++i) coefficients[i] += l.flux * basis[i];
    }
    std::array<double, lastBand + 1> power{};  // of irradiance, by band
    double sum = 0.0;
    for (int l = 0; l <= lastBand; ++l) {
        for (int i = l * l; i < (l + 1) * (l + 1); ++i) power[size_t(l)] += coefficients[size_t(i)].length2();
        power[size_t(l)] *= cosineBand(l) * cosineBand(l);
        sum += power[size_t(l)];
    }
    if (!(sum > 0.0)) return {0.0, 0.0};
    // The last band stands for all above it as well.
    return {std::sqrt((power[4] + power[6] + 2.0 * power[8]) / sum), std::sqrt((power[6] + 1.5 * power[8]) / sum)};
}

double measure(const LightList& truth, const LightList& lights)
{
    const int count = 64;
    double square = 0.0;
    double error = 0.0;
    for (int i = 0; i < count; ++i) {
        // A spiral with the golden angle covers the sphere evenly.
        const double z = 1.0 - 2.0 * (i + 0.5) / count;
        const double phi = 2.399963229728653 * i;
        const double s = std::sqrt(1.0 - z * z);
        const osg::Vec3d n(s * std::cos(phi), s * std::sin(phi), z);
        const osg::Vec3d e = irradiance(truth, n);
        square += e.length2();
        error += (irradiance(lights, n) - e).length2();
    }
    return square > 0.0 ? std::sqrt(error / square) : 0.0;
}

}  // namespace

std::string DiffuseCarrier::describe() const
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    if (harmonics)
        out << harmonics << " spherical harmonics";
    else
        out << lights << (given ? " lights, the application's own" : " lights");
    if (error >= 0.0)
        out << std::fixed << std::setprecision(2) << ": they err by " << 100.0 * error << " % on this map, diffuseError is "
            << 100.0 * bound << " %";
    return out.str();
}

HarmonicsError predictHarmonicsError(const RadianceMap& map)
{
    return predict(cells(map));
}

double measureLights(const RadianceMap& map, const LightList& lights)
{
    return measure(cells(map), lights);
}

DiffuseCarrier chooseCarrier(const RadianceMap& map, double bound, unsigned most,
                             const std::function<const LightList&(unsigned)>& list, const DiffuseCarrier* former)
{
    DiffuseCarrier best;
    // Whether this candidate, dearer than all before it, will do.
    auto serves = [&](unsigned harmonics, unsigned lights, double error) {
        if (best.error < 0.0 || error < best.error) best = {harmonics, lights, error, bound, false};
        if (!former || former->error < 0.0) return error <= bound;
        const bool same = former->harmonics == harmonics && former->lights == lights;
        const unsigned had = former->harmonics ? former->harmonics : 18 + former->lights;
        const bool cheaper = (harmonics ? harmonics : 18 + lights) < had;
        const bool kept = error <= bound * (same ? hysteresis : cheaper ? 1.0 / hysteresis : 1.0);
        if (kept) best = {harmonics, lights, error, bound, false};
        return kept;
    };
    const LightList truth = cells(map);
    const HarmonicsError harmonics = predict(truth);
    if (serves(9, 0, harmonics.nine) || serves(18, 0, harmonics.eighteen)) return best;
    // A list that goes on asks for no shorter ones: they would have to start cold.
    const unsigned first = former && former->error >= 0.0 && former->lights ? former->lights : 32;
    for (unsigned count = std::min(first, most);; count = std::min(2 * count, most)) {
        if (serves(0, count, measure(truth, list(count))) || count >= most) return best;
    }
}

}  // namespace osgEnvLight
