// SPDX-License-Identifier: MIT
#include "LightTransport.h"

#include "Directions.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

thread_local size_t raysOfThread = 0;

bool isBlack(const glm::dvec3& c)
{
    return c.r == 0.0 && c.g == 0.0 && c.b == 0.0;
}

}  // namespace

size_t LightTransport::takeRays()
{
    return std::exchange(raysOfThread, 0);
}

BlockerClasses::Class BlockerClasses::of(const SurfaceHit& blocker) const
{
    const glm::dvec3 world = blocker.position + _scene.scene().origin;
    const glm::dvec3 p = _camera.project(world);
    if (!(p.z > 0.0) || p.x < 0.0 || p.y < 0.0 || p.x >= _camera.width() || p.y >= _camera.height()) return OUTSIDE;
    Ray ray = _camera.ray(p.x, p.y);
    ray.origin -= _scene.scene().origin;
    SurfaceHit seen;
    ++raysOfThread;
    if (!_scene.nearest(ray, RayScene::CAMERA, 0, seen)) return HIDDEN;
    const double distance = glm::length(blocker.position - ray.origin);
    // A depth buffer tells no more apart than its pixel: a surface within a pixel's width of the seen one is it.
    const double pixel = glm::length(_camera.ray(p.x + 1.0, p.y).direction - ray.direction) * distance;
    if (seen.distance < distance - std::max(2.0 * pixel, 1e-4 * distance)) return HIDDEN;
    return blocker.distance > _reach ? FAR : SEEN;
}

double LightTransport::density(const Reflection& surface, const Incident& in) const
{
    if (_options.estimator == ReferenceOptions::UNIFORM) return surface.hemisphereDensity(in.direction);
    if (_options.estimator == ReferenceOptions::COSINE) return surface.cosineDensity(in.direction);
    double sum = in.density;
    if (surface.hasDiffuse()) sum += surface.cosineDensity(in.direction);
    if (surface.hasLobe()) sum += surface.lobeDensity(in.direction);
    return sum;
}

void LightTransport::Arrivals::clear()
{
    rays.clear();
    ends.clear();
    lights.clear();
    below = Light();
}

void LightTransport::add(const SurfaceHit& hit, const glm::dvec3& direction, const RayEnd& end, const Arrivals::Light& light,
                         Arrivals& arrivals)
{
    if (glm::dot(direction, hit.facet) > 0.0) {
        arrivals.rays.push_back(RayScene::leave(hit, direction));
        arrivals.ends.push_back(end);
        arrivals.lights.push_back(light);
    } else {
        arrivals.below.diffuse += light.diffuse;
        arrivals.below.specular += light.specular;
    }
}

void LightTransport::add(const Start& start, const Incident& in, const RayEnd& end, double weight, Arrivals& arrivals) const
{
    const Reflection& surface = *start.surface;
    const double c = surface.cosine(in.direction);
    if (c <= 0.0 || isBlack(in.radiance)) return;
    const double p = density(surface, in);
    if (!(p > 0.0)) return;
    const glm::dvec3 light = in.radiance * (weight * c / p);
    const bool listed = _lights && end.emitter < 0;  // the list's lights stand for the environment's
    const Arrivals::Light a{listed ? glm::dvec3(0.0) : light * surface.diffuse(in.direction),
                            light * surface.glossy(in.direction)};
    if (!isBlack(a.diffuse) || !isBlack(a.specular)) add(*start.hit, in.direction, end, a, arrivals);
}

void LightTransport::sampleDirect(const std::vector<Start>& starts, double weight, Arrivals& arrivals) const
{
    // Kept from call to call: allocations would cost more than the rays. Step by step for all samples, so that the arithmetic of
    // one need not wait for that of another.
    thread_local Aims aims;
    thread_local std::vector<glm::dvec2> squares;
    thread_local std::vector<Incident> incidents;
    aims.takers.clear();
    aims.aimed.clear();
    aims.directions.clear();
    squares.clear();
    const bool mis = _options.estimator == ReferenceOptions::MIS;
    const auto aim = [&](const Start& start, const glm::dvec3& l) {
        if (start.surface->cosine(l) <= 0.0) return;
        aims.aimed.push_back(&start);
        aims.directions.push_back(l);
    };
    for (const Start& start : starts) {
        const Reflection& surface = *start.surface;
        if (surface.isMirror()) {
            const glm::dvec3& l = surface.mirrorDirection();
            const glm::dvec3 seen = weight * surface.mirrorWeight() * _environment.from(l).radiance;
            add(*start.hit, l, RayEnd(), {glm::dvec3(0.0), seen}, arrivals);
        }
        const bool diffuse = surface.hasDiffuse() && (!_lights || !_emitters.empty());
        if (!diffuse && !surface.hasLobe()) continue;
        const glm::dvec2 u = start.random->square();
        if (mis) {
            aims.takers.push_back(&start);
            squares.push_back(u);
            if (surface.hasDiffuse()) aim(start, surface.sampleCosine(start.random->square()));
            if (surface.hasLobe()) aim(start, surface.sampleLobe(start.random->square()));
        } else {
            aim(start, _options.estimator == ReferenceOptions::UNIFORM ? surface.sampleHemisphere(u) : surface.sampleCosine(u));
        }
    }
    _environment.fromEach(aims.directions, mis, incidents);
    for (size_t i = 0; i < aims.aimed.size(); ++i) add(*aims.aimed[i], incidents[i], RayEnd(), weight, arrivals);
    if (mis) _environment.sampleEach(squares, incidents);
    for (size_t i = 0; i < aims.takers.size(); ++i) add(*aims.takers[i], incidents[i], RayEnd(), weight, arrivals);
    if (!_emitters.empty()) addEmitters(starts, aims, weight, arrivals);
    for (const Start& start : starts) addPointLights(start, weight, arrivals);
}

