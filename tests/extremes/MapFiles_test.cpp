// SPDX-License-Identifier: MIT
// Environment maps in files that OSG's own plugins read: what they leave out or turn over, and the messages about it.
#include <Layouts.h>
#include <Process.h>

#include <gtest/gtest.h>

#include <array>

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::EnvironmentMap;
using osgEnvLight::MapLayout;

namespace
{

void append(std::string& file, std::uint32_t word)
{
    file.append(reinterpret_cast<const char*>(&word), 4);
}

// RGBA floats, rows from the top, slice after slice.
std::string texelsOf(const LaidOut& l, const osg::ref_ptr<osg::Image>& image)
{
    std::string data;
    for (int slice = 0; slice < l.slices; ++slice)
        for (int y = 0; y < l.height; ++y)
            for (int x = 0; x < l.width; ++x) {
                const float* t = texelOf(*image, x, y, slice);
                const float rgba[4] = {t[0], t[1], t[2], 1.0f};
                data.append(reinterpret_cast<const char*>(rgba), sizeof(rgba));
            }
    return data;
}

enum class Kind { FLAT, VOLUME, CUBE, CUBE_DX10 };

// [Microsoft, DDS_HEADER]: A32B32G32R32F.
std::string dds(const LaidOut& l, const std::string& texels, Kind kind)
{
    const bool volume = kind == Kind::VOLUME;
    std::array<std::uint32_t, 31> header = {};
    header[0] = 124;
    header[1] = 0x1007 | (volume ? 0x800000 : 0);
    header[2] = std::uint32_t(l.height);
    header[3] = std::uint32_t(l.width);
    header[5] = volume ? 6 : 0;
    header[18] = 32;
    header[19] = 4;                                           // fourCC
    header[20] = kind == Kind::CUBE_DX10 ? 0x30315844 : 116;  // "DX10", D3DFMT_A32B32G32R32F
    header[26] = 0x1008;
    header[27] = volume ? 0x200000 : kind == Kind::CUBE ? 0xfe00 : 0;
    std::string file = "DDS ";
    for (std::uint32_t word : header) append(file, word);
    if (kind == Kind::CUBE_DX10)
        for (std::uint32_t word : {2u, 3u, 4u, 1u, 0u})
            append(file, word);  // DXGI_FORMAT_R32G32B32A32_FLOAT, 2D, cube, 1 of them
    return file + texels;
}

// [Khronos, KTX file format 1]: GL_RGBA32F. All six faces are one level.
std::string ktx(const LaidOut& l, const std::string& texels, Kind kind)
{
    std::string file("\xABKTX 11\xBB\r\n\x1A\n", 12);
    const bool volume = kind == Kind::VOLUME;
    const auto size = std::uint32_t(texels.size());
    for (std::uint32_t word :
         {0x04030201u, 0x1406u, 4u, 0x1908u, 0x8814u, 0x1908u, std::uint32_t(l.width), std::uint32_t(l.height), volume ? 6u : 0u,
          0u, kind == Kind::CUBE ? 6u : 1u, 1u, 0u, kind == Kind::CUBE ? size / 6 : size})
        append(file, word);
    return file + texels;
}

vec3 colours(const vec3& d)
{
    return vec3(1.5) + d;
}

const LaidOut faces = {MapLayout::CUBE, 16, 16, 6};

}  // namespace

class MapFiles : public testing::Test
{
  protected:
    std::string load(const std::string& name, const std::string& content, MapLayout layout = MapLayout::AUTO)
    {
        path = folder.write(name, content);
        std::string error;
        environment = new EnvironmentMap;
        environment->setLayout(layout);
        const bool loaded = environment->load(path, options.get(), error);
        EXPECT_EQ(loaded, error.empty());
        return error;
    }

    // Every texel of the map that was loaded is as the direction says.
    void expectColours()
    {
        std::string error;
        const osg::ref_ptr<const osgEnvLight::RadianceMap> map = environment->radiance(error);
        ASSERT_TRUE(map) << error;
        for (int y = 0; y < map->height; ++y)
            for (int x = 0; x < map->width; ++x) {
                const vec3 expected = colours(texelDirection(x, y, map->width, map->height));
                for (int k = 0; k < 3; ++k) ASSERT_NEAR(map->texel(x, y)[k], expected[k], 0.1) << x << " " << y << " " << k;
            }
    }

