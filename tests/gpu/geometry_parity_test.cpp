// SPDX-License-Identifier: MIT
// Parity of latlong, octahedral, frame, depth, bilateral, sequence, sh, tone, fresnel. A bound is a few float roundings
// (6e-8) and what the driver's sin, cos, atan, exp, log, pow lose; measured on Mesa's llvmpipe, doubled.
#include "Parity.h"
#include "Projections.h"

namespace geometry_parity_test
{

using namespace parity;
using glsl::mat4;
using glsl::vec2;
using glsl::vec3;
using glsl::vec4;
using testmaths::Random;

namespace
{

std::vector<Row> rowsOf(const std::vector<vec3>& directions)
{
    std::vector<Row> rows;
    for (const vec3& d : directions) rows.push_back({toFloat(d)});
    return rows;
}

std::vector<Row> squareRows(int count, unsigned seed)
{
    Random random(seed);
    std::vector<Row> rows;
    for (double x : {0.0, 0.25, 0.5, 0.75, 1.0})
        for (double y : {0.0, 0.25, 0.5, 0.75, 1.0}) rows.push_back({toFloat(vec3(x, y, 0))});
    while (int(rows.size()) < count) rows.push_back({toFloat(vec3(random.square(), 0.0))});
    return rows;
}

std::vector<Row> colourRows()
{
    Random random(51);
    std::vector<Row> rows;
    for (double x : {0.0, 1e-6, 0.0031308, 0.04045, 0.08, 0.76, 0.8, 1.0, 10.0, 1e6}) rows.push_back({toFloat(vec3(x))});
    while (rows.size() < 2000)
        rows.push_back({toFloat(
            vec3(std::exp(random.uniform(-10, 8)), std::exp(random.uniform(-10, 8)), std::exp(random.uniform(-10, 8))))});
    return rows;
}

// The columns of an inverse projection in a, b, c, d; ndc and depth in e.
std::vector<Row> viewRows(unsigned seed, double deepest = 0.999)
{
    using testmaths::frustum;
    using testmaths::orthographic;
    Random random(seed);
    std::vector<Row> rows;
    for (const mat4& p : {frustum(-0.4, 0.4, -0.3, 0.3, 1.0, 100.0), frustum(-0.1, 0.7, -0.5, 0.1, 1.0, 100.0),
                          frustum(-0.04, 0.04, -0.03, 0.03, 0.1, 1000.0), orthographic(-4, 4, -3, 3, 1, 100)}) {
        const mat4 inverse = glm::inverse(p);
        for (int i = 0; i < 500; ++i)
            rows.push_back({toFloat(inverse[0]), toFloat(inverse[1]), toFloat(inverse[2]), toFloat(inverse[3]),
                            toFloat(vec4(2.0 * random.square() - 1.0, random.uniform(0.0, deepest), 0.0))});
    }
    return rows;
}

mat4 matrixOf(const std::vector<vec4>& in)
{
    return mat4(in[0], in[1], in[2], in[3]);
}

}  // namespace

TEST(parity, latlongFromDirection)
{
    // Beside the seam u may come out at either end of [0,1].
    expectParity(
        {"lib/latlong.glsl"}, "vec2 uv = latlongFromDirection(a.xyz); result = vec4(abs(uv.x - 0.5), uv.y, 0.0, 0.0);",
        rowsOf(directions(4000, 52)),
        [](auto& in) {
            const vec2 uv = glsl::latlongFromDirection(vec3(in[0]));
            return vec4(std::abs(uv.x - 0.5), uv.y, 0, 0);
        },
        within(0.0, 1.5e-6));
}

TEST(parity, directionFromLatlong)
{
    expectParity(
        {"lib/latlong.glsl"}, "result = vec4(directionFromLatlong(a.xy), 0.0);", squareRows(4000, 53),
        [](auto& in) { return vec4(glsl::directionFromLatlong(vec2(in[0])), 0); }, within(0.0, 1e-6));
}

TEST(parity, latlongTexelSolidAngle)
{
    std::vector<Row> rows;
    for (double height : {1.0, 2.0, 512.0, 8192.0})
        for (double y : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0})
            rows.push_back({toFloat(vec3(std::floor(y * (height - 1)), 2 * height, height))});
    expectParity(
        {"lib/latlong.glsl"}, "result = vec4(latlongTexelSolidAngle(a.x, a.yz), 0.0, 0.0, 0.0);", rows,
        [](auto& in) { return vec4(glsl::latlongTexelSolidAngle(in[0].x, vec2(in[0].y, in[0].z)), 0, 0, 0); }, within(2e-6));
}

