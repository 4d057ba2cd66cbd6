// SPDX-License-Identifier: MIT
#include "environment/DominantLight.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double degree = glsl::PI / 180.0;
const double firstLevel = 8.0;  // times the mean radiance: where the search for regions starts
const double levelStep = 1.5;   // and how it climbs
const double shareOn = 0.02;    // of the map's flux
const double shareOff = 0.015;  // for what was a sun already
const double contrast = 12.0;   // to the surroundings
const double largestRadius = 5.3 * degree;
const double roundness = 0.6;             // of the radius of an even disc of its flux, to the one of its spread
const double smallRadius = 2.0 * degree;  // below, texels are too coarse to tell a shape
const int membraneRounds = 60;

using Texels = std::vector<int>;

double solidAngleOf(double radius)
{
    return glsl::TWO_PI * (1.0 - std::cos(radius));
}

// The map as brightness, with its neighbourhoods: columns wrap, a pole row joins its opposite column.
class Sphere
{
  public:
    explicit Sphere(const RadianceMap& map)
        : width(map.width), height(map.height), mark(size_t(map.width) * size_t(map.height), 0), _map(map)
    {
        for (int y = 0; y < height; ++y) {
            const double theta = glsl::PI * (y + 0.5) / height;
            _polar.push_back(osg::Vec2d(std::sin(theta), std::cos(theta)));
            _solidAngle.push_back(glsl::latlongTexelSolidAngle(y, glsl::vec2(width, height)));
        }
        for (int x = 0; x < width; ++x) {
            const glsl::vec3 d = glsl::directionFromLatlong(glsl::vec2((x + 0.5) / width, 0.5));
            _azimuth.push_back(osg::Vec2d(d.x, d.y));
        }
    }

    osg::Vec3d radiance(int i) const
    {
        const float* t = _map.texel(i % width, i / width);
        return osg::Vec3d(t[0], t[1], t[2]);
    }
    double brightness(int i) const
    {
        const osg::Vec3d c = radiance(i);
        return (c[0] + c[1] + c[2]) / 3.0;
    }
    double solidAngle(int i) const { return _solidAngle[size_t(i / width)]; }
    osg::Vec3d direction(int i) const
    {
        const osg::Vec2d& p = _polar[size_t(i / width)];
        const osg::Vec2d& a = _azimuth[size_t(i % width)];
        return osg::Vec3d(p.x() * a.x(), p.x() * a.y(), p.y());
    }
    double texel() const { return glsl::PI / height; }

    template <class Visit>
    void neighbours(int i, Visit visit) const
    {
        const int x = i % width;
        const int y = i / width;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                if (dx == 0 && dy == 0) continue;
                const bool over = y + dy < 0 || y + dy >= height;
                const int column = (x + dx + width + (over ? width / 2 : 0)) % width;
                visit((over ? y : y + dy) * width + column);
            }
    }

    // The connected regions of those texels that are brighter than the level.
    std::vector<Texels> regions(const Texels& texels, double level)
    {
        for (int i : texels) mark[size_t(i)] = brightness(i) > level;
        std::vector<Texels> result;
        for (int start : texels) {
            if (!mark[size_t(start)]) continue;
            mark[size_t(start)] = 0;
            Texels region = {start};
            for (size_t k = 0; k < region.size(); ++k)
                neighbours(region[k], [&](int n) {
                    if (!mark[size_t(n)]) return;
                    mark[size_t(n)] = 0;
                    region.push_back(n);
                });
            result.push_back(std::move(region));
        }
        return result;
    }

    // Mean brightness between two angles about c, without the texels given.
    double ringMean(const osg::Vec3d& c, double inner, double outer, const Texels& without)
    {
        for (int i : without) mark[size_t(i)] = 1;
        const double polar = std::acos(std::clamp(c.z(), -1.0, 1.0));
        const int first = std::max(0, int((polar - outer) / texel()) - 1);
        const int last = std::min(height - 1, int((polar + outer) / texel()) + 1);
        const double cosInner = std::cos(inner);
        const double cosOuter = std::cos(std::min(glsl::PI, outer));
        double sum = 0.0;
        double weight = 0.0;
        for (int i = first * width; i < (last + 1) * width; ++i) {
            const double cosine = c * direction(i);
            if (cosine < cosOuter || cosine > cosInner || mark[size_t(i)]) continue;
            sum += brightness(i) * solidAngle(i);
            weight += solidAngle(i);
        }
        for (int i : without) mark[size_t(i)] = 0;
        return weight > 0.0 ? sum / weight : 0.0;
    }

    const int width;
    const int height;
    std::vector<unsigned char> mark;  // all 0 between calls

  private:
    const RadianceMap& _map;
    std::vector<osg::Vec2d> _polar;
    std::vector<osg::Vec2d> _azimuth;
    std::vector<double> _solidAngle;
};

