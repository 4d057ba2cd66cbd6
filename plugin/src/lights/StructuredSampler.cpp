// SPDX-License-Identifier: MIT
#include "lights/StructuredSampler.h"

#include "lights/FarthestPoints.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace osgEnvLight
{

namespace
{

// The paper's. Half or twice the deviation and twelve strata all come within a fifth of the error.
const unsigned char strata = 6;
const double exponent = 0.25;
const double largestSolidAngle = 0.01;
const unsigned char dark = 255;

// The stratum of each texel; dark where nothing decides. The highest is open, so that a map of one radiance is one stratum.
std::vector<unsigned char> findStrata(const LightTexels& texels)
{
    double sum = 0.0;
    double whole = 0.0;
    for (size_t i = 0; i < texels.size(); ++i) {
        sum += texels.deciding(i);
        whole += texels.solidAngle(i);
    }
    double variance = 0.0;
    for (size_t i = 0; i < texels.size(); ++i) {
        const double difference = texels.deciding(i) / texels.solidAngle(i) - sum / whole;
        variance += difference * difference * texels.solidAngle(i) / whole;
    }
    const double deviation = std::sqrt(variance);
    std::vector<unsigned char> stratum(texels.size(), dark);
    for (size_t i = 0; i < texels.size(); ++i) {
        const double radiance = texels.deciding(i) / texels.solidAngle(i);
        if (!(radiance > 0.0)) continue;
        const bool highest = !(radiance < (strata - 1) * deviation);
        stratum[i] = highest ? strata - 1 : static_cast<unsigned char>(radiance / deviation);
    }
    return stratum;
}

// Sums the importance of the components of each stratum.
class ComponentFinder
{
  public:
    ComponentFinder(const LightTexels& texels, const std::vector<unsigned char>& stratum)
        : _texels(texels), _stratum(stratum), _seen(texels.size(), false)
    {
    }

    std::vector<double> importance()
    {
        std::vector<double> sum(strata, 0.0);
        for (size_t i = 0; i < _texels.size(); ++i)
            if (!_seen[i] && _stratum[i] != dark) sum[_stratum[i]] += flood(i);
        return sum;
    }

  private:
    double flood(size_t start)
    {
        const int width = _texels.width();
        const int height = _texels.height();
        double flux = 0.0;
        double solidAngle = 0.0;
        visit(int(start) % width, int(start) / width, _stratum[start]);
        while (!_open.empty()) {
            const size_t i = _open.back();
            _open.pop_back();
            flux += _texels.deciding(i);
            solidAngle += _texels.solidAngle(i);
            const int x = int(i) % width;
            const int y = int(i) / width;
            visit((x + 1) % width, y, _stratum[i]);
            visit((x + width - 1) % width, y, _stratum[i]);
            // Beyond a pole lies the opposite column.
            y > 0 ? visit(x, y - 1, _stratum[i]) : visit((x + width / 2) % width, y, _stratum[i]);
            y + 1 < height ? visit(x, y + 1, _stratum[i]) : visit((x + width / 2) % width, y, _stratum[i]);
        }
        return flux * std::pow(std::min(solidAngle, largestSolidAngle), exponent);
    }

    void visit(int x, int y, unsigned char stratum)
    {
        const size_t i = size_t(y) * size_t(_texels.width()) + size_t(x);
        if (_seen[i] || _stratum[i] != stratum) return;
        _seen[i] = true;
        _open.push_back(i);
    }

    const LightTexels& _texels;
    const std::vector<unsigned char>& _stratum;
    std::vector<bool> _seen;
    std::vector<size_t> _open;
};

}  // namespace

std::vector<size_t> apportion(size_t count, const std::vector<double>& weights, const std::vector<size_t>& capacities)
{
    std::vector<size_t> shares(weights.size(), 0);
    std::vector<double> open = weights;
    double sum = 0.0;
    // Those whose share reaches their capacity are filled, until the shares of the others all lie below theirs.
    for (bool filled = true; filled;) {
        filled = false;
        sum = std::accumulate(open.begin(), open.end(), 0.0);
        const double each = sum > 0.0 ? double(count) / sum : 0.0;
        for (size_t i = 0; i < open.size(); ++i) {
            if (!(open[i] > 0.0) || open[i] * each < double(capacities[i])) continue;
            shares[i] = std::min(capacities[i], count);
            count -= shares[i];
            open[i] = 0.0;
            filled = true;
        }
    }
    std::vector<std::pair<double, size_t>> remainders;
    size_t given = 0;
    for (size_t i = 0; i < open.size(); ++i) {
        if (!(open[i] > 0.0)) continue;
        const double exact = double(count) * open[i] / sum;
        shares[i] = size_t(exact);
        given += shares[i];
        remainders.push_back({double(shares[i]) - exact, i});
    }
    std::sort(remainders.begin(), remainders.end());
    for (size_t k = 0; k < remainders.size() && given < count; ++k, ++given) ++shares[remainders[k].second];
    return shares;
}

LightList StructuredSampler::place(const RadianceMap& map, unsigned count, const Options& options) const
{
    const LightTexels texels(map, 512, options.floor);
    if (texels.lit() <= count) return texels.lights();
    const std::vector<unsigned char> stratum = findStrata(texels);
    std::vector<size_t> capacities(strata, 0);
    for (unsigned char s : stratum)
        if (s != dark) ++capacities[s];
    const std::vector<size_t> shares = apportion(count, ComponentFinder(texels, stratum).importance(), capacities);

    std::vector<osg::Vec3d> chosen;
    std::vector<unsigned> owner(texels.size(), 0);
    for (unsigned char s = strata; s-- > 0;) {
        if (shares[s] == 0) continue;
        const TexelGroup group{stratum, s};
        FarthestPoints points(texels, group, chosen);
        const size_t first = chosen.size();
        for (size_t k = 0; k < shares[s]; ++k) chosen.push_back(texels.direction(points.next()));
        findNearest(texels, group, chosen, first, owner);
    }
    // What has no light in its own stratum goes to any.
    for (unsigned char s = 0; s < strata; ++s)
        if (shares[s] == 0) findNearest(texels, {stratum, s}, chosen, 0, owner);
    return gatherLights(texels, owner, chosen);
}

}  // namespace osgEnvLight
