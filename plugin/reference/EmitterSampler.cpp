// SPDX-License-Identifier: MIT
#include "EmitterSampler.h"

#include "Directions.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Of a triangle seen from the origin [Van Oosterom, Strackee 1983].
double triangleSolidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
    return 2.0 * std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

// The part of b at right angles to the unit vector a, of unit length.
glm::dvec3 besides(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::normalize(b - glm::dot(a, b) * a);
}

// Evenly within a spherical triangle of unit vectors [Arvo 1995]. Not finite where it is as good as a line.
glm::dvec3 sampleSphericalTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec2& random)
{
    const glm::dvec3 ab = glm::cross(a, b), bc = glm::cross(b, c), ca = glm::cross(c, a);
    const double alpha = angleBetween(ab, -ca), beta = angleBetween(bc, -ab), gamma = angleBetween(ca, -bc);
    // A corner on the edge from a to c cuts off the part whose area is that share.
    const double part = random.x * (alpha + beta + gamma - pi);
    const double s = std::sin(part - alpha), t = std::cos(part - alpha);
    const double u = t - std::cos(alpha), v = s + std::sin(alpha) * glm::dot(a, b);
    const double q = ((v * t - u * s) * std::cos(alpha) - v) / ((v * s + u * t) * std::sin(alpha));
    const double cosine = glm::clamp(q, -1.0, 1.0);
    const glm::dvec3 corner = cosine * a + std::sqrt(1.0 - cosine * cosine) * besides(a, c);
    const double height = random.y * 0.5 * glm::dot(corner - b, corner - b);
    return (1.0 - height) * b + std::sqrt(height * (2.0 - height)) * besides(b, corner);
}

// 1 - cosine of the half angle at which a sphere is seen.
double capHeight(double radius, double distance)
{
    const double squareSin = std::min(radius * radius / (distance * distance), 1.0);
    return squareSin / (1.0 + std::sqrt(1.0 - squareSin));
}

// Largest cosine to the normal of what lies in a sphere.
double largestCosine(const glm::dvec3& normal, const glm::dvec3& center, double radius)
{
    const double distance = glm::length(center);
    if (distance <= radius) return 1.0;
    const double cosine = glm::dot(normal, center) / distance, sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double sinRadius = radius / distance, cosRadius = std::sqrt(1.0 - sinRadius * sinRadius);
    return cosine >= cosRadius ? 1.0 : std::max(0.0, cosine * cosRadius + sine * sinRadius);
}

// As the surface that shows it is sampled.
std::shared_ptr<const TextureImage> readPicture(const osg::Image* image)
{
    if (!image) return nullptr;
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(const_cast<osg::Image*>(image));
    texture->setResizeNonPowerOfTwoHint(false);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    std::string reason;
    return TextureImage::create(*texture, !isEncoded(*image), reason);
}

}  // namespace

EmitterSampler::Light EmitterSampler::convert(const Emitter& e)
{
    Light light;
    light.shape = e.shape;
    light.center = toGlm(e.center);
    light.frame = frameAbout(e.shape == AreaLight::SPHERE ? glm::dvec3(0, 0, 1) : toGlm(e.normal));
    light.radiance = toGlm(e.image ? e.tint : e.radiance);
    light.brightness = (e.radiance[0] + e.radiance[1] + e.radiance[2]) / 3.0;
    light.area = e.area;
    light.radius = e.radius();
    light.extent = e.extent();
    light.twoSided = e.twoSided;
    light.picture = readPicture(e.image);
    const bool fromTop = e.image && e.image->getOrigin() == osg::Image::TOP_LEFT;
    light.halfAxes[0] = toGlm(e.u);
    light.halfAxes[1] = toGlm(e.v) * (e.pictureTurned == fromTop ? 1.0 : -1.0);
    const auto add = [&light](const osg::Vec3d& a, const osg::Vec3d& b, const osg::Vec3d& c) {
        Triangle t;
        t.corners[0] = toGlm(a);
        t.corners[1] = toGlm(b);
        t.corners[2] = toGlm(c);
        for (int i = 0; i < 3; ++i) t.inPlane[i] = glm::dvec2(t.corners[i] * light.frame);
        t.area = 0.5 * cross(t.inPlane[1] - t.inPlane[0], t.inPlane[2] - t.inPlane[0]);
        light.triangles.push_back(t);
    };
    if (e.shape == AreaLight::RECTANGLE) {
        add(-e.u - e.v, e.u - e.v, e.u + e.v);
        add(-e.u - e.v, e.u + e.v, e.v - e.u);
    }
    for (size_t i = 0; i + 2 < e.triangles.size(); i += 3)
        add(e.vertices[e.triangles[i]], e.vertices[e.triangles[i + 1]], e.vertices[e.triangles[i + 2]]);
    return light;
}

