// SPDX-License-Identifier: MIT
#include "surface/MeshShapes.h"

#include "surface/MeshParts.h"
#include "surface/Outline.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace osgEnvLight
{

namespace
{

using Triangles = std::vector<MeshTriangle>;
using Places = std::vector<osg::Vec3d>;

const size_t mostFlatParts = 12;   // of a body that is taken by them
const size_t mostDiscs = 16;       // that stand for another body
const double roundness = 0.03;     // share of its radius by which a ball's or a disc's corners may be off it
const size_t leastBallFaces = 20;  // an icosahedron is a ball
const size_t leastDiscCorners = 12;
const double leastLoss = 0.03;  // of the area that a disc's directions cost, below which it is not split for them
const double evenDisc = 0.5;    // mean square distance from the middle, in areas over pi

double areaOf(const Triangles& triangles)
{
    double sum = 0.0;
    for (const MeshTriangle& t : triangles) sum += t.area;
    return sum;
}

osg::Vec3d centerOf(const Triangles& triangles)
{
    osg::Vec3d sum;
    for (const MeshTriangle& t : triangles) sum += t.center * t.area;
    return sum / areaOf(triangles);
}

// Area times normal, which is what it shows at most.
osg::Vec3d shownBy(const Triangles& triangles)
{
    osg::Vec3d sum;
    for (const MeshTriangle& t : triangles) sum += t.normal * t.area;
    return sum;
}

Emitter emitter(AreaLight::Shape shape, const osg::Vec3d& center)
{
    Emitter e;
    e.shape = shape;
    e.center = center;
    e.radiance = osg::Vec3d(1, 1, 1);
    e.drawn = true;
    return e;
}

Emitter disc(const osg::Vec3d& center, const osg::Vec3d& normal, double area)
{
    Emitter e = emitter(AreaLight::DISC, center);
    e.normal = normal;
    e.area = area;
    e.u = std::abs(normal.x()) < 0.6 ? osg::Vec3d(1, 0, 0) ^ normal : osg::Vec3d(0, 1, 0) ^ normal;
    e.u.normalize();
    e.u *= std::sqrt(area / osg::PI);
    e.v = normal ^ e.u;
    return e;
}

std::optional<Emitter> ballOf(const MeshBodies::Body& body, const Places& places)
{
    if (body.open || body.triangles.size() < leastBallFaces) return std::nullopt;
    const osg::Vec3d center = centerOf(body.triangles);
    double least = 1e300, most = 0.0;
    for (const MeshTriangle& t : body.triangles)
        for (unsigned corner : t.corners) {
            const double distance = (places[corner] - center).length();
            least = std::min(least, distance);
            most = std::max(most, distance);
        }
    if (most - least > roundness * most) return std::nullopt;
    // Through the corners: its points lie outside of the faces, which would hide them.
    Emitter e = emitter(AreaLight::SPHERE, center);
    e.u = osg::Vec3d(most, 0, 0);
    e.area = 4.0 * osg::PI * most * most;
    e.radiance *= areaOf(body.triangles) / e.area;
    return e;
}

bool isRound(const std::vector<osg::Vec3d>& outline, const osg::Vec3d& center)
{
    if (outline.size() < leastDiscCorners) return false;
    double least = 1e300, most = 0.0;
    for (const osg::Vec3d& p : outline) {
        least = std::min(least, (p - center).length());
        most = std::max(most, (p - center).length());
    }
    return most - least <= roundness * most;
}

std::optional<Emitter> rectangleOf(const std::vector<osg::Vec3d>& outline)
{
    if (outline.size() != 4) return std::nullopt;
    const osg::Vec3d center = (outline[0] + outline[1] + outline[2] + outline[3]) * 0.25;
    Emitter e = emitter(AreaLight::RECTANGLE, center);
    e.u = (outline[1] - outline[0]) * 0.5;
    e.v = (outline[2] - outline[1]) * 0.5;
    if ((center - e.u - e.v - outline[0]).length() > 1e-3 * (e.u.length() + e.v.length())) return std::nullopt;
    e.normal = e.u ^ e.v;
    e.area = 4.0 * e.normal.normalize();
    return e;
}

std::optional<Emitter> polygonOf(const std::vector<osg::Vec3d>& corners)
{
    if (corners.size() < 3 || corners.size() > AreaLight::mostVertices) return std::nullopt;
    const Outline outline(corners);
    Emitter e = emitter(AreaLight::POLYGON, osg::Vec3d());
    e.triangles = outline.triangles();
    if (!outline.isFlat() || outline.crosses() || e.triangles.empty()) return std::nullopt;
    e.vertices = outline.vertices();
    for (const osg::Vec3d& p : e.vertices) e.center += p / double(e.vertices.size());
    for (osg::Vec3d& p : e.vertices) p -= e.center;
    for (size_t i = 0; i < e.vertices.size(); ++i) e.normal += e.vertices[i] ^ e.vertices[(i + 1) % e.vertices.size()];
    e.area = 0.5 * e.normal.normalize();
    return e;
}

std::optional<Emitter> flatShapeOf(const Triangles& part, const Places& places)
{
    const std::vector<osg::Vec3d> outline = outlineOf(part, places);
    const osg::Vec3d center = centerOf(part);
    if (isRound(outline, center)) {
        osg::Vec3d normal = shownBy(part);
        const double area = normal.normalize();
        return disc(center, normal, area);
    }
    if (const auto rectangle = rectangleOf(outline)) return rectangle;
    return polygonOf(outline);
}

// The direction in which unit or other vectors, weighted by area, are spread most, by powers of their covariance.
template <class F>
osg::Vec3d mainAxis(const Triangles& triangles, F vectorOf)
{
    osg::Vec3d mean;
    for (const MeshTriangle& t : triangles) mean += vectorOf(t) * t.area;
    mean /= areaOf(triangles);
    osg::Vec3d axis(0.57, 0.63, 0.53);
    for (int i = 0; i < 32; ++i) {
        osg::Vec3d next;
        for (const MeshTriangle& t : triangles) {
            const osg::Vec3d d = vectorOf(t) - mean;
            next += d * (t.area * (d * axis));
        }
        if (next.normalize() <= 0.0) return osg::Vec3d();
        axis = next;
    }
    return axis;
}

template <class F>
bool split(const Triangles& all, F vectorOf, Triangles& low, Triangles& high)
{
    const osg::Vec3d axis = mainAxis(all, vectorOf);
    double mean = 0.0;
    for (const MeshTriangle& t : all) mean += (vectorOf(t) * axis) * t.area;
    mean /= areaOf(all);
    for (const MeshTriangle& t : all) (vectorOf(t) * axis < mean ? low : high).push_back(t);
    return !low.empty() && !high.empty();
}

// By how much a disc is not what these triangles are, in areas: what their directions cost, and how far they reach beyond it.
struct Misfit {
    double directions, reach;
    double sum() const { return directions + reach; }
};

Misfit misfitOf(const Triangles& triangles)
{
    const double area = areaOf(triangles), loss = area - shownBy(triangles).length();
    const osg::Vec3d center = centerOf(triangles);
    double square = 0.0;
    for (const MeshTriangle& t : triangles) square += t.area * (t.center - center).length2();
    const double spread = square / area / (area / osg::PI);
    return {loss > leastLoss * area ? loss : 0.0, spread > 4.0 * evenDisc ? 0.01 * area * std::min(spread, 10.0) : 0.0};
}

bool splitForDisc(const Triangles& all, Triangles& low, Triangles& high)
{
    const Misfit misfit = misfitOf(all);
    const auto normal = [](const MeshTriangle& t) { return t.normal; };
    const auto place = [](const MeshTriangle& t) { return t.center; };
    return misfit.directions > misfit.reach ? split(all, normal, low, high) : split(all, place, low, high);
}

// Parts that are nearly discs, or as many as there may be.
std::vector<Triangles> clustersOf(const Triangles& triangles)
{
    std::vector<Triangles> done, open = {triangles};
    const auto less = [](const Triangles& a, const Triangles& b) { return misfitOf(a).sum() < misfitOf(b).sum(); };
    while (!open.empty() && open.size() + done.size() < mostDiscs) {
        const auto worst = std::max_element(open.begin(), open.end(), less);
        Triangles all, low, high;
        all.swap(*worst);
        open.erase(worst);
        if (misfitOf(all).sum() <= 0.0 || !splitForDisc(all, low, high)) {
            done.push_back(std::move(all));
            continue;
        }
        open.push_back(std::move(low));
        open.push_back(std::move(high));
    }
    done.insert(done.end(), open.begin(), open.end());
    return done;
}

void addDiscs(const Triangles& triangles, const Places& places, bool bothSides, std::vector<Emitter>& shapes)
{
    const size_t first = shapes.size();
    double area = 0.0;
    for (const Triangles& cluster : clustersOf(triangles)) {
        osg::Vec3d normal = shownBy(cluster);
        const double shown = normal.normalize();
        if (shown <= 1e-6 * areaOf(cluster)) continue;  // as much one way as the other: from afar it shows nothing
        osg::Vec3d center = centerOf(cluster);
        double height = 0.0;
        for (const MeshTriangle& t : cluster)
            for (unsigned corner : t.corners) height = std::max(height, (places[corner] - center) * normal);
        shapes.push_back(disc(center + normal * height, normal, shown));
        shapes.back().twoSided = bothSides;
        area += shown;
    }
    for (size_t i = first; i < shapes.size(); ++i) shapes[i].radiance *= areaOf(triangles) / area;
}

void addShapes(const MeshBodies::Body& body, const Places& places, bool bothSides, std::vector<Emitter>& shapes)
{
    if (const auto ball = ballOf(body, places)) {
        shapes.push_back(*ball);
        return;
    }
    const std::vector<Triangles> parts = flatPartsOf(body, places);
    if (parts.size() > mostFlatParts) return addDiscs(body.triangles, places, false, shapes);
    for (const Triangles& part : parts) {
        const bool both = body.open && bothSides;
        if (const auto shape = flatShapeOf(part, places)) {
            shapes.push_back(*shape);
            shapes.back().twoSided = both;
        } else {
            addDiscs(part, places, both, shapes);
        }
    }
}

}  // namespace

std::vector<Emitter> shapesOf(const CasterMesh& mesh, bool bothSides)
{
    std::vector<Emitter> shapes;
    const MeshBodies bodies = bodiesOf(mesh);
    for (const MeshBodies::Body& body : bodies.bodies) addShapes(body, bodies.places, bothSides, shapes);
    return shapes;
}

}  // namespace osgEnvLight
