// SPDX-License-Identifier: MIT
// No light through closed walls, no shadow of a surface on itself, and scenes, cameras and maps at the extremes.
#include <metrics/Mask>

#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <gtest/gtest.h>

#include <limits>

#include "Maths.h"
#include "TestScenes.h"
#include "Traced.h"

namespace Robustness_test
{

using testmaths::pi;
using testmaths::Random;

namespace
{

const FunctionEnvironment bright([](const glm::dvec3&) { return 1e6; });
const FunctionEnvironment constantSky([](const glm::dvec3&) { return 1.0; });
const FunctionEnvironment tiltedSky([](const glm::dvec3& d) { return 1.0 + 0.5 * d.x + 0.3 * d.z; });

osg::ref_ptr<osg::Geode> makeMesh(osg::Vec3Array* vertices, osg::DrawElementsUInt* triangles)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(triangles);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    lambert(geode, 0.8);
    return geode;
}

// The box [-1,1]^3, each side a grid of its own between the given lines, which end at -1 and 1: sides share their edges'
// vertices by value.
osg::ref_ptr<osg::Geode> gridBox(const std::vector<double>& lines)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    const auto n = unsigned(lines.size());
    for (int axis = 0; axis < 3; ++axis)
        for (double side : {-1.0, 1.0}) {
            const auto base = unsigned(vertices->size());
            for (double b : lines)
                for (double a : lines) {
                    osg::Vec3d p;
                    p[axis] = side;
                    p[(axis + 1) % 3] = a;
                    p[(axis + 2) % 3] = b;
                    vertices->push_back(p);
                }
            for (unsigned j = 0; j + 1 < n; ++j)
                for (unsigned i = 0; i + 1 < n; ++i) {
                    const unsigned k = base + j * n + i;
                    for (unsigned v : {k, k + 1, k + n + 1, k, k + n + 1, k + n}) triangles->push_back(v);
                }
        }
    return makeMesh(vertices.get(), triangles.get());
}

std::vector<double> evenLines(int n)
{
    std::vector<double> lines;
    for (int i = 0; i <= n; ++i) lines.push_back(-1.0 + 2.0 * i / n);
    return lines;
}

osg::ref_ptr<osg::MatrixTransform> moved(osg::Node& node, const osg::Matrixd& matrix)
{
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
    transform->addChild(&node);
    return transform;
}

void expectBlackInside(osg::Node& box, const osg::Matrixd& matrix, unsigned seed, const std::string& what)
{
    const osg::ref_ptr<osg::Node> scene = moved(box, matrix);
    Random random(seed);
    for (int i = 0; i < 6; ++i) {
        const osg::Vec3d eye(random.uniform(-0.99, 0.99), random.uniform(-0.99, 0.99), random.uniform(-0.99, 0.99));
        const osg::Vec3d target(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const Traced view = perspectiveView(*scene, eye * matrix, target * matrix, 24, 120.0);
        ReferenceOptions options = makeOptions(ReferenceOptions::MIS, 8, 2, unsigned(i));
        options.paths = ReferenceOptions::FULL;
        const Picture p = view.render(bright, options).mean(Layer::BEAUTY);
        for (size_t k = 0; k < p.rgba.size(); ++k)
            ASSERT_EQ(k % 4 == 3 ? 1.0f : 0.0f, p.rgba[k]) << what << ", camera " << i << ", pixel " << k / 4;
    }
}

Picture visibilityOf(const Traced& view, const ReferenceOptions& options)
{
    return view.render(constantSky, options, {Layer::DIFFUSE, Layer::OCCLUSION}).visibility();
}

osg::ref_ptr<osg::Node> solids()
{
    return together({lambert(makeBox(osg::Vec3d(-2, -2, -0.5), osg::Vec3d(2, 2, 0)), 0.6),
                     lambert(makeBox(osg::Vec3d(-1, -0.5, 0), osg::Vec3d(0, 0.5, 1)), 0.5),
                     lambert(makeSphere(osg::Vec3d(0.9, 0, 0.7), 0.6, 32), 0.7)});
}

}  // namespace

