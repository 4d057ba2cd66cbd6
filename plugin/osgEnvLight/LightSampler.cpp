// SPDX-License-Identifier: MIT
#include <osgEnvLight/LightSampler>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// Of a region: flux, flux times direction (3), RGB flux (3). The flux that decides is the mean of the channels: by luminance
// a blue region would get a sixth of the lights that its share of the irradiance needs.
using Moments = std::array<double, 7>;

const osg::Vec3d channelWeights(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0);

// Summed-area table of moments over the map's texels, or over blocks of them; read bilinearly, so that borders of
// regions are real numbers.
class MomentTable
{
  public:
    MomentTable(const RadianceMap& map, unsigned count)
    {
        // Blocks no finer than the lights can tell apart; small maps are repeated, so that one texel spans directions.
        const int wanted = std::clamp(int(32.0 * std::sqrt(double(count))), 64, 1024);
        _block = std::max(map.width / wanted, 1);
        _repeatX = map.width < 64 ? (63 + map.width) / map.width : 1;
        _repeatY = map.height < 32 ? (31 + map.height) / map.height : 1;
        width = (map.width * _repeatX + _block - 1) / _block;
        height = (map.height * _repeatY + _block - 1) / _block;
        _table.resize(size_t(width + 1) * size_t(height + 1));
        fill(map);
    }

    Moments region(double u0, double v0, double u1, double v1) const
    {
        Moments a = at(u1, v1);
        const Moments b = at(u0, v1);
        const Moments c = at(u1, v0);
        const Moments d = at(u0, v0);
        for (size_t k = 0; k < 7; ++k) a[k] += d[k] - b[k] - c[k];
        a[0] = std::max(a[0], 0.0);
        return a;
    }

    int width;
    int height;

  private:
    Moments& cell(int x, int y) { return _table[size_t(y) * size_t(width + 1) + size_t(x)]; }
    const Moments& cell(int x, int y) const { return _table[size_t(y) * size_t(width + 1) + size_t(x)]; }

    void fill(const RadianceMap& map)
    {
        const glsl::vec2 size(map.width * _repeatX, map.height * _repeatY);
        const int fineWidth = int(size.x);
        std::vector<glsl::vec2> azimuth(size_t(fineWidth), glsl::vec2(0.0));  // (cos, sin) of each column
        for (int x = 0; x < fineWidth; ++x) {
            const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2((x + 0.5) / size.x, 0.5));
            azimuth[size_t(x)] = glsl::vec2(d.x, d.y);
        }
        for (int y = 0; y < int(size.y); ++y) {
            const double solidAngle = glsl::latlongTexelSolidAngle(y, size);
            const double theta = glsl::PI * (y + 0.5) / size.y;
            const double sinTheta = std::sin(theta);
            const double cosTheta = std::cos(theta);
            for (int x = 0; x < fineWidth; ++x) {
                const float* t = map.texel(x / _repeatX, y / _repeatY);
                const osg::Vec3d flux = osg::Vec3d(t[0], t[1], t[2]) * solidAngle;
                const double l = channelWeights * flux;
                const glsl::vec3 d(sinTheta * azimuth[size_t(x)].x, sinTheta * azimuth[size_t(x)].y, cosTheta);
                const Moments m = {l, l * d.x, l * d.y, l * d.z, flux[0], flux[1], flux[2]};
                Moments& c = cell(x / _block + 1, y / _block + 1);
                for (size_t k = 0; k < 7; ++k) c[k] += m[k];
            }
        }
        for (int y = 1; y <= height; ++y)
            for (int x = 1; x <= width; ++x)
                for (size_t k = 0; k < 7; ++k) cell(x, y)[k] += cell(x - 1, y)[k] + cell(x, y - 1)[k] - cell(x - 1, y - 1)[k];
    }

    Moments at(double u, double v) const
    {
        const int x = std::min(int(u), width - 1);
        const int y = std::min(int(v), height - 1);
        const double a = u - x;
        const double b = v - y;
        Moments m;
        for (size_t k = 0; k < 7; ++k)
            m[k] = (1 - b) * ((1 - a) * cell(x, y)[k] + a * cell(x + 1, y)[k]) +
                   b * ((1 - a) * cell(x, y + 1)[k] + a * cell(x + 1, y + 1)[k]);
        return m;
    }

    int _block;
    int _repeatX;
    int _repeatY;
    std::vector<Moments> _table;
};

struct Region {
    double u0, v0, u1, v1;
    Moments m;
    double cost;
    unsigned index;  // ties go to the older region

    bool operator<(const Region& o) const { return cost != o.cost ? cost < o.cost : index > o.index; }
};

// Sine of the mean angle from the centroid: sqrt(1 - |mean direction|^2).
double spread(const Moments& m)
{
    if (m[0] <= 0.0) return 0.0;
    const double r2 = (m[1] * m[1] + m[2] * m[2] + m[3] * m[3]) / (m[0] * m[0]);
    return std::sqrt(std::max(0.0, 1.0 - r2));
}

