// SPDX-License-Identifier: MIT
// Kept references are found again, and only where nothing of them or of what
// they are made from has changed.
#include "ReferenceCache.h"

#include <gtest/gtest.h>

#include <osgDB/FileUtils>

#include <cstdio>
#include <fstream>
#include <sstream>

namespace ReferenceCache_test
{

using osgEnvLight::Picture;
using suite::ContentHash;
using suite::ReferenceCache;

namespace
{

class ReferenceCacheTest : public testing::Test
{
  protected:
    ~ReferenceCacheTest() override { std::remove(cache.fileName(key).c_str()); }

    // Counts how often it is asked.
    ReferenceCache::Pictures get()
    {
        return cache.get(key, [this] {
            ++made;
            Picture a(3, 2), b(1, 1);
            for (size_t i = 0; i < a.rgba.size(); ++i) a.rgba[i] = 0.1f * float(i);
            b.rgba = {1.0f, 2.0f, 3.0f, float(made)};
            return ReferenceCache::Pictures{a, b};
        });
    }

    std::string stored() const
    {
        std::ostringstream all;
        all << std::ifstream(cache.fileName(key), std::ios::binary).rdbuf();
        return all.str();
    }

    void store(const std::string& content) const { std::ofstream(cache.fileName(key), std::ios::binary) << content; }

    ReferenceCache cache{ENVLIGHT_BINARY_DIR "/references"};
    const std::uint64_t key = 0x0123456789abcdefu;
    int made = 0;
};

// One triangle, one map, one camera: the hash of all that a picture is made
// from.
struct Content {
    osgEnvLight::TriangleScene scene;
    osg::ref_ptr<osgEnvLight::EnvironmentMap> map = new osgEnvLight::EnvironmentMap;
    double rotation = 0.0;
    osg::Matrixd view;
    osgEnvLight::ReferenceOptions options;

    Content()
    {
        scene.meshes.resize(1);
        scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        scene.meshes[0].triangles = {{0, 1, 2}};
    }

    std::uint64_t hash() const
    {
        ContentHash h;
        std::string error;
        h.scene(scene);
        h.map(*map->radiance(error), rotation, 1.0);
        h.camera(view, osg::Matrixd(), 8, 8);
        h.options(options);
        return h.get();
    }
};

}  // namespace

TEST_F(ReferenceCacheTest, KeepsPicturesToTheBit)
{
    std::remove(cache.fileName(key).c_str());
    const ReferenceCache::Pictures first = get();
    const ReferenceCache::Pictures second = get();
    EXPECT_EQ(made, 1);
    ASSERT_EQ(second.size(), 2u);
    EXPECT_EQ(second[0].width, 3);
    EXPECT_EQ(second[0].height, 2);
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(second[i].rgba, first[i].rgba);
}

TEST_F(ReferenceCacheTest, DamagedFilesAreMadeAgain)
{
    std::remove(cache.fileName(key).c_str());
    get();
    const std::string whole = stored();
    ASSERT_GT(whole.size(), 112u);  // the pixels
    int expected = 1;
    for (size_t at = 0; at < whole.size(); ++at) {
        std::string damaged = whole;
        damaged[at] = char(damaged[at] ^ 4);
        store(damaged);
        get();
        EXPECT_EQ(made, ++expected) << "byte " << at;
    }
    for (size_t length = 0; length < whole.size(); ++length) {
        store(whole.substr(0, length));
        get();
        EXPECT_EQ(made, ++expected) << "cut to " << length;
    }
    get();
    EXPECT_EQ(made, expected);  // the last is whole again
}

TEST_F(ReferenceCacheTest, AnothersFileIsNotTaken)
{
    std::remove(cache.fileName(key).c_str());
    get();
    const std::string other = cache.fileName(key + 1);
    ASSERT_EQ(std::rename(cache.fileName(key).c_str(), other.c_str()), 0);
    cache.get(key + 1, [this] {
        ++made;
        return ReferenceCache::Pictures();
    });
    EXPECT_EQ(made, 2);
    std::remove(other.c_str());
}

TEST(ContentHashTest, TellsEveryIngredientApart)
{
    const std::uint64_t before = Content().hash();
    EXPECT_EQ(Content().hash(), before);
    const std::vector<std::function<void(Content&)>> changes = {
        [](Content& c) { c.scene.meshes[0].positions[2].y = 1.0000001f; },
        [](Content& c) {
            c.scene.meshes[0].triangles[0] = {0, 2, 1};
        },
        [](Content& c) { c.scene.meshes[0].normals.resize(3, glm::vec3(0, 0, 1)); },
        [](Content& c) { c.scene.meshes[0].material.roughness = 0.5; },
        [](Content& c) { c.scene.meshes[0].material.color.a = 0.5; },
        [](Content& c) { c.scene.meshes[0].material.encoded = true; },
        [](Content& c) { c.scene.meshes[0].material.textureMode = osgEnvLight::SurfaceState::TEXTURE_DECAL; },
        [](Content& c) { c.scene.meshes[0].material.sides = osgEnvLight::SurfaceMaterial::SHOW_FRONT; },
        [](Content& c) { c.scene.origin.x = 1.0; },
        [](Content& c) { c.rotation = 1e-9; },
        [](Content& c) { c.view(3, 2) = -1e-9; },
        [](Content& c) { c.options.samples = 257; },
        [](Content& c) { c.options.estimator = osgEnvLight::ReferenceOptions::MIS; },
        [](Content& c) {
            std::string error;
            ASSERT_TRUE(c.map->load("studio", nullptr, error)) << error;
        }};
    for (size_t i = 0; i < changes.size(); ++i) {
        Content content;
        changes[i](content);
        EXPECT_NE(content.hash(), before) << "change " << i;
    }
}

}  // namespace ReferenceCache_test
