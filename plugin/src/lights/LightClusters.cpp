// SPDX-License-Identifier: MIT
#include "lights/LightClusters.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace osgEnvLight
{

namespace
{

const size_t nearest = 20;   // neighbours asked when a cell changes its owner
const size_t together = 16;  // cells compared with one generator at a time

std::vector<LightRegion> cellsOf(const MomentTable& table, std::vector<LightRegion> start, size_t count)
{
    RegionRule rule;
    rule.exponent = 1.0;
    rule.bestAxis = false;
    return divideRegions(table, std::move(start), count, rule);
}

}  // namespace

unsigned LightClusters::microCells(unsigned count)
{
    return std::min(16 * count, std::max(16384u, 4 * count));
}

LightClusters::LightClusters(const MomentTable& table, unsigned count)
{
    std::vector<LightRegion> regions = divideRegions(table, {wholeRegion(table)}, count, RegionRule());
    for (size_t i = 0; i < regions.size(); ++i) {
        LightRegion& r = regions[i];
        r.owner = unsigned(i);
        _generators.push_back(r.deciding.centroid(table.direction(0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1))));
    }
    setCells(cellsOf(table, std::move(regions), microCells(count)));
    _assigned = true;
}

LightClusters::LightClusters(const MomentTable& table, std::vector<osg::Vec3d> generators) : _generators(std::move(generators))
{
    // Dividing into cells takes the time; of long lists half as many do.
    const unsigned count = unsigned(_generators.size());
    setCells(cellsOf(table, {wholeRegion(table)}, microCells(count) / (count > 256 ? 2 : 1)));
}

void LightClusters::setCells(const std::vector<LightRegion>& regions)
{
    _cells.reserve(regions.size());
    for (const LightRegion& r : regions)
        if (r.deciding.flux > 0.0) _cells.push_back(r);
    const size_t padded = (_cells.size() + together - 1) / together * together;
    for (std::vector<float>* v : {&_cx, &_cy, &_cz}) v->assign(padded, 0.0f);
    _owner.resize(_cells.size());
    for (size_t j = 0; j < _cells.size(); ++j) {
        const osg::Vec3d d = _cells[j].deciding.centroid(osg::Vec3d(0, 0, 1));
        _cx[j] = float(d.x());
        _cy[j] = float(d.y());
        _cz[j] = float(d.z());
        _owner[j] = _cells[j].owner;
    }
    copyGenerators();
}

void LightClusters::copyGenerators()
{
    const size_t n = _generators.size();
    for (std::vector<float>* v : {&_x, &_y, &_z}) v->resize(n);
    for (size_t i = 0; i < n; ++i) {
        _x[i] = float(_generators[i].x());
        _y[i] = float(_generators[i].y());
        _z[i] = float(_generators[i].z());
    }
}

void LightClusters::refine(unsigned rounds)
{
    for (unsigned round = 0; round < rounds; ++round) {
        if (!_assigned) {
            assignAll();
        } else {
            if (round == 0 || round == 2 || round == 5) findNeighbours();
            assignNear();
        }
        sumClusters();
        moveGenerators();
    }
    // Lights stand at the centroids of what is nearest to the generators as they are now.
    if (_numNeighbours == 0) findNeighbours();
    assignNear();
    sumClusters();
}

// The 20 nearest of each generator, by a histogram of distances: a full sort would cost more than the assignment.
void LightClusters::findNeighbours()
{
    const size_t n = _generators.size();
    _numNeighbours = std::min(nearest, n);
    _neighbours.resize(n * _numNeighbours);
    std::vector<float> cosine(n);
    std::vector<unsigned short> bin(n);
    std::vector<unsigned> candidates(n);
    for (size_t i = 0; i < n; ++i) {
        std::array<unsigned, 256> histogram{};
        for (size_t k = 0; k < n; ++k) cosine[k] = _x[k] * _x[i] + _y[k] * _y[i] + _z[k] * _z[i];
        for (size_t k = 0; k < n; ++k)
            bin[k] = static_cast<unsigned short>(std::sqrt(std::max(0.0f, 0.5f - 0.5f * cosine[k])) * 255.0f);
        for (size_t k = 0; k < n; ++k) ++histogram[std::min<size_t>(bin[k], 255)];
        size_t last = 0;
        for (size_t sum = histogram[0]; sum < _numNeighbours; sum += histogram[++last]) continue;
        size_t found = 0;
        for (size_t k = 0; k < n; ++k)
            if (bin[k] <= last) candidates[found++] = unsigned(k);
        const auto begin = candidates.begin();
        std::nth_element(begin, begin + long(_numNeighbours) - 1, begin + long(found),
                         [&](unsigned a, unsigned b) { return cosine[a] != cosine[b] ? cosine[a] > cosine[b] : a < b; });
        std::copy_n(begin, _numNeighbours, _neighbours.begin() + long(i * _numNeighbours));
    }
}

void LightClusters::assignNear()
{
    for (size_t j = 0; j < _cells.size(); ++j) {
        const float x = _cx[j];
        const float y = _cy[j];
        const float z = _cz[j];
        unsigned best = _owner[j];
        float cosine = _x[best] * x + _y[best] * y + _z[best] * z;
        const unsigned* near = &_neighbours[best * _numNeighbours];
        for (size_t k = 0; k < _numNeighbours; ++k) {
            const unsigned i = near[k];
            const float c = _x[i] * x + _y[i] * y + _z[i] * z;
            if (c > cosine) {
                cosine = c;
                best = i;
            }
        }
        _owner[j] = best;
    }
}