// What the criterion asks of a region.
struct Measure {
    double solidAngle = 0.0;
    double flux = 0.0;
    double square = 0.0;  // integral of L^2
    osg::Vec3d vector;
    osg::Vec3d centre;
    double reach = 0.0;  // angle from the centre to the farthest texel
    double ring = 0.0;

    Measure(const Sphere& sphere, const Texels& texels)
    {
        for (int i : texels) {
            const double w = sphere.solidAngle(i);
            const double l = sphere.brightness(i);
            solidAngle += w;
            flux += l * w;
            square += l * l * w;
            vector += sphere.direction(i) * (l * w);
        }
        centre = vector / vector.length();
        double cosine = 1.0;
        for (int i : texels) cosine = std::min(cosine, centre * sphere.direction(i));
        reach = std::acos(std::max(cosine, -1.0));
    }

    double radiance() const { return flux / solidAngle; }
    double equalRadius() const { return std::sqrt(solidAngle / glsl::PI); }
};

class Finder
{
  public:
    Finder(const RadianceMap& map, const DominantLights& former)
        : _map(map), _sphere(map), _former(former), _mean(map.meanOfChannels()), _flux(map.meanOfChannels() * 4.0 * glsl::PI)
    {
    }

    struct Found {
        Texels texels;
        Measure measure;
    };

    std::vector<Found> find()
    {
        struct Node {
            Texels texels;
            double level;
            bool root;
        };
        std::vector<Node> open;
        std::vector<Found> result;
        Texels bright;
        for (int y = 0; y < _sphere.height; ++y) {
            const float* t = _map.texel(0, y);
            const float level = float(3.0 * firstLevel * _mean);
            for (int x = 0; x < _sphere.width; ++x, t += 3)
                if (t[0] + t[1] + t[2] > level) bright.push_back(y * _sphere.width + x);
        }
        for (Texels& t : _sphere.regions(bright, firstLevel * _mean)) open.push_back({std::move(t), firstLevel * _mean, true});
        while (!open.empty()) {
            const Node node = std::move(open.back());
            open.pop_back();
            Measure m(_sphere, node.texels);
            const double share = wanted(m);
            if (m.flux < share * _flux) continue;
            if (isSun(m, node.texels, node.root, share)) {
                result.push_back({node.texels, m});
                continue;
            }
            const double level = node.level * levelStep;
            for (Texels& t : _sphere.regions(node.texels, level)) open.push_back({std::move(t), level, false});
        }
        return result;
    }

    Sphere& sphere() { return _sphere; }

  private:
    double wanted(const Measure& m) const
    {
        for (const DominantLight& l : _former)
            if (l.direction * m.centre > std::cos(l.radius + 3.0 * degree)) return shareOff;
        return shareOn;
    }

