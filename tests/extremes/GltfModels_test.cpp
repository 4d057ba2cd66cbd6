// SPDX-License-Identifier: MIT
// The glTF reader against models of others: those of Debian's assimp-testmodels, and a picture.
#include "GltfFiles.h"

#include <SceneRenderer.h>

#include <filesystem>

using namespace gltffiles;
namespace fs = std::filesystem;

namespace
{

const fs::path kModels = "/usr/share/assimp/models/glTF2";

int trianglesBelow(osg::Node* root)
{
    int count = 0;
    for (osg::Geometry* g : find<osg::Geometry>(root)) count += trianglesOf(*g);
    return count;
}

ReadResult readModel(const fs::path& path)
{
    return osgDB::Registry::instance()->readNode(path.string(), nullptr);
}

class GltfModels : public ::testing::Test
{
  protected:
    void SetUp() override
    {
        if (!fs::exists(kModels)) GTEST_SKIP() << "no assimp-testmodels";
    }
};

}  // namespace

TEST_F(GltfModels, EachLoadsOrSaysWhyNot)
{
    int loaded = 0, refused = 0;
    NotifyCatcher said;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kModels)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb") continue;
        ReadResult result = readModel(entry.path());
        (result.validNode() ? loaded : refused)++;
        if (result.validNode()) continue;
        EXPECT_EQ(result.message().rfind(entry.path().string() + ": ", 0), 0u) << result.message();
        EXPECT_EQ(result.message().find('\n'), std::string::npos) << result.message();
    }
    EXPECT_EQ(said.text(), "");
    EXPECT_EQ(loaded, 31);
    EXPECT_EQ(refused, 15);
}

TEST_F(GltfModels, TrianglesOfSeveral)
{
    const std::pair<const char*, int> models[] = {{"BoxTextured-glTF/BoxTextured.gltf", 12},
                                                  {"BoxTextured-glTF-Binary/BoxTextured.glb", 12},
                                                  {"BoxTextured-glTF-Embedded/BoxTextured.gltf", 12},
                                                  {"2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 121496},
                                                  {"glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", 12},
                                                  {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_04.gltf", 2},
                                                  {"simple_skin/simple_skin.gltf", 8}};
    for (const auto& [name, triangles] : models) {
        ReadResult result = readModel(kModels / name);
        EXPECT_TRUE(result.validNode()) << result.message();
        EXPECT_EQ(trianglesBelow(result.getNode()), triangles) << name;
    }
}

TEST_F(GltfModels, Messages)
{
    const std::pair<const char*, const char*> models[] = {
        {"draco/2CylinderEngine.gltf",
         "key 'extensionsRequired[0]': expected an extension that this reader knows, found \"KHR_draco_mesh_compression\""},
        {"RecursiveNodes/RecursiveNodes.gltf",
         "key 'nodes[0]': expected at most 512 nodes above it, found more, or itself among them"},
        {"MissingBin/BoxTextured.gltf",
         "key 'buffers[0].uri': expected 840 bytes in a data URI or a file at a relative path, found 'BoxTextured0.bin': no such "
         "file"},
        {"IndexOutOfRange/IndexOutOfRange.gltf",
         "key 'meshes[0].primitives[0].indices': expected indices below 24, found 255 at 0"},
        {"BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb",
         "key 'meshes[0].primitives[0].attributes.POSITION': expected finite numbers, found infinity in element 0"},
        {"wrongTypes/badUint.gltf",
         "key 'materials[0].pbrMetallicRoughness.baseColorTexture.index': expected an index below 1, the number of textures, "
         "found -1"},
    };
    for (const auto& [name, message] : models) {
        const std::string path = (kModels / name).string();
        EXPECT_EQ(readModel(path).message(), path + ": " + message);
    }
}

/** Lit by the nodekit: a box whose base colour texture is red and green above blue and white, seen from the front (glTF's +Z, -Y
 * here). */
TEST(GltfPicture, ABoxIsUprightInItsColors)
{
    // A PNG of 2 x 2 pixels.
    const std::string png =
        "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM/4EAAB/uBfvxq7p3AAAAAElFTkSuQmCC";
    File file;
    json primitive = {{"attributes",
                       {{"POSITION", file.vec3({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0})},
                        {"NORMAL", file.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})},
                        {"TEXCOORD_0", file.vec2({0, 1, 1, 1, 1, 0, 0, 0})}}},
                      {"indices", file.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, kUShort, "SCALAR", 1)}};
    file.add("images", {{"uri", "data:image/png;base64," + png}});
    file.add("textures", {{"source", 0}, {"sampler", 0}});
    file.add("samplers", {{"magFilter", 9728}, {"minFilter", 9728}});
    primitive["material"] =
        file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}});
    file.show(primitive);

    osg::ref_ptr<osgEnvLight::LitScene> lit = makeLit(constantMap(1.0));
    lit->addChild(readNode(file, ""));
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -5, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    const Picture picture = renderer.render(lit, 2);
    const auto colorAt = [&](double x, double z) {
        const osg::Vec2d p = renderer.pixelOf(osg::Vec3d(x, 0, z));
        return picture.color(int(p.x()), int(p.y()));
    };
    const auto isMostly = [](const osg::Vec3d& c, int channel) {
        for (int i = 0; i < 3; ++i)
            if (i != channel && c[i] > 0.2 * c[channel]) return false;
        return c[channel] > 0.5;
    };
    EXPECT_TRUE(isMostly(colorAt(-.5, .5), 0));
    EXPECT_TRUE(isMostly(colorAt(.5, .5), 1));
    EXPECT_TRUE(isMostly(colorAt(-.5, -.5), 2));
    const osg::Vec3d white = colorAt(.5, -.5);
    EXPECT_GT(std::min({white.x(), white.y(), white.z()}), 0.8);
}
