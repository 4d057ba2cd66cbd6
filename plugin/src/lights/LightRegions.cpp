// SPDX-License-Identifier: MIT
#include "lights/LightRegions.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

bool cheaper(const LightRegion& a, const LightRegion& b)
{
    return a.cost != b.cost ? a.cost < b.cost : a.index > b.index;
}

double weighted(const Moments& m, double exponent)
{
    if (exponent == 0.0) return m.flux;
    const double s = std::max(spread(m), 1e-9);
    return m.flux * (exponent == 0.5 ? std::sqrt(s) : exponent == 1.0 ? s : std::pow(s, exponent));
}

// Divides one region after the other.
class Divider
{
  public:
    Divider(const MomentTable& table, const RegionRule& rule) : _table(table), _rule(rule) {}

    void enter(LightRegion& r)
    {
        r.index = _made++;
        r.cost = weighted(r.deciding, _rule.exponent);
        // A texel that can't be divided waits behind all that can.
        if (_rule.wholeTexels && r.u1 - r.u0 < 1.5 && r.v1 - r.v0 < 1.5) r.cost = -1.0;
    }

    std::pair<LightRegion, LightRegion> divide(const LightRegion& r)
    {
        const osg::Vec2d size = _table.extent(r.u0, r.v0, r.u1, r.v1);
        bool alongU = size.x() >= size.y();
        if (_rule.wholeTexels && (alongU ? r.u1 - r.u0 : r.v1 - r.v0) < 1.5) alongU = !alongU;
        const bool alike = size.x() <= 2.5 * size.y() && size.x() >= 0.4 * size.y();
        auto a = cut(r, alongU);
        if (!_rule.bestAxis || !alike) return a;
        auto b = cut(r, !alongU);
        return error(a) <= error(b) ? a : b;
    }

  private:
    double error(const std::pair<LightRegion, LightRegion>& p) const
    {
        const double a = weighted(p.first.deciding, std::max(_rule.exponent, 0.5));
        const double b = weighted(p.second.deciding, std::max(_rule.exponent, 0.5));
        return a * a + b * b;
    }

    std::pair<LightRegion, LightRegion> cut(const LightRegion& r, bool alongU) const
    {
        const double x = _rule.wholeTexels ? wholeHalf(r, alongU) : half(r, alongU);
        LightRegion a = r;
        LightRegion b = r;
        (alongU ? a.u1 : a.v1) = x;
        (alongU ? b.u0 : b.v0) = x;
        a.light = a.deciding = _table.region(a.u0, a.v0, a.u1, a.v1);
        b.light -= a.light;
        if (_table.isDark(b.light)) b.light = Moments();
        if (_table.hasFloor()) {
            const Moments f = _table.floorRegion(a.u0, a.v0, a.u1, a.v1);
            a.deciding.flux += f.flux;
            a.deciding.vector += f.vector;
        }
        b.deciding -= a.deciding;
        if (_table.isDark(b.deciding)) b.deciding = Moments();
        return {a, b};
    }

    double fluxUpTo(const LightRegion& r, bool alongU, double x) const
    {
        return alongU ? _table.deciding(r.u0, r.v0, x, r.v1) : _table.deciding(r.u0, r.v0, r.u1, x);
    }

    // At half the flux: bisection over whole cells, then linear inside one.
    double half(const LightRegion& r, bool alongU) const
    {
        const double target = 0.5 * r.deciding.flux;
        double low = alongU ? r.u0 : r.v0;
        double high = alongU ? r.u1 : r.v1;
        double f0 = 0.0;
        double f1 = r.deciding.flux;
        for (int a = int(std::ceil(low)), b = int(std::floor(high)); a <= b;) {
            const int c = (a + b) / 2;
            const double f = fluxUpTo(r, alongU, c);
            if (f < target) {
                low = std::max(low, double(c));
                f0 = f;
                a = c + 1;
            } else {
                high = std::min(high, double(c));
                f1 = f;
                b = c - 1;
            }
        }
        return low + (high - low) * (f1 > f0 ? std::clamp((target - f0) / (f1 - f0), 0.0, 1.0) : 0.5);
    }

    double wholeHalf(const LightRegion& r, bool alongU) const
    {
        const double low = alongU ? r.u0 : r.v0;
        const double high = alongU ? r.u1 : r.v1;
        return std::clamp(std::round(half(r, alongU)), low + 1.0, high - 1.0);
    }

    const MomentTable& _table;
    const RegionRule& _rule;
    unsigned _made = 0;
};

}  // namespace

LightRegion wholeRegion(const MomentTable& table)
{
    LightRegion r{0.0, 0.0, double(table.width()), double(table.height()), {}, {}};
    r.light = r.deciding = table.region(r.u0, r.v0, r.u1, r.v1);
    const Moments f = table.floorRegion(r.u0, r.v0, r.u1, r.v1);
    r.deciding.flux += f.flux;
    r.deciding.vector += f.vector;
    return r;
}

std::vector<LightRegion> divideRegions(const MomentTable& table, std::vector<LightRegion> regions, size_t count,
                                       const RegionRule& rule)
{
    Divider divider(table, rule);
    regions.reserve(count);
    for (LightRegion& r : regions) divider.enter(r);
    std::make_heap(regions.begin(), regions.end(), cheaper);
    auto push = [&](LightRegion& r) {
        if (rule.wholeTexels && r.deciding.flux <= 0.0) return;  // dark texels all round a lamp
        divider.enter(r);
        regions.push_back(r);
        std::push_heap(regions.begin(), regions.end(), cheaper);
    };
    while (regions.size() < count && !regions.empty() && regions.front().cost >= 0.0) {
        std::pop_heap(regions.begin(), regions.end(), cheaper);
        auto [a, b] = divider.divide(regions.back());
        regions.pop_back();
        push(a);
        push(b);
    }
    return regions;
}

double spread(const Moments& m)
{
    if (m.flux <= 0.0) return 0.0;
    return std::sqrt(std::max(0.0, 1.0 - m.vector.length2() / (m.flux * m.flux)));
}

DirectionalLight regionLight(const LightRegion& r, const MomentTable& table)
{
    const Moments& m = r.light.flux > 0.0 ? r.light : r.deciding;
    osg::Vec3d d = m.vector.length() > 1e-12 * m.flux ? m.vector : table.direction(0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1));
    d.normalize();
    // A channel that the region lacks may come out slightly negative beside areas bright in it.
    return {d, osg::Vec3d(std::max(r.light.rgb[0], 0.0), std::max(r.light.rgb[1], 0.0), std::max(r.light.rgb[2], 0.0))};
}

LightList regionLights(const MomentTable& table, size_t count, const RegionRule& rule)
{
    LightList lights;
    lights.reserve(count);
    for (const LightRegion& r : divideRegions(table, {wholeRegion(table)}, count, rule)) lights.push_back(regionLight(r, table));
    return lights;
}

}  // namespace osgEnvLight