    bool isSun(Measure& m, const Texels& texels, bool root, double share)
    {
        // The core of a softbox is no sun: within a larger bright region only a quarter of the size is.
        if (m.solidAngle > solidAngleOf(largestRadius) * (root ? 1.0 : 0.25)) return false;
        const double texel = _sphere.texel();
        const double variance = 2.0 * (1.0 - m.vector.length() / m.flux) + texel * texel / 6.0;
        const double spreadRadius = std::sqrt(2.0 * std::max(variance, 0.0));
        const double evenRadius = std::sqrt(m.flux * m.flux / (glsl::PI * m.square));
        if (spreadRadius > smallRadius && evenRadius < roundness * spreadRadius) return false;
        m.ring = _sphere.ringMean(m.centre, m.equalRadius() + texel, 2.0 * m.equalRadius() + 4.0 * texel, texels);
        return m.flux - m.ring * m.solidAngle >= share * _flux && m.radiance() >= contrast * m.ring;
    }

    const RadianceMap& _map;
    Sphere _sphere;
    const DominantLights& _former;
    double _mean;
    double _flux;
};

// What is cut out for a sun: the texels that it lights, and those that its edge touches.
Texels cutOf(Sphere& sphere, const Finder::Found& found)
{
    const Measure& m = found.measure;
    const double level = m.radiance() * std::clamp(std::sqrt(m.ring / m.radiance()), 0.02, 0.5);
    const double reach = std::cos(std::min(glsl::PI, 2.0 * m.reach + 3.0 * sphere.texel()));
    int peak = found.texels.front();
    for (int i : found.texels)
        if (sphere.brightness(i) > sphere.brightness(peak)) peak = i;
    Texels cut = {peak};
    sphere.mark[size_t(peak)] = 1;
    for (size_t k = 0; k < cut.size(); ++k)
        sphere.neighbours(cut[k], [&](int n) {
            if (sphere.mark[size_t(n)] || sphere.brightness(n) <= level || m.centre * sphere.direction(n) <= reach) return;
            sphere.mark[size_t(n)] = 1;
            cut.push_back(n);
        });
    for (size_t k = 0, inner = cut.size(); k < inner; ++k)
        sphere.neighbours(cut[k], [&](int n) {
            if (sphere.mark[size_t(n)]) return;
            sphere.mark[size_t(n)] = 1;
            cut.push_back(n);
        });
    for (int i : cut) sphere.mark[size_t(i)] = 0;
    return cut;
}

// The membrane over the rim: each texel the mean of its neighbours, the rim as it is.
std::vector<osg::Vec3d> membrane(const Sphere& sphere, const Texels& cut)
{
    std::unordered_map<int, size_t> place;
    for (size_t k = 0; k < cut.size(); ++k) place[cut[k]] = k;
    struct Stencil {
        osg::Vec3d rim;  // sum of the neighbours outside
        std::vector<size_t> inside;
        int count = 0;
    };
    std::vector<Stencil> stencils(cut.size());
    osg::Vec3d mean;
    int rimCount = 0;
    for (size_t k = 0; k < cut.size(); ++k)
        sphere.neighbours(cut[k], [&](int n) {
            Stencil& s = stencils[k];
            ++s.count;
            const auto inside = place.find(n);
            if (inside != place.end()) {
                s.inside.push_back(inside->second);
                return;
            }
            s.rim += sphere.radiance(n);
            mean += sphere.radiance(n);
            ++rimCount;
        });
    std::vector<osg::Vec3d> fill(cut.size(), rimCount ? mean / rimCount : osg::Vec3d());
    for (int round = 0; round < membraneRounds; ++round)
        for (size_t k = 0; k < cut.size(); ++k) {
            osg::Vec3d sum = stencils[k].rim;
            for (size_t n : stencils[k].inside) sum += fill[n];
            fill[k] = sum / stencils[k].count;
        }
    return fill;
}