TEST(ReferenceRobustness, NoLightLeaksIntoAClosedBox)
{
    const osg::Matrixd turned = osg::Matrixd::rotate(0.7, osg::Vec3d(1, 2, 3)) * osg::Matrixd::translate(5, -7, 11);
    std::vector<double> skinny = evenLines(1);
    skinny.insert(skinny.begin() + 1, -1.0 + 2e-5);  // 1 : 10^5
    skinny.insert(skinny.end() - 1, 1.0 - 2e-5);
    const std::vector<std::pair<std::string, osg::ref_ptr<osg::Geode>>> boxes = {
        {"two triangles a side", gridBox(evenLines(1))}, {"skinny triangles", gridBox(skinny)}, {"many", gridBox(evenLines(60))}};
    for (const auto& [name, box] : boxes) {
        expectBlackInside(*box, osg::Matrixd(), 1, name);
        expectBlackInside(*box, turned, 2, name + ", turned");
        expectBlackInside(*box, turned * osg::Matrixd::scale(1e-5, 1e-5, 1e-5), 3, name + ", small");
        expectBlackInside(*box, osg::Matrixd::scale(1e5, 1e5, 1e5) * turned, 4, name + ", large");
        expectBlackInside(*box, osg::Matrixd::scale(1.0, 1.0, 1e-3) * turned, 5, name + ", flat");
    }
}

TEST(ReferenceRobustness, NoSurfaceShadowsItself)
{
    // A plane sees all of the sky, however it is cut up and wherever it lies.
    for (int cells : {1, 3, 200})
        for (double offset : {0.0, 1e3}) {
            const osg::Matrixd matrix =
                osg::Matrixd::rotate(0.4, osg::Vec3d(1, 1, 0)) * osg::Matrixd::translate(offset, 0, offset);
            osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
            osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
            const auto n = unsigned(cells) + 1;
            for (unsigned k = 0; k < n * n; ++k)
                vertices->push_back(osg::Vec3d(2.0 * (k % n) / cells - 1.0, 2.0 * (k / n) / cells - 1.0, 0.0));
            for (unsigned k = 0; k + n < n * n; ++k)
                if (k % n + 1 < n)
                    for (unsigned v : {k, k + 1, k + n + 1, k, k + n + 1, k + n}) triangles->push_back(v);
            const osg::ref_ptr<osg::Node> scene = moved(*makeMesh(vertices.get(), triangles.get()), matrix);
            const Traced view = perspectiveView(*scene, osg::Vec3d(0.2, 0.1, 2) * matrix, osg::Vec3d() * matrix, 32, 30.0);
            // In a cut-up plane the corners' rounding tilts facets against each other: by 1e-7 over 1e-2, 1e-5; what lies below
            // that angle of a neighbour's horizon is 1e-10 of the sky's light.
            const Picture v = visibilityOf(view, makeOptions(ReferenceOptions::COSINE, 64, 1));
            for (size_t i = 0; i < v.rgba.size(); ++i) ASSERT_EQ(1.0f, v.rgba[i]) << cells << " cells at " << offset;
        }
    // Convex: nothing but the shading normal, which sees below its facet, takes light away. With the facets' own normals
    // nothing does.
    const osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(), 100.0, 512);
    lambert(sphere, 1.0);
    const Traced smooth = perspectiveView(*sphere, osg::Vec3d(300, 200, 100), osg::Vec3d(), 32);
    const Picture v = visibilityOf(smooth, makeOptions(ReferenceOptions::COSINE, 256, 1));
    double sum = 0.0, count = 0.0;
    for (size_t i = 0; i < v.pixels(); ++i)
        if (v.rgba[4 * i + 3] > 0.0f) {
            sum += double(v.rgba[4 * i]);
            ++count;
        }
    // At most half the angle between facets, pi / 512, tilts a normal: (1 - cos) / 2 = 1e-5 of the light comes from below.
    EXPECT_GT(count, 300.0);
    EXPECT_NEAR(sum / count, 1.0, 3e-5);
    sphere->getDrawable(0)->asGeometry()->setNormalArray(nullptr);
    const Traced faceted = perspectiveView(*sphere, osg::Vec3d(300, 200, 100), osg::Vec3d(), 32);
    const Picture f = visibilityOf(faceted, makeOptions(ReferenceOptions::COSINE, 256, 1));
    for (size_t i = 0; i < f.pixels(); ++i) ASSERT_EQ(1.0f, f.rgba[4 * i]) << "pixel " << i;
}

