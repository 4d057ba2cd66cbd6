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

void LightTransport::add(const Reflection& surface, const Incident& in, Arrivals& arrivals) const
{
    const double c = surface.cosine(in.direction);
    if (c <= 0.0 || isBlack(in.radiance)) return;
    const double p = density(surface, in);
    if (!(p > 0.0)) return;
    const glm::dvec3 light = in.radiance * (c / p);
    const Arrival a{in.direction, _lights ? glm::dvec3(0.0) : light * surface.diffuse(), light * surface.glossy(in.direction)};
    if (!isBlack(a.diffuse) || !isBlack(a.specular)) arrivals.push_back(a);
}

void LightTransport::addFrom(const Reflection& surface, const glm::dvec3& l, Arrivals& arrivals) const
{
    if (surface.cosine(l) > 0.0) add(surface, _environment.from(l, _options.estimator == ReferenceOptions::MIS), arrivals);
}

void LightTransport::sampleDirect(const Reflection& surface, RandomPoints& random, Arrivals& arrivals) const
{
    if (surface.isMirror()) {
        const glm::dvec3& l = surface.mirrorDirection();
        arrivals.push_back({l, glm::dvec3(0.0), surface.mirrorWeight() * _environment.from(l).radiance});
    }
    const bool diffuse = surface.hasDiffuse() && !_lights;
    if (!diffuse && !surface.hasLobe()) return;
    if (_options.estimator == ReferenceOptions::UNIFORM)
        return addFrom(surface, surface.sampleHemisphere(random.square()), arrivals);
    if (_options.estimator == ReferenceOptions::COSINE) return addFrom(surface, surface.sampleCosine(random.square()), arrivals);
    add(surface, _environment.sample(random.square()), arrivals);
    if (surface.hasDiffuse()) addFrom(surface, surface.sampleCosine(random.square()), arrivals);
    if (surface.hasLobe()) addFrom(surface, surface.sampleLobe(random.square()), arrivals);
}

void LightTransport::addLights(const Reflection& surface, Arrivals& arrivals) const
{
    for (const DirectionalLight& light : *_lights) {
        const glm::dvec3 l(light.direction.x(), light.direction.y(), light.direction.z());
        const glm::dvec3 flux(light.flux.x(), light.flux.y(), light.flux.z());
        const glm::dvec3 d = flux * surface.diffuse() * surface.cosine(l);
        if (!isBlack(d)) arrivals.push_back({l, d, glm::dvec3(0.0)});
    }
}

DirectLight LightTransport::resolve(const SurfaceHit& hit, const Arrivals& arrivals) const
{
    DirectLight result;
    // Kept from call to call: allocations would cost more than the rays.
    thread_local std::vector<Ray> rays;
    thread_local std::vector<const Arrival*> traced;
    thread_local std::vector<float> through;
    rays.clear();
    traced.clear();
    for (const Arrival& a : arrivals) {
        result.diffuse += a.diffuse;
        result.specular += a.specular;
        if (_options.paths == ReferenceOptions::UNOCCLUDED) continue;
        // From below its own triangle nothing comes, whatever the interpolated normal says.
        if (glm::dot(a.direction, hit.facet) <= 0.0) {
            result.occlusion += a.diffuse;
            continue;
        }
        rays.push_back(RayScene::leave(hit, a.direction));
        traced.push_back(&a);
    }
    if (_options.paths == ReferenceOptions::UNOCCLUDED) {
        result.specularVisible = result.specular;
        return result;
    }
    through.resize(rays.size());
    _scene.transmittance(rays.data(), rays.size(), through.data());
    raysOfThread += rays.size();
    for (size_t i = 0; i < rays.size(); ++i) {
        const double t = double(through[i]);
        const glm::dvec3 kept = (1.0 - t) * traced[i]->diffuse;
        result.occlusion += kept;
        result.specularVisible += t * traced[i]->specular;
        if (!_classes || isBlack(kept)) continue;
        SurfaceHit blocker;
        ++raysOfThread;
        if (!_scene.nearest(rays[i], RayScene::ANY, 0, blocker)) continue;
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
    weight = (surface.diffuse() + surface.glossy(direction)) * (c * lobes / p);
    return true;
}

glm::dvec3 LightTransport::indirect(const SurfaceHit& hit, const Reflection& surface, std::uint64_t seed,
                                    RandomPoints& random) const
{
    thread_local Arrivals arrivals;
    glm::dvec3 sum(0.0);
    glm::dvec3 throughput(1.0);
    SurfaceHit at = hit;
    Reflection reflection = surface;
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
        sampleDirect(reflection, random, arrivals);
        if (_lights) addLights(reflection, arrivals);
        sum += throughput * (reflection.emission() + resolve(at, arrivals).visible());
    }
}

}  // namespace osgEnvLight