// Of these there is but one direction, which no other sample meets.
void LightTransport::addPointLights(const Start& start, double weight, Arrivals& arrivals) const
{
    for (const PointLight& light : _scene.scene().pointLights) {
        glm::dvec3 l = light.directional ? light.position : light.position - start.hit->position;
        const double distance = glm::length(l);
        if (!(distance > 0.0)) continue;
        l /= distance;
        const double c = start.surface->cosine(l), alongAxis = -glm::dot(l, light.axis);
        if (c <= 0.0 || alongAxis < light.cosCutoff) continue;
        const glm::dvec3& k = light.attenuation;
        double factor = pi * weight * c;
        RayEnd end;
        if (!light.directional) {
            factor /= std::max(k.x + distance * (k.y + distance * k.z), 1e-6);
            end.distance = distance * (1.0 - 1e-6);
        }
        if (light.cosCutoff >= -1.0 && light.exponent > 0.0) factor *= std::pow(std::max(alongAxis, 0.0), light.exponent);
        const glm::dvec3 arriving = light.radiance * factor;
        const Arrivals::Light a{arriving * start.surface->diffuse(l), arriving * start.surface->glossy(l)};
        if (!isBlack(a.diffuse) || !isBlack(a.specular)) add(*start.hit, l, end, a, arrivals);
    }
}

// By the same directions, and by points of the emitters.
void LightTransport::addEmitters(const std::vector<Start>& starts, const Aims& aims, double weight, Arrivals& arrivals) const
{
    thread_local EmitterSampler::Outlook outlook;
    thread_local std::vector<EmitterSampler::Arrival> met;
    const SurfaceHit* from = nullptr;
    // Samples of one surface follow each other.
    const auto look = [&](const Start& start) {
        if (start.hit != from) _emitters.look(start.hit->position, start.surface->normal(), outlook);
        from = start.hit;
    };
    for (size_t i = 0; i < aims.aimed.size(); ++i) {
        look(*aims.aimed[i]);
        _emitters.meet(outlook, aims.directions[i], met);
        for (const auto& a : met) add(*aims.aimed[i], {a.direction, a.radiance, a.density}, a.end(), weight, arrivals);
    }
    for (const Start* start : aims.takers) {
        look(*start);
        EmitterSampler::Arrival a;
        const double choice = start->random->number();
        if (_emitters.sample(outlook, choice, start->random->square(), a))
            add(*start, {a.direction, a.radiance, a.density}, a.end(), weight, arrivals);
    }
    for (const Start& start : starts) {
        if (!start.surface->isMirror()) continue;
        look(start);
        _emitters.meet(outlook, start.surface->mirrorDirection(), met);
        for (const auto& a : met)
            add(*start.hit, a.direction, a.end(), {glm::dvec3(0.0), weight * start.surface->mirrorWeight() * a.radiance},
                arrivals);
    }
}

void LightTransport::addLights(const SurfaceHit& hit, const Reflection& surface, double weight, Arrivals& arrivals) const
{
    for (const DirectionalLight& light : *_lights) {
        const glm::dvec3 l(light.direction.x(), light.direction.y(), light.direction.z());
        const glm::dvec3 flux(light.flux.x(), light.flux.y(), light.flux.z());
        const glm::dvec3 d = flux * surface.diffuse(l) * (weight * surface.cosine(l));
        if (!isBlack(d)) add(hit, l, RayEnd(), {d, glm::dvec3(0.0)}, arrivals);
    }
}

