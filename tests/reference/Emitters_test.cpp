// SPDX-License-Identifier: MIT
// Area lights before the reference, against closed forms (systems.md 1.7).
#include <Halves.h>

#include <osg/BlendFunc>

#include "Lamps.h"
#include "Maths.h"
#include "Oracles.h"

namespace Emitters_test
{

using testmaths::pi;
namespace oracle = testmaths::oracle;

namespace
{

// All estimators, all ways of light: nothing is in the way, and one surface sends nothing to itself.
void expectLit(const osg::ref_ptr<AreaLight>& light, double truth, const std::string& what)
{
    const osg::ref_ptr<osg::Group> scene = together({whiteFloor(), light});
    const Traced view = originOf(*scene);
    for (const auto estimator : allEstimators) {
        const bool blind = estimator != ReferenceOptions::MIS;
        if (blind && truth < 1e-3) continue;  // none of the directions meets it
        for (const auto paths : {ReferenceOptions::UNOCCLUDED, ReferenceOptions::DIRECT, ReferenceOptions::FULL}) {
            const std::string which = what + ", " + nameOf(estimator) + ", paths " + std::to_string(paths);
            const ReferenceResult result = view.render(night, options(estimator, paths), allTerms);
            const Estimate e = estimateOf(result, Layer::BEAUTY);
            EXPECT_EQ(64, e.pixels) << which;
            expectNear(e, truth, which);
            expectNear(estimateOf(result, Layer::DIFFUSE), truth, which);
            EXPECT_EQ(0.0, estimateOf(result, Layer::OCCLUSION).value) << which;
            EXPECT_LT(e.error, (blind ? 0.15 : 0.005) * truth) << which;
        }
    }
}

double directLight(osg::Node& scene)
{
    return estimateOf(originOf(scene).render(night, options(ReferenceOptions::MIS)), Layer::BEAUTY).value;
}

// What is seen of a lamp at height 1 from that height.
Picture seen(osg::Node& scene, double from)
{
    return parallelView(scene, osg::Vec3d(0, 0, from), osg::Vec3d(0, 0, 1.0 - from), 1e-2, 4)
        .render(night, options(ReferenceOptions::MIS, ReferenceOptions::FULL, 1))
        .mean(Layer::BEAUTY);
}

}  // namespace

TEST(ReferenceEmitters, APlaneUnderARectangle)
{
    expectLit(rectangle(osg::Vec3d(0, 0, 1), 2, 1), oracle::centredRectangle(2, 1, 1), "above");
    expectLit(rectangle(osg::Vec3d(1.5, 0.5, 0.5), 3, 1), oracle::rectangleCorner(3, 1, 0.5), "above a corner");
    expectLit(rectangle(osg::Vec3d(0, 0, 1e-2), 2, 2), oracle::centredRectangle(2, 2, 1e-2), "close");
    expectLit(rectangle(osg::Vec3d(0, 0, 300), 2, 1), oracle::centredRectangle(2, 1, 300), "far");
    const osg::ref_ptr<AreaLight> wall = lamp(1.0);
    wall->setRectangle(osg::Vec3d(1, 0, 0), osg::Vec3d(0, 0.7, 0), osg::Vec3d(0, 0, -1.5));
    expectLit(wall, oracle::verticalRectangle(1, 0.7, 1.5), "across the horizon");
}

// Of a screen whose halves are red and blue each half is a light.
TEST(ReferenceEmitters, APlaneUnderAPicture)
{
    const osg::ref_ptr<AreaLight> light = rectangle(osg::Vec3d(0.5, 0, 1), 3, 1);
    light->setImage(makeHalves());
    const osg::ref_ptr<osg::Group> scene = together({whiteFloor(), light});
    const Picture picture =
        originOf(*scene).render(night, options(ReferenceOptions::MIS, ReferenceOptions::DIRECT, 16384)).mean(Layer::BEAUTY);
    osg::Vec3d mean;
    for (int i = 0; i < 64; ++i) mean += picture.color(i % 8, i / 8) / 64.0;
    const auto strip = [](double from, double to) {  // x from and to, by parts that end above the origin
        const auto part = [](double x) { return 2.0 * oracle::rectangleCorner(std::abs(x), 0.5, 1) * (x < 0.0 ? -1.0 : 1.0); };
        return part(to) - part(from);
    };
    // Of a million samples a third meets the smaller half: 3.5 times the deviation of their number.
    EXPECT_NEAR(strip(-1.0, 0.5), mean[0], 5e-3 * mean[0]);
    EXPECT_EQ(0.0, mean[1]);
    EXPECT_NEAR(strip(0.5, 2.0), mean[2], 5e-3 * mean[2]);
}

TEST(ReferenceEmitters, APlaneUnderADisc)
{
    expectLit(disc(osg::Vec3d(0, 0, 1), 0.5), oracle::coaxialDisk(0.5, 1), "above");
    expectLit(disc(osg::Vec3d(0, 0, 0.1), 1.0), oracle::coaxialDisk(1, 0.1), "close");
    expectLit(disc(osg::Vec3d(0, 0, 50), 0.5), oracle::coaxialDisk(0.5, 50), "far");
}

TEST(ReferenceEmitters, APlaneUnderASphere)
{
    const auto at = [](double radius, double distance, double zenith) {
        const osg::Vec3d center(distance * std::sin(zenith), 0, distance * std::cos(zenith));
        expectLit(sphere(center, radius), oracle::sphere(std::asin(radius / distance), zenith),
                  std::to_string(radius) + " at " + std::to_string(zenith));
    };
    at(0.5, 1.0, 0.0);
    at(0.5, 1.0, 0.9);
    at(0.5, 1.0, 1.4);  // across the horizon
    at(0.5, 1.0, 1.9);
    at(0.95, 1.0, 0.3);
    at(0.01, 1.0, 0.5);
}

TEST(ReferenceEmitters, APlaneUnderAPolygon)
{
    // An L above its corner, clockwise seen from above.
    const double h = 0.8;
    const float z = 0.8f;
    const double letter = oracle::rectangleCorner(2, 1, h) + oracle::rectangleCorner(1, 2, h) - oracle::rectangleCorner(1, 1, h);
    expectLit(polygon({{0, 0, z}, {0, 2, z}, {1, 2, z}, {1, 1, z}, {2, 1, z}, {2, 0, z}}), letter, "concave");
    // A square, and all of the plane but a hole: the hole is joined to the rim.
    const double frame = oracle::centredRectangle(4, 4, 1) - oracle::centredRectangle(2, 2, 1);
    expectLit(polygon({{-2, -2, 1},
                       {-2, 2, 1},
                       {2, 2, 1},
                       {2, -2, 1},
                       {-2, -2, 1},
                       {-1, -1, 1},
                       {1, -1, 1},
                       {1, 1, 1},
                       {-1, 1, 1},
                       {-1, -1, 1}}),
              frame, "with a hole");
    // Two shapes of one parallelogram.
    const osg::ref_ptr<AreaLight> sheared = lamp(1.0);
    sheared->setRectangle(osg::Vec3d(0.5, 0, 1), osg::Vec3d(1, 0.5, 0), osg::Vec3d(0.25, -1, 0.5));
    const osg::ref_ptr<AreaLight> same =
        polygon({{-0.75f, 0.5f, 0.5f}, {1.25f, 1.5f, 0.5f}, {1.75f, -0.5f, 1.5f}, {-0.25f, -1.5f, 1.5f}});
    const osg::ref_ptr<osg::Group> a = together({whiteFloor(), sheared}), b = together({whiteFloor(), same});
    for (const auto estimator : allEstimators)
        expectSame(estimateOf(originOf(*a).render(night, options(estimator)), Layer::BEAUTY),
                   estimateOf(originOf(*b).render(night, options(estimator)), Layer::BEAUTY), nameOf(estimator));
}

TEST(ReferenceEmitters, ALampThatWasMovedIsWhereItIsSeen)
{
    const double truth = oracle::centredRectangle(2, 1, 1);
    // Both ways of turning a lamp over: by a rotation and in a mirror.
    const osg::ref_ptr<AreaLight> up = lamp(1.0);
    up->setRectangle(osg::Vec3d(0, 0, 0.5), osg::Vec3d(0.5, 0, 0), osg::Vec3d(0, 0.25, 0));
    for (const osg::Matrixd& m :
         {osg::Matrixd::scale(2, 2, 2) * osg::Matrixd::rotate(pi, osg::Vec3d(1, 0, 0)), osg::Matrixd::scale(2, 2, -2)}) {
        const auto scene = together({whiteFloor(), moved(m * osg::Matrixd::translate(0, 0, 2), up)});
        for (const auto estimator : allEstimators)
            expectNear(estimateOf(originOf(*scene).render(night, options(estimator)), Layer::BEAUTY), truth, nameOf(estimator));
        EXPECT_EQ(1.0f, seen(*scene, 0.5).at(1, 1)[0]);
        EXPECT_EQ(0.0f, seen(*scene, 1.5).at(1, 1)[0]);
    }
    // Far from the world's origin.
    const osg::Matrixd away = osg::Matrixd::translate(1e5, -3e5, 1e4);
    const auto scene = moved(away, together({whiteFloor(), rectangle(osg::Vec3d(0, 0, 1), 2, 1)}));
    const Traced view = parallelView(*scene, osg::Vec3d(0, 0, 1e-3) * away, osg::Vec3d(0, 0, -1), 1e-4, 8);
    expectNear(estimateOf(view.render(night, options(ReferenceOptions::MIS)), Layer::BEAUTY), truth, "far out");
}

TEST(ReferenceEmitters, WhatStandsBetweenHidesThem)
{
    const auto lights = {rectangle(osg::Vec3d(0, 0, 1), 2, 1), disc(osg::Vec3d(0, 0, 1), 0.5), sphere(osg::Vec3d(0, 0, 1), 0.4)};
    for (const auto& light : lights)
        for (const auto estimator : allEstimators) {
            const auto cover = [](double z) {
                return lambert(makeQuad(osg::Vec3d(-30, -30, z), osg::Vec3d(60, 0, 0), osg::Vec3d(0, 60, 0)), 0.0);
            };
            // In a cover's plane it is cut off at the angle 30 / .5: 1 / 3600 of the light at most comes from beyond.
            const auto hidden = together({whiteFloor(), light, cover(0.5)}), free = together({whiteFloor(), light, cover(1.5)});
            const std::string what = std::to_string(light->getShape()) + ", " + nameOf(estimator);
            const ReferenceResult black = originOf(*hidden).render(night, options(estimator), allTerms);
            EXPECT_EQ(0.0, estimateOf(black, Layer::BEAUTY).value) << what;
            EXPECT_GT(estimateOf(black, Layer::DIFFUSE).value, 0.1) << what;
            EXPECT_DOUBLE_EQ(estimateOf(black, Layer::DIFFUSE).value, estimateOf(black, Layer::OCCLUSION).value) << what;
            const ReferenceResult lit = originOf(*free).render(night, options(estimator), allTerms);
            EXPECT_EQ(0.0, estimateOf(lit, Layer::OCCLUSION).value) << what;
            EXPECT_EQ(estimateOf(lit, Layer::DIFFUSE).value, estimateOf(lit, Layer::BEAUTY).value) << what;
        }
}

// In a scene so large that its triangles are rounded by a tenth of the gap between lamp and floor.
TEST(ReferenceEmitters, ALampDoesNotHideItself)
{
    const osg::ref_ptr<osg::Node> far =
        lambert(makeQuad(osg::Vec3d(2e4, 1e4, 3e4), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0)), 0.0);
    for (const auto& light : {rectangle(osg::Vec3d(0, 0, 0.0117), 2, 2), sphere(osg::Vec3d(0, 0, 0.6117), 0.6)}) {
        const auto scene = together({whiteFloor(), far, light});
        const Traced view = parallelView(*scene, osg::Vec3d(0, 0, 5e-3), osg::Vec3d(0, 0, -1), 1e-4, 8);
        for (const auto estimator : allEstimators) {
            const ReferenceResult result = view.render(night, options(estimator), allTerms);
            EXPECT_NEAR(1.0, estimateOf(result, Layer::DIFFUSE).value, 0.1) << nameOf(estimator);
            EXPECT_EQ(0.0, estimateOf(result, Layer::OCCLUSION).value) << nameOf(estimator);
        }
    }
}

