// SPDX-License-Identifier: MIT
// A scene's surface points and probes as textures, and the thread that makes them.
#include "indirect/TransportScene.h"
#include "indirect/TransportWorker.h"

#include "base/Limits.h"

#include <TracedShapes.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

namespace TransportScene_test
{

using namespace osgEnvLight;

namespace
{

TracedScene makeBody()
{
    TracedScene scene;
    addSphere(scene, addSurface(scene, true), osg::Vec3f(), 1.0f, 12);
    addBox(scene, addSurface(scene, true), osg::Vec3f(2, -1, -1), osg::Vec3f(4, 1, 1));
    return scene;
}

CasterMesh meshOf(const TracedScene& scene)
{
    return {scene.positions, scene.triangles, {}, {}};
}

const float* texel(const osg::Texture2D& texture, int i)
{
    const osg::Image& image = *texture.getImage();
    return reinterpret_cast<const float*>(image.data(unsigned(i % image.s()), unsigned(i / image.s())));
}

osg::ref_ptr<TransportScene> waitFor(TransportWorker& worker)
{
    for (int i = 0; i < 2000; ++i) {
        if (osg::ref_ptr<TransportScene> made = worker.take()) return made;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return nullptr;
}

}  // namespace

TEST(TracedScene, KnowsWhichPartsAreClosed)
{
    const TracedScene body = makeBody();
    const auto closed = std::make_shared<CasterMesh>(meshOf(body));
    const auto open = std::make_shared<CasterMesh>(*closed);
    open->triangles.pop_back();
    const auto inwards = std::make_shared<CasterMesh>(*closed);
    for (auto& t : inwards->triangles) std::swap(t[0], t[1]);
    const TracedScene scene = tracedScene({{closed, {}}, {open, {}}, {inwards, {}}});
    ASSERT_EQ(3u, scene.surfaces.size());
    EXPECT_TRUE(scene.surfaces[0].closed);
    EXPECT_FALSE(scene.surfaces[1].closed) << "a triangle is missing";
    EXPECT_FALSE(scene.surfaces[2].closed) << "a room is seen from its inside";
    EXPECT_EQ(3 * body.triangles.size() - 1, scene.triangles.size());
    EXPECT_EQ(2u, scene.surfaceOf.back());
    EXPECT_EQ(body.corner(5, 1), scene.corner(body.triangles.size() + 5, 1));
}

TEST(TransportScene, TexturesHoldPointsAndProbes)
{
    const osg::ref_ptr<TransportScene> scene = new TransportScene(makeBody(), osg::Vec3d(7, 8, 9), 4, false);
    ASSERT_FALSE(scene->empty());
    EXPECT_EQ(osg::Vec3d(7, 8, 9), scene->origin);
    EXPECT_EQ((std::array<int, 3>{4, 4, 2}), scene->count);
    EXPECT_EQ(6, scene->columns);
    const int points = limits::POINT_SIDE * limits::POINT_SIDE;
    for (int i = 0; i < points; i += 97) {
        const float* n = texel(*scene->pointNormals, i);
        EXPECT_NEAR(1.0f, osg::Vec3f(n[0], n[1], n[2]).length(), 1e-5f);
    }
    int on = 0;
    for (int i = 0; i < 32; ++i) on += texel(*scene->probePlaces, i)[3] == 1.0f;
    EXPECT_GT(on, 16);
    for (int i = 0; i < 32 * 384; ++i) {
        const float code = 65535.0f * *texel(*scene->probeLinks, i);
        EXPECT_NEAR(std::round(code), code, 1e-2f);
        EXPECT_TRUE(code > -0.5f && code < float(points) + 1.5f);
    }
    EXPECT_GT(scene->bytes(), size_t(points) * 32);
}

TEST(TransportScene, HasTablesForRaysWhereTheyAreAskedFor)
{
    const auto mesh = std::make_shared<CasterMesh>(meshOf(makeBody()));
    const osg::Vec3f diffuse(0.1f, 0.2f, 0.3f), glossy(0.4f, 0.0f, 0.1f), emission(4, 5, 6);
    const StaticCasters::Parts parts = {{mesh, {osg::Vec3f(), osg::Vec3f(), osg::Vec3f()}},
                                        {mesh, {diffuse, glossy, emission, 1.0f, 0.3f}}};
    const osg::ref_ptr<TransportScene> without = new TransportScene(tracedScene(parts), osg::Vec3d(), 2, false),
                                       with = new TransportScene(tracedScene(parts), osg::Vec3d(), 2, true);
    EXPECT_FALSE(without->rays);
    ASSERT_TRUE(with->rays);
    size_t more = 0;
    for (const osg::Texture2D* t : with->rays->textures()) more += t->getImage()->getTotalSizeInBytes();
    EXPECT_EQ(without->bytes() + more, with->bytes());
    const osg::ref_ptr<osg::Texture2D> colors = SceneRays::colors(parts);
    const int second = osgEnvLight::limits::SURFACE_TEXELS;
    const auto color = [&](int i) { return osg::Vec3f(texel(*colors, i)[0], texel(*colors, i)[1], texel(*colors, i)[2]); };
    EXPECT_EQ(diffuse, color(second));
    EXPECT_EQ(glossy, color(second + 1));
    EXPECT_EQ(0.3f, texel(*colors, second + 1)[3]);
    EXPECT_EQ(emission, color(second + 2));
}

TEST(TransportScene, PointsSendOnWhatTheirSurfacesDo)
{
    const auto mesh = std::make_shared<CasterMesh>(meshOf(makeBody()));
    StaticCasters::Parts parts = {{mesh, {osg::Vec3f(0.1f, 0.2f, 0.3f), osg::Vec3f(), osg::Vec3f()}}};
    const osg::ref_ptr<TransportScene> scene = new TransportScene(tracedScene(parts), osg::Vec3d(), 2, false);
    EXPECT_FLOAT_EQ(0.2f, texel(*scene->diffuse(parts), 1234)[1]);
    EXPECT_FALSE(scene->glossy(parts)) << "nothing is glossy";
    EXPECT_FALSE(scene->emissions(parts)) << "nothing emits";
    parts[0].sent.glossy = osg::Vec3f(0.4f, 0.5f, 0.6f);
    ASSERT_TRUE(scene->glossy(parts));
    EXPECT_FLOAT_EQ(0.4f, texel(*scene->glossy(parts), 17)[0]);
    parts[0].sent.emission = osg::Vec3f(4, 5, 6);
    ASSERT_TRUE(scene->emissions(parts));
    EXPECT_FLOAT_EQ(6.0f, texel(*scene->emissions(parts), 4095)[2]);
}

TEST(TransportScene, OfNothingIsEmpty)
{
    TracedScene scene;
    EXPECT_TRUE(osg::ref_ptr<TransportScene>(new TransportScene(scene, osg::Vec3d(), 8, false))->empty());
    addTriangle(scene, addSurface(scene, false), osg::Vec3f(), osg::Vec3f(), osg::Vec3f());
    EXPECT_TRUE(osg::ref_ptr<TransportScene>(new TransportScene(scene, osg::Vec3d(), 8, false))->empty());
    addTriangle(scene, 0, osg::Vec3f(), osg::Vec3f(1, 0, 0), osg::Vec3f(0, 1, 0));
    EXPECT_FALSE(osg::ref_ptr<TransportScene>(new TransportScene(scene, osg::Vec3d(), 8, false))->empty()) << "one triangle";
}

TEST(TransportWorker, MakesTheNewestAlone)
{
    TransportWorker worker;
    EXPECT_FALSE(worker.busy());
    EXPECT_FALSE(worker.take());
    for (int i = 0; i < 20; ++i)
        worker.post([i](const std::atomic<bool>& stop) {
            return osg::ref_ptr<TransportScene>(new TransportScene(makeBody(), osg::Vec3d(i, 0, 0), 4, false, {}, &stop));
        });
    EXPECT_TRUE(worker.busy());
    const osg::ref_ptr<TransportScene> made = waitFor(worker);
    ASSERT_TRUE(made);
    EXPECT_EQ(19.0, made->origin.x());
    EXPECT_FALSE(worker.busy());
}

TEST(TransportWorker, ForgetsWhatIsNotWanted)
{
    TransportWorker worker;
    std::atomic<int> stopped{0};
    const auto job = [&](const std::atomic<bool>& stop) {
        while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ++stopped;
        return osg::ref_ptr<TransportScene>(new TransportScene(TracedScene(), osg::Vec3d(), 2, false));
    };
    worker.post(job);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    worker.discard();
    EXPECT_FALSE(worker.busy());
    for (int i = 0; i < 2000 && stopped == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(1, stopped);
    EXPECT_FALSE(worker.take());
    worker.post([](const std::atomic<bool>&) -> osg::ref_ptr<TransportScene> { throw std::bad_alloc(); });
    for (int i = 0; i < 2000 && worker.busy(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_FALSE(worker.busy()) << "no memory: it goes without";
    worker.post(job);  // the destructor ends it
}

}  // namespace TransportScene_test