TEST(parity, octahedralFromDirection)
{
    expectParity(
        {"lib/octahedral.glsl"}, "result = vec4(octahedralFromDirection(a.xyz), 0.0, 0.0);", rowsOf(directions(4000, 54)),
        [](auto& in) { return vec4(glsl::octahedralFromDirection(vec3(in[0])), 0, 0); }, within(0.0, 3e-7));
}

TEST(parity, directionFromOctahedral)
{
    expectParity(
        {"lib/octahedral.glsl"}, "result = vec4(directionFromOctahedral(a.xy), octahedralSolidAngleDensity(a.xy));",
        squareRows(4000, 55),
        [](auto& in) { return vec4(glsl::directionFromOctahedral(vec2(in[0])), glsl::octahedralSolidAngleDensity(vec2(in[0]))); },
        within(1e-6, 5e-7));
}

TEST(parity, pyramidLevels)
{
    std::vector<Row> rows;
    for (double side = 4.0; side <= 1024.0; side *= 2.0)
        for (double level = 0.0; level <= std::log2(side / 4.0); ++level) rows.push_back({toFloat(vec3(side, level, 0))});
    // Powers of two, whole numbers: exp2 must be exact enough to leave them
    expectParity(
        {"lib/octahedral.glsl"}, "result = vec4(pyramidLevelCorner(a.x, a.y), pyramidLevelSide(a.x, a.y), 0.0);", rows,
        [](auto& in) { return vec4(glsl::pyramidLevelCorner(in[0].x, in[0].y), glsl::pyramidLevelSide(in[0].x, in[0].y), 0); },
        within(2e-7));
}

TEST(parity, pyramidLookup)
{
    // A whole atlas of side 32, of noise.
    Random random(56);
    GlContext::Texture atlas{"atlas", 32 + 2 + 16 + 2, 32 + 2 + 6, {}, true};
    for (int i = 0; i < 4 * atlas.width * atlas.height; ++i) atlas.texels.push_back(float(random.uniform()));
    std::vector<Row> rows;
    for (const vec3& d : directions(4000, 57)) rows.push_back({toFloat(d, random.uniform(-1.0, 5.0))});
    const glsl::sampler2D map{atlas.texels.data(), atlas.width, atlas.height};
    // The filter's weights have 8 bits or more by OpenGL's promise: 1/512 a side, two axes, texels differ by up to 1.
    const Tolerance tolerance = within(0.0, 2.0 / 512.0);
    expectParity({"lib/octahedral.glsl"}, "result = vec4(pyramidLookup(atlas, 32.0, 3.0, a.xyz, a.w), 0.0);", rows,
                 [&](auto& in) { return vec4(glsl::pyramidLookup(map, 32.0, 3.0, vec3(in[0]), in[0].w), 0); }, tolerance,
                 {atlas});
    expectParity({"lib/octahedral.glsl"}, "result = vec4(pyramidLevel(atlas, 32.0, a.xyz, 2.0), 0.0);", rows,
                 [&](auto& in) { return vec4(glsl::pyramidLevel(map, 32.0, vec3(in[0]), 2.0), 0); }, tolerance, {atlas});
}

TEST(parity, frameAround)
{
    for (int column = 0; column < 3; ++column)
        expectParity(
            {"lib/frame.glsl"}, "result = vec4(frameAround(a.xyz)[" + std::to_string(column) + "], 0.0);",
            rowsOf(directions(4000, 58)), [column](auto& in) { return vec4(glsl::frameAround(vec3(in[0]))[column], 0); },
            within(0.0, 3e-7));
}

TEST(parity, fresnelSchlick)
{
    Random random(59);
    std::vector<Row> rows;
    for (int i = 0; i < 1000; ++i)
        rows.push_back({toFloat(vec4(random.uniform(), random.uniform(), 0.04, random.uniform(-0.01, 1.01)))});
    expectParity(
        {"lib/fresnel.glsl"}, "result = vec4(fresnelSchlick(a.xyz, a.w), 0.0);", rows,
        [](auto& in) { return vec4(glsl::fresnelSchlick(vec3(in[0]), in[0].w), 0); }, within(5e-7));
}

