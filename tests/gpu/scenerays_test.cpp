// SPDX-License-Identifier: MIT
// Rays of shaders/pass/scenerays.glsl against CasterBvh, whose own test tries every triangle.
#include "indirect/SceneRays.h"

#include <cmath>
#include <cstring>
#include <random>

#include "Parity.h"
#include "TracedShapes.h"

namespace scenerays_test
{

using osg::Vec3f;
using osgEnvLight::CasterBvh;
using osgEnvLight::SceneRays;
using osgEnvLight::TracedScene;

namespace
{

struct Ray {
    Vec3f origin, direction;
};

GlContext::Texture tableOf(const char* name, const osg::Texture2D& texture)
{
    const osg::Image& image = *texture.getImage();
    GlContext::Texture table{name, image.s(), image.t(), {}};
    table.texels.resize(size_t(image.s() * image.t() * 4));
    std::memcpy(table.texels.data(), image.data(), table.texels.size() * sizeof(float));
    return table;
}

glm::vec4 padded(const Vec3f& v)
{
    return glm::vec4(v.x(), v.y(), v.z(), 0.0f);
}

// Distances, negative where nothing is met, and the numbers of surfaces.
std::vector<glm::vec4> hitsOf(const SceneRays& scene, const std::vector<Ray>& rays, const std::string& stops = "STOPS_BY_PLACE")
{
    std::vector<std::vector<glm::vec4>> columns(2);
    for (const Ray& r : rays) {
        columns[0].push_back(padded(r.origin));
        columns[1].push_back(padded(r.direction));
    }
    return parity::context().evaluate({"pass/scenerays.glsl"},
                                      "SceneHit hit = sceneHit(nodes, triangles, a.xyz, b.xyz, 1e3, " + stops +
                                          ");\n"
                                          "bool met = hit.distance != MISSED;\n"
                                          "result = vec4(met ? hit.distance : -1.0, met ? hit.surface : -1,\n"
                                          "              dot(hit.normal, b.xyz), 0.0);",
                                      columns, {tableOf("nodes", *scene.nodes), tableOf("triangles", *scene.triangles)});
}

std::vector<Ray> raysAbout(float size, int count)
{
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> between(-size, size);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        Vec3f d(normal(random), normal(random), normal(random));
        if (i % 8 == 0) d = Vec3f(i % 3 == 0, i % 3 == 1, i % 3 == 2);  // two zeros
        if (i % 8 == 1) d.z() = 0.0f;
        if (i % 8 == 2) d.x() = -0.0f;
        d.normalize();
        rays.push_back({Vec3f(between(random), between(random), between(random)), d});
    }
    return rays;
}

// A ray through an edge may meet either of its triangles, so one of a thousand may differ.
void expectHitsOfBvh(const TracedScene& scene, int mostDifferent)
{
    const CasterBvh bvh(scene);
    const osg::ref_ptr<SceneRays> gpu = new SceneRays(scene, bvh, {}, 16);
    const std::vector<Ray> rays = raysAbout(2.0f, 4000);
    const std::vector<glm::vec4> hits = hitsOf(*gpu, rays);
    int different = 0, met = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const auto exact = bvh.nearest(rays[i].origin, rays[i].direction, 1e3f);
        met += exact.has_value();
        const bool same = exact ? std::abs(hits[i].x - exact->distance) < 1e-4f * (1.0f + exact->distance) &&
                                      int(hits[i].y) == int(scene.surfaceOf[exact->triangle])
                                : hits[i].x == -1.0f;
        if (hits[i].x > 0.0f) {
            EXPECT_LE(hits[i].z, 0.0f) << "normals are against the ray";
        }
        different += !same;
    }
    EXPECT_LE(different, mostDifferent) << "of " << rays.size() << ", of which " << met << " meet something";
}

TracedScene makeSoup(int count, float size)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> between(-1.0f, 1.0f);
    const auto place = [&] { return Vec3f(between(random), between(random), between(random)); };
    TracedScene scene;
    for (int i = 0; i < count; ++i) {
        const Vec3f corner = place();
        addTriangle(scene, addSurface(scene, false), corner, corner + place() * size, corner + place() * size);
    }
    return scene;
}

}  // namespace

TEST(scenerays, MeetWhatTheHierarchyMeets)
{
    expectHitsOfBvh(makeSoup(3000, 0.3f), 4);
    expectHitsOfBvh(makeSoup(30, 2.0f), 4);
    TracedScene room;
    addBox(room, addSurface(room, true), Vec3f(-2, -2, -2), Vec3f(2, 2, 2), true);
    addSphere(room, addSurface(room, true), Vec3f(0.5f, 0, 0), 1.0f, 24);
    expectHitsOfBvh(room, 4);
}

TEST(scenerays, OfNothingAndOfOneTriangle)
{
    expectHitsOfBvh(TracedScene(), 0);
    expectHitsOfBvh(makeSoup(1, 4.0f), 0);
    TracedScene flat;
    const unsigned surface = addSurface(flat, false);
    addTriangle(flat, surface, Vec3f(1, 1, 1), Vec3f(1, 1, 1), Vec3f(2, 2, 2));
    expectHitsOfBvh(flat, 0);
}