TEST(ReferenceRobustness, ScaleAndPlaceDoNotMatter)
{
    const osg::Vec3d eye(1, -5, 3), target(0, 0, 0.4);
    const auto picture = [&](const osg::Matrixd& m) {
        const osg::ref_ptr<osg::Node> scene = moved(*solids(), m);
        return perspectiveView(*scene, eye * m, target * m, 32)
            .render(tiltedSky, makeOptions(ReferenceOptions::COSINE, 32, 1))
            .mean(Layer::BEAUTY);
    };
    const Picture expected = picture(osg::Matrixd());
    // The rays are the same: single-precision corners decide differently at outlines only, about one ray in 10^5 here, each
    // 1/32 of a pixel of radiance about 1.
    for (double scale : {1e-6, 1e-3, 1e3, 1e6})
        EXPECT_LT(rootMeanSquare(expected, picture(osg::Matrixd::scale(scale, scale, scale))), 1e-3) << "scale " << scale;
    for (double offset : {1e3, 1e6})
        EXPECT_LT(rootMeanSquare(expected, picture(osg::Matrixd::translate(offset, -offset, offset))), 1e-3)
            << "offset " << offset;
    EXPECT_LT(rootMeanSquare(expected, picture(osg::Matrixd::scale(1e-3, 1e-3, 1e-3) * osg::Matrixd::translate(1e3, 1e3, 0))),
              1e-3);
}

TEST(ReferenceRobustness, DegenerateTrianglesAreLeftOutAndCounted)
{
    const auto nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& v : {osg::Vec3(-1, -1, 0), osg::Vec3(1, -1, 0), osg::Vec3(1, 1, 0), osg::Vec3(-1, 1, 0),
                               osg::Vec3(nan, 0, 0), osg::Vec3(0, inf, 0), osg::Vec3(0, -1, 0)})
        vertices->push_back(v);
    // What an index beyond the vertices reads, OSG's own bounding box among others, is not the triangles'.
    const size_t count = vertices->size();
    vertices->resize(100, osg::Vec3(1e38f, 1e38f, 1e38f));
    vertices->resize(count);
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    // A square; two on one spot; three in line; NaN; Inf; an index of no vertex.
    for (unsigned v : {0u, 1u, 2u, 0u, 2u, 3u, 0u, 0u, 1u, 0u, 6u, 1u, 0u, 1u, 4u, 0u, 1u, 5u, 0u, 1u, 77u})
        triangles->push_back(v);
    const osg::ref_ptr<osg::Geode> mesh = makeMesh(vertices.get(), triangles.get());
    const Traced view = perspectiveView(*mesh, osg::Vec3d(0.1, 0.2, 4), osg::Vec3d(), 16);
    EXPECT_EQ(2u, view.triangles().triangles);
    EXPECT_EQ(5u, view.triangles().degenerate);
    EXPECT_FLOAT_EQ(float(std::sqrt(2.0)), float(view.triangles().radius));
    const Picture p = view.render(constantSky, makeOptions(ReferenceOptions::COSINE, 16, 2)).mean(Layer::BEAUTY);
    EXPECT_TRUE(p.finite());
    EXPECT_FLOAT_EQ(0.8f, p.at(8, 8)[0]);
}

TEST(ReferenceRobustness, NothingAndOneTriangle)
{
    const osg::ref_ptr<osg::Group> nothing = new osg::Group;
    const Traced empty = perspectiveView(*nothing, osg::Vec3d(0, -4, 0), osg::Vec3d(), 16);
    EXPECT_EQ(0u, empty.triangles().triangles);
    for (const auto estimator : allEstimators) {
        ReferenceOptions options = makeOptions(estimator, 4, 2);
        options.paths = ReferenceOptions::FULL;
        options.antialias = true;
        const ReferenceResult result = empty.render(constantSky, options, {Layer::BACKGROUND, Layer::DEPTH, Layer::OCCLUSION});
        const Picture p = result.mean(Layer::BEAUTY);
        for (size_t i = 0; i < p.rgba.size(); ++i) ASSERT_EQ(i % 4 == 3 ? 0.0f : 1.0f, p.rgba[i]);
        EXPECT_EQ(0.0, result.relativeError(Layer::BEAUTY));
    }
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& v : {osg::Vec3(-1, 0, -1), osg::Vec3(1, 0, -1), osg::Vec3(0, 0, 1)}) vertices->push_back(v);
    osg::ref_ptr<osg::DrawElementsUInt> one = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (unsigned v : {0u, 1u, 2u}) one->push_back(v);
    const osg::ref_ptr<osg::Geode> triangle = makeMesh(vertices.get(), one.get());
    const Traced view = perspectiveView(*triangle, osg::Vec3d(0, -4, 0), osg::Vec3d(), 32, 40.0);
    const Picture p = view.render(constantSky, makeOptions(ReferenceOptions::COSINE, 8, 2)).mean(Layer::BEAUTY);
    double covered = 0.0;
    for (size_t i = 0; i < p.pixels(); ++i) {
        covered += double(p.rgba[4 * i + 3]);
        ASSERT_NEAR(p.rgba[4 * i + 3] > 0.0f ? 0.8f : 1.0f, p.rgba[4 * i], 1e-6f);
    }
    // Area 2 of the picture's (8 tan 20)^2; pixels at three outlines of 20 pixels each decide either way.
    const double side = 8.0 * std::tan(pi / 9.0);
    EXPECT_NEAR(covered, 1024.0 * 2.0 / (side * side), 0.5 * std::sqrt(60.0) * 4.0);
}

