// SPDX-License-Identifier: MIT
// How a surface point reflects: the values of lib's BRDFs, and ways of our own to sample them.
#pragma once

#include <reference/RayScene>

namespace osgEnvLight
{

/** A surface point as the surface shader reads it, seen from a ray's origin. */
class Reflection
{
  public:
    /** @param ray        that met the surface
     * @param colour      surfaceColor() there */
    Reflection(const SurfaceHit& hit, const Ray& ray, const glm::dvec4& color);

    const glm::dvec3& albedo() const { return _albedo; }  // of the diffuse layer, before the lobe's share is taken off
    const glm::dvec3& emission() const { return _emission; }
    const glm::dvec3& normal() const { return _normal; }

    /** BRDF values per solid angle, for light from the unit direction l; 0 where it comes from behind the shading normal. */
    glm::dvec3 diffuse(const glm::dvec3& l) const;
    glm::dvec3 glossy(const glm::dvec3& l) const;
    double cosine(const glm::dvec3& l) const { return glm::max(glm::dot(_normal, l), 0.0); }

    bool hasDiffuse() const { return _diffuse.r > 0.0 || _diffuse.g > 0.0 || _diffuse.b > 0.0; }
    /** A lobe with width. */
    bool hasLobe() const { return _base.wide || _coat.wide; }
    /** A lobe without: it reflects mirrorWeight() of the radiance from mirrorDirection(). */
    bool isMirror() const { return _mirror; }
    const glm::dvec3& mirrorDirection() const { return _reflected; }
    const glm::dvec3& mirrorWeight() const { return _mirrorWeight; }

    /** Random directions. sampleCosine: by the cosine about the normal. sampleHemisphere: evenly. sampleLobe: by the lobe; if
     * there are two, by each half the time. Lobes about the mirror direction are sampled by cos^n, microfacets by normals of
     * GGX's distribution [Walter 2007, eq. 35], whose tails are the longest. A lobe's direction may point below the surface; it
     * is null where the viewer can't see the normal.*/
    glm::dvec3 sampleCosine(const glm::dvec2& u) const;
    glm::dvec3 sampleHemisphere(const glm::dvec2& u) const;
    glm::dvec3 sampleLobe(const glm::dvec2& u) const;
    double cosineDensity(const glm::dvec3& l) const;
    double hemisphereDensity(const glm::dvec3& l) const;
    double lobeDensity(const glm::dvec3& l) const;

  private:
    /** A lobe of microfacets or about the mirror direction. */
    struct Lobe {
        int brdf = 0;  // Material::Brdf
        glm::dvec3 f0{0, 0, 0};
        glm::dvec3 edgeLoss{0, 0, 0};
        glm::dvec3 energy{1, 1, 1};
        double roughness = 1.0;
        double anisotropy = 0.0;
        bool wide = false;  // not a mirror's
    };
    glm::dvec3 value(const Lobe& lobe, const glm::dvec3& toLight) const;
    glm::dvec3 sample(const Lobe& lobe, const glm::dvec2& u) const;
    double density(const Lobe& lobe, const glm::dvec3& l) const;
    void setView(const glm::dvec3& direction);
    void setBrushing(const SurfaceHit& hit);
    void setParameters(const SurfaceMaterial& m, const glm::dvec3& base);
    void setLobes(const SurfaceMaterial& m);
    void addMirror(const Lobe& lobe);
    glm::dvec3 local(const glm::dvec3& l) const { return l * _frame; }

    glm::dvec3 _normal;
    glm::dmat3 _frame;  // about the normal
    // Towards the ray's origin, in the frame, and its mirror image in the world: for lobes only.
    glm::dvec3 _view{0, 0, 1};
    glm::dvec3 _reflected{0, 0, 1};
    glm::dvec3 _albedo{0, 0, 0};
    glm::dvec3 _diffuse{0, 0, 0};
    glm::dvec3 _emission{0, 0, 0};
    glm::dvec3 _mirrorWeight{0, 0, 0};
    glm::dvec3 _body{1, 1, 1};  // share of light that the lobe leaves to the diffuse layer
    double _diffuseRoughness = 0.0;
    Lobe _base;
    Lobe _coat;
    bool _mirror = false;
};

}  // namespace osgEnvLight
