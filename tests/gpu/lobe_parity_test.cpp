// SPDX-License-Identifier: MIT
// Parity of ggx, phong and visibility. Where a lobe is narrow its value moves by 1/alpha of its argument's rounding, and
// the bound says so.
#include "Parity.h"
#include "Projections.h"

namespace lobe_parity_test
{

using namespace parity;
using glsl::vec2;
using glsl::vec3;
using glsl::vec4;
using testmaths::Random;

namespace
{

const double smallestAlpha = 1e-4;

double alphaOf(Random& random)
{
    return std::pow(10.0, random.uniform(-4.0, 0.0));
}

// v and alpha in a, a half vector about the normal in b, l in c
std::vector<Row> lobeRows(unsigned seed)
{
    Random random(seed);
    std::vector<Row> rows;
    for (int i = 0; i < 4000; ++i) {
        const double alpha = i % 10 ? alphaOf(random) : (i % 20 ? 1.0 : smallestAlpha);
        const double mu = i % 7 ? random.uniform(0.01, 1.0) : 1e-4;
        const vec3 v = glsl::normalize(vec3(std::sqrt(1.0 - mu * mu), 0.0, mu));
        const vec3 h = testmaths::fromSlope(alpha * std::exp(random.uniform(-3, 3)), random.uniform(0, 2 * testmaths::pi));
        rows.push_back({toFloat(v, alpha), toFloat(h), toFloat(random.upper())});
    }
    return rows;
}

glsl::Bsdf ggx(double alpha)
{
    return glsl::makeBsdf(BRDF_COOK_TORRANCE, vec3(1), std::sqrt(alpha), vec2(1, 0));
}

vec3 xyz(const vec4& v)
{
    return vec3(v);
}

}  // namespace

TEST(parity, ggxScalars)
{
    const std::vector<Row> rows = lobeRows(71);
    expectParity(
        {"lib/ggx.glsl"}, "result = vec4(ggxD(b.xyz, a.w), 0.0, 0.0, 0.0);", rows,
        [](auto& in) { return vec4(glsl::ggxD(xyz(in[1]), in[0].w), 0, 0, 0); }, within(2e-6));
    expectParity(
        {"lib/ggx.glsl"}, "result = vec4(ggxRoot(a.z, a.w), ggxG2OverG1(a.z, c.z, a.w), ggxVisibility(a.z, c.z, a.w), 0.0);",
        rows,
        [](auto& in) {
            return vec4(glsl::ggxRoot(in[0].z, in[0].w), glsl::ggxG2OverG1(in[0].z, in[2].z, in[0].w),
                        glsl::ggxVisibility(in[0].z, in[2].z, in[0].w), 0);
        },
        within(2e-6));
    expectParity(
        {"lib/ggx.glsl"}, "result = vec4(ggxReflectionPdf(a.xyz, b.xyz, a.w), 0.0, 0.0, 0.0);", rows,
        [](auto& in) { return vec4(glsl::ggxReflectionPdf(xyz(in[0]), xyz(in[1]), in[0].w), 0, 0, 0); }, within(2e-6));
}

TEST(parity, ggxBrdf)
{
    // h = normalize(v + l) is off by a rounding, 1e-7, of a distribution of width alpha; D's slope is at most 4 D / alpha.
    auto tolerance = [](const std::vector<vec4>& in, double exact) { return (3e-6 + 1e-6 / in[0].w) * exact; };
    expectParity(
        {"lib/ggx.glsl"},
        "vec3 l = 2.0 * dot(a.xyz, b.xyz) * b.xyz - a.xyz; result = vec4(ggxBrdf(a.xyz, c.xyz, a.w), 0.0, 0.0, 0.0);",
        lobeRows(72), [](auto& in) { return vec4(glsl::ggxBrdf(xyz(in[0]), xyz(in[2]), in[0].w), 0, 0, 0); }, tolerance);
}

// Both alphas apart: that of the row along x, its root along y.
TEST(parity, ggxAnisotropic)
{
    const std::vector<Row> rows = lobeRows(73);
    const auto alphas = [](double alpha) { return vec2(alpha, std::sqrt(alpha)); };
    expectParity(
        {"lib/ggx.glsl"}, "vec2 t = vec2(a.w, sqrt(a.w)); result = vec4(ggxD(b.xyz, t), ggxRoot(a.xyz, t), 0.0, 0.0);", rows,
        [&](auto& in) { return vec4(glsl::ggxD(xyz(in[1]), alphas(in[0].w)), glsl::ggxRoot(xyz(in[0]), alphas(in[0].w)), 0, 0); },
        within(4e-6));
    expectParity(
        {"lib/ggx.glsl"}, "result = vec4(ggxReflectionPdf(a.xyz, b.xyz, vec2(a.w, sqrt(a.w))), 0.0, 0.0, 0.0);", rows,
        [&](auto& in) { return vec4(glsl::ggxReflectionPdf(xyz(in[0]), xyz(in[1]), alphas(in[0].w)), 0, 0, 0); }, within(4e-6));
}

TEST(parity, ggxVisibleNormalSample)
{
    Random random(73);
    std::vector<Row> rows;
    for (int i = 0; i < 4000; ++i) {
        const double mu = i % 7 ? random.uniform(0.01, 1.0) : 1e-4;
        const vec2 u = i % 11 ? random.square() : vec2(random.uniform(), i % 2 ? 0.0 : 0.9999999);
        rows.push_back({toFloat(vec3(std::sqrt(1.0 - mu * mu), 0.0, mu), alphaOf(random)), toFloat(vec3(u, 0.0))});
    }
    // Opposite to w the point of the cap and w cancel: their rounding, stretched by alpha, over the length that is left.
    auto tolerance = [](const std::vector<vec4>& in, double) {
        const double alpha = in[0].w;
        const vec3 w = glsl::normalize(vec3(alpha * in[0].x, alpha * in[0].y, in[0].z));
        const double height = (1.0 - in[1].y) * (1.0 + w.z) - w.z;
        const double s = std::sqrt(std::max(0.0, 1.0 - height * height));
        const double phi = 2.0 * testmaths::pi * in[1].x;
        const vec3 h = vec3(s * std::cos(phi), s * std::sin(phi), height) + w;
        return 1e-6 + 3e-7 * alpha / glsl::length(vec3(alpha * h.x, alpha * h.y, h.z));
    };
    expectParity(
        {"lib/ggx.glsl"}, "result = vec4(ggxVisibleNormalSample(a.xyz, a.w, b.xy), 0.0);", rows,
        [](auto& in) { return vec4(glsl::ggxVisibleNormalSample(xyz(in[0]), in[0].w, vec2(in[1])), 0); }, tolerance);
}

TEST(parity, phong)
{
    Random random(74);
    std::vector<Row> rows;
    for (int i = 0; i < 4000; ++i) {
        const double n = i % 20 ? std::pow(10.0, random.uniform(-2.0, 7.0)) : 0.0;
        const vec3 r = random.direction();
        const vec3 l = i % 3 ? glsl::normalize(r + std::sqrt(2.0 / (n + 2.0)) * random.uniform(0.0, 2.0) * random.direction())
                             : random.direction();
        rows.push_back({toFloat(r, n), toFloat(l)});
    }
    // From x = 1 - cos = .01 on, log(1 - x) rounds by 6e-8, which n multiplies: 6e-8 n e^(-.01 n) <= 2.2e-6 of the peak;
    // exp and log themselves as much again.
    expectParity(
        {"lib/phong.glsl"}, "result = vec4(phongPower(a.xyz, b.xyz, a.w));", rows,
        [](auto& in) { return vec4(glsl::phongPower(xyz(in[0]), xyz(in[1]), in[0].w)); }, within(1e-6, 4e-6));
    auto tolerance = [](const std::vector<vec4>& in, double exact) {
        return 1e-6 * exact + 4e-6 * (in[0].w + 2.0) / (2.0 * testmaths::pi);
    };
    expectParity(
        {"lib/phong.glsl"}, "result = vec4(phongBrdf(a.xyz, b.xyz, a.w), phongPdf(a.xyz, b.xyz, a.w), 0.0, 0.0);", rows,
        [](auto& in) {
            return vec4(glsl::phongBrdf(xyz(in[0]), xyz(in[1]), in[0].w), glsl::phongPdf(xyz(in[0]), xyz(in[1]), in[0].w), 0, 0);
        },
        tolerance);
}

TEST(parity, phongSample)
{
    Random random(75);
    std::vector<Row> rows;
    for (int i = 0; i < 4000; ++i) {
        const double n = i % 20 ? std::pow(10.0, random.uniform(-2.0, 7.0)) : 0.0;
        const vec2 u = i % 11 ? random.square() : vec2(random.uniform(), i % 2 ? 0.0 : 0.9999999);
        rows.push_back({toFloat(vec3(u, n))});
    }
    expectParity(
        {"lib/phong.glsl"}, "result = vec4(phongSample(a.z, a.xy), 0.0);", rows,
        [](auto& in) { return vec4(glsl::phongSample(in[0].z, vec2(in[0])), 0); }, within(0.0, 3e-6));
}

TEST(parity, phongRoughness)
{
    std::vector<Row> rows;
    for (double n : {0.0, 1e-3, 1.0, 20.0, 128.0, 1e4, 1e6})
        rows.push_back({toFloat(vec3(n, std::pow(2.0 / (n + 2.0), 0.25), 0))});
    // 2/r^4 - 2 cancels as r goes to 1: relative to n + 2, four roundings of r times 4
    expectParity(
        {"lib/phong.glsl"}, "result = vec4(phongRoughness(a.x), phongExponent(a.y), 0.0, 0.0);", rows,
        [](auto& in) { return vec4(glsl::phongRoughness(in[0].x), glsl::phongExponent(in[0].y), 0, 0); },
        [](const std::vector<vec4>& in, double) { return 1e-6 * (in[0].x + 2.0); });
}

TEST(parity, phongAlbedo)
{
    std::vector<Row> rows;
    for (double n : {0.0, 1.0, 20.0, 128.0, 1e4, 1e6})
        for (double c : {-0.1, 0.0, 0.01, 0.3, 0.9, 1.0}) rows.push_back({toFloat(vec3(n, c, 0))});
    // What errorFunction() says of its own error, and roundings of the cosine.
    expectParity(
        {"lib/phong.glsl"}, "result = vec4(phongAlbedo(a.x, a.y));", rows,
        [](auto& in) { return vec4(glsl::phongAlbedo(in[0].x, in[0].y)); },
        [](const std::vector<vec4>&, double) { return 2e-6; });
}

TEST(parity, rayMarch)
{
    // A floor and a wall in a 64 x 64 depth buffer; the same rays on both sides. A ray whose point falls on the border of
    // a texel or of the thickness may go either way: less than 1 in 200 of them.
    const glsl::mat4 projection = testmaths::frustum(-0.4, 0.4, -0.4, 0.4, 1.0, 50.0);
    const glsl::mat4 inverse = glm::inverse(projection);
    GlContext::Texture depth{"depthMap", 64, 64, std::vector<float>(4 * 64 * 64)};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const vec2 ndc = (vec2(x, y) + 0.5) / 32.0 - 1.0;
            const double z = ndc.x > 0.2 ? -1.0 / (0.4 * ndc.x) : -10.0;  // the wall x = 1, the floor z = -10
            const vec4 clip = projection * vec4(0, 0, std::max(z, -10.0), 1);
            depth.texels[size_t(4 * (64 * y + x))] = float(0.5 * clip.z / clip.w + 0.5);
        }
    Random random(76);
    std::vector<std::vector<glm::vec4>> columns(2);
    for (int i = 0; i < 4000; ++i) {
        columns[0].push_back(toFloat(vec3(random.uniform(-3.0, 0.9), random.uniform(-2.0, 2.0), -10.0), random.uniform()));
        columns[1].push_back(toFloat(random.upper()));
    }
    std::string matrices;
    for (const auto& [name, m] : {std::pair("projection", projection), std::pair("inverseProjection", inverse)}) {
        matrices += std::string("m.") + name + " = mat4(";
        for (int i = 0; i < 16; ++i) matrices += (i ? ", " : "") + std::to_string(m[i / 4][i % 4]);
        matrices += ");\n";
    }
    const std::string march = "RayMarch m;\n" + matrices +
                              "m.size = vec2(64.0); m.radius = 4.0; m.thickness = 1.5; m.steps = 16;\n"
                              "m = rayMarchFrom(m, a.xyz, vec3(0.0, 0.0, 1.0), 0.02);\n";
    const std::vector<glm::vec4> gpu = context().evaluate(
        {"lib/visibility.glsl"}, march + "result = vec4(rayBlocked(depthMap, m, b.xyz, a.w), 0.0, 0.0, 0.0);", columns, {depth});
    const std::vector<glm::vec4> clip = context().evaluate({"lib/visibility.glsl"}, march + "result = m.clip;", columns, {depth});
    const std::vector<glm::vec4> plane =
        context().evaluate({"lib/visibility.glsl"}, march + "result = m.plane;", columns, {depth});
    glsl::RayMarch m;
    m.projection = projection;
    m.inverseProjection = inverse;
    m.size = vec2(64.0);
    m.radius = 4.0;
    m.thickness = 1.5;
    m.steps = 16;
    int blocked = 0;
    int different = 0;
    for (size_t i = 0; i < gpu.size(); ++i) {
        const glsl::RayMarch r = glsl::rayMarchFrom(m, vec3(vec4(columns[0][i])), vec3(0, 0, 1), 0.02);
        const double exact =
            glsl::rayBlocked({depth.texels.data(), 64, 64}, r, vec3(vec4(columns[1][i])), double(columns[0][i].w));
        blocked += exact > 0.5;
        different += std::abs(exact - double(gpu[i].x)) > 0.5;
        for (int c = 0; c < 4; ++c) {
            EXPECT_NEAR(clip[i][c], r.clip[c], 2e-5);  // of order 10, matrices of 6 decimals
            EXPECT_NEAR(plane[i][c], r.plane[c], 2e-5);
        }
    }
    EXPECT_GT(blocked, 500);
    EXPECT_LT(blocked, 3500);
    EXPECT_LE(different, 20) << "of " << gpu.size();
}