TEST(ReferenceEmitters, APaneLetsThroughWhatItsOpacityLeaves)
{
    const osg::ref_ptr<osg::Geode> pane = makeQuad(osg::Vec3d(-30, -30, 0.5), osg::Vec3d(60, 0, 0), osg::Vec3d(0, 60, 0));
    const osg::ref_ptr<osg::Vec4Array> colour = new osg::Vec4Array;
    colour->push_back(osg::Vec4(0, 0, 0, 0.25f));
    pane->getDrawable(0)->asGeometry()->setColorArray(colour, osg::Array::BIND_OVERALL);
    osg::StateSet& state = *pane->getOrCreateStateSet();
    state.setMode(GL_BLEND, osg::StateAttribute::ON);
    state.setAttribute(new osg::BlendFunc);
    state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    const auto scene = together({whiteFloor(), pane, sphere(osg::Vec3d(0, 0, 1), 0.4)});
    for (const auto estimator : allEstimators)
        expectNear(estimateOf(originOf(*scene).render(night, options(estimator)), Layer::BEAUTY), 0.75 * 0.16, nameOf(estimator));
}

TEST(ReferenceEmitters, OneSideIsLitOrBoth)
{
    for (const auto& light : {rectangle(osg::Vec3d(0, 0, 1), 2, 1), disc(osg::Vec3d(0, 0, 1), 0.5)}) {
        const auto scene = together({whiteFloor(), light});
        const auto turned =
            together({whiteFloor(), moved(osg::Matrixd::translate(0, 0, -1) * osg::Matrixd::rotate(pi, osg::Vec3d(1, 0, 0)) *
                                              osg::Matrixd::translate(0, 0, 1),
                                          light)});
        const double one = directLight(*scene);
        EXPECT_GT(one, 0.1);
        EXPECT_EQ(0.0, directLight(*turned));
        // Seen from below it shows its radiance, from above it is black.
        EXPECT_EQ(1.0f, seen(*together({light}), 0.5).at(1, 1)[0]);
        const Picture back = seen(*together({light}), 2.0);
        EXPECT_EQ(0.0f, back.at(1, 1)[0]);
        EXPECT_EQ(1.0f, back.at(1, 1)[3]);
        light->setTwoSided(true);
        EXPECT_NEAR(one, directLight(*scene), 0.02 * one);
        EXPECT_NEAR(one, directLight(*turned), 0.02 * one);
        EXPECT_EQ(1.0f, seen(*together({light}), 2.0).at(1, 1)[0]);
    }
}