void LightClusters::assignAll()
{
    for (size_t j = 0; j < _cells.size(); j += together) {
        std::array<float, together> cosine;
        std::array<unsigned, together> best{};
        cosine.fill(-2.0f);
        for (size_t i = 0; i < _generators.size(); ++i) {
            const float x = _x[i];
            const float y = _y[i];
            const float z = _z[i];
            for (size_t k = 0; k < together; ++k) {
                const float c = x * _cx[j + k] + y * _cy[j + k] + z * _cz[j + k];
                best[k] = c > cosine[k] ? unsigned(i) : best[k];
                cosine[k] = c > cosine[k] ? c : cosine[k];
            }
        }
        for (size_t k = 0; k < together && j + k < _cells.size(); ++k) _owner[j + k] = best[k];
    }
    _assigned = true;
}

void LightClusters::sumClusters()
{
    _clusters.assign(_generators.size(), Cluster());
    for (size_t j = 0; j < _cells.size(); ++j) {
        Cluster& c = _clusters[_owner[j]];
        const LightRegion& r = _cells[j];
        c.light.flux += r.light.flux;
        c.light.vector += r.light.vector;
        c.light.rgb += r.light.rgb;
        c.deciding.flux += r.deciding.flux;
        c.deciding.vector += r.deciding.vector;
        ++c.cells;
    }
}

void LightClusters::moveGenerators()
{
    for (size_t i = 0; i < _generators.size(); ++i)
        if (_clusters[i].cells) _generators[i] = _clusters[i].deciding.centroid(_generators[i]);
    copyGenerators();
}

osg::Vec3d LightClusters::cellDirection(size_t j) const
{
    return osg::Vec3d(double(_cx[j]), double(_cy[j]), double(_cz[j]));
}

unsigned LightClusters::farthestCell(unsigned cluster) const
{
    const osg::Vec3d g = _clusters[cluster].deciding.centroid(_generators[cluster]);
    unsigned farthest = 0;
    double cosine = 2.0;
    for (size_t j = 0; j < _cells.size(); ++j) {
        if (_owner[j] != cluster) continue;
        const double c = g * cellDirection(j);
        if (c < cosine) {
            cosine = c;
            farthest = unsigned(j);
        }
    }
    return farthest;
}

void LightClusters::fillEmpty()
{
    for (unsigned e = 0; e < _clusters.size(); ++e) {
        if (_clusters[e].cells) continue;
        int worst = -1;
        double cost = -1.0;
        for (size_t i = 0; i < _clusters.size(); ++i) {
            const Cluster& c = _clusters[i];
            const double loss = c.deciding.flux - c.deciding.vector.length();
            if (c.cells > 1 && loss > cost) {
                cost = loss;
                worst = int(i);
            }
        }
        if (worst < 0) return;
        const unsigned w = unsigned(worst);
        const unsigned far = farthestCell(w);
        const osg::Vec3d g = _clusters[w].deciding.centroid(_generators[w]);
        const osg::Vec3d away = cellDirection(far) - g;
        // The farthest cell always goes over, and what is nearer to it than to the centroid, but not the last cell.
        unsigned left = _clusters[w].cells - 1;
        const double middle = 0.5 * (away * (g + cellDirection(far)));
        for (size_t j = 0; j < _cells.size(); ++j) {
            if (_owner[j] != w || j == far || left <= 1 || away * cellDirection(j) <= middle) continue;
            _owner[j] = e;
            --left;
        }
        _owner[far] = e;
        sumClusters();
        _generators[e] = _clusters[e].deciding.centroid(_generators[e]);
        _generators[w] = _clusters[w].deciding.centroid(_generators[w]);
    }
    copyGenerators();
}

int LightClusters::teleport()
{
    unsigned worst = 0;
    double gain = -1.0;
    for (unsigned i = 0; i < _clusters.size(); ++i) {
        const double cost = _clusters[i].deciding.flux * spread(_clusters[i].deciding);
        if (_clusters[i].cells > 1 && cost > gain) {
            gain = cost;
            worst = i;
        }
    }
    findNeighbours();
    int cheapest = -1;
    double loss = 0.25 * gain;
    for (unsigned i = 0; i < _clusters.size(); ++i) {
        if (i == worst) continue;
        double cosine = -1.0;
        for (size_t k = 0; k < _numNeighbours; ++k) {
            const unsigned n = _neighbours[i * _numNeighbours + k];
            if (n != i) cosine = std::max(cosine, _generators[i] * _generators[n]);
        }
        const double cost = _clusters[i].deciding.flux * std::sqrt(std::max(0.0, 2.0 - 2.0 * cosine));
        if (cost < loss) {
            loss = cost;
            cheapest = int(i);
        }
    }
    if (cheapest < 0 || gain <= 0.0) return -1;
    const unsigned far = farthestCell(worst);
    _generators[size_t(cheapest)] = cellDirection(far);
    copyGenerators();
    findNeighbours();
    assignAll();
    return cheapest;
}

LightList LightClusters::lights() const
{
    LightList lights(_generators.size());
    for (size_t i = 0; i < lights.size(); ++i) {
        const Moments& m = _clusters[i].light;
        lights[i].direction = m.centroid(_generators[i]);
        for (int k = 0; k < 3; ++k) lights[i].flux[k] = std::max(m.rgb[k], 0.0);
    }
    return lights;
}

}  // namespace osgEnvLight
