// SPDX-License-Identifier: MIT
#include "LightJudge.h"

#include <algorithm>

namespace testmaths
{

using glsl::vec3;
using osgEnvLight::LightList;
using osgEnvLight::RadianceMap;

namespace
{

// Whether the ray from the origin along d meets the box, beyond its very start.
bool meets(const Receiver::Box& box, const vec3& d)
{
    double near = 1e-3;
    double far = 1e30;
    for (int k = 0; k < 3; ++k) {
        const double inverse = 1.0 / (std::abs(d[k]) < 1e-12 ? 1e-12 : d[k]);
        const double a = (box.centre[k] - box.half[k]) * inverse;
        const double b = (box.centre[k] + box.half[k]) * inverse;
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return near < far;
}

vec3 perpendicular(const vec3& n, Random& random)
{
    const vec3 d = random.direction();
    return glsl::normalize(d - n * glsl::dot(d, n));
}

void placeBoxes(Receiver& r, Random& random)
{
    const vec3 z = random.direction();
    const vec3 x = perpendicular(z, random);
    r.axes = glsl::transpose(glsl::mat3(x, glsl::cross(z, x), z));  // takes world to the boxes' frame
    const int count = 1 + int(random.uniform() * 3.0);
    for (int i = 0; i < count; ++i) {
        vec3 toward = random.direction();
        while (glsl::dot(toward, r.normal) < 0.1) toward = random.direction();
        const double size = random.uniform(0.2, 0.7);
        const double distance = random.uniform(1.2, 2.5);
        const vec3 half(random.uniform(0.5, 1.5), random.uniform(0.5, 1.5), random.uniform(0.5, 1.5));
        r.boxes.push_back({r.axes * (toward * distance), half * size});
    }
}

// One row of the map, so laid out that a compiler can take several texels at a time. In single precision: a sum of a row's
// few hundred positive terms is good to 1e-6, a thousandth of the errors that are judged.
struct Row {
    std::vector<float> x, y, z, r, g, b;

    Row(const RadianceMap& map, int row)
    {
        for (std::vector<float>* v : {&x, &y, &z, &r, &g, &b}) v->resize(size_t(map.width));
        for (size_t i = 0; i < x.size(); ++i) {
            const vec3 d = texelDirection(int(i), row, map.width, map.height);
            const float* t = map.texel(int(i), row);
            x[i] = float(d.x);
            y[i] = float(d.y);
            z[i] = float(d.z);
            r[i] = t[0];
            g[i] = t[1];
            b[i] = t[2];
        }
    }

    vec3 unoccluded(const vec3& normal) const
    {
        const float nx = float(normal.x), ny = float(normal.y), nz = float(normal.z);
        float sums[3][8] = {};
        size_t i = 0;
        for (; i + 8 <= x.size(); i += 8)
            for (size_t k = 0; k < 8; ++k) {
                const float c = std::max(nx * x[i + k] + ny * y[i + k] + nz * z[i + k], 0.0f);
                sums[0][k] += c * r[i + k];
                sums[1][k] += c * g[i + k];
                sums[2][k] += c * b[i + k];
            }
        vec3 sum(0.0);
        for (size_t k = 0; k < 8; ++k) sum += vec3(double(sums[0][k]), double(sums[1][k]), double(sums[2][k]));
        for (; i < x.size(); ++i) sum += vec3(r[i], g[i], b[i]) * double(std::max(nx * x[i] + ny * y[i] + nz * z[i], 0.0f));
        return sum;
    }
};

std::vector<vec3> truth(const RadianceMap& map, const std::vector<Receiver>& receivers)
{
    std::vector<vec3> result(receivers.size(), vec3(0.0));
    for (int y = 0; y < map.height; ++y) {
        const double solidAngle = texelSolidAngle(y, map.width, map.height);
        const Row row(map, y);
        for (size_t i = 0; i < receivers.size(); ++i) {
            vec3 sum(0.0);
            if (receivers[i].kind == Receiver::FREE)
                sum = row.unoccluded(receivers[i].normal);
            else
                for (size_t x = 0; x < row.x.size(); ++x)
                    sum += vec3(row.r[x], row.g[x], row.b[x]) * receivers[i].cosine(vec3(row.x[x], row.y[x], row.z[x]));
            result[i] += sum * solidAngle;
        }
    }
    return result;
}

std::vector<Receiver> freeReceivers()
{
    // Turned a little, so that no normal lies along a row of the map.
    const vec3 axis = glsl::normalize(vec3(0.3, 0.5, 0.81));
    std::vector<Receiver> result;
    for (const vec3& n : spiral(256)) {
        Receiver r;
        r.normal = n * std::cos(0.7) + glsl::cross(axis, n) * std::sin(0.7) + axis * (glsl::dot(axis, n) * (1.0 - std::cos(0.7)));
        result.push_back(r);
    }
    return result;
}

}  // namespace

double Receiver::cosine(const vec3& d) const
{
    const double c = glsl::dot(normal, d);
    if (c <= 0.0) return 0.0;
    if (kind == HALF_SPACE && glsl::dot(d, toward) < limit) return 0.0;
    if (kind == WALL) {
        const double out = glsl::dot(d, toward);
        if (out > 0.0 && c < limit * out) return 0.0;
    }
    if (kind == BOXES) {
        const vec3 local = axes * d;
        for (const Box& b : boxes)
            if (meets(b, local)) return 0.0;
    }
    return c;
}

std::vector<Receiver> occludedReceivers()
{
    Random random(7);
    std::vector<Receiver> result(512);
    for (size_t i = 0; i < result.size(); ++i) {
        Receiver& r = result[i];
        r.normal = random.direction();
        if (i % 4 == 0) {
            r.kind = Receiver::HALF_SPACE;
            r.toward = random.direction();
            r.limit = random.uniform(-0.6, 0.6);
        } else if (i % 4 == 1) {
            r.kind = Receiver::WALL;
            r.toward = perpendicular(r.normal, random);
            r.limit = 1.0 / random.uniform(0.1, 1.6);
        } else {
            r.kind = Receiver::BOXES;
            placeBoxes(r, random);
        }
    }
    return result;
}

LightJudge::LightJudge(const RadianceMap& map, bool occluded) : _free(freeReceivers()), _freeTruth(truth(map, _free))
{
    if (!occluded) return;
    _occluded = occludedReceivers();
    _occludedTruth = truth(map, _occluded);
}

double LightJudge::unoccludedError(const LightList& lights) const
{
    return relativeError(irradiance(lights, _free), _freeTruth);
}

double LightJudge::occludedError(const LightList& lights) const
{
    return relativeError(irradiance(lights, _occluded), _occludedTruth);
}

double LightJudge::visibilityError(const LightList& lights) const
{
    LightList cells = lights;
    for (auto& l : cells) l.flux.set(0, 0, 0);
    const std::vector<vec3> directions = spiral(16384);
    std::vector<vec3> exact(_occluded.size(), vec3(0.0));
    for (const vec3& d : directions) {
        const osg::Vec3d e(d.x, d.y, d.z);
        size_t best = 0;
        for (size_t i = 1; i < cells.size(); ++i)
            if (cells[i].direction * e > cells[best].direction * e) best = i;
        cells[best].flux += osg::Vec3d(1, 1, 1) * (4.0 / double(directions.size()));
        for (size_t r = 0; r < _occluded.size(); ++r) exact[r] += vec3(_occluded[r].cosine(d) * 4.0 / double(directions.size()));
    }
    const std::vector<vec3> e = irradiance(cells, _occluded);
    double sum = 0.0;
    for (size_t r = 0; r < _occluded.size(); ++r) sum += (e[r].x - exact[r].x) * (e[r].x - exact[r].x);
    return std::sqrt(sum / double(_occluded.size()));
}

std::vector<vec3> LightJudge::unoccludedDifference(const LightList& lights) const
{
    std::vector<vec3> e = irradiance(lights, _free);
    for (size_t i = 0; i < e.size(); ++i) e[i] -= _freeTruth[i];
    return e;
}

double LightJudge::scale() const
{
    double sum = 0.0;
    for (const vec3& e : _freeTruth) sum += glsl::dot(e, e);
    return std::sqrt(sum / double(_freeTruth.size()));
}

double relativeError(const std::vector<vec3>& e, const std::vector<vec3>& truth)
{
    double error = 0.0;
    double norm = 0.0;
    for (size_t i = 0; i < e.size(); ++i) {
        error += glsl::dot(e[i] - truth[i], e[i] - truth[i]);
        norm += glsl::dot(truth[i], truth[i]);
    }
    return norm > 0.0 ? std::sqrt(error / norm) : 0.0;
}

std::vector<vec3> irradiance(const LightList& lights, const std::vector<Receiver>& receivers)
{
    std::vector<vec3> result(receivers.size(), vec3(0.0));
    for (size_t i = 0; i < receivers.size(); ++i)
        for (const auto& l : lights)
            result[i] +=
                vec3(l.flux[0], l.flux[1], l.flux[2]) * receivers[i].cosine(vec3(l.direction[0], l.direction[1], l.direction[2]));
    return result;
}

}  // namespace testmaths