EmitterSampler::EmitterSampler(const std::vector<Emitter>& emitters)
{
    for (const Emitter& e : emitters) _lights.push_back(convert(e));
}

// Of a point of its plane, relative to the centre.
bool EmitterSampler::Light::contains(const glm::dvec3& p) const
{
    const glm::dvec2 q(p * frame);
    if (shape == AreaLight::DISC) return glm::dot(q, q) <= radius * radius;
    return std::any_of(triangles.begin(), triangles.end(), [&q](const Triangle& t) {
        const glm::dvec2* c = t.inPlane;
        return cross(c[1] - c[0], q - c[0]) >= 0.0 && cross(c[2] - c[1], q - c[1]) >= 0.0 && cross(c[0] - c[2], q - c[2]) >= 0.0;
    });
}

// At a point of its plane, relative to the centre.
glm::dvec3 EmitterSampler::Light::shown(const glm::dvec3& p) const
{
    if (!picture) return glm::dvec3(1.0);
    const glm::dvec3 &u = halfAxes[0], &v = halfAxes[1], n = glm::cross(u, v);
    const glm::dvec2 place(glm::dot(glm::cross(p, v), n), glm::dot(glm::cross(u, p), n));
    const glm::dvec2 st = 0.5 + 0.5 * place / glm::dot(n, n);
    return glm::dvec3(picture->sample(st, glm::dvec2(0.0), glm::dvec2(0.0)));
}

// Whether a point lies before a lit side.
bool EmitterSampler::Light::lights(const glm::dvec3& point) const
{
    const glm::dvec3 p = point - center;
    if (shape == AreaLight::SPHERE) return glm::dot(p, p) > radius * radius;
    const double height = glm::dot(normal(), p);
    const double onIt = 1e-7 * extent;  // in its plane but for rounding: its own surface, which does not light itself
    return height > onIt || (twoSided && height < -onIt);
}

double EmitterSampler::solidAngle(const Light& light, const glm::dvec3& point)
{
    const glm::dvec3 c = light.center - point;
    if (light.shape == AreaLight::SPHERE) return 2.0 * pi * capHeight(light.radius, glm::length(c));
    if (light.shape == AreaLight::DISC)
        return light.area * std::abs(glm::dot(light.normal(), c)) * std::pow(glm::dot(c, c) + light.radius * light.radius, -1.5);
    double sum = 0.0;
    for (const Triangle& t : light.triangles) sum += triangleSolidAngle(c + t.corners[0], c + t.corners[1], c + t.corners[2]);
    return sum;
}

// Far away the area is as good; close to the plane a spherical triangle has no corners left.
bool EmitterSampler::byAngle(const Light& light, double solidAngle)
{
    return light.shape != AreaLight::DISC && (light.shape == AreaLight::SPHERE || (solidAngle > 1e-4 && solidAngle < 6.0));
}

void EmitterSampler::look(const glm::dvec3& point, const glm::dvec3& normal, Outlook& outlook) const
{
    outlook.point = point;
    outlook.sights.assign(_lights.size(), {});
    double sum = 0.0;
    for (size_t i = 0; i < _lights.size(); ++i) {
        const Light& light = _lights[i];
        if (!light.lights(point)) continue;
        Outlook::Sight& sight = outlook.sights[i];
        sight.solidAngle = solidAngle(light, point);
        sight.probability = light.brightness * sight.solidAngle * largestCosine(normal, light.center - point, light.extent);
        sum += sight.probability;
    }
    for (Outlook::Sight& sight : outlook.sights) sight.probability = sum > 0.0 ? sight.probability / sum : 0.0;
}

glm::dvec3 EmitterSampler::sampleSphere(const Light& light, const glm::dvec3& point, const glm::dvec2& u)
{
    const glm::dvec3 c = light.center - point;
    const double distance = glm::length(c);
    return frameAbout(c / distance) * aboutPoleByHeight(u.x * capHeight(light.radius, distance), u.y);
}

glm::dvec3 EmitterSampler::sampleDisc(const Light& light, const glm::dvec3& point, const glm::dvec2& u)
{
    const glm::dvec3 inPlane(light.radius * std::sqrt(u.x) * onCircle(u.y), 0.0);
    return glm::normalize(light.center - point + light.frame * inPlane);
}

