// SPDX-License-Identifier: MIT
// GCC compiles this with -fsingle-precision-constant.
#include "SinglePrecision.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-const-variable"
#pragma GCC diagnostic ignored "-Wconversion"
namespace
{

using namespace glm;
using glm::clamp;
using glm::max;
// For compilers that take constants as doubles.
inline float max(float a, double b)
{
    return glm::max(a, float(b));
}
inline float clamp(float x, double low, double high)
{
    return glm::clamp(x, float(low), float(high));
}
// Nothing here reads a texture.
struct sampler2D {
};
inline ivec2 textureSize(sampler2D, int)
{
    return ivec2(0);
}
inline vec4 textureLod(sampler2D, const vec2&, float)
{
    return vec4(0);
}
#include "lib/constants.glsl"
#include "lib/disc.glsl"
#include "lib/ltc.glsl"
#include "lib/polygon.glsl"
#include "lib/sun.glsl"

}  // namespace
#pragma GCC diagnostic pop

namespace testmaths::single
{

const bool isExact = sizeof(0.1) == sizeof(float);

float rectangleFormFactor(const glm::vec3& center, const glm::vec3& u, const glm::vec3& v)
{
    return ::rectangleFormFactor(center, u, v);
}

float polygonFormFactor(const glm::vec3& center, float squareRadius, const std::vector<glm::vec3>& vertices)
{
    PolygonSum sum = polygonSum(center, squareRadius);
    for (const glm::vec3& vertex : vertices) sum = withVertex(sum, vertex);
    return ::polygonFormFactor(sum);
}

float discFormFactor(const glm::vec3& center, const glm::vec3& u, const glm::vec3& v)
{
    return ::discFormFactor(center, u, v);
}

float sphereFormFactor(const glm::vec3& center, float radius)
{
    return ::sphereFormFactor(center, radius);
}

float ltcRectangle(const glm::vec4& inverse, const glm::vec3& center, const glm::vec3& u, const glm::vec3& v)
{
    return ::ltcRectangle({inverse, ltcLeak(inverse)}, center, u, v);
}

}  // namespace testmaths::single
