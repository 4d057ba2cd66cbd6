// SPDX-License-Identifier: MIT
// The exposure that a picture begins with, against skies whose irradiance is known in closed form.
#include "environment/Exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Exposure_test
{

using osgEnvLight::EnvironmentMap;
using osgEnvLight::Radiosity;

namespace
{

osg::ref_ptr<const osgEnvLight::RadianceMap> sky(const std::function<osg::Vec3d(const osg::Vec3d&)>& radiance, int width = 256)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, width / 2, 1, GL_RGB, GL_FLOAT);
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x) {
            const double theta = osg::PI * (y + 0.5) / (width / 2), phi = 2.0 * osg::PI * (0.5 - (x + 0.5) / width);
            const osg::Vec3d c = radiance({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
            float* p = reinterpret_cast<float*>(image->data(unsigned(x), unsigned(width / 2 - 1 - y)));
            for (int k = 0; k < 3; ++k) p[k] = float(c[k]);
        }
    osg::ref_ptr<EnvironmentMap> map = new EnvironmentMap(image.get());
    std::string error;
    return map->radiance(error);
}

}  // namespace

TEST(Exposure, OfSkiesKnownInClosedForm)
{
    const osg::Vec3d axis(0.6, 0.0, 0.8);
    for (double scale : {1e-6, 1.0, 1e6}) {
        const auto even = sky([&](const osg::Vec3d&) { return osg::Vec3d(scale, scale, scale); });
        EXPECT_NEAR(Radiosity::of(*even).greatest / scale, 1.0, 0.01);
        EXPECT_NEAR(Radiosity::of(*even).mean / scale, 1.0, 1e-3);
        EXPECT_NEAR(osgEnvLight::mapExposure(*even), std::log2(0.63 / scale), 0.01);
        // cos^16 about an axis: irradiance of a surface facing it 2 pi / 18, flux 2 pi / 17.
        const auto lobe = sky([&](const osg::Vec3d& d) {
            const double l = scale * std::pow(std::max(d * axis, 0.0), 16.0);
            return osg::Vec3d(l, 0.5 * l, 0.1 * l);
        });
        EXPECT_NEAR(Radiosity::of(*lobe).greatest / scale, 2.0 / 18.0, 0.01 * 2.0 / 18.0);
        EXPECT_NEAR(Radiosity::of(*lobe).mean / scale, 0.5 / 17.0, 0.01 * 0.5 / 17.0);
    }
}

TEST(Exposure, AtTheExtremes)
{
    EXPECT_EQ(osgEnvLight::mapExposure(*sky([](const osg::Vec3d&) { return osg::Vec3d(); })), 0.0);
    // One lit texel: all flux from one direction, four times the mean.
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(64, 32, 1, GL_RGB, GL_FLOAT);
    std::fill_n(reinterpret_cast<float*>(image->data()), 64 * 32 * 3, 0.0f);
    std::fill_n(reinterpret_cast<float*>(image->data(20, 12)), 3, 6e4f);
    std::string error;
    osg::ref_ptr<EnvironmentMap> sun = new EnvironmentMap(image.get());
    const Radiosity radiosity = Radiosity::of(*sun->radiance(error));
    EXPECT_NEAR(radiosity.greatest, 4.0 * radiosity.mean, 0.04 * radiosity.mean);
    osg::ref_ptr<osg::Image> texel = new osg::Image;
    texel->allocateImage(2, 1, 1, GL_RGB, GL_FLOAT);
    std::fill_n(reinterpret_cast<float*>(texel->data()), 6, 2.0f);
    osg::ref_ptr<EnvironmentMap> tiny = new EnvironmentMap(texel.get());
    EXPECT_TRUE(std::isfinite(osgEnvLight::mapExposure(*tiny->radiance(error)))) << error;
}

}  // namespace Exposure_test