TEST(parity, bsdfLobe)
{
    for (const int brdf : {BRDF_PHONG, BRDF_COOK_TORRANCE, BRDF_BLINN_PHONG, BRDF_BECKMANN, BRDF_STRAUSS}) {
        const std::string made = "makeBsdf(" + std::to_string(brdf) + ", vec3(0.9, 0.5, 0.04), 0.5, vec2(0.7, 0.1))";
        expectParity(
            {"lib/bsdf.glsl"}, "result = vec4(bsdfLobe(" + made + ", normalize(vec3(0.3, -0.2, 0.8)), a.xyz), 0.0);",
            rowsOf(directions(1000, 61)),
            [brdf](auto& in) {
                const glsl::Bsdf b = glsl::makeBsdf(brdf, vec3(0.9, 0.5, 0.04), 0.5, glsl::vec2(0.7, 0.1));
                return vec4(glsl::bsdfLobe(b, glm::normalize(vec3(0.3, -0.2, 0.8)), vec3(in[0])), 0);
            },
            // exp of -30 log1p, and halves of nearly opposite directions; arc cosines are good to 7e-5 only
            within(brdf == BRDF_STRAUSS ? 3e-4 : 2e-5, 1e-6));
    }
}

TEST(parity, shBasis18)
{
    for (int i = 0; i < 18; ++i)
        expectParity(
            {"lib/sh.glsl"}, "result = vec4(shBasis18(" + std::to_string(i) + ", a.xyz));", rowsOf(directions(1000, 60)),
            [i](auto& in) { return vec4(glsl::shBasis18(i, vec3(in[0]))); }, within(0.0, 2e-6));  // terms of up to 3.7 cancel
}

TEST(parity, shIrradiance)
{
    Random random(61);
    std::vector<Row> rows;
    for (const vec3& d : directions(1000, 62)) rows.push_back({toFloat(d), toFloat(random.direction())});
    expectParity(
        {"lib/sh.glsl"},
        "vec3 c[18]; for (int i = 0; i < 18; ++i) c[i] = vec3(1.0, 0.5, 2.0) * shBasis18(i, b.xyz);\n"
        "result = vec4(shIrradiance(c, a.xyz), 0.0);",
        rows,
        [](auto& in) {
            std::vector<vec3> c;
            for (int i = 0; i < 18; ++i) c.push_back(vec3(1.0, 0.5, 2.0) * glsl::shBasis18(i, vec3(in[1])));
            return vec4(glsl::shIrradiance(c.data(), vec3(in[0])), 0);
        },
        within(1e-6, 5e-6));  // 18 products of up to 3
}

TEST(parity, tone)
{
    expectParity(
        {"lib/tone.glsl"}, "result = vec4(toneReinhard(a.xyz), 0.0);", colourRows(),
        [](auto& in) { return vec4(glsl::toneReinhard(vec3(in[0])), 0); }, within(1e-6));
    // 1 - .0576 / (peak + ..) and the mix towards white cancel: absolute, on values below 1
    expectParity(
        {"lib/tone.glsl"}, "result = vec4(toneNeutral(a.xyz), 0.0);", colourRows(),
        [](auto& in) { return vec4(glsl::toneNeutral(vec3(in[0])), 0); }, within(0.0, 1e-6));
    // pow: a relative error of log2 times up to 20
    expectParity(
        {"lib/tone.glsl"}, "result = vec4(srgbEncode3(a.xyz), srgbEncode(a.x));", colourRows(),
        [](auto& in) { return vec4(glsl::srgbEncode3(vec3(in[0])), glsl::srgbEncode(in[0].x)); }, within(5e-6));
    expectParity(
        {"lib/tone.glsl"}, "result = vec4(srgbDecode3(a.xyz), srgbDecode(a.x));", colourRows(),
        [](auto& in) { return vec4(glsl::srgbDecode3(vec3(in[0])), glsl::srgbDecode(in[0].x)); }, within(1e-5));
    expectParity(
        {"lib/tone.glsl"}, "result = vec4(typedDecode3(a.xyz), typedEncode(a.x));", colourRows(),
        [](auto& in) { return vec4(glsl::typedDecode3(vec3(in[0])), glsl::typedEncode(in[0].x)); }, within(1e-5));
}

