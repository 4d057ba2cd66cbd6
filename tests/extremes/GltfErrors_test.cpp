// SPDX-License-Identifier: MIT
// The glTF reader against files that are wrong: one line that names the file, the property, what was expected and what was found.
#include "GltfFiles.h"

#include <osg/Notify>

#include <fstream>
#include <functional>
#include <limits>
#include <thread>

using namespace gltffiles;

namespace
{

/** A triangle with indices, a material with a texture, an animation and a skin: something of everything. */
File whole()
{
    File file;
    json primitive = file.triangle();
    primitive["attributes"]["JOINTS_0"] = file.accessor(std::vector<std::uint8_t>(12, 0), kUByte, "VEC4", 4);
    primitive["attributes"]["WEIGHTS_0"] = file.vec4({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    primitive["indices"] = file.accessor(std::vector<std::uint16_t>{0, 1, 2}, kUShort, "SCALAR", 1);
    primitive["material"] = file.add("materials", {{"name", "m"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    file.show(primitive);
    file.document["nodes"][0]["skin"] = 0;
    file.add("skins", {{"joints", {1}}});
    file.add("nodes", {{"name", "joint"}});
    const int input = file.scalars({0, 1});
    file.add("animations", {{"samplers", {{{"input", input}, {"output", file.vec3({0, 0, 0, 1, 0, 0})}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
    return file;
}

void expectFault(const std::function<void(json&)>& change, const std::string& message)
{
    File file = whole();
    change(file.document);
    EXPECT_EQ(messageOf(file), "stream: key '" + message);
}

std::string replaced(std::string text, std::size_t at, std::uint32_t value)
{
    for (std::size_t i = 0; i < 4; ++i) text[at + i] = char(value >> 8 * i & 255);
    return text;
}

}  // namespace

TEST(GltfErrors, TheWholeFileIsRight)
{
    EXPECT_TRUE(readNode(whole()));
}

TEST(GltfErrors, Containers)
{
    EXPECT_EQ(messageOf(std::string()), "stream: it is empty or cannot be read, expected a glTF file");
    EXPECT_EQ(messageOf("{\"asset\""),
              "stream: not valid JSON at line 1, column 9: syntax error while parsing object separator - unexpected end of "
              "input; expected ':'");
    EXPECT_EQ(messageOf("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 7\n"),
              "stream: it is the pointer of a file that Git LFS has not fetched, expected a glTF file");
    EXPECT_EQ(messageOf("[]"), "stream: the file: expected an object, found []");
    EXPECT_EQ(messageOf(std::string(100, '[')), "stream: not valid: nested deeper than 64 levels");
    const std::string binary = whole().binary();
    EXPECT_EQ(messageOf("glTF"), "stream: the file ends within its header, expected 12 bytes");
    EXPECT_EQ(messageOf(replaced(binary, 4, 1)), "stream: binary glTF of version 1, expected 2");
    EXPECT_EQ(messageOf(replaced(binary, 8, 0xffffffff)),
              "stream: its header says 4294967295 bytes, found " + std::to_string(binary.size()));
    EXPECT_EQ(messageOf(replaced(binary, 12, 0xfffffff0)),
              "stream: a chunk of 4294967280 bytes, found " + std::to_string(binary.size() - 20) + " after its header");
    EXPECT_EQ(messageOf(replaced(binary, 16, 0)), "stream: no JSON chunk, expected one after the header");
    for (std::size_t size = 0; size < binary.size(); ++size) EXPECT_NE(messageOf(binary.substr(0, size)), "") << size;
}

TEST(GltfErrors, Cameras)
{
    const auto expectCamera = [](const json& camera, const std::string& message) {
        expectFault([&](json& d) { d["cameras"] = {camera}; }, message);
    };
    expectCamera({{"name", "c"}}, "cameras[0].type': expected one of perspective, orthographic, found nothing");
    expectCamera({{"type", "fisheye"}}, "cameras[0].type': expected one of perspective, orthographic, found \"fisheye\"");
    expectCamera({{"type", "perspective"}}, "cameras[0].perspective': expected an object, found nothing");
    expectCamera({{"type", "perspective"}, {"perspective", {{"znear", 1}}}},
                 "cameras[0].perspective.yfov': expected a number from 0.001 to 3.1, found nothing");
    expectCamera({{"type", "perspective"}, {"perspective", {{"yfov", 0}}}},
                 "cameras[0].perspective.yfov': expected a number from 0.001 to 3.1, found 0");
    expectFault([](json& d) { d["nodes"][0]["camera"] = 0; },
                "nodes[0].camera': expected an index below 0, the number of cameras, found 0");
}

TEST(GltfErrors, TypesRangesAndIndices)
{
    expectFault([](json& d) { d.erase("asset"); }, "asset': expected an object, found nothing");
    expectFault([](json& d) { d["asset"]["version"] = "1.0"; }, "asset.version': expected 2.0, found \"1.0\"");
    expectFault([](json& d) { d["meshes"] = 5; }, "meshes': expected a list, found 5");
    expectFault([](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 7; },
                "meshes[0].primitives[0].mode': expected an integer from 0 to 6, found 7");
    expectFault([](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 77; },
                "meshes[0].primitives[0].attributes.POSITION': expected an index below 6, the number of accessors, found 77");
    expectFault([](json& d) { d["meshes"][0]["primitives"][0]["indices"] = -1; },
                "meshes[0].primitives[0].indices': expected an index below 6, the number of accessors, found -1");
    expectFault([](json& d) { d["accessors"][0]["componentType"] = 5124; },
                "accessors[0].componentType': expected one of 5120, 5121, 5122, 5123, 5125, 5126, found 5124");
    expectFault([](json& d) { d["accessors"][0]["type"] = "VEC5"; },
                "accessors[0].type': expected one of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4, found \"VEC5\"");
    expectFault([](json& d) { d["accessors"][0]["count"] = 0; },
                "accessors[0].count': expected an integer from 1 to 2147483647, found 0");
    expectFault([](json& d) { d["accessors"][0]["count"] = 1.5; },
                "accessors[0].count': expected an integer from 1 to 2147483647, found 1.5");
    expectFault(
        [](json& d) {
            d["nodes"][0]["matrix"] = {1, 2};
        },
        "nodes[0].matrix': expected a list of 16 elements, found [1,2]");
    expectFault([](json& d) { d["nodes"][0]["scale"] = {1, 1, 1e300}; }, "nodes[0].scale[2]': expected a number, found 1e+300");
    expectFault([](json& d) { d["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 1.5; },
                "materials[0].pbrMetallicRoughness.metallicFactor': expected a number from 0 to 1, found 1.5");
    expectFault([](json& d) { d["materials"][0]["normalTexture"]["index"] = 0; },
                "materials[0].normalTexture.index': expected an index below 0, the number of textures, found 0");
    expectFault([](json& d) { d["materials"][0]["alphaMode"] = "GLASS"; },
                "materials[0].alphaMode': expected one of OPAQUE, MASK, BLEND, found \"GLASS\"");
    expectFault([](json& d) { d["skins"][0]["joints"] = json::array(); },
                "skins[0].joints': expected a list of at least 1 element, found []");
    expectFault([](json& d) { d["scene"] = 0; }, "scene': expected an index below 0, the number of scenes, found 0");
}

TEST(GltfErrors, Extensions)
{
    expectFault(
        [](json& d) {
            d["extensionsRequired"] = {"KHR_materials_ior", "KHR_draco_mesh_compression"};
        },
        "extensionsRequired[1]': expected an extension that this reader knows, found \"KHR_draco_mesh_compression\"");
    File file = whole();
    file.document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    file.document["extensionsRequired"] = {"KHR_materials_ior"};
    EXPECT_TRUE(readNode(file));
}

TEST(GltfErrors, BuffersAndAccessors)
{
    expectFault([](json& d) { d["bufferViews"][0]["byteOffset"] = 1 << 20; },
                "bufferViews[0]': expected a view within the 136 bytes of its buffer, found 36 bytes at 1048576");
    expectFault([](json& d) { d["bufferViews"][0]["byteLength"] = 9007199254740992; },
                "bufferViews[0]': expected a view within the 136 bytes of its buffer, found 9007199254740992 bytes at 0");
    expectFault([](json& d) { d["accessors"][0]["count"] = 4; }, "accessors[0]': expected 48 bytes in its buffer view, found 36");
    expectFault([](json& d) { d["accessors"][0]["count"] = 2147483647; },
                "accessors[0]': expected 25769803764 bytes in its buffer view, found 36");
    expectFault([](json& d) { d["accessors"][0]["byteOffset"] = 9007199254740992; },
                "accessors[0]': expected 36 bytes in its buffer view, found 0");
    expectFault([](json& d) { d["accessors"][0]["type"] = "VEC2"; },
                "meshes[0].primitives[0].attributes.POSITION': expected an accessor of VEC3, found VEC2");
    expectFault(
        [](json& d) {
            d["accessors"][0].erase("bufferView");
            d["accessors"][0]["count"] = 100000000;
        },
        "meshes[0].primitives[0].attributes.POSITION': expected no more data than a file of this size describes, found "
        "2400000000 bytes of it beyond 64 times its buffers");
    expectFault([](json& d) { d["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); },
                "meshes[0].primitives[0].attributes.POSITION': expected an accessor of VEC3, found nothing");
    expectFault([](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 4; },
                "meshes[0].primitives[0].attributes.NORMAL': expected 3 elements as POSITION has, found 2");
    expectFault(
        [](json& d) {
            d["accessors"][0]["sparse"] = {
                {"count", 4}, {"indices", {{"bufferView", 0}, {"componentType", kUByte}}}, {"values", {{"bufferView", 0}}}};
        },
        "accessors[0].sparse.count': expected at most 3, found 4");
    expectFault(
        [](json& d) {
            d["accessors"][0]["sparse"] = {{"count", 3},
                                           {"indices", {{"bufferView", 0}, {"byteOffset", 34}, {"componentType", kUByte}}},
                                           {"values", {{"bufferView", 0}}}};
        },
        "accessors[0].sparse.indices': expected 3 bytes in its buffer view, found 2");
    expectFault(
        [](json& d) {
            d["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", 0}, {"byteOffset", 15}, {"componentType", kUByte}}},
                                           {"values", {{"bufferView", 0}}}};
        },
        "accessors[0].sparse.indices': expected indices below 3, found 63 at 0");
}

TEST(GltfErrors, Contents)
{
    const auto withPosition = [](float x) {
        File file;
        file.show({{"attributes", {{"POSITION", file.vec3({0, 0, 0, 0, x, 0})}}}});
        return messageOf(file);
    };
    const std::string finite = "stream: key 'meshes[0].primitives[0].attributes.POSITION': expected finite numbers, found ";
    EXPECT_EQ(withPosition(std::numeric_limits<float>::quiet_NaN()), finite + "NaN in element 1");
    EXPECT_EQ(withPosition(std::numeric_limits<float>::infinity()), finite + "infinity in element 1");

    File file;
    json primitive = file.triangle();
    primitive["indices"] = file.accessor(std::vector<std::uint8_t>{0, 1, 3}, kUByte, "SCALAR", 1);
    file.show(primitive);
    EXPECT_EQ(messageOf(file), "stream: key 'meshes[0].primitives[0].indices': expected indices below 3, found 3 at 2");
    expectFault([](json& d) { d["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0"); },
                "meshes[0].primitives[0].attributes.WEIGHTS_0': expected an accessor beside JOINTS_0, found nothing");
    expectFault([](json& d) { d["animations"][0]["samplers"][0]["output"] = 4; },
                "animations[0].samplers[0].output': expected an accessor of VEC3, found SCALAR");
    expectFault([](json& d) { d["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"; },
                "animations[0].samplers[0].output': expected 18 numbers for 2 times, found 6");
    expectFault(
        [](json& d) { d["accessors"][4]["bufferView"] = 0; },
        "animations[0].samplers[0].input': expected times that begin at 0 or later and increase, found one that does not at 1");
    expectFault([](json& d) { d["animations"][0]["channels"][0]["sampler"] = 3; },
                "animations[0].channels[0].sampler': expected an index below 1, the number of samplers, found 3");
    expectFault(
        [](json& d) { d["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
        "animations[0].channels[0].target.node': expected a node with translation, rotation and scale, found one with a matrix");
}

TEST(GltfErrors, Trees)
{
    expectFault([](json& d) { d["nodes"][0]["children"] = {0}; },
                "nodes[0]': expected at most 512 nodes above it, found more, or itself among them");
    expectFault(
        [](json& d) {
            d["nodes"][0]["children"] = {1, 1};
        },
        "nodes[0].children[1]': expected a node without another parent, found node 1, a child of node 0");
    expectFault(
        [](json& d) {
            d["nodes"][0]["children"] = {1};
            d["scenes"] = {{{"nodes", {0, 1}}}};
        },
        "scenes[0].nodes[1]': expected a node without a parent, once, found node 1, a child of node 0");
    expectFault(
        [](json& d) {
            d["scenes"] = {{{"nodes", {0}}}};
        },
        "skins[0].joints[0]': expected a node of the scene that shows the skin, found node 1");
    File deep;
    for (int i = 0; i < 2000; ++i) deep.add("nodes", {{"children", {i + 1}}});
    deep.add("nodes", json::object());
    EXPECT_EQ(messageOf(deep), "stream: key 'nodes[512]': expected at most 512 nodes above it, found more, or itself among them");
}

TEST(GltfErrors, Uris)
{
    const auto bufferUri = [](const std::string& uri) {
        json d = whole().document;
        d["buffers"] = {{{"byteLength", 184}, {"uri", uri}}};
        return messageOf(d.dump());
    };
    const std::string start =
        "stream: key 'buffers[0].uri': expected 184 bytes in a data URI or a file at a relative path, found ";
    EXPECT_EQ(bufferUri("/etc/passwd"), start + "the absolute path '/etc/passwd'");
    EXPECT_EQ(bufferUri("%2Fetc/passwd"), start + "the absolute path '/etc/passwd'");
    EXPECT_EQ(bufferUri("file:///etc/passwd"), start + "the absolute path '///etc/passwd'");
    EXPECT_EQ(bufferUri("C:\\a.bin"), start + "the scheme 'C:'");
    EXPECT_EQ(bufferUri("https://example.org/a.bin"), start + "the scheme 'https:'");
    EXPECT_EQ(bufferUri("no%20such.bin"), start + "'no such.bin': no such file");
    EXPECT_EQ(bufferUri("../../../../../../../../dev/zero"), start + "'../../../../../../../../dev/zero', which is not a file");
    EXPECT_EQ(bufferUri("data:;base64,AAAA"), start + "a data URI of 3 bytes");
    EXPECT_EQ(bufferUri("data:;base64,A*AA"), start + "a data URI whose base64 is damaged");
    EXPECT_EQ(bufferUri("data:text/plain,AAAA"), start + "a data URI that is not base64");
    EXPECT_EQ(bufferUri(""), start + "an empty URI");
    EXPECT_EQ(bufferUri("two\nlines"), start + "'two?lines': no such file");
    EXPECT_EQ(bufferUri(std::string(5000, 'x')).size(), 403u);
    File file = whole();
    file.document["buffers"] = {{{"byteLength", 184}}};
    file.buffer.clear();
    EXPECT_EQ(messageOf(file), "stream: key 'buffers[0]': expected a URI, found none");
}

TEST(GltfErrors, Images)
{
    const auto image = [](const std::string& bytes) {
        File file = whole();
        file.add("images", {{"uri", "data:image/png;base64," + base64(bytes)}});
        file.add("textures", {{"source", 0}});
        file.document["materials"][0]["normalTexture"] = {{"index", 0}};
        return messageOf(file);
    };
    const std::string start = "stream: key 'images[0]': expected ";
    EXPECT_EQ(image("nothing of the kind"), start + "a PNG or JPEG image of at most 16384 pixels a side, found something else");
    EXPECT_EQ(image("RIFF....WEBPVP8 "), start + "a PNG or JPEG image of at most 16384 pixels a side, found WebP");
    const std::string header("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
    const auto png = [&](unsigned char side) {
        return header + std::string({0, 0, char(side), 0, 0, 0, char(side), 0, 8, 2, 0, 0, 0, 0, 0, 0, 0});
    };
    EXPECT_EQ(image(png(16)), start + "as many pixels as a file of 33 bytes can hold, found 4096 x 4096");
    EXPECT_EQ(image(png(128)), start + "a PNG or JPEG image of at most 16384 pixels a side, found something else");
    EXPECT_EQ(image(png(0)), start + "a PNG or JPEG image of at most 16384 pixels a side, found something else");
    EXPECT_EQ(image(header + std::string("\0\0\0\2\0\0\0\2\10\2\0\0\0\0\0\0\0", 17)),
              start + "a PNG or JPEG image, found a damaged one");
}

TEST(GltfErrors, FilesThatAreNotThere)
{
    EXPECT_EQ(osgDB::Registry::instance()->readNode("/no/such.glb", nullptr).message(),
              "/no/such.glb: it is not there, expected a glTF file");
}

TEST(GltfErrors, EveryDamagedByteGivesASceneOrAMessage)
{
    const std::string text = whole().binary();
    int refused = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
        for (const int flip : {0x01, 0x10, 0x80}) {
            std::string damaged = text;
            damaged[i] = char(damaged[i] ^ flip);
            ReadResult result = readText(damaged);
            refused += result.validNode() ? 0 : 1;
            ASSERT_NE(result.validNode(), !result.message().empty());
            ASSERT_EQ(result.message().find('\n'), std::string::npos) << result.message();
            ASSERT_TRUE(result.validNode() || result.message().rfind("stream: ", 0) == 0u) << result.message();
        }
    EXPECT_GT(refused, 0);
}

TEST(GltfErrors, AnyThreadAnyLocale)
{
    class Comma : public std::numpunct<char>
    {
        char do_decimal_point() const override { return ','; }
        std::string do_grouping() const override { return "\1"; }
    };
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
    const std::string text = whole().text();
    std::vector<std::string> failures(4);
    std::vector<std::thread> threads;
    for (std::string& failure : failures)
        threads.emplace_back([&] {
            for (int i = 0; i < 20; ++i) failure += readText(text).message();
        });
    for (std::thread& thread : threads) thread.join();
    for (const std::string& failure : failures) EXPECT_EQ(failure, "");
    expectFault([](json& d) { d["nodes"][0]["scale"] = {1, 1, 1e300}; }, "nodes[0].scale[2]': expected a number, found 1e+300");
    std::locale::global(before);
}
