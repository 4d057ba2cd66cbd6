// SPDX-License-Identifier: MIT
// Depth and normal buffers of planes, computed ray by ray and rounded as a GPU's 24-bit buffer is.
#pragma once

#include <functional>
#include <vector>

#include "glsl.h"

namespace testmaths
{

/** In eye space. `inside` tells which of its points there are; none: all. */
struct Plane {
    glsl::vec3 point;
    glsl::vec3 normal;
    std::function<bool(const glsl::vec3&)> inside = nullptr;
};

/** What a view sees of a few planes; the nearest in front of the eye counts. */
class PlaneView
{
  public:
    PlaneView(const glsl::mat4& p, int width, int height, const std::vector<Plane>& planes)
        : projection(p),
          inverse(glm::inverse(p)),
          size(width, height),
          _depth(size_t(4 * width * height), 1.0f),
          _normal(size_t(4 * width * height), 0.0f)
    {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) cast(x, y, planes);
    }

    glsl::sampler2D depthMap() const { return {_depth.data(), int(size.x), int(size.y)}; }
    glsl::sampler2D normalMap() const { return {_normal.data(), int(size.x), int(size.y)}; }

    double depth(int x, int y) const { return _depth[at(x, y)]; }
    bool hasSurface(int x, int y) const { return depth(x, y) < 1.0; }
    glsl::vec2 ndc(int x, int y) const { return (glsl::vec2(x, y) + 0.5) / size * 2.0 - 1.0; }
    glsl::vec3 eye(int x, int y) const { return glsl::eyeFromDepth(inverse, ndc(x, y), depth(x, y)); }
    double footprint(int x, int y) const { return glsl::pixelFootprint(inverse, ndc(x, y), depth(x, y), size); }

    /** As pass/occlusion.frag lifts the receiver. */
    double bias(int x, int y) const
    {
        const double quantum = glsl::eyeFromDepth(inverse, ndc(x, y), depth(x, y) - 1.2e-7).z - eye(x, y).z;
        return 0.1 * footprint(x, y) + std::abs(quantum);
    }

    const glsl::mat4 projection;
    const glsl::mat4 inverse;
    const glsl::vec2 size;

  private:
    size_t at(int x, int y) const { return size_t(4 * (y * int(size.x) + x)); }

    void cast(int x, int y, const std::vector<Plane>& planes)
    {
        // To depth 1/2 and beyond: the far plane may lie at infinity.
        const glsl::vec3 a = glsl::eyeFromDepth(inverse, ndc(x, y), 0.0);
        const glsl::vec3 b = glsl::eyeFromDepth(inverse, ndc(x, y), 0.5);
        float& nearest = _depth[at(x, y)];
        for (const Plane& plane : planes) {
            const double t = glsl::dot(plane.normal, plane.point - a) / glsl::dot(plane.normal, b - a);
            const glsl::vec3 hit = a + t * (b - a);
            if (!(t >= 0.0 && t < 1e30) || (plane.inside && !plane.inside(hit))) continue;
            const glsl::vec4 clip = projection * glsl::vec4(hit, 1.0);
            const float depth = float(std::round((0.5 * clip.z / clip.w + 0.5) * 16777215.0) / 16777215.0);
            if (depth >= nearest) continue;
            nearest = depth;
            for (int i = 0; i < 3; ++i) _normal[at(x, y) + size_t(i)] = float(0.5 * plane.normal[i] + 0.5);
        }
    }

    std::vector<float> _depth;
    std::vector<float> _normal;
};

}  // namespace testmaths
