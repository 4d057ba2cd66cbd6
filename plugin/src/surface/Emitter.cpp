// SPDX-License-Identifier: MIT
#include "surface/Emitter.h"

#include "surface/Axes.h"
#include "surface/Outline.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

const char* const noArea = "has no area";
const char* const notFinite = "has a number that is not finite";

bool isFinite(const osg::Vec3d& v)
{
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

// Sets the normal and, where the matrix mirrors, turns v over.
std::string orient(bool mirrored, Emitter& e)
{
    if (mirrored) e.v = -e.v;
    e.normal = e.u ^ e.v;
    const double size = e.u.length() * e.v.length();
    if (!std::isfinite(size)) return notFinite;
    return e.normal.normalize() > 1e-12 * size ? std::string() : noArea;
}

std::string placeRectangle(bool mirrored, Emitter& e)
{
    e.pictureTurned = mirrored;
    e.area = 4.0 * (e.u ^ e.v).length();
    return orient(mirrored, e);
}

// An ellipse of these half axes, which need not be at right angles.
void makePolygon(Emitter& e)
{
    const unsigned n = AreaLight::mostVertices;
    const double angle = 2.0 * osg::PI / n;
    const double scale = std::sqrt(angle / std::sin(angle));  // of the ellipse's area
    for (unsigned i = 0; i < n; ++i) {
        e.vertices.push_back((e.u * std::cos(i * angle) + e.v * std::sin(i * angle)) * scale);
        if (i > 1) e.triangles.insert(e.triangles.end(), {0u, i - 1, i});
    }
    e.shape = AreaLight::POLYGON;
    e.u = e.v = osg::Vec3d();
}

std::string placeDisc(bool mirrored, Emitter& e)
{
    e.area = osg::PI * (e.u ^ e.v).length();
    const std::string problem = orient(mirrored, e);
    if (!problem.empty()) return problem;
    // Of a matrix that was stored as floats.
    const double slack = 1e-4, u = e.u.length(), v = e.v.length();
    if (std::abs(u - v) > slack * u || std::abs(e.u * e.v) > slack * u * v) {
        makePolygon(e);
        return {};
    }
    e.u *= std::sqrt(e.area / osg::PI) / u;
    e.v = e.normal ^ e.u;
    return {};
}

std::string placeSphere(double localRadius, double volumeScale, Emitter& e)
{
    const double radius = localRadius * std::cbrt(std::abs(volumeScale));
    e.u = osg::Vec3d(radius, 0, 0);
    e.v = osg::Vec3d();
    e.area = 4.0 * osg::PI * radius * radius;
    e.twoSided = false;
    return e.area > 0.0 ? std::string() : noArea;
}

std::string placePolygon(const osg::Vec3Array* array, const osg::Matrixd& matrix, bool mirrored, Emitter& e)
{
    if (!array || array->size() < 3) return "has less than three vertices";
    if (array->size() > AreaLight::mostVertices) return "has more than " + std::to_string(AreaLight::mostVertices) + " vertices";
    std::vector<osg::Vec3d> vertices(array->begin(), array->end());
    if (!std::all_of(vertices.begin(), vertices.end(), isFinite)) return notFinite;
    const Outline local(std::move(vertices));
    if (local.vertices().size() < 3 || local.area() <= 1e-12 * local.extent() * local.extent()) return noArea;
    if (!local.isFlat()) return "is not flat";
    e.triangles = local.triangles();
    if (local.crosses() || e.triangles.empty()) return "has edges that cross";
    e.center = osg::Vec3d();
    for (const osg::Vec3d& p : local.vertices()) e.vertices.push_back(osg::Matrixd::transform3x3(p, matrix));
    for (const osg::Vec3d& p : e.vertices) e.center += p / double(e.vertices.size());
    for (osg::Vec3d& p : e.vertices) p -= e.center;
    e.center += matrix.getTrans();
    if (mirrored) {
        std::reverse(e.vertices.begin(), e.vertices.end());
        std::reverse(e.triangles.begin(), e.triangles.end());
        for (unsigned& i : e.triangles) i = unsigned(e.vertices.size()) - 1 - i;
    }
    const Outline placed(e.vertices);
    e.area = placed.area();
    if (placed.area() <= 1e-12 * placed.extent() * placed.extent()) return noArea;
    for (size_t i = 0; i < e.vertices.size(); ++i) e.normal += e.vertices[i] ^ e.vertices[(i + 1) % e.vertices.size()];
    e.normal.normalize();
    return {};
}

std::string placeShape(const AreaLight& light, const osg::Matrixd& matrix, Emitter& e)
{
    const double volumeScale = volumeScaleOf(matrix);
    if (light.getShape() == AreaLight::POLYGON) return placePolygon(light.getVertices(), matrix, volumeScale < 0.0, e);
    e.center = light.getCenter() * matrix;
    e.u = osg::Matrixd::transform3x3(light.getU(), matrix);
    e.v = osg::Matrixd::transform3x3(light.getV(), matrix);
    if (!isFinite(e.center) || !isFinite(e.u) || !isFinite(e.v)) return notFinite;
    if (light.getShape() == AreaLight::SPHERE) return placeSphere(light.getU().length(), volumeScale, e);
    return light.getShape() == AreaLight::DISC ? placeDisc(volumeScale < 0.0, e) : placeRectangle(volumeScale < 0.0, e);
}

// Radiance is that of white until here; of a light by its flux it is the mean already. A channel that the picture does not have
// is black.
void show(const AreaLight& light, const EmitterPicture& picture, Emitter& e)
{
    const bool isMean = light.getQuantity() == AreaLight::FLUX;
    e.picture = &picture;
    e.image = light.getImage();
    for (int i = 0; i < 3; ++i) {
        const double mean = picture.mean()[i];
        e.tint[i] = isMean ? (mean > 0.0 ? e.radiance[i] / mean : 0.0) : e.radiance[i];
        e.radiance[i] = e.tint[i] * mean;
    }
}

}  // namespace