glm::dvec3 EmitterSampler::sampleTriangles(const Light& light, const glm::dvec3& point, double solidAngle, double choice,
                                           const glm::dvec2& u)
{
    const glm::dvec3 c = light.center - point;
    const bool even = byAngle(light, solidAngle);
    double left = choice * (even ? solidAngle : light.area);
    const Triangle* chosen = nullptr;
    for (const Triangle& t : light.triangles) {
        chosen = &t;
        left -= even ? triangleSolidAngle(c + t.corners[0], c + t.corners[1], c + t.corners[2]) : t.area;
        if (left < 0.0) break;
    }
    const glm::dvec3* corners = chosen->corners;
    if (even)
        return sampleSphericalTriangle(glm::normalize(c + corners[0]), glm::normalize(c + corners[1]),
                                       glm::normalize(c + corners[2]), u);
    const double s = std::sqrt(u.x);
    return glm::normalize(c + (1.0 - s) * corners[0] + s * (1.0 - u.y) * corners[1] + s * u.y * corners[2]);
}

// Along a direction to the plane of a flat light, or to the nearer side of a sphere, whose rim a sampled direction may miss by
// rounding.
bool EmitterSampler::distanceTo(const Light& light, const glm::dvec3& point, const glm::dvec3& direction, double& distance)
{
    const glm::dvec3 c = light.center - point;
    if (light.shape != AreaLight::SPHERE) {
        distance = glm::dot(light.normal(), c) / glm::dot(light.normal(), direction);
        return distance > 0.0 && std::isfinite(distance);
    }
    const double middle = glm::dot(c, direction);
    const glm::dvec3 beside = c - middle * direction;
    const double square = light.radius * light.radius - glm::dot(beside, beside);
    distance = middle - std::sqrt(std::max(0.0, square));
    return distance > 0.0 && square >= -1e-9 * light.radius * light.radius;
}

EmitterSampler::Arrival EmitterSampler::arrivalOf(size_t i, const Outlook& outlook, const glm::dvec3& direction,
                                                  double distance) const
{
    const Light& light = _lights[i];
    const Outlook::Sight& sight = outlook.sights[i];
    Arrival a;
    a.emitter = int(i);
    a.direction = direction;
    a.distance = distance;
    a.radiance = light.radiance * light.shown(outlook.point - light.center + distance * direction);
    const double perAngle = byAngle(light, sight.solidAngle)
                                ? 1.0 / sight.solidAngle
                                : distance * distance / (light.area * std::abs(glm::dot(light.normal(), direction)));
    a.density = sight.probability > 0.0 ? sight.probability * perAngle : 0.0;
    return a;
}

bool EmitterSampler::sample(const Outlook& outlook, double choice, const glm::dvec2& u, Arrival& arrival) const
{
    size_t chosen = _lights.size();
    for (size_t i = 0; i < _lights.size(); ++i) {
        const double p = outlook.sights[i].probability;
        if (!(p > 0.0)) continue;
        chosen = i;
        if (choice < p) break;
        choice -= p;
    }
    if (chosen == _lights.size()) return false;
    const Light& light = _lights[chosen];
    const Outlook::Sight& sight = outlook.sights[chosen];
    choice = glm::clamp(choice / sight.probability, 0.0, 1.0);
    const glm::dvec3 direction = light.shape == AreaLight::SPHERE ? sampleSphere(light, outlook.point, u)
                                 : light.shape == AreaLight::DISC
                                     ? sampleDisc(light, outlook.point, u)
                                     : sampleTriangles(light, outlook.point, sight.solidAngle, choice, u);
    double distance;
    if (!distanceTo(light, outlook.point, direction, distance)) return false;
    arrival = arrivalOf(chosen, outlook, direction, distance);
    return true;
}

glm::dvec3 EmitterSampler::shown(int emitter, const glm::dvec3& position) const
{
    return emitter < 0 ? glm::dvec3(1.0) : _lights[size_t(emitter)].shown(position - _lights[size_t(emitter)].center);
}

void EmitterSampler::meet(const Outlook& outlook, const glm::dvec3& direction, std::vector<Arrival>& arrivals) const
{
    arrivals.clear();
    for (size_t i = 0; i < _lights.size(); ++i) {
        const Light& light = _lights[i];
        double distance;
        if (!light.lights(outlook.point) || !distanceTo(light, outlook.point, direction, distance)) continue;
        if (light.shape != AreaLight::SPHERE && !light.contains(outlook.point - light.center + distance * direction)) continue;
        arrivals.push_back(arrivalOf(i, outlook, direction, distance));
    }
}

}  // namespace osgEnvLight
