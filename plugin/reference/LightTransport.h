// SPDX-License-Identifier: MIT
// One point's light: direct, by the environment and the area lights, and along paths.
#pragma once

#include "EmitterSampler.h"
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
        : _scene(scene),
          _environment(environment),
          _emitters(scene.scene().emitters),
          _lights(lights),
          _options(options),
          _classes(classes)
    {
    }

    /** One sample of the light at a surface. */
    struct Start {
        const SurfaceHit* hit;
        const Reflection* surface;
        RandomPoints* random;
    };

    /** Rays to where light comes from, and what it brings before visibility. */
    struct Arrivals {
        struct Light {
            glm::dvec3 diffuse{0, 0, 0};
            glm::dvec3 specular{0, 0, 0};
        };
        std::vector<Ray> rays;
        std::vector<RayEnd> ends;
        std::vector<Light> lights;
        Light below;  // from below the surface's own triangle: whatever the interpolated normal says, nothing comes from there

        void clear();
    };

    /** Direct light, as arrivals whose sum is the estimate: the sum over all starts times the weight. */
    void sampleDirect(const std::vector<Start>& starts, double weight, Arrivals& arrivals) const;
    /** All of the light list. */
    void addLights(const SurfaceHit& hit, const Reflection& surface, double weight, Arrivals& arrivals) const;
    /** Their sum, with what the scene lets through. */
    DirectLight resolve(const Arrivals& arrivals) const;

    /** What a surface sends to the eye by itself. */
    glm::dvec3 emitted(const SurfaceHit& hit, const Reflection& surface) const
    {
        return surface.emission() * _emitters.shown(hit.mesh->emitter, hit.position);
    }

    /** What other surfaces send by one path from here on, to the eye. */
    glm::dvec3 indirect(const Start& start, std::uint64_t seed) const;

    /** Rays traced by this thread's transports since the last call. */
    static size_t takeRays();

  private:
    // What samples aim at: starts, one for each direction; and those that take a sample of each source of light.
    struct Aims {
        std::vector<const Start*> aimed, takers;
        std::vector<glm::dvec3> directions;
    };
    void addPointLights(const Start& start, double weight, Arrivals& arrivals) const;
    void addEmitters(const std::vector<Start>& starts, const Aims& aims, double weight, Arrivals& arrivals) const;
    void add(const Start& start, const Incident& in, const RayEnd& end, double weight, Arrivals& arrivals) const;
    static void add(const SurfaceHit& hit, const glm::dvec3& direction, const RayEnd& end, const Arrivals::Light& light,
                    Arrivals& arrivals);
    double density(const Reflection& surface, const Incident& in) const;
    bool continuePath(const Reflection& surface, RandomPoints& random, glm::dvec3& direction, glm::dvec3& weight) const;

    const RayScene& _scene;
    const Environment& _environment;
    const EmitterSampler _emitters;
    const LightList* _lights;
    const ReferenceOptions& _options;
    const BlockerClasses* _classes;
};

}  // namespace osgEnvLight
