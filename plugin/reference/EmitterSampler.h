// SPDX-License-Identifier: MIT
// Area lights as light transport meets and chooses them: nothing of the nodekit's own sampling is used.
#pragma once

#include <reference/RayScene>
#include <reference/TextureImage>

#include <glm/glm.hpp>

#include <vector>

namespace osgEnvLight
{

class EmitterSampler
{
  public:
    /** In the coordinates of all that follows. */
    explicit EmitterSampler(const std::vector<Emitter>& emitters);

    bool empty() const { return _lights.empty(); }

    /** Light from one point of a lit side, before visibility. */
    struct Arrival {
        int emitter = -1;
        glm::dvec3 direction{0, 0, 0};  // unit, to where it comes from
        double distance = 0.0;
        glm::dvec3 radiance{0, 0, 0};
        double density = 0.0;  // of sample() giving this point of this emitter, per solid angle

        /** Of a shadow ray, a little before the emitter: what an application draws in its place does not hide it. */
        RayEnd end() const { return {distance * (1.0 - 1e-4), emitter}; }
    };

    /** What a point of a surface sees of each emitter. */
    struct Outlook {
        struct Sight {
            double probability = 0.0;  // of sample() choosing it; 0: it does not light the point
            double solidAngle = 0.0;   // of a disc, about
        };
        glm::dvec3 point{0, 0, 0};
        std::vector<Sight> sights;
    };
    void look(const glm::dvec3& point, const glm::dvec3& normal, Outlook& outlook) const;

    /** From an emitter chosen about in proportion to the light without visibility, evenly over the solid angle where that is
     * known and of some size, else over the area; all numbers in [0,1). False if none lights the point. */
    bool sample(const Outlook& outlook, double choice, const glm::dvec2& u, Arrival& arrival) const;

    /** From every emitter along a direction, near and far. */
    void meet(const Outlook& outlook, const glm::dvec3& direction, std::vector<Arrival>& arrivals) const;

    /** By what a surface's emission is multiplied at a position: the colour of the emitter's image; 1 without one. */
    glm::dvec3 shown(int emitter, const glm::dvec3& position) const;

  private:
    struct Triangle {
        glm::dvec3 corners[3];  // relative to the light's centre
        glm::dvec2 inPlane[3];
        double area;
    };
    struct Light {
        AreaLight::Shape shape;
        glm::dvec3 center;
        glm::dmat3 frame;     // about the normal
        glm::dvec3 radiance;  // of an image's white
        double brightness;    // mean of the colours of the mean radiance
        double area;
        double radius;  // of a disc or sphere
        double extent;
        bool twoSided;
        std::shared_ptr<const TextureImage> picture;  // null: even
        glm::dvec3 halfAxes[2];                       // of the picture, to the right and up
        std::vector<Triangle> triangles;              // of a rectangle or polygon

        const glm::dvec3& normal() const { return frame[2]; }
        bool contains(const glm::dvec3& inPlane) const;
        bool lights(const glm::dvec3& point) const;
        glm::dvec3 shown(const glm::dvec3& inPlane) const;
    };
    static Light convert(const Emitter& emitter);
    static double solidAngle(const Light& light, const glm::dvec3& point);
    static bool byAngle(const Light& light, double solidAngle);
    static bool distanceTo(const Light& light, const glm::dvec3& point, const glm::dvec3& direction, double& distance);
    static glm::dvec3 sampleSphere(const Light& light, const glm::dvec3& point, const glm::dvec2& u);
    static glm::dvec3 sampleDisc(const Light& light, const glm::dvec3& point, const glm::dvec2& u);
    static glm::dvec3 sampleTriangles(const Light& light, const glm::dvec3& point, double solidAngle, double choice,
                                      const glm::dvec2& u);
    Arrival arrivalOf(size_t i, const Outlook& outlook, const glm::dvec3& direction, double distance) const;

    std::vector<Light> _lights;
};

}  // namespace osgEnvLight