TEST(ReferenceEmitters, LightNothingFromTheirPlaneOrFromWithin)
{
    const osg::ref_ptr<AreaLight> beside = lamp(1.0);
    beside->setRectangle(osg::Vec3d(0.5, 0, 0), osg::Vec3d(0.5, 0, 0), osg::Vec3d(0, 1, 0));
    beside->setTwoSided(true);
    for (const auto& light :
         {invisible(beside), invisible(sphere(osg::Vec3d(0.1, 0, 0.2), 0.5)), invisible(disc(osg::Vec3d(), 1.0))})
        for (const auto estimator : allEstimators) {
            const auto scene = together({whiteFloor(), light});
            const Traced view = originOf(*scene);
            const Estimate e = estimateOf(view.render(night, options(estimator)), Layer::BEAUTY);
            EXPECT_EQ(64, e.pixels);
            EXPECT_NEAR(0.0, e.value, 1e-9) << light->getShape() << nameOf(estimator);
        }
}

TEST(ReferenceEmitters, FluxIsSharedByTheArea)
{
    // A small lamp far away is a point light: E = flux / (4 pi d^2) of a sphere, flux / (pi d^2) of a disc.
    const osg::ref_ptr<AreaLight> bulb = sphere(osg::Vec3d(0, 0, 0.5), 0.01), spot = disc(osg::Vec3d(0, 0, 0.5), 0.01);
    for (const double scale : {1.0, 10.0})
        for (const auto& light : {bulb, spot}) {
            light->setFlux(osg::Vec3f(1, 1, 1) * float(4.0 * pi));
            const double distance = 0.5 * scale, share = light == bulb ? 0.25 : 1.0;
            const auto scene = together({whiteFloor(), moved(osg::Matrixd::scale(scale, scale, scale), light)});
            const double truth = 4.0 * share / (pi * distance * distance);
            EXPECT_NEAR(1.0, directLight(*scene) / truth, 3e-3) << scale;
            // And what is drawn has that radiance.
            const auto drawn = moved(osg::Matrixd::scale(2, 2, 2), light);
            const double radius = 0.02, area = share > 0.5 ? pi * radius * radius : 4.0 * pi * radius * radius;
            EXPECT_NEAR(1.0, double(seen(*drawn, 0.5).at(1, 1)[0]) * area / 4.0, 1e-5);
        }
}