TEST(parity, sequence)
{
    Random random(63);
    std::vector<Row> rows;
    for (double high : {0.0, 1.0, 255.0, 65535.0})
        for (double low : {0.0, 1.0, 32768.0, 65535.0}) rows.push_back({toFloat(vec3(high, low, 1000))});
    while (rows.size() < 2000)
        rows.push_back({toFloat(vec3(std::floor(random.uniform(0, 65536)), std::floor(random.uniform(0, 65536)),
                                     1.0 + std::floor(random.uniform(0, 1e6))))});
    auto index = [](const vec4& v) { return glsl::uint(v.x) * 65536u + glsl::uint(v.y); };
    // Bits: exact
    expectParity(
        {"lib/sequence.glsl"},
        "result = vec4(radicalInverse(uint(a.x) * 65536u + uint(a.y)), float(bayer4(int(a.x), int(a.y))), 0.0, 0.0);", rows,
        [&](auto& in) { return vec4(glsl::radicalInverse(index(in[0])), glsl::bayer4(int(in[0].x), int(in[0].y)), 0, 0); },
        within(0.0));
    expectParity(
        {"lib/sequence.glsl"},
        "uint n = uint(a.z); result = vec4(hammersley((uint(a.x) * 65536u + uint(a.y)) % n, n), 0.0, 0.0);", rows,
        [&](auto& in) {
            const glsl::uint n = glsl::uint(in[0].z);
            return vec4(glsl::hammersley(index(in[0]) % n, n), 0, 0);
        },
        within(0.0, 2e-7));
}

TEST(parity, sliceMarks)
{
    // Odd multiples of 2^-13 and phases of 2^-5: exact in float, and no position meets a sample.
    Random random(70);
    auto position = [&] { return (std::floor(random.uniform(-2048, 6144)) + 0.5) / 4096.0; };
    std::vector<Row> rows;
    while (rows.size() < 4000) {
        const double a = position();
        const double b = position();
        rows.push_back({toFloat(vec3(a, b, (std::floor(random.uniform(0, 16)) + 0.5) / 16.0))});
    }
    expectParity(
        {"lib/slices.glsl"},
        "uint bits = sliceMarks(a.x, a.y, a.z); result = vec4(float(bits >> 16u), float(bits & 0xffffu), 0.0, 0.0);", rows,
        [](auto& in) {
            const glsl::uint bits = glsl::sliceMarks(in[0].x, in[0].y, in[0].z);
            return vec4(bits >> 16u, bits & 0xffffu, 0, 0);
        },
        within(0.0));
}

TEST(parity, HammersleyStaysBelowOneInFloat)
{
    // What a double would not show: rounding up to 1.
    std::vector<Row> rows;
    for (double n : {1.0, 3.0, 1024.0, 65536.0, 1048576.0, 16777216.0}) rows.push_back({toFloat(vec3(n - 1.0, n, 0))});
    std::vector<std::vector<glm::vec4>> columns(1);
    for (const Row& row : rows) columns[0].push_back(row[0]);
    for (const glm::vec4& p :
         context().evaluate({"lib/sequence.glsl"},
                            "result = vec4(hammersley(uint(a.x), uint(a.y)), radicalInverse(0xffffffffu), 0.0);", columns))
        EXPECT_LT(p.z, 1.0f);
    // The specular pass takes up to 1024 samples a pixel.
    const std::vector<glm::vec4> points =
        context().evaluate({"lib/sequence.glsl"}, "result = vec4(hammersley(uint(a.x), uint(a.y)), 0.0, 0.0);", columns);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_LT(points[i].x, 1.0f) << i;
        EXPECT_LT(points[i].y, 1.0f) << i;
    }
}

TEST(parity, eyeFromDepth)
{
    // w = 1/z is a difference of numbers of order 1/near: the relative error grows as z / near.
    auto tolerance = [](const std::vector<vec4>& in, double exact) {
        const vec4 q = matrixOf(in) * vec4(in[4].x, in[4].y, 2.0 * in[4].z - 1.0, 1.0);
        return (5e-7 + 2e-7 * (std::abs(in[2].w) + std::abs(in[3].w)) / std::abs(q.w)) * std::abs(exact) +
               2e-6 * glsl::length(vec3(q)) / std::abs(q.w);
    };
    expectParity(
        {"lib/depth.glsl"}, "result = vec4(eyeFromDepth(mat4(a, b, c, d), e.xy, e.z), 0.0);", viewRows(64),
        [](auto& in) { return vec4(glsl::eyeFromDepth(matrixOf(in), vec2(in[4]), in[4].z), 0); }, tolerance);
}

