// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <HeadlessContext.h>

#include "glsl.h"

/** OpenGL for a test, without a screen: runs fragment shaders over float targets. One at a time, in one thread. */
class GlContext
{
  public:
    /** A texture of RGBA floats, row 0 at the bottom, clamped to its edge. */
    struct Texture {
        std::string name;  // of its sampler
        int width;
        int height;
        std::vector<float> texels;
        bool linear = false;
    };

    /** Throws std::runtime_error that says what is missing. */
    GlContext();

    std::string renderer() const { return _context.renderer(); }

    /** Compile and link. Empty, or the driver's log. */
    std::string link(const std::string& vertex, const std::string& fragment) const;

    /** Draw over width x height pixels of RGBA 32F and read them back, row 0 first. Throws with the driver's log. */
    std::vector<float> render(const std::string& fragment, int width, int height, const std::vector<Texture>& textures) const;

    /** `body`, GLSL that assigns `vec4 result` from vec4 `a`, `b`, ..., run once for each row of inputs: column k of row i
     * is the i-th value of the k-th letter. `files` of shaders/ are included in front; textures serve the body too.*/
    std::vector<glm::vec4> evaluate(const std::vector<std::string>& files, const std::string& body,
                                    const std::vector<std::vector<glm::vec4>>& inputs,
                                    const std::vector<Texture>& textures = {}) const;

  private:
    HeadlessContext _context;
};