    TemporaryFolder folder;
    std::string path;
    osg::ref_ptr<osgDB::Options> options;
    osg::ref_ptr<EnvironmentMap> environment;
};

TEST_F(MapFiles, SixSlicesAreTheFacesOfACube)
{
    const std::string texels = texelsOf(faces, makeImage(faces, colours));
    EXPECT_EQ(load("faces.dds", dds(faces, texels, Kind::VOLUME)), "");
    expectColours();
    EXPECT_EQ(load("faces.ktx", ktx(faces, texels, Kind::VOLUME)), "");
    expectColours();
}

TEST_F(MapFiles, CubeMapsThatThePluginsDoNotReadAreRefusedByName)
{
    const std::string texels = texelsOf(faces, makeImage(faces, colours));
    const std::pair<const char*, std::string> cases[] = {{"cube.dds", dds(faces, texels, Kind::CUBE)},
                                                         {"cube10.dds", dds(faces, texels, Kind::CUBE_DX10)},
                                                         {"cube.ktx", ktx(faces, texels, Kind::CUBE)}};
    for (const auto& [name, content] : cases)
        for (MapLayout layout : {MapLayout::AUTO, MapLayout::CUBE, MapLayout::ANGULAR}) {
            const std::string error = load(name, content, layout);
            for (const std::string& word : {path, std::string("cube map"), std::string("six faces")})
                EXPECT_NE(error.find(word), std::string::npos) << error;
            EXPECT_EQ(environment->getMap(), "sky");
        }
}

TEST_F(MapFiles, DdsStartsAtTheTop)
{
    for (const char* option : {"", "dds_flip"})
        for (const LaidOut& l :
             {LaidOut{MapLayout::HORIZONTAL_CROSS, 64, 48, 1}, LaidOut{MapLayout::VERTICAL_CROSS, 48, 64, 1}}) {
            options = new osgDB::Options(option);
            EXPECT_EQ(load("cross.dds", dds(l, texelsOf(l, makeImage(l, colours)), Kind::FLAT)), "");
            expectColours();
            EXPECT_EQ(load("faces.dds", dds(faces, texelsOf(faces, makeImage(faces, colours)), Kind::VOLUME)), "");
            expectColours();
        }
}

TEST_F(MapFiles, TruncatedAndStrangeTexturesAreRefusedByName)
{
    const std::string texels = texelsOf(faces, makeImage(faces, colours));
    for (const char* name : {"broken.dds", "broken.ktx"})
        for (const std::string& content :
             {std::string(), std::string("D"), std::string("DDS "), dds(faces, texels, Kind::VOLUME).substr(0, 200),
              ktx(faces, texels, Kind::VOLUME).substr(0, 60)}) {
            const std::string error = load(name, content);
            EXPECT_NE(error.find(path), std::string::npos) << name << " " << content.size() << ": " << error;
        }
}

TEST_F(MapFiles, AFileOfNoBytesIsSaidToBeEmpty)
{
    for (const char* name :
         {"empty.exr", "empty.hdr", "empty.pic", "empty.png", "empty.jpg", "empty.tif", "empty.dds", "empty.ktx"}) {
        const std::string error = load(name, "");
        EXPECT_EQ(error, "environment map '" + path + "' is empty (0 bytes)");
    }
    EXPECT_EQ(environment->getMap(), "sky");
}

TEST_F(MapFiles, ASquareNeedsALayout)
{
    const LaidOut l = {MapLayout::OCTAHEDRAL, 32, 32, 1};
    const std::string content = dds(l, texelsOf(l, makeImage(l, colours)), Kind::FLAT);
    const std::string error = load("square.dds", content);
    for (const std::string& word : {path, std::string("is 32x32"), std::string("octahedral")})
        EXPECT_NE(error.find(word), std::string::npos) << error;
    EXPECT_EQ(load("square.dds", content, MapLayout::OCTAHEDRAL), "");
    expectColours();
}