TEST(ReferenceEmitters, InvisibleOnesOnlyLight)
{
    const double truth = oracle::centredRectangle(2, 1, 1);
    const auto light = invisible(rectangle(osg::Vec3d(0, 0, 1), 2, 1));
    const auto scene = together({whiteFloor(), light});
    EXPECT_EQ(2u, originOf(*scene).triangles().triangles);
    EXPECT_EQ(0.0f, seen(*together({light}), 0.5).at(1, 1)[3]);
    for (const auto estimator : allEstimators)
        for (const auto paths : {ReferenceOptions::DIRECT, ReferenceOptions::FULL}) {
            expectNear(estimateOf(originOf(*scene).render(night, options(estimator, paths)), Layer::BEAUTY), truth,
                       nameOf(estimator));
            // The sky behind it is not hidden.
            expectNear(estimateOf(originOf(*scene).render(day, options(estimator, paths)), Layer::BEAUTY), 1.0 + truth,
                       nameOf(estimator));
        }
    // One is no blocker of another, seen ones are.
    const auto above = rectangle(osg::Vec3d(0, 0, 2), 2, 1, 3.0);
    const auto both = together({whiteFloor(), above, light});
    EXPECT_NEAR(directLight(*both), truth + 3.0 * oracle::centredRectangle(2, 1, 2), 2e-3);
    const auto hidden = together({whiteFloor(), above, rectangle(osg::Vec3d(0, 0, 1), 2, 1)});
    const ReferenceResult result = originOf(*hidden).render(night, options(ReferenceOptions::MIS), allTerms);
    expectNear(estimateOf(result, Layer::BEAUTY), truth, "hidden");
    expectNear(estimateOf(result, Layer::OCCLUSION), 3.0 * oracle::centredRectangle(2, 1, 2), "hidden");
}

}  // namespace Emitters_test
