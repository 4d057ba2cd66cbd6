// SPDX-License-Identifier: MIT
// One function of shaders/lib on the GPU in float against the same text in C++ in double, on the same float inputs.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "GlContext.h"
#include "Maths.h"

namespace parity
{

using Row = std::vector<glm::vec4>;  // one value of each input
using Function = std::function<glsl::vec4(const std::vector<glsl::vec4>&)>;
/** Largest difference allowed for these inputs and this exact value. */
using Tolerance = std::function<double(const std::vector<glsl::vec4>&, double)>;

/** relative |exact| + absolute */
Tolerance within(double relative, double absolute = 0.0);

/** Runs `body` (see GlContext::evaluate) over the rows and compares all four components with `exact`; reports the worst
 * point. What is not finite in double must not be asked.*/
void expectParity(const std::vector<std::string>& files, const std::string& body, const std::vector<Row>& rows,
                  const Function& exact, const Tolerance& tolerance, const std::vector<GlContext::Texture>& textures = {});

/** The context that all tests of the program share. Throws if there is none. */
GlContext& context();

/** A float of every kind that matters, for sweeps. */
glm::vec4 toFloat(const glsl::vec4& v);
inline glm::vec4 toFloat(const glsl::vec3& v, double w = 0.0)
{
    return toFloat(glsl::vec4(v, w));
}

/** Random directions, the axes, directions near the poles, the seam and the horizon. */
std::vector<glsl::vec3> directions(int count, unsigned seed);

}  // namespace parity