DirectLight LightTransport::resolve(const Arrivals& arrivals) const
{
    DirectLight result;
    result.diffuse = arrivals.below.diffuse;
    result.specular = arrivals.below.specular;
    for (const Arrivals::Light& a : arrivals.lights) {
        result.diffuse += a.diffuse;
        result.specular += a.specular;
    }
    if (_options.paths == ReferenceOptions::UNOCCLUDED) {
        result.specularVisible = result.specular;
        return result;
    }
    thread_local std::vector<float> through;
    through.resize(arrivals.rays.size());
    _scene.transmittance(arrivals.rays.data(), arrivals.rays.size(), through.data(), arrivals.ends.data());
    raysOfThread += arrivals.rays.size();
    result.occlusion = arrivals.below.diffuse;
    for (size_t i = 0; i < through.size(); ++i) {
        const double t = double(through[i]);
        const glm::dvec3 kept = (1.0 - t) * arrivals.lights[i].diffuse;
        result.occlusion += kept;
        result.specularVisible += t * arrivals.lights[i].specular;
        if (!_classes || isBlack(kept)) continue;
        SurfaceHit blocker;
        ++raysOfThread;
        if (!_scene.nearest(arrivals.rays[i], RayScene::ANY, 0, blocker) || blocker.distance > arrivals.ends[i].distance)
            continue;
        const BlockerClasses::Class c = _classes->of(blocker);
        if (c == BlockerClasses::OUTSIDE) result.outside += kept;
        if (c == BlockerClasses::HIDDEN) result.hidden += kept;
        if (c == BlockerClasses::FAR) result.far += kept;
    }
    return result;
}

bool LightTransport::continuePath(const Reflection& surface, RandomPoints& random, glm::dvec3& direction,
                                  glm::dvec3& weight) const
{
    // One of the ways at random, with all their densities in the denominator.
    const double lobes = double(surface.hasDiffuse()) + double(surface.hasLobe()) + double(surface.isMirror());
    if (lobes == 0.0) return false;
    double choice = random.number() * lobes;
    const glm::dvec2 u = random.square();
    if (surface.isMirror() && (choice -= 1.0) < 0.0) {
        direction = surface.mirrorDirection();
        weight = surface.mirrorWeight() * lobes;
        return true;
    }
    const bool mis = _options.estimator == ReferenceOptions::MIS;
    const double smooth = double(surface.hasDiffuse()) + double(surface.hasLobe());
    double p;
    if (!mis) {
        direction = surface.sampleCosine(u);
        p = surface.cosineDensity(direction) * smooth;
    } else {
        const bool byLobe = surface.hasLobe() && (!surface.hasDiffuse() || (choice -= 1.0) < 0.0);
        direction = byLobe ? surface.sampleLobe(u) : surface.sampleCosine(u);
        p = 0.0;
        if (surface.hasDiffuse()) p += surface.cosineDensity(direction);
        if (surface.hasLobe()) p += surface.lobeDensity(direction);
    }
    const double c = surface.cosine(direction);
    if (!(p > 0.0) || c <= 0.0) return false;
    weight = (surface.diffuse(direction) + surface.glossy(direction)) * (c * lobes / p);
    return true;
}

glm::dvec3 LightTransport::indirect(const Start& start, std::uint64_t seed) const
{
    thread_local Arrivals arrivals;
    thread_local std::vector<Start> next;
    glm::dvec3 sum(0.0);
    glm::dvec3 throughput(1.0);
    RandomPoints& random = *start.random;
    SurfaceHit at = *start.hit;
    Reflection reflection = *start.surface;
    for (int bounce = 1;; ++bounce) {
        glm::dvec3 direction, weight;
        if (!continuePath(reflection, random, direction, weight) || glm::dot(direction, at.facet) <= 0.0) return sum;
        throughput *= weight;
        if (bounce > 3) {
            // Russian roulette: what survives is worth more by as much as survival was unlikely.
            const double survival = std::min(0.95, std::max(throughput.r, std::max(throughput.g, throughput.b)));
            if (!(random.number() < survival)) return sum;
            throughput /= survival;
        }
        const Ray ray = RayScene::leave(at, direction);
        ++raysOfThread;
        if (!_scene.nearest(ray, RayScene::ANY, mixBits(seed + std::uint64_t(bounce)), at)) return sum;
        reflection = Reflection(at, ray, surfaceColor(at));
        arrivals.clear();
        next.assign(1, {&at, &reflection, &random});
        sampleDirect(next, 1.0, arrivals);
        if (_lights) addLights(at, reflection, 1.0, arrivals);
        // An emitter's light has been counted where the path comes from.
        const glm::dvec3 emission = at.mesh->emitter < 0 && !at.mesh->lamp ? reflection.emission() : glm::dvec3(0.0);
        sum += throughput * (emission + resolve(arrivals).visible());
    }
}

}  // namespace osgEnvLight
