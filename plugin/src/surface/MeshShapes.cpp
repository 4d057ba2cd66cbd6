// SPDX-License-Identifier: MIT
#include "surface/MeshShapes.h"

#include "surface/Axes.h"
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
const size_t mostPlates = 32;      // that stand for another body
const double roundness = 0.03;     // share of its radius by which a ball's or a disc's corners may be off it
const size_t leastBallFaces = 20;  // an icosahedron is a ball
const size_t leastDiscCorners = 12;
const double leastLoss = 0.03;  // of the area that a plate's directions cost, below which it is not split for them
const double mostBend = 1.5;    // times the spread across of a flat strip of that length and area

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
    e.u = besides(normal) * std::sqrt(area / osg::PI);
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

const auto normalOf = [](const MeshTriangle& t) { return t.normal; };
const auto placeOf = [](const MeshTriangle& t) { return t.center; };

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

// Mean square distance from the middle along a direction.
double spreadAlong(const Triangles& triangles, const Places& places, const osg::Vec3d& axis)
{
    const double middle = centerOf(triangles) * axis;
    double sum = 0.0;
    for (const MeshTriangle& t : triangles) {
        double corners = 0.0;
        for (unsigned corner : t.corners) corners += std::pow(places[corner] * axis - middle, 2);
        sum += t.area / 12.0 * (corners + 9.0 * std::pow(t.center * axis - middle, 2));  // of a triangle, exactly
    }
    return sum / areaOf(triangles);
}

// An arc, a wave or a ring, which is wider than what has its area along its length.
bool isBent(const Triangles& triangles, const Places& places)
{
    const osg::Vec3d along = mainAxis(triangles, placeOf);
    const auto offAxis = [&](const MeshTriangle& t) { return t.center - along * (t.center * along); };
    const osg::Vec3d across = mainAxis(triangles, offAxis);
    const double length = std::sqrt(12.0 * spreadAlong(triangles, places, along)), width = areaOf(triangles) / length;
    return spreadAlong(triangles, places, across) > mostBend * width * width / 12.0;
}

// What keeps these triangles from being a rectangle: their directions or their bend.
struct Misfit {
    double area;
    bool bent;
    double loss;  // share of the area that the directions cost
    double sum() const { return bent ? 2.0 * area : loss > leastLoss ? loss * area : 0.0; }
};

Misfit misfitOf(const Triangles& triangles, const Places& places)
{
    const double area = areaOf(triangles), loss = 1.0 - shownBy(triangles).length() / area;
    return {area, isBent(triangles, places), loss};
}

// Parts that are nearly rectangles, or as many as there may be.
std::vector<Triangles> clustersOf(const Triangles& triangles, const Places& places)
{
    struct Open {
        Triangles triangles;
        Misfit misfit;
    };
    std::vector<Triangles> done;
    std::vector<Open> open = {{triangles, misfitOf(triangles, places)}};
    const auto less = [](const Open& a, const Open& b) { return a.misfit.sum() < b.misfit.sum(); };
    while (!open.empty() && open.size() + done.size() < mostPlates) {
        const auto worst = std::max_element(open.begin(), open.end(), less);
        const Open all = std::move(*worst);
        open.erase(worst);
        Triangles low, high;
        const bool fits = all.misfit.sum() <= 0.0;
        if (fits || !(all.misfit.bent ? split(all.triangles, placeOf, low, high) : split(all.triangles, normalOf, low, high))) {
            done.push_back(all.triangles);
            continue;
        }
        open.push_back({low, misfitOf(low, places)});
        open.push_back({high, misfitOf(high, places)});
    }
    for (Open& o : open) done.push_back(std::move(o.triangles));
    return done;
}

// As long and wide as the triangles are spread, with the area that they show, on top of them.
Emitter plateOf(const Triangles& triangles, const Places& places, const osg::Vec3d& normal, double area)
{
    const osg::Vec3d center = centerOf(triangles);
    double height = 0.0;
    for (const MeshTriangle& t : triangles)
        for (unsigned corner : t.corners) height = std::max(height, (places[corner] - center) * normal);
    Emitter e = emitter(AreaLight::RECTANGLE, center + normal * height);
    e.normal = normal;
    e.area = area;
    osg::Vec3d along = mainAxis(triangles, [&](const MeshTriangle& t) { return t.center - normal * (t.center * normal); });
    if (along.length2() < 0.5) along = besides(normal);
    const osg::Vec3d across = normal ^ along;
    const double length = std::sqrt(spreadAlong(triangles, places, along)),
                 width = std::sqrt(spreadAlong(triangles, places, across));
    const double ratio = std::max(length, 1e-9) / std::max(width, 1e-9 * length + 1e-300);
    e.u = along * (0.5 * std::sqrt(area * ratio));
    e.v = across * (0.5 * std::sqrt(area / ratio));
    return e;
}

void addPlates(const Triangles& triangles, const Places& places, bool bothSides, std::vector<Emitter>& shapes)
{
    const size_t first = shapes.size();
    double area = 0.0;
    for (const Triangles& cluster : clustersOf(triangles, places)) {
        osg::Vec3d normal = shownBy(cluster);
        const double shown = normal.normalize();
        if (shown <= 1e-6 * areaOf(cluster)) continue;  // as much one way as the other: from afar it shows nothing
        shapes.push_back(plateOf(cluster, places, normal, shown));
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
    if (parts.size() > mostFlatParts) return addPlates(body.triangles, places, false, shapes);
    for (const Triangles& part : parts) {
        const bool both = body.open && bothSides;
        if (const auto shape = flatShapeOf(part, places)) {
            shapes.push_back(*shape);
            shapes.back().twoSided = both;
        } else {
            addPlates(part, places, both, shapes);
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