double splitCost(const Moments& m)
{
    return m[0] * std::sqrt(std::max(spread(m), 1e-9));
}

class Splitter
{
  public:
    explicit Splitter(const MomentTable& table) : _table(table) {}

    Region make(double u0, double v0, double u1, double v1)
    {
        Region r{u0, v0, u1, v1, _table.region(u0, v0, u1, v1), 0.0, _made++};
        r.cost = splitCost(r.m);
        return r;
    }

    // Across the longer side in solid angle; where the sides are alike, whichever leaves the smaller error.
    std::pair<Region, Region> split(const Region& r)
    {
        const double theta0 = glsl::PI * r.v0 / _table.height;
        const double theta1 = glsl::PI * r.v1 / _table.height;
        const bool equator = theta0 < 0.5 * glsl::PI && theta1 > 0.5 * glsl::PI;
        const double w =
            glsl::TWO_PI * (r.u1 - r.u0) / _table.width * (equator ? 1.0 : std::max(std::sin(theta0), std::sin(theta1)));
        const double h = theta1 - theta0;
        if (w > 2.5 * h) return cut(r, true);
        if (w < 0.4 * h) return cut(r, false);
        auto a = cut(r, true);
        auto b = cut(r, false);
        auto error = [](const std::pair<Region, Region>& p) {
            return p.first.cost * p.first.cost + p.second.cost * p.second.cost;
        };
        return error(a) <= error(b) ? a : b;
    }

  private:
    // At half the flux: bisection over whole cells, then linear inside one.
    std::pair<Region, Region> cut(const Region& r, bool alongU)
    {
        const double target = 0.5 * r.m[0];
        auto flux = [&](double x) {
            return (alongU ? _table.region(r.u0, r.v0, x, r.v1) : _table.region(r.u0, r.v0, r.u1, x))[0];
        };
        double low = alongU ? r.u0 : r.v0;
        double high = alongU ? r.u1 : r.v1;
        for (int a = int(std::ceil(low)), b = int(std::floor(high)); a <= b;) {
            const int c = (a + b) / 2;
            if (flux(c) < target) {
                low = std::max(low, double(c));
                a = c + 1;
            } else {
                high = std::min(high, double(c));
                b = c - 1;
            }
        }
        const double f0 = flux(low);
        const double f1 = flux(high);
        const double x = low + (high - low) * (f1 > f0 ? std::clamp((target - f0) / (f1 - f0), 0.0, 1.0) : 0.5);
        if (alongU) return {make(r.u0, r.v0, x, r.v1), make(x, r.v0, r.u1, r.v1)};
        return {make(r.u0, r.v0, r.u1, x), make(r.u0, x, r.u1, r.v1)};
    }

    const MomentTable& _table;
    unsigned _made = 0;
};

DirectionalLight lightOf(const Region& r, const MomentTable& table)
{
    osg::Vec3d d(r.m[1], r.m[2], r.m[3]);
    if (d.length() > 1e-12 * r.m[0] && r.m[0] > 0.0) {
        d.normalize();
    } else {
        const glsl::vec3 c =
            glsl::directionFromLatlong(glsl::vec2(0.5 * (r.u0 + r.u1) / table.width, 0.5 * (r.v0 + r.v1) / table.height));
        d = osg::Vec3d(c.x, c.y, c.z);
    }
    // Differences of the table go to -1e-16 of the total beside bright areas.
    return {d, osg::Vec3d(std::max(r.m[4], 0.0), std::max(r.m[5], 0.0), std::max(r.m[6], 0.0))};
}

void scaleToFlux(LightList& lights, const osg::Vec3d& flux)
{
    osg::Vec3d sum;
    for (const DirectionalLight& l : lights) sum += l.flux;
    for (DirectionalLight& l : lights)
        for (int i = 0; i < 3; ++i)
            if (sum[i] > 0.0) l.flux[i] *= flux[i] / sum[i];
}

}  // namespace

LightList SplitSampler::sample(const RadianceMap& map, unsigned count) const
{
    if (!(map.mean > 0.0) || count == 0) return {};
    const MomentTable table(map, count);
    Splitter splitter(table);
    std::priority_queue<Region> regions;
    regions.push(splitter.make(0, 0, table.width, table.height));
    while (regions.size() < count) {
        const Region r = regions.top();
        regions.pop();
        auto [a, b] = splitter.split(r);
        regions.push(a);
        regions.push(b);
    }
    LightList lights;
    lights.reserve(count);
    for (; !regions.empty(); regions.pop()) lights.push_back(lightOf(regions.top(), table));
    scaleToFlux(lights, map.flux);
    matchHarmonics(lights, map);
    return lights;
}

}  // namespace osgEnvLight
