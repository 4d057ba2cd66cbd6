// SPDX-License-Identifier: MIT
// Parity of polygon, disc and ltc: form factors, and shares of lobes. Bounds are shares of what a light of that size sends at
// most.
#include "surface/LtcTable.h"

#include "EmitterPoses.h"
#include "Parity.h"

namespace emitter_parity_test
{

using namespace parity;
using namespace testmaths;
using glsl::vec3;
using glsl::vec4;

namespace
{

// Centre, u and v in a, b and c; a.w is a roughness, b.w the cosine of a view.
std::vector<Row> rowsOf(unsigned seed, bool isDisc)
{
    Random random(seed);
    std::vector<Row> rows;
    for (int i = 0; i < 6000; ++i) {
        const double size = std::pow(10.0, random.uniform(-5.0, 0.3));
        ExactLight l = randomLight(random, size);
        if (i % 3 == 0) l.center.z = random.uniform(-size, size);
        if (isDisc) l.v *= size / glsl::length(l.v);
        if (std::abs(glsl::dot(l.center, glsl::normalize(glsl::cross(l.u, l.v)))) < 1e-3) continue;
        rows.push_back({toFloat(l.center, random.uniform(0.03, 1.0)), toFloat(l.u, random.uniform(0.05, 1.0)), toFloat(l.v)});
    }
    return rows;
}

ExactLight lightOf(const std::vector<vec4>& in)
{
    return {vec3(in[0]), vec3(in[1]), vec3(in[2])};
}

double largest(const std::vector<vec4>& in)
{
    const double square = std::max(glsl::dot(vec3(in[1]), vec3(in[1])), glsl::dot(vec3(in[2]), vec3(in[2])));
    return square / (square + glsl::dot(vec3(in[0]), vec3(in[0])));
}

Tolerance ofLargest(double share)
{
    return [share](const std::vector<vec4>& in, double) { return share * largest(in); };
}

double polygon(const ExactLight& l)
{
    glsl::PolygonSum sum = glsl::polygonSum(l.center, glsl::dot(l.u, l.u) + glsl::dot(l.v, l.v));
    for (const vec3& p : {vec3(0), l.v, -l.u, -l.v, l.u}) sum = glsl::withVertex(sum, p);
    return glsl::polygonFormFactor(sum);
}

}  // namespace

TEST(parity, rectangle)
{
    expectParity(
        {"lib/polygon.glsl"},
        "result = vec4(rectangleFormFactor(a.xyz, b.xyz, c.xyz), 0.0, 0.0, 0.0);\n"
        "PolygonSum s = polygonSum(a.xyz, dot(b.xyz, b.xyz) + dot(c.xyz, c.xyz));\n"
        "for (int i = 0; i < 5; ++i)\n"
        "    s = withVertex(s, i == 0 ? vec3(0.0) : i == 1 ? c.xyz : i == 2 ? -b.xyz : i == 3 ? -c.xyz : b.xyz);\n"
        "result.y = polygonFormFactor(s);",
        rowsOf(1, false),
        [](auto& in) {
            const ExactLight l = lightOf(in);
            return vec4(glsl::rectangleFormFactor(l.center, l.u, l.v), polygon(l), 0, 0);
        },
        ofLargest(3e-5));
}

TEST(parity, disc)
{
    expectParity(
        {"lib/disc.glsl"},
        "result = vec4(discFormFactor(a.xyz, b.xyz, c.xyz), sphereFormFactor(a.xyz, length(b.xyz)), 0.0, 0.0);", rowsOf(2, true),
        [](auto& in) {
            const ExactLight l = lightOf(in);
            return vec4(glsl::discFormFactor(l.center, l.u, l.v), glsl::sphereFormFactor(l.center, glsl::length(l.u)), 0, 0);
        },
        ofLargest(2e-4));
}

TEST(parity, ltc)
{
    const osg::ref_ptr<osg::Image> image = osgEnvLight::ltcTableImage();
    const float* texels = reinterpret_cast<const float*>(image->data());
    const GlContext::Texture table = {"table", image->s(), image->t(), {texels, texels + 4 * image->s() * image->t()}, true};
    const glsl::sampler2D sampler = {texels, image->s(), image->t()};
    // Filters of textures know 1/256 of a texel. By that a narrow lobe changes little: its table is flat.
    expectParity({"lib/ltc.glsl"},
                 "Ltc lobe = ltcOf(table, a.w, b.w);\n"
                 "result = vec4(ltcRectangle(lobe, a.xyz, b.xyz, c.xyz), ltcDisc(lobe, a.xyz, b.xyz, c.xyz),\n"
                 "              ltcSphere(lobe, a.xyz, length(b.xyz)), lobe.leak);",
                 rowsOf(3, true),
                 [&](auto& in) {
                     const ExactLight l = lightOf(in);
                     const glsl::Ltc lobe = glsl::ltcOf(sampler, in[0].w, in[1].w);
                     return vec4(glsl::ltcRectangle(lobe, l.center, l.u, l.v), glsl::ltcDisc(lobe, l.center, l.u, l.v),
                                 glsl::ltcSphere(lobe, l.center, glsl::length(l.u)), lobe.leak);
                 },
                 within(1e-3, 1e-3), {table});
}

}  // namespace emitter_parity_test