TEST(parity, sun)
{
    Random random(77);
    std::vector<Row> rows;
    for (int i = 0; i < 4000; ++i) {
        const double radius = std::pow(10.0, random.uniform(-3.0, -1.0));
        const double alpha = std::pow(10.0, random.uniform(-2.0, 0.0));
        const double mu = random.uniform(0.05, 1.0);
        const vec3 v(-std::sqrt(1.0 - mu * mu), 0.0, mu);
        const vec3 mirror(-v.x, 0.0, v.z);
        vec3 s = glsl::normalize(mirror + random.direction() * (alpha + radius) * random.uniform(0.0, 2.0));
        if (s.z < 0.02) s = vec3(0, 0, 1);
        rows.push_back({toFloat(v, alpha), toFloat(s, radius)});
    }
    // The cosine's rounding, 1e-7, where the disc sets and its irradiance is cut off: of sin s cosine.
    expectParity(
        {"lib/sun.glsl"}, "result = vec4(discIrradianceOverPi(b.z, b.w), discShare(b.z, b.w), 0.0, 0.0);", rows,
        [](auto& in) { return vec4(glsl::discIrradianceOverPi(in[1].z, in[1].w), glsl::discShare(in[1].z, in[1].w), 0, 0); },
        [](const std::vector<vec4>& in, double exact) { return 3e-6 * exact + 1e-6 * in[1].w; });
    // Slopes are good to 1e-7, which the lobe's width and the ellipse's short axis (radius times the cosine) divide:
    // specular.md 3 found up to 9e-4.
    expectParity(
        {"lib/glint.glsl"},
        "Bsdf lobe = makeBsdf(BRDF_COOK_TORRANCE, vec3(1.0), sqrt(a.w), vec2(1.0, 0.0));\n"
        "result = vec4(microfacetDisc(lobe, b.xyz, a.xyz, b.w), 0.0, 0.0, 0.0);",
        rows, [](auto& in) { return vec4(glsl::microfacetDisc(ggx(in[0].w), xyz(in[1]), xyz(in[0]), in[1].w), 0, 0, 0); },
        [](const std::vector<vec4>& in, double exact) {
            const double peak = std::min(in[1].w * in[1].w / (in[0].w * in[0].w), 1.0) / in[0].z;
            return 1e-3 * exact + (1e-5 + 1e-7 / (in[1].w * in[0].z)) * peak;
        });
    expectParity(
        {"lib/glint.glsl"}, "result = vec4(phongDisc(vec3(-a.x, 0.0, a.z), b.xyz, 2.0 / (a.w * a.w), b.w), 0.0, 0.0, 0.0);", rows,
        [](auto& in) {
            return vec4(glsl::phongDisc(vec3(-in[0].x, 0.0, in[0].z), xyz(in[1]), 2.0 / (in[0].w * in[0].w), in[1].w), 0, 0, 0);
        },
        [](const std::vector<vec4>& in, double exact) {
            return 1e-4 * exact + 1e-5 * std::min(in[1].w * in[1].w, in[0].w * in[0].w);
        });
}

}  // namespace lobe_parity_test
