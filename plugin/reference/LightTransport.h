// SPDX-License-Identifier: MIT
// One point's light: direct, by the environment, and along paths.
#pragma once

#include "RandomNumbers.h"
#include "Reflection.h"

#include <reference/Reference>

namespace osgEnvLight
{

/** What arrives at the eye from one surface, apart. */
struct DirectLight {
    glm::dvec3 diffuse{0, 0, 0};  // unoccluded
    glm::dvec3 occlusion{0, 0, 0};
    glm::dvec3 specular{0, 0, 0};  // unoccluded
    glm::dvec3 specularVisible{0, 0, 0};
    glm::dvec3 outside{0, 0, 0};
    glm::dvec3 hidden{0, 0, 0};
    glm::dvec3 far{0, 0, 0};

    glm::dvec3 visible() const { return diffuse - occlusion + specularVisible; }
};

/** Why a point that blocks light is not what the picture shows. */
class BlockerClasses
{
  public:
    enum Class { SEEN, OUTSIDE, HIDDEN, FAR };
    BlockerClasses(const RayScene& scene, const RayCamera& camera, double reach) : _scene(scene), _camera(camera), _reach(reach)
    {
    }
    Class of(const SurfaceHit& blocker) const;

  private:
    const RayScene& _scene;
    const RayCamera& _camera;
    double _reach;
};

class LightTransport
{
  public:
    LightTransport(const RayScene& scene, const Environment& environment, const LightList* lights,
                   const ReferenceOptions& options, const BlockerClasses* classes)
        : _scene(scene), _environment(environment), _lights(lights), _options(options), _classes(classes)
    {
    }

    /** A direction, and what it brings: diffuse and specular radiance, before visibility. */
    struct Arrival {
        glm::dvec3 direction;
        glm::dvec3 diffuse;
        glm::dvec3 specular;
    };
    using Arrivals = std::vector<Arrival>;

    /** One sample of direct light, as arrivals whose sum is the estimate. */
    void sampleDirect(const Reflection& surface, RandomPoints& random, Arrivals& arrivals) const;
    /** All of the light list. */
    void addLights(const Reflection& surface, Arrivals& arrivals) const;
    /** Their sum, with what the scene lets through. */
    DirectLight resolve(const SurfaceHit& hit, const Arrivals& arrivals) const;

    /** What other surfaces send by one path from here on, to the eye. */
    glm::dvec3 indirect(const SurfaceHit& hit, const Reflection& surface, std::uint64_t seed, RandomPoints& random) const;

    /** Rays traced by this thread's transports since the last call. */
    static size_t takeRays();

  private:
    void add(const Reflection& surface, const Incident& in, Arrivals& arrivals) const;
    void addFrom(const Reflection& surface, const glm::dvec3& l, Arrivals& arrivals) const;
    double density(const Reflection& surface, const Incident& in) const;
    bool continuePath(const Reflection& surface, RandomPoints& random, glm::dvec3& direction, glm::dvec3& weight) const;

    const RayScene& _scene;
    const Environment& _environment;
    const LightList* _lights;
    const ReferenceOptions& _options;
    const BlockerClasses* _classes;
};

}  // namespace osgEnvLight
