// SPDX-License-Identifier: MIT
// Clusters of area lights, and the bounds of what they send.
#include "surface/EmitterTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "Emitters.h"
#include "Maths.h"

namespace EmitterTree_test
{

using namespace testmaths;
using glsl::LightCluster;
using glsl::LightReceiver;
using glsl::mat3;
using glsl::vec3;
using osgEnvLight::AreaLight;
using osgEnvLight::Emitter;
using osgEnvLight::EmitterCluster;
using osgEnvLight::emitterTree;

namespace
{

vec3 vector(const osg::Vec3d& v)
{
    return vec3(v.x(), v.y(), v.z());
}

osg::Vec3d vector(const vec3& v)
{
    return osg::Vec3d(v.x, v.y, v.z);
}

Emitter randomLight(Random& random, const osg::Vec3d& center, double size, bool round)
{
    osg::ref_ptr<AreaLight> light = new AreaLight;
    if (round)
        light->setSphere(center, size);
    else
        light->setDisc(center, vector(random.direction()), size);
    const float strength = float(std::pow(10.0, random.uniform(-2.0, 2.0)));
    light->setRadiance(osg::Vec3f(strength, 0.5f * strength, 2.0f * strength));
    return placed(*light);
}

// In a cube about a place.
std::vector<Emitter> randomLights(Random& random, size_t count, const osg::Vec3d& center, double reach, double size)
{
    std::vector<Emitter> lights;
    for (size_t i = 0; i < count; ++i) {
        const osg::Vec3d shift(random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach));
        lights.push_back(randomLight(random, center + shift, size, random.uniform() < 0.3));
    }
    return lights;
}

LightCluster seenFrom(const osg::Vec3d& point, const EmitterCluster& c)
{
    LightCluster cluster;
    cluster.place = vector(c.place - point);
    cluster.reach = vector(c.reach);
    cluster.axis = vector(c.axis);
    cluster.spread = c.isRound ? -1.0 : c.spread;
    cluster.power = (c.power[0] + c.power[1] + c.power[2]) / 3.0;
    return cluster;
}

LightReceiver diffuse(const vec3& n)
{
    LightReceiver r;
    r.n = r.up = n;
    r.lobe = mat3(1.0);
    r.scale = 1.0 / pi;
    return r;
}

// A cosine lobe that a matrix stretches, about n, which does not show what is below the horizon.
LightReceiver stretched(Random& random, const vec3& n)
{
    const mat3 frame = glsl::frameAround(n);
    const double width = std::pow(10.0, random.uniform(-1.5, 0.0));
    const vec3 columns[] = {vec3(1.0, 0.0, random.uniform(-0.5, 0.5)), vec3(0.0, 1.0, 0.0),
                            vec3(random.uniform(-0.5, 0.5) * width, 0.0, width)};
    LightReceiver r;
    r.n = n;
    for (int i = 0; i < 3; ++i) r.lobe[i] = frame * columns[i];
    r.up = r.lobe[2];
    r.scale = std::abs(glm::determinant(r.lobe)) / pi;
    return r;
}

// What a part of a light at p, from the receiver, of unit normal m sends over its power: the density of the stretched lobe per
// solid angle in that direction, the cosine at the light over the square of the distance. Of a sphere the cosine is 1.
double sentFrom(const LightReceiver& r, const vec3& p, const vec3* m)
{
    if (glsl::dot(r.n, p) <= 0.0) return 0.0;
    const double distance = glsl::length(p);
    const double length = glsl::length(p / distance * r.lobe);
    const double density = r.scale * std::max(glsl::dot(r.up, p) / distance, 0.0) / std::pow(length, 4.0);
    const double cosine = m ? std::max(-glsl::dot(*m, p) / distance, 0.0) : 1.0;
    return density * cosine / (distance * distance);
}

// Of all lights, each by 64 points on it; a sphere by its centre alone, but for which its distance is several times its size.
double sentByAll(const LightReceiver& r, const std::vector<Emitter>& lights, const osg::Vec3d& point)
{
    double sum = 0.0;
    for (const Emitter& light : lights) {
        const double power = (light.radiance[0] + light.radiance[1] + light.radiance[2]) / 3.0 * light.area;
        if (light.shape == AreaLight::SPHERE) {
            sum += power / 4.0 * sentFrom(r, vector(light.center - point), nullptr);
            continue;
        }
        const vec3 normal = vector(light.normal);
        for (int i = 0; i < 64; ++i) {
            const double angle = 2.399963229728653 * i, radius = std::sqrt((i + 0.5) / 64.0);
            const osg::Vec3d p = light.center + (light.u * std::cos(angle) + light.v * std::sin(angle)) * radius;
            sum += power / 64.0 * sentFrom(r, vector(p - point), &normal);
        }
    }
    return sum;
}

struct Cut {
    double sum = 0.0;
    size_t clusters = 0, seen = 0;
};

// As the shaders walk; leaves are taken whatever their error.
Cut cutOf(const std::vector<EmitterCluster>& tree, const LightReceiver& r, const osg::Vec3d& point, double limit)
{
    Cut cut;
    for (size_t i = 0; i < tree.size(); ++cut.seen) {
        const LightCluster c = seenFrom(point, tree[i]);
        const double sends = c.power * glsl::clusterKernel(r, c, 0.0);
        const bool taken = tree[i].light >= 0 || glsl::clusterError(glsl::clusterRange(r, c), sends) <= limit;
        if (taken) cut.sum += sends;
        cut.clusters += taken ? 1 : 0;
        i = taken ? tree[i].next : i + 1;
    }
    return cut;
}

}  // namespace

