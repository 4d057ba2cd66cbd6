// SPDX-License-Identifier: MIT
// The octahedral map of a light list's irradiance against the sum over the list itself.
#include <gtest/gtest.h>

#include "lights/IrradianceMap.h"

#include "Maths.h"

namespace IrradianceMap_test
{

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::DirectionalLight;
using osgEnvLight::LightList;

namespace
{

class Map
{
  public:
    Map(const LightList& lights, double scale)
    {
        const osg::ref_ptr<osg::Texture2D> texture = osgEnvLight::irradianceTexture(lights, scale);
        const osg::Image& image = *texture->getImage();
        _side = image.s();
        for (int y = 0; y < _side; ++y)
            for (int x = 0; x < _side; ++x) {
                const float* t = reinterpret_cast<const float*>(image.data(unsigned(x), unsigned(y)));
                _texels.insert(_texels.end(), {t[0], t[1], t[2], 1.0f});
            }
    }
    vec3 at(const vec3& n) const { return glsl::octahedralLookup({_texels.data(), _side, _side}, n); }

  private:
    int _side;
    std::vector<float> _texels;
};

vec3 sumOver(const LightList& lights, const vec3& n)
{
    vec3 sum(0.0);
    for (const DirectionalLight& l : lights) {
        const double c = l.direction * osg::Vec3d(n.x, n.y, n.z);
        if (c > 0.0) sum += vec3(l.flux.x(), l.flux.y(), l.flux.z()) * (c / pi);
    }
    return sum;
}

LightList randomLights(size_t count, unsigned seed)
{
    Random random(seed);
    LightList lights;
    while (lights.size() < count) {
        const vec3 d = random.direction();
        lights.push_back({osg::Vec3d(d.x, d.y, d.z), osg::Vec3d(1, random.uniform(), random.uniform(0, 0.1))});
    }
    return lights;
}

// Largest and root mean square error of red over the largest value.
std::pair<double, double> errors(const LightList& lights)
{
    const Map map(lights, 1.0);
    Random random(91);
    double most = 0.0, worst = 0.0, squares = 0.0;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
        const vec3 n = random.direction();
        const double truth = sumOver(lights, n).x;
        const double error = std::abs(map.at(n).x - truth);
        most = std::max(most, truth);
        worst = std::max(worst, error);
        squares += error * error / count;
    }
    return {worst / most, std::sqrt(squares) / most};
}

}  // namespace

// The error is greatest at a light's horizon, where irradiance has a kink: bilinear filtering misses a quarter of what it changes
// by from a texel to the next. The longest diagonal of a texel is 4.6 radians over the side, times the root of 2.
TEST(IrradianceMap, IsTheSumOverTheList)
{
    const double texel = 4.6 * std::sqrt(2.0);
    const auto one = errors(randomLights(1, 92));
    EXPECT_LT(one.first, 0.25 * texel / osgEnvLight::irradianceSide(1));
    EXPECT_LT(one.second, 1e-3);  // below diffuseError's default, .3 %
    for (size_t count : {size_t(32), size_t(128), size_t(1024)}) {
        const auto many = errors(randomLights(count, 93));
        EXPECT_LT(many.first, 0.25 * texel / osgEnvLight::irradianceSide(count)) << count;
        EXPECT_LT(many.second, 3e-4) << count;
    }
}

// On the folded edges and at the corners the neighbours across the border are the right ones.
TEST(IrradianceMap, HasNoSeam)
{
    const LightList lights = randomLights(128, 94);
    const Map map(lights, 1.0);
    for (int i = 0; i < 1000; ++i) {
        const double t = 2.0 * pi * i / 1000.0;
        for (double z : {-1e-9, 1e-9}) {
            const vec3 n = glsl::normalize(vec3(std::cos(t), std::sin(t), z));
            EXPECT_NEAR(map.at(n).x / sumOver(lights, n).x, 1.0, 5e-3) << t;
        }
        const vec3 below = glsl::normalize(vec3(1e-3 * std::cos(t), 1e-3 * std::sin(t), -1.0));
        EXPECT_NEAR(map.at(below).x / sumOver(lights, below).x, 1.0, 5e-3) << t;
    }
}

TEST(IrradianceMap, Extremes)
{
    for (const vec3& n : {vec3(0, 0, 1), vec3(0, 0, -1), vec3(1, 0, 0)}) {
        EXPECT_EQ(Map(LightList(), 1.0).at(n), vec3(0.0));
        EXPECT_EQ(Map({{osg::Vec3d(0, 0, 1), osg::Vec3d()}}, 1.0).at(n), vec3(0.0));
    }
    const LightList huge = {{osg::Vec3d(0, 0, 1), osg::Vec3d(1e30, 1e-30, 0)}};
    const vec3 up = Map(huge, 1.0).at(vec3(0, 0, 1));
    EXPECT_NEAR(up.x * pi / 1e30, 1.0, 1e-3);
    EXPECT_NEAR(up.y * pi / 1e-30, 1.0, 1e-3);
    EXPECT_EQ(up.z, 0.0);
    EXPECT_NEAR(Map(huge, 1e-30).at(vec3(0, 0, 1)).x * pi, 1.0, 1e-3);
}

}  // namespace IrradianceMap_test
