// SPDX-License-Identifier: MIT
// Which of many area lights have points, and that these stay while a view moves.
#include "shadow/PointChoice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "Emitters.h"
#include "Maths.h"

namespace PointChoice_test
{

using osgEnvLight::chooseParts;
using osgEnvLight::ChosenPart;
using osgEnvLight::Emitter;
using osgEnvLight::EmitterPoint;
using osgEnvLight::PointChoice;

namespace
{

const unsigned count = 64;

// A street of 1000 lamps, 10 apart and 5 high.
std::vector<Emitter> street()
{
    std::vector<Emitter> lights;
    for (int i = 0; i < 1000; ++i) lights.push_back(lampAt(osg::Vec3d(10.0 * i, 0, 5), 0.1));
    return lights;
}

// What a view that stands there sees of its ground.
std::vector<osg::Vec3d> groundAbout(double x)
{
    std::vector<osg::Vec3d> places;
    for (int i = -8; i < 8; ++i) places.emplace_back(x + 5.0 * i, 1, 0);
    return places;
}

double share(const std::vector<double>& weights, const std::vector<ChosenPart>& chosen, size_t first, size_t last)
{
    double sum = 0.0;
    for (const ChosenPart& c : chosen)
        if (c.side >= first && c.side < last) sum += c.scale * weights[c.side] / c.part.parts;
    return sum;
}

std::set<unsigned> numbersOf(const std::vector<EmitterPoint>& points)
{
    std::set<unsigned> numbers;
    for (const EmitterPoint& p : points) numbers.insert(p.lightNumber);
    return numbers;
}

unsigned inPlace(const std::vector<EmitterPoint>& a, const std::vector<EmitterPoint>& b)
{
    unsigned same = 0;
    for (size_t i = 0; i < a.size(); ++i) same += a[i].lightNumber == b[i].lightNumber ? 1 : 0;
    return same;
}

}  // namespace

TEST(PointChoice, StandsForAllWeightsAndEachPartOnAverageForItsOwn)
{
    testmaths::Random random(1);
    std::vector<double> weights;
    for (int i = 0; i < 500; ++i) weights.push_back(std::pow(10.0, random.uniform(-3.0, 0.0)));
    weights[77] = 40.0;
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double first = std::accumulate(weights.begin(), weights.begin() + 50, 0.0);
    double sum = 0.0;
    const unsigned rounds = 400;
    for (unsigned round = 0; round < rounds; ++round) {
        const std::vector<ChosenPart> chosen = chooseParts(weights, count, round);
        ASSERT_EQ(count, chosen.size());
        EXPECT_NEAR(total, share(weights, chosen, 0, 500), 1e-9 * total);
        // What is heavier than a point stands for is there with all its parts.
        EXPECT_NEAR(40.0, share(weights, chosen, 77, 78), 1e-9 * 40.0);
        sum += share(weights, chosen, 0, 50);
    }
    EXPECT_NEAR(first, sum / rounds, 0.05 * first);
}

TEST(PointChoice, LooksWhatLightsThePlaces)
{
    const std::vector<Emitter> lights = street();
    PointChoice choice;
    const std::vector<osg::Vec3d> places = groundAbout(5000);
    unsigned near = 0, far = 0;
    for (const EmitterPoint& p : choice.update(lights, count, &places, count)) {
        near += std::abs(p.position.x() - 5000) < 60 ? 1 : 0;
        far += std::abs(p.position.x() - 5000) > 500 ? 1 : 0;
    }
    EXPECT_GT(near, count / 2);
    EXPECT_GT(far, 0u);  // other surfaces are lit, too
    // Nobody has looked yet: all are alike.
    PointChoice blind;
    near = 0;
    for (const EmitterPoint& p : blind.update(lights, count, nullptr, count))
        near += std::abs(p.position.x() - 5000) < 60 ? 1 : 0;
    EXPECT_LT(near, 3u);
}

// A place on a light, one that none of them sees, and none.
TEST(PointChoice, KnowsWeightsAtStrangePlaces)
{
    const std::vector<Emitter> lights = street();
    const std::vector<osg::Vec3d> strange[] = {{osg::Vec3d(50, 0, 5)}, {osg::Vec3d(50, 0, 5.1)}, {}};
    for (const std::vector<osg::Vec3d>& places : strange) {
        PointChoice choice;
        double power = 0.0;
        for (const EmitterPoint& p : choice.update(lights, count, &places, count)) power += p.power[0];
        EXPECT_TRUE(std::isfinite(power));
        EXPECT_GT(power, 0.0);
    }
}

TEST(PointChoice, KeepsPointsInPlaceWhileAViewMoves)
{
    const std::vector<Emitter> lights = street();
    PointChoice choice;
    std::vector<osg::Vec3d> places = groundAbout(5000);
    std::vector<EmitterPoint> former = choice.update(lights, count, &places, count);
    unsigned most = 0;
    for (int i = 1; i <= 20; ++i) {
        places = groundAbout(5000 + 0.5 * i);
        const std::vector<EmitterPoint> points = choice.update(lights, count, &places, count);
        EXPECT_EQ(choice.changed(), count - inPlace(points, former));
        most = std::max(most, choice.changed());
        former = points;
    }
    EXPECT_LT(most, 8u);
}

TEST(PointChoice, ChangesAFewPointsAFrameAfterAJump)
{
    const std::vector<Emitter> lights = street();
    PointChoice choice;
    std::vector<osg::Vec3d> places = groundAbout(1000);
    choice.update(lights, count, &places, count);
    places = groundAbout(9000);
    const unsigned budget = 8;
    std::vector<EmitterPoint> points = choice.update(lights, count, &places, budget);
    EXPECT_GT(choice.waiting(), 24u);  // measured: 32
    int frames = 0;
    do {
        ASSERT_LT(choice.changed(), budget + 16u);  // the parts of a light change together
        // None is there twice, nor in parts of two sizes: then it would count twice.
        EXPECT_EQ(points.size(),
                  numbersOf(points).size() + (numbersOf(points).count(0) ? points.size() - numbersOf(points).size() : 0));
        points = choice.update(lights, count, nullptr, budget);
    } while (choice.waiting() > 0 && ++frames < 30);
    EXPECT_LT(frames, 12);
    PointChoice fresh;
    EXPECT_EQ(numbersOf(fresh.update(lights, count, &places, count)), numbersOf(points));
}

TEST(PointChoice, FollowsLightsThatMoveAndOthers)
{
    std::vector<Emitter> lights = street();
    PointChoice choice;
    const std::vector<osg::Vec3d> places = groundAbout(5000);
    const std::vector<EmitterPoint> former = choice.update(lights, count, &places, count);
    for (Emitter& light : lights) light.center += osg::Vec3d(0, 0.1, 0);
    const std::vector<EmitterPoint> moved = choice.update(lights, count, nullptr, 8);
    EXPECT_GT(inPlace(moved, former), count - 8);
    for (const EmitterPoint& p : moved) EXPECT_NEAR(0.1, p.position.y(), 0.1 + 1e-6);
    lights.erase(lights.begin(), lights.begin() + 300);
    const std::vector<EmitterPoint> fewer = choice.update(lights, count, nullptr, 8);
    EXPECT_EQ(0u, choice.waiting());  // none of the former points says anything
    for (const EmitterPoint& p : fewer) EXPECT_GT(p.position.x(), 2999.0 - 1.0);
}

}  // namespace PointChoice_test