TEST(EmitterTree, HasALeafForEachLitSideAndBoundsThem)
{
    Random random(1);
    std::vector<Emitter> lights = randomLights(random, 300, osg::Vec3d(5, 6, 7), 4.0, 0.2);
    for (size_t i = 0; i < lights.size(); i += 3) lights[i].twoSided = lights[i].shape != AreaLight::SPHERE;
    lights[7].radiance = osg::Vec3d();
    std::multiset<std::pair<int, bool>> expected, found;
    for (size_t i = 0; i < lights.size(); ++i) {
        if (i == 7) continue;
        expected.emplace(int(i), false);
        if (lights[i].twoSided) expected.emplace(int(i), true);
    }
    const std::vector<EmitterCluster> tree = emitterTree(lights);
    for (size_t k = 0; k < tree.size(); ++k) {
        const EmitterCluster& c = tree[k];
        if (c.light >= 0) found.emplace(c.light, c.back);
        ASSERT_GT(c.next, k);
        ASSERT_LE(c.next, tree.size());
        for (size_t i = k; i < c.next; ++i) {
            if (tree[i].light < 0) continue;
            const Emitter& light = lights[size_t(tree[i].light)];
            const osg::Vec3d apart = light.center - c.place;
            const double size = light.shape == AreaLight::SPHERE ? light.radius() : 0.0;
            for (int axis = 0; axis < 3; ++axis) ASSERT_LE(std::abs(apart[axis]) + size, c.reach[axis] + 1e-9);
            if (c.isRound) {
                ASSERT_EQ(AreaLight::SPHERE, light.shape);
            } else if (light.shape != AreaLight::SPHERE) {
                ASSERT_LE((light.normal * (tree[i].back ? -1.0 : 1.0) - c.axis).length(), c.spread + 1e-9);
            }
        }
    }
    EXPECT_EQ(expected, found);
    EXPECT_EQ(tree.size(), tree.front().next);
}

TEST(EmitterTree, OfNoLightIsEmpty)
{
    EXPECT_TRUE(emitterTree({}).empty());
    Random random(1);
    Emitter black = randomLight(random, osg::Vec3d(), 1.0, false);
    black.radiance = osg::Vec3d();
    EXPECT_TRUE(emitterTree({black}).empty());
}