// Chains of halves are as deep as a hierarchy gets.
TEST(scenerays, DeepHierarchies)
{
    TracedScene scene;
    float size = 1.0f;
    for (int i = 0; i < 60; ++i, size *= 0.5f)
        for (int k = 0; k < 5; ++k)
            addTriangle(scene, addSurface(scene, false), Vec3f(size, 0, float(k) * size), Vec3f(size, size, 0),
                        Vec3f(0, size, size));
    expectHitsOfBvh(scene, 4);
}

TEST(scenerays, SingleRaysPassWhatIsMostlyHoles)
{
    TracedScene scene;
    addQuad(scene, addSurface(scene, false, 0.4f), Vec3f(-1, -1, 1), Vec3f(2, 0, 0), Vec3f(0, 2, 0));
    addQuad(scene, addSurface(scene, false, 0.6f), Vec3f(-1, -1, 2), Vec3f(2, 0, 0), Vec3f(0, 2, 0));
    addQuad(scene, addSurface(scene, false), Vec3f(-1, -1, 3), Vec3f(2, 0, 0), Vec3f(0, 2, 0));
    const osg::ref_ptr<SceneRays> rays = new SceneRays(scene, CasterBvh(scene), {}, 16);
    const glm::vec4 hit = hitsOf(*rays, {{Vec3f(0.1f, 0.2f, 0), Vec3f(0, 0, 1)}}, "STOPS_FROM_HALF").front();
    EXPECT_FLOAT_EQ(2.0f, hit.x);
    EXPECT_FLOAT_EQ(1.0f, hit.y);
}

// Each surface stops its share of those that reach it, at whatever places: the first .4, the second .5 of the rest, the last all.
TEST(scenerays, ManyRaysPassHolesByTheirShare)
{
    TracedScene scene;
    addQuad(scene, addSurface(scene, false, 0.4f), Vec3f(-1, -1, 1), Vec3f(2, 0, 0), Vec3f(0, 2, 0));
    addQuad(scene, addSurface(scene, false, 0.5f), Vec3f(-1, -1, 2), Vec3f(2, 0, 0), Vec3f(0, 2, 0));
    addQuad(scene, addSurface(scene, false), Vec3f(-1, -1, 3), Vec3f(2, 0, 0), Vec3f(0, 2, 0));
    const osg::ref_ptr<SceneRays> gpu = new SceneRays(scene, CasterBvh(scene), {}, 16);
    std::mt19937 random(11);
    std::uniform_real_distribution<float> between(-0.99f, 0.99f);
    std::vector<Ray> rays;
    for (int i = 0; i < 8000; ++i) rays.push_back({Vec3f(between(random), between(random), 0), Vec3f(0, 0, 1)});
    double stopped[3] = {};
    for (const glm::vec4& hit : hitsOf(*gpu, rays)) stopped[int(hit.y)] += 1.0 / double(rays.size());
    const double error =
        4.0 * std::sqrt(0.25 / 4096.0);  // four standard deviations of as many places, two triangles of half as many
    EXPECT_NEAR(0.4, stopped[0], error);
    EXPECT_NEAR(0.3, stopped[1], error);
    EXPECT_NEAR(0.3, stopped[2], error);
    EXPECT_EQ(hitsOf(*gpu, rays), hitsOf(*gpu, rays)) << "always the same";
}

// Between the corners', on the side that is met; of a flat triangle its own.
TEST(scenerays, NormalsAreThoseBetweenTheCorners)
{
    TracedScene scene;
    addTriangle(scene, addSurface(scene, false), Vec3f(0, 0, 0), Vec3f(4, 0, 0), Vec3f(0, 4, 0));
    addTriangle(scene, addSurface(scene, false), Vec3f(0, 0, 5), Vec3f(4, 0, 5), Vec3f(0, 4, 5));
    const Vec3f corners[3] = {Vec3f(0.6f, 0, 0.8f), Vec3f(0, 0, 1), Vec3f(0, -0.6f, 0.8f)};
    scene.normals = {{}, osgEnvLight::CasterMesh::flat};
    for (size_t k = 0; k < 3; ++k)
        scene.normals[0][k] = float(glsl::packDirection(glsl::vec3(corners[k].x(), corners[k].y(), corners[k].z())));
    const osg::ref_ptr<SceneRays> gpu = new SceneRays(scene, CasterBvh(scene), {}, 16);
    const std::vector<std::vector<glm::vec4>> rays = {{glm::vec4(1, 2, 2, 0), glm::vec4(1, 2, -2, 0), glm::vec4(1, 2, 3, 0)},
                                                      {glm::vec4(0, 0, -1, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, 0, 1, 0)}};
    const std::vector<glm::vec4> normals = parity::context().evaluate(
        {"pass/scenerays.glsl"},
        "result = vec4(smoothNormal(triangles, sceneHit(nodes, triangles, a.xyz, b.xyz, 1e3, STOPS_BY_PLACE)), 0.0);", rays,
        {tableOf("nodes", *gpu->nodes), tableOf("triangles", *gpu->triangles)});
    Vec3f exact = corners[0] * 0.25f + corners[1] * 0.25f + corners[2] * 0.5f;
    exact.normalize();
    for (int k = 0; k < 3; ++k) {  // 1e-3: packDirection()
        EXPECT_NEAR(exact[k], normals[0][k], 1e-3f);
        EXPECT_NEAR(-exact[k], normals[1][k], 1e-3f);
    }
    EXPECT_NEAR(-1.0f, normals[2].z, 1e-6f);
}

}  // namespace scenerays_test
