// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <osgEnvLight/LightTexture>

#include "Maps.h"

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::DirectionalLight;
using osgEnvLight::LightList;

namespace
{

LightList listOf(unsigned count)
{
    LightList lights;
    for (const vec3& d : spiral(int(count))) {
        const double i = double(lights.size());
        lights.push_back({osg::Vec3d(d.x, d.y, d.z), osg::Vec3d(1.0 + i, 2.0 + i, 3.0 + i)});
    }
    return lights;
}

const float* texel(const osg::Texture2D& texture, unsigned x, unsigned y)
{
    return reinterpret_cast<const float*>(texture.getImage()->data(x, y));
}

}  // namespace

TEST(LightTexture, GroupsAndRows)
{
    const LightList lights = listOf(64);
    const osg::ref_ptr<osg::Texture2D> texture = osgEnvLight::lightTexture(lights, 16, 0.5);
    ASSERT_EQ(texture->getImage()->s(), 4);
    ASSERT_EQ(texture->getImage()->t(), 32);
    EXPECT_EQ(texture->getInternalFormat(), GL_RGBA32F_ARB);
    EXPECT_EQ(texture->getFilter(osg::Texture::MAG_FILTER), osg::Texture::NEAREST);
    for (unsigned i = 0; i < 64; ++i)
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(texel(*texture, i / 16, 2 * (i % 16))[k], float(lights[i].direction[k]));
            EXPECT_EQ(texel(*texture, i / 16, 2 * (i % 16) + 1)[k], float(0.5 * lights[i].flux[k]));
        }
}

TEST(LightTexture, FilledUpWithDarkLights)
{
    const LightList lights = listOf(35);
    const osg::ref_ptr<osg::Texture2D> texture = osgEnvLight::lightTexture(lights, 16, 1.0);
    ASSERT_EQ(texture->getImage()->s(), 3);
    osg::Vec3d sum;
    osg::Vec3d exact;
    for (unsigned x = 0; x < 3; ++x)
        for (unsigned q = 0; q < 16; ++q)
            for (int k = 0; k < 3; ++k) sum[k] += double(texel(*texture, x, 2 * q + 1)[k]);
    for (const DirectionalLight& l : lights) exact += l.flux;
    EXPECT_EQ(sum, exact);  // whole numbers
    EXPECT_EQ(texel(*texture, 2, 31)[0], 0.0f);
}

TEST(LightTexture, EmptyList)
{
    const osg::ref_ptr<osg::Texture2D> texture = osgEnvLight::lightTexture({}, 16, 1.0);
    ASSERT_EQ(texture->getImage()->s(), 1);
    ASSERT_EQ(texture->getImage()->t(), 32);
    for (unsigned y = 0; y < 32; ++y)
        for (int k = 0; k < 4; ++k) EXPECT_EQ(texel(*texture, 0, y)[k], 0.0f);
}

TEST(LightTexture, DealingKeepsTheLights)
{
    const LightList lights = listOf(1009);
    const LightList dealt = osgEnvLight::dealt(lights);
    ASSERT_EQ(dealt.size(), lights.size());
    std::vector<double> a;
    std::vector<double> b;
    for (size_t i = 0; i < lights.size(); ++i) {
        a.push_back(lights[i].flux[0]);
        b.push_back(dealt[i].flux[0]);
        const auto original = size_t(dealt[i].flux[0] - 1.0);
        EXPECT_EQ(dealt[i].direction, lights[original].direction);
    }
    std::sort(b.begin(), b.end());
    EXPECT_EQ(a, b);
}

TEST(LightTexture, TheCurveHasNoJumps)
{
    // Hilbert's curve keeps |p(a) - p(b)|^2 <= 6 |a - b| [Bauman 2006] on the unit square. Of 4096 even directions at least
    // 4 fall into each of 16 x 16 cells, so that neighbours in the list are less than two cells apart along the curve.
    const LightList dealt = osgEnvLight::dealt(listOf(4096));
    double longest = 0.0;
    for (size_t i = 1; i < dealt.size(); ++i) {
        auto square = [](const osg::Vec3d& d) { return glsl::octahedralFromDirection(vec3(d[0], d[1], d[2])); };
        longest = std::max(longest, glsl::length(square(dealt[i].direction) - square(dealt[i - 1].direction)));
    }
    EXPECT_LT(longest, std::sqrt(6.0 * 2.0 / 256.0));
}

TEST(LightTexture, EachGroupIsAGoodSampleOfTheMap)
{
    // sampling.md 6, real maps: a group's irradiance spreads by .062 about the groups' mean when dealt along the curve, .154
    // at random. Even lights of equal flux are an easier map: .0244 (measured), and .037 along a curve with jumps.
    LightList lights = listOf(1024);
    for (DirectionalLight& l : lights) l.flux = osg::Vec3d(1, 1, 1);
    const LightList dealt = osgEnvLight::dealt(lights);
    double spread = 0.0;
    const std::vector<vec3> normals = spiral(64);
    for (const vec3& n : normals) {
        double group[16] = {};
        double mean = 0.0;
        for (size_t i = 0; i < dealt.size(); ++i) {
            const double e =
                std::max(0.0, n.x * dealt[i].direction[0] + n.y * dealt[i].direction[1] + n.z * dealt[i].direction[2]);
            group[i % 16] += e;
            mean += e / 16.0;
        }
        for (double g : group) spread += (g / mean - 1.0) * (g / mean - 1.0) / 16.0 / double(normals.size());
    }
    EXPECT_LT(std::sqrt(spread), 0.03);
}