TEST(EmitterTree, OfLightsInOnePlaceIsNoDeeperThanTheirCount)
{
    Random random(2);
    const std::vector<Emitter> lights(1000, randomLight(random, osg::Vec3d(1, 2, 3), 0.1, false));
    const std::vector<EmitterCluster> tree = emitterTree(lights);
    EXPECT_LT(tree.size(), 2 * lights.size());
    EXPECT_LT((tree.front().place - osg::Vec3d(1, 2, 3)).length(), 1e-9);
    EXPECT_NEAR(1000.0 * lights[0].radiance[0] * lights[0].area, tree.front().power[0], 1e-6 * tree.front().power[0]);
}

// What lights send and what their cluster stands for it are in the range, wherever the surface is: near to them and far, before
// and behind.
TEST(EmitterTree, AClustersRangeHoldsWhatItsLightsSend)
{
    Random random(3);
    int inside = 0;
    for (int k = 0; k < 10000; ++k) {
        const double reach = std::pow(10.0, random.uniform(-3.0, 0.0));
        const size_t count = 1 + size_t(random.uniform() * 5.0);
        const bool round = random.uniform() < 0.3;
        const osg::Vec3d away = vector(random.direction());
        std::vector<Emitter> lights;
        for (size_t i = 0; i < count; ++i)
            lights.push_back(randomLight(random, away + vector(random.direction()) * reach, 0.1 * reach, round));
        const EmitterCluster cluster = emitterTree(lights).front();
        const vec3 n = random.direction();
        const LightReceiver r = k % 2 ? diffuse(n) : stretched(random, n);
        const LightCluster c = seenFrom(osg::Vec3d(), cluster);
        const glsl::LightRange range = glsl::clusterRange(r, c);
        const double sent = sentByAll(r, lights, osg::Vec3d());
        const double slack = 1e-9 * range.most;
        ASSERT_LE(sent, range.most + slack) << k;
        ASSERT_GE(sent, range.least - slack) << k;
        const double sends = c.power * glsl::clusterKernel(r, c, 0.0);
        ASSERT_LE(std::abs(sends - sent), glsl::clusterError(range, sends) + slack) << k;
        inside += range.most < 2.0 * range.least ? 1 : 0;
    }
    EXPECT_GT(inside, 500);  // the bounds say something
}

// The limit is each cluster's; their errors are of both signs. Of lamps that hang over a floor cuts are small.
TEST(EmitterTree, ACutIsOffByLessThanItsLimitAndGrowsSlowly)
{
    Random random(4);
    size_t clusters[2] = {};
    for (const bool hang : {false, true})
        for (const size_t count : {size_t(300), size_t(10000)}) {
            std::vector<Emitter> lights;
            for (size_t i = 0; i < count; ++i) {
                const osg::Vec3d place(random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0));
                lights.push_back(hang ? lampAt(osg::Vec3d(place.x(), place.y(), 2.0 + 0.05 * place.z()), 0.01)
                                      : randomLight(random, place, 0.01, random.uniform() < 0.3));
            }
            const std::vector<EmitterCluster> tree = emitterTree(lights);
            for (int k = 0; k < 20; ++k) {
                const osg::Vec3d point(random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0), hang ? 0.0 : random.uniform());
                const LightReceiver r = diffuse(hang ? vec3(0, 0, 1) : random.direction());
                const double all = sentByAll(r, lights, point);
                EXPECT_NEAR(all, cutOf(tree, r, point, 0.0).sum, 2e-3 * all);  // leaves as points
                const Cut cut = cutOf(tree, r, point, 0.02 * all);
                EXPECT_NEAR(all, cut.sum, 0.02 * all) << count;
                if (hang) clusters[count > 300] += cut.clusters;
            }
        }
    EXPECT_LT(clusters[1] / 20, 500u);
    EXPECT_LT(clusters[1], 6 * clusters[0]);  // of 33 times the lights
}

}  // namespace EmitterTree_test
