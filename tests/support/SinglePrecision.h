// SPDX-License-Identifier: MIT
// Functions of shaders/lib in single precision, as GPUs compute them: glsl.h has the same in double.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace testmaths::single
{

/** Compilers other than GCC take the text's constants as doubles: what is computed there is too precise to be judged. */
extern const bool isExact;

float rectangleFormFactor(const glm::vec3& center, const glm::vec3& u, const glm::vec3& v);
float polygonFormFactor(const glm::vec3& center, float squareRadius, const std::vector<glm::vec3>& vertices);
float discFormFactor(const glm::vec3& center, const glm::vec3& u, const glm::vec3& v);
float sphereFormFactor(const glm::vec3& center, float radius);
float ltcRectangle(const glm::vec4& inverse, const glm::vec3& center, const glm::vec3& u, const glm::vec3& v);

}  // namespace testmaths::single