double Emitter::extent() const
{
    if (shape == AreaLight::RECTANGLE) return std::max((u + v).length(), (u - v).length());
    double extent = radius();
    for (const osg::Vec3d& p : vertices) extent = std::max(extent, p.length());
    return extent;
}

double Emitter::flux() const
{
    return (twoSided ? 2.0 : 1.0) * osg::PI * area * (radiance.x() + radiance.y() + radiance.z()) / 3.0;
}

bool Emitter::operator==(const Emitter& o) const
{
    return shape == o.shape && center == o.center && u == o.u && v == o.v && vertices == o.vertices && radiance == o.radiance &&
           twoSided == o.twoSided && drawn == o.drawn && picture == o.picture && tint == o.tint &&
           pictureTurned == o.pictureTurned;
}

bool Emitter::isRounded(const Emitter& o) const
{
    if (shape != o.shape || twoSided != o.twoSided || drawn != o.drawn || vertices.size() != o.vertices.size()) return false;
    if (picture != o.picture || pictureTurned != o.pictureTurned) return false;
    const double slack = 1e-13 * center.length() + 1e-9 * extent();
    const auto isNear = [slack](const osg::Vec3d& a, const osg::Vec3d& b) { return (a - b).length() <= slack; };
    return isNear(center, o.center) && isNear(u, o.u) && isNear(v, o.v) &&
           std::equal(vertices.begin(), vertices.end(), o.vertices.begin(), isNear) &&
           (radiance - o.radiance).length() <= 1e-9 * radiance.length() && (tint - o.tint).length() <= 1e-9 * tint.length();
}

Emitter Emitter::moved(const osg::Matrixd& rigid) const
{
    Emitter e = *this;
    e.center = center * rigid;
    e.normal = osg::Matrixd::transform3x3(normal, rigid);
    for (osg::Vec3d& p : e.vertices) p = osg::Matrixd::transform3x3(p, rigid);
    if (shape == AreaLight::SPHERE) return e;
    e.u = osg::Matrixd::transform3x3(u, rigid);
    e.v = osg::Matrixd::transform3x3(v, rigid);
    return e;
}

std::string placeEmitter(const AreaLight& light, const osg::Matrixd& matrix, Emitter& emitter)
{
    emitter = Emitter();
    emitter.shape = light.getShape();
    emitter.twoSided = light.getTwoSided();
    emitter.drawn = light.getVisible();
    if (!isFinite(osg::Vec3d(light.getEmission()))) return notFinite;
    for (int i = 0; i < 3; ++i) emitter.radiance[i] = std::max(double(light.getEmission()[i]), 0.0);
    const std::string problem = placeShape(light, matrix, emitter);
    if (!problem.empty()) return problem;
    if (light.getQuantity() == AreaLight::FLUX) emitter.radiance /= (emitter.twoSided ? 2.0 : 1.0) * osg::PI * emitter.area;
    std::string pictureProblem;
    const osg::ref_ptr<const EmitterPicture> picture = light.picture(pictureProblem);
    if (!pictureProblem.empty()) return pictureProblem;
    if (picture && emitter.shape != AreaLight::RECTANGLE) return "has an image but is no rectangle";
    if (picture) show(light, *picture, emitter);
    const bool finite = isFinite(emitter.center) && isFinite(emitter.normal) && isFinite(emitter.radiance) &&
                        std::isfinite(emitter.area) && std::isfinite(emitter.extent());
    if (!finite) return notFinite;
    return emitter.area > 0.0 ? std::string() : noArea;
}

}  // namespace osgEnvLight
