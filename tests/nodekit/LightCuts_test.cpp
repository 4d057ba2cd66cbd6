// SPDX-License-Identifier: MIT
// Many area lights, lit by cuts through their tree: beside the sum of pictures in which few of them are lit, each by its closed
// form.
#include <Maths.h>

#include "AreaLightScene.h"

namespace LightCuts_test
{

using osgEnvLight::AreaLight;
using osgEnvLight::Material;

namespace
{

const unsigned lights = 60, few = 6;

// Rectangles, discs, spheres and triangles over a floor, some lit on both sides, some so near to it that they are no points.
osg::ref_ptr<AreaLight> lightNumber(unsigned i)
{
    testmaths::Random random(i + 1);
    const double x = random.uniform(-3, 3), y = random.uniform(-3, 3), size = random.uniform(0.02, 0.2);
    const osg::Vec3d center(x, y, random.uniform(0.3, 1.5));
    const glsl::vec3 direction = random.direction();
    const osg::Vec3d facing(direction.x, direction.y, direction.z - 0.5);
    osg::ref_ptr<AreaLight> light = new AreaLight;
    osg::Vec3d u = facing ^ osg::Vec3d(0.3, 1, 0.2);
    u.normalize();
    osg::Vec3d v = facing ^ u;
    v.normalize();
    const osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (const osg::Vec3d& p : {u, v, -u - v}) corners->push_back(osg::Vec3(center + p * size));
    switch (i % 4) {
        case 0:
            light->setRectangle(center, u * size, v * size * 0.5);
            break;
        case 1:
            light->setDisc(center, facing, size);
            break;
        case 2:
            light->setSphere(center, size);
            break;
        default:
            light->setPolygon(*corners);
            break;
    }
    light->setTwoSided(i % 3 == 0);
    const double red = random.uniform(1, 20), green = random.uniform(1, 20);
    light->setRadiance(osg::Vec3f(float(red), float(green), float(random.uniform(1, 20))));
    light->setVisible(false);
    return light;
}

class LightCuts : public AreaLightScene
{
  protected:
    LightCuts() : group(new osg::Group)
    {
        lit->getSettings()->occlusion = false;
        lit->addChild(group);
    }

    // Of lights from first on.
    Picture shown(unsigned first, unsigned count)
    {
        group->removeChildren(0, group->getNumChildren());
        for (unsigned i = first; i < first + count; ++i) group->addChild(lightNumber(i));
        return renderer.render(lit, 2);
    }

    Picture sumOfFew()
    {
        Picture sum = shown(0, few);
        for (unsigned i = few; i < lights; i += few) {
            const Picture part = shown(i, few);
            for (size_t k = 0; k < sum.rgba.size(); ++k) sum.rgba[k] += k % 4 == 3 ? 0.0f : part.rgba[k];
        }
        return sum;
    }

    const osg::ref_ptr<osg::Group> group;
};

}  // namespace

// Diffuse layers, rough and not, and metals. The pictures differ by what half floats round: 1/2048 of each of eleven pictures.
TEST_F(LightCuts, WithoutErrorAreTheSumOfTheClosedForms)
{
    lit->addChild(makeSphere(osg::Vec3d(-1, 0, 0.5), 0.5, 24));
    for (const double roughness : {0.1, 0.5}) {
        const osg::ref_ptr<osg::Geode> metal = makeSphere(osg::Vec3d(4.0 * roughness, -1, 0.4), 0.4, 24);
        Material::setCookTorrance(*metal->getOrCreateStateSet(), osg::Vec3f(0.9f, 0.7f, 0.4f), 1.0f, float(roughness));
        lit->addChild(metal);
    }
    const Picture sum = sumOfFew();
    lit->getSettings()->lightCutError = 0.0f;
    const Picture all = shown(0, lights);
    EXPECT_NE(std::string::npos, lit->plan().reason("arealights").find("by a cut through a tree"));
    for (size_t k = 0; k < sum.rgba.size(); ++k)
        ASSERT_NEAR(sum.rgba[k], all.rgba[k], 0.01 * sum.rgba[k] + 1e-3) << "at " << k / 4 % size << ", " << k / 4 / size;
}

// Each cluster is off by a twentieth of all light at most, and mostly by far less.
TEST_F(LightCuts, AreOffByLessThanTheirBound)
{
    lit->getSettings()->lightCutError = 0.0f;
    const Picture all = shown(0, lights);
    double former = 0.0;
    for (const float bound : {0.05f, 1.0f}) {
        lit->getSettings()->lightCutError = bound;
        const Picture cut = renderer.render(lit, 2);
        double square = 0.0, total = 0.0;
        for (size_t k = 0; k < all.rgba.size(); ++k) {
            ASSERT_NEAR(all.rgba[k], cut.rgba[k], double(bound) * all.rgba[k] + 1e-3);
            square += std::pow(all.rgba[k] - cut.rgba[k], 2.0);
            total += std::pow(double(all.rgba[k]), 2.0);
        }
        const double error = std::sqrt(square / total);
        EXPECT_LT(error, 0.1 * bound);
        EXPECT_GT(error, 2.0 * former);
        former = error;
    }
}

}  // namespace LightCuts_test