TEST(ReferenceRobustness, StrangeCameras)
{
    const osg::ref_ptr<osg::Node> scene = solids();
    const auto check = [](const Traced& view, const std::string& what) {
        ReferenceOptions options = makeOptions(ReferenceOptions::MIS, 8, 2);
        options.paths = ReferenceOptions::FULL;
        const ReferenceResult result = view.render(tiltedSky, options, {Layer::DEPTH, Layer::NORMAL});
        EXPECT_TRUE(result.mean(Layer::BEAUTY).finite()) << what;
        EXPECT_TRUE(result.mean(Layer::DEPTH).finite()) << what;
        return result.mean(Layer::BEAUTY);
    };
    // Inside the solid box, in the plane of its side, and at a corner of it.
    const Picture inside = check(perspectiveView(*scene, osg::Vec3d(0.1, 0.2, -0.25), osg::Vec3d(1, 1, -0.2), 24), "inside");
    for (size_t i = 0; i < inside.pixels(); ++i) ASSERT_EQ(0.0f, inside.rgba[4 * i]);
    check(perspectiveView(*scene, osg::Vec3d(0.5, -1.5, 0.0), osg::Vec3d(0, 0, 0.0), 24), "in the plane");
    check(perspectiveView(*scene, osg::Vec3d(-2, -2, 0), osg::Vec3d(0, 0, 0.3), 24), "at a corner");

    // Far away by as small an angle the picture is the same to the parallax, 1e-6.
    const osg::Vec3d direction(0.2, -0.9, 0.5), target(0, 0, 0.3);
    const double reach = 3.0;
    const auto from = [&](double distance) {
        const double fovy = 2.0 * std::atan(0.5 * 4.0 / distance) * 180.0 / pi;
        return perspectiveView(*scene, target + direction / direction.length() * distance, target, 32, fovy);
    };
    const Picture far = check(from(1e6 * reach), "far");
    const osg::Vec3d eye = target + direction / direction.length() * 10.0;
    const Picture parallel = check(parallelView(*scene, eye, -direction, 4.0, 32), "parallel");
    EXPECT_GT(osgEnvLight::Mask::geometry(far).pixels(), 500u);
    // But for the pixels at outlines whose centre falls on the other side: a handful of 1024.
    int different = 0;
    for (size_t i = 0; i < far.pixels(); ++i) different += std::abs(far.rgba[4 * i] - parallel.rgba[4 * i]) > 0.05f;
    EXPECT_LE(different, 5);

    // An off-axis window is a part of the whole picture.
    const osg::Matrixd view = osg::Matrixd::lookAt(osg::Vec3d(1, -5, 3), target, osg::Vec3d(0, 0, 1));
    const Traced whole(*scene, view, osg::Matrixd::frustum(-0.4, 0.4, -0.4, 0.4, 1, 100), 32, 32);
    const Traced part(*scene, view, osg::Matrixd::frustum(0.0, 0.4, -0.4, 0.0, 1, 100), 16, 16);
    const ReferenceOptions still = makeOptions(ReferenceOptions::COSINE, 1, 1);
    const Picture wholeDepth = whole.render(tiltedSky, still, {Layer::DEPTH}).mean(Layer::DEPTH);
    const Picture partDepth = part.render(tiltedSky, still, {Layer::DEPTH}).mean(Layer::DEPTH);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_NEAR(wholeDepth.at(x + 16, y)[0], partDepth.at(x, y)[0], 1e-5f) << x << " " << y;

    // One pixel.
    const Picture pixel = check(perspectiveView(*scene, osg::Vec3d(1, -5, 3), target, 1), "one pixel");
    EXPECT_EQ(1u, pixel.pixels());
    EXPECT_GT(pixel.rgba[0], 0.0f);
}