TEST(parity, viewRay)
{
    expectParity(
        {"lib/depth.glsl"}, "result = vec4(viewRay(mat4(a, b, c, d), e.xy), 0.0);", viewRows(65),
        [](auto& in) { return vec4(glsl::viewRay(matrixOf(in), vec2(in[4])), 0); }, within(0.0, 1e-6));
}

TEST(parity, viewRayAt)
{
    expectParity(
        {"lib/depth.glsl"}, "result = vec4(viewRayAt(mat4(a, b, c, d), vec3(5.0 * e.xy, -1.0 - 50.0 * e.z)), 0.0);", viewRows(69),
        [](auto& in) { return vec4(glsl::viewRayAt(matrixOf(in), vec3(5.0 * vec2(in[4]), -1.0 - 50.0 * in[4].z)), 0); },
        within(0.0, 5e-7));
}

TEST(parity, viewRayOfADeepView)
{
    // near : far = 1 : 1e8, where float can't tell the far plane from infinity
    const mat4 inverse = glm::inverse(testmaths::frustum(-0.4, 0.4, -0.3, 0.3, 1.0, 1e8));
    Random random(66);
    std::vector<Row> rows;
    for (int i = 0; i < 200; ++i)
        rows.push_back({toFloat(inverse[0]), toFloat(inverse[1]), toFloat(inverse[2]), toFloat(inverse[3]),
                        toFloat(vec3(2.0 * random.square() - 1.0, 0.0))});
    expectParity(
        {"lib/depth.glsl"}, "result = vec4(viewRay(mat4(a, b, c, d), e.xy), 0.0);", rows,
        [](auto& in) { return vec4(glsl::normalize(vec3(0.4 * in[4].x, 0.3 * in[4].y, -1.0)), 0); }, within(0.0, 1e-6));
}

TEST(parity, pixelFootprint)
{
    // The difference of two neighbouring points: their rounding (see eyeFromDepth) over a pixel of 1/540.
    auto tolerance = [](const std::vector<vec4>& in, double exact) {
        const vec4 q = matrixOf(in) * vec4(in[4].x, in[4].y, 2.0 * in[4].z - 1.0, 1.0);
        return 1e-6 * (std::abs(in[2].w) + std::abs(in[3].w)) / std::abs(q.w) * exact +
               2e-7 * glsl::length(vec3(q)) / std::abs(q.w);
    };
    expectParity(
        {"lib/depth.glsl"}, "result = vec4(pixelFootprint(mat4(a, b, c, d), e.xy, e.z, vec2(960.0, 540.0)), 0.0, 0.0, 0.0);",
        viewRows(67),
        [](auto& in) { return vec4(glsl::pixelFootprint(matrixOf(in), vec2(in[4]), in[4].z, vec2(960, 540)), 0, 0, 0); },
        tolerance);
}

TEST(parity, depthSlope)
{
    // Multiples of 1/64: float knows them, and which side goes on more evenly.
    Random random(71);
    std::vector<Row> rows;
    const auto depth = [&] { return std::floor(random.uniform(0.0, 65.0)) / 64.0; };
    for (int i = 0; i < 1000; ++i)
        rows.push_back({toFloat(vec3(depth(), depth(), depth()), depth()), toFloat(vec3(depth(), 0.0, 0.0))});
    expectParity(
        {"lib/depth.glsl"}, "result = vec4(depthSlope(a.x, a.y, a.z, a.w, b.x), 0.0, 0.0);", rows,
        [](auto& in) { return vec4(glsl::depthSlope(in[0].x, in[0].y, in[0].z, in[0].w, in[1].x), 0, 0); }, within(0.0, 0.0));
}

TEST(parity, bilateral)
{
    Random random(68);
    std::vector<Row> rows;
    for (int i = 0; i < 2000; ++i) {
        const vec3 n = random.direction();
        const vec3 nq = glsl::normalize(n + 0.3 * random.direction());
        rows.push_back({toFloat(n), toFloat(nq, random.uniform(-1.5, 1.5))});
    }
    // exp of up to -2, cos to the 32nd: 40 roundings, on weights of at most 1
    expectParity(
        {"lib/bilateral.glsl"}, "result = vec4(surfaceWeight(b.w, dot(a.xyz, b.xyz)), cellWeight(2, 4), cellWeight(-4, 4), 0.0);",
        rows, [](auto& in) { return vec4(glsl::surfaceWeight(in[1].w, glsl::dot(vec3(in[0]), vec3(in[1]))), 1.0, 0.5, 0); },
        within(5e-6, 2e-6));
}

}  // namespace geometry_parity_test