// Radius of the even disc of that flux, flux-weighted direction and integral of L^2.
double discRadius(const Sphere& sphere, const osg::Vec3d& centre, const osg::Vec3d& vector, double flux, double square)
{
    // From the second moment, less what the texels' own width adds: exact in the mean over where the disc lies on the grid,
    // within 15 % from .7 texels of radius and 4 % from 1.4.
    const double height = sphere.texel();
    const double width = 2.0 * height * std::sqrt(std::max(1.0 - centre.z() * centre.z(), 0.0)) * sphere.height / sphere.width;
    const double variance = 2.0 * (1.0 - vector.length() / flux) - (width * width + height * height) / 12.0;
    const double fromSpread = std::sqrt(2.0 * std::max(variance, 0.0));
    // From the integral of L^2, which a faint aureole does not move; texels that the edge crosses count for less.
    const double k = 0.215 * std::sqrt(std::max(width, 0.05 * height) * height);
    const double fromSquare = std::sqrt(k * k + flux * flux / (square * glsl::PI)) - k;
    return std::clamp(fromSpread, 0.5 * fromSquare, 1.25 * fromSquare);
}

// Takes the sun out of the residual's texels.
DominantLight take(const Sphere& sphere, const Texels& cut, RadianceMap& residual)
{
    const std::vector<osg::Vec3d> fill = membrane(sphere, cut);
    DominantLight light;
    osg::Vec3d vector;
    double flux = 0.0;
    double square = 0.0;
    for (size_t k = 0; k < cut.size(); ++k) {
        const double w = sphere.solidAngle(cut[k]);
        float* t = const_cast<float*>(residual.texel(cut[k] % sphere.width, cut[k] / sphere.width));
        double taken = 0.0;
        for (int c = 0; c < 3; ++c) {
            const float left = std::min(t[c], float(fill[k][c]));
            const double difference = double(t[c]) - double(left);
            t[c] = left;
            light.flux[c] += difference * w;
            taken += difference / 3.0;
        }
        vector += sphere.direction(cut[k]) * (taken * w);
        flux += taken * w;
        square += taken * taken * w;
    }
    light.direction = vector / vector.length();
    light.radius = discRadius(sphere, light.direction, vector, flux, square);
    return light;
}

osg::ref_ptr<RadianceMap> copyOf(const RadianceMap& map)
{
    osg::ref_ptr<RadianceMap> copy = new RadianceMap;
    copy->image = new osg::Image(*map.image, osg::CopyOp::DEEP_COPY_ALL);
    copy->width = map.width;
    copy->height = map.height;
    return copy;
}

void measure(RadianceMap& map)
{
    map.flux.set(0, 0, 0);
    for (int y = 0; y < map.height; ++y) {
        osg::Vec3d row;
        const float* t = map.texel(0, y);
        float largest = 0.0f;
        for (int x = 0; x < 3 * map.width; x += 3) {
            row += osg::Vec3d(t[x], t[x + 1], t[x + 2]);
            largest = std::max({largest, t[x], t[x + 1], t[x + 2]});
        }
        map.maximum = std::max(map.maximum, double(largest));
        map.flux += row * glsl::latlongTexelSolidAngle(y, glsl::vec2(map.width, map.height));
    }
    map.mean = osg::Vec3d(0.2126, 0.7152, 0.0722) * map.flux / (4.0 * glsl::PI);
}

}  // namespace

SunSplit splitSuns(const RadianceMap& map, unsigned maximum, const DominantLights& former)
{
    SunSplit split;
    split.residual = &map;
    if (!(map.meanOfChannels() > 0.0) || maximum == 0) return split;
    Finder finder(map, former);
    std::vector<Finder::Found> found = finder.find();
    std::stable_sort(found.begin(), found.end(),
                     [](const Finder::Found& a, const Finder::Found& b) { return a.measure.flux > b.measure.flux; });
    if (found.size() > maximum) found.resize(maximum, found.front());
    if (found.empty()) return split;
    osg::ref_ptr<RadianceMap> residual = copyOf(map);
    for (const Finder::Found& f : found) split.suns.push_back(take(finder.sphere(), cutOf(finder.sphere(), f), *residual));
    measure(*residual);
    split.residual = residual;
    return split;
}

}  // namespace osgEnvLight