TEST(ReferenceRobustness, MirroredTransformsMirrorThePicture)
{
    const osg::Vec3d eye(1, -5, 3), target(0.1, 0, 0.4);
    const osg::Matrixd mirror = osg::Matrixd::scale(-1, 1, 1);
    const FunctionEnvironment sky([](const glm::dvec3& d) { return 1.0 + 0.5 * d.y + 0.3 * d.z; });
    const auto picture = [&](const osg::Matrixd& m) {
        const osg::ref_ptr<osg::Node> scene = moved(*solids(), m);
        return perspectiveView(*scene, eye * m, target * m, 32).render(sky, makeOptions(ReferenceOptions::MIS, 256, 2));
    };
    const Picture straight = picture(osg::Matrixd()).mean(Layer::BEAUTY);
    const Picture mirrored = picture(mirror).mean(Layer::BEAUTY);
    double square = 0.0;
    int outline = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double d = double(straight.at(x, y)[0] - mirrored.at(31 - x, y)[0]);
            outline += straight.at(x, y)[3] != mirrored.at(31 - x, y)[3];
            if (straight.at(x, y)[3] == mirrored.at(31 - x, y)[3]) square += d * d / 1024.0;
        }
    EXPECT_LE(outline, 4);
    // Other random numbers: 512 scrambled samples leave about 1 %.
    EXPECT_LT(std::sqrt(square), 0.02);
}

TEST(ReferenceRobustness, BlackMapAndOneBrightTexel)
{
    const auto environment = [](const osg::ref_ptr<osg::Image>& image) {
        const osg::ref_ptr<osgEnvLight::EnvironmentMap> map = new osgEnvLight::EnvironmentMap(image);
        std::string error;
        return osgEnvLight::MapEnvironment(*map->radiance(error), 0.0, 1.0);
    };
    const osg::ref_ptr<osg::Geode> quad = makeQuad(osg::Vec3d(-1, -1, 0), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0));
    lambert(quad, 1.0);
    const Traced view = parallelView(*quad, osg::Vec3d(0, 0, 1), osg::Vec3d(0, 0, -1), 1e-3, 32);
    const auto black = environment(constantMap(0.0));
    for (const auto estimator : allEstimators) {
        const Picture p = view.render(black, makeOptions(estimator, 16, 2)).mean(Layer::BEAUTY);
        for (size_t i = 0; i < p.rgba.size(); ++i) ASSERT_EQ(i % 4 == 3 ? 1.0f : 0.0f, p.rgba[i]);
    }
    // 21 stops above the rest, at 45 degrees' height: the truth by quadrature over the bilinear map.
    const int width = 128, height = 64, x0 = 40, y0 = 16;
    const osg::ref_ptr<osg::Image> image = constantMap(0.0);
    image->allocateImage(width, height, 1, GL_RGB, GL_FLOAT);
    auto* texels = reinterpret_cast<float*>(image->data());
    std::fill_n(texels, 3 * width * height, 1.0f);
    std::fill_n(texels + 3 * ((height - 1 - y0) * width + x0), 3, 2097152.0f);
    const auto spike = environment(image);
    double truth = 1.0;
    const int n = 400;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double row = y0 - 0.5 + 2.0 * (j + 0.5) / n, theta = pi * row / height;
            const double weight = (1.0 - std::abs(row - y0 - 0.5)) * (1.0 - std::abs(2.0 * (i + 0.5) / n - 1.0));
            const double cell = (2.0 / n * pi / height) * (2.0 / n * 2.0 * pi / width);
            truth += 2097151.0 * weight * std::sin(theta) * std::cos(theta) * cell / pi;
        }
    const ReferenceResult result = view.render(spike, makeOptions(ReferenceOptions::MIS, 64, 4));
    EXPECT_TRUE(result.mean(Layer::BEAUTY).finite());
    const Estimate e = estimateOf(result, Layer::BEAUTY);
    EXPECT_NEAR(e.value, truth, 4.0 * e.error + 1e-4 * truth);
    EXPECT_LT(e.error, 0.002 * truth);
}

}  // namespace Robustness_test
