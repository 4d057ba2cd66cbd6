// SPDX-License-Identifier: MIT
// Images as lights: their colours, averaged over parts, and the points on a light that shows one.
#include "surface/EmitterPicture.h"

#include "shadow/EmitterPoints.h"

#include <Halves.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace EmitterPicture_test
{

using osgEnvLight::AreaLight;
using osgEnvLight::Emitter;
using osgEnvLight::EmitterPicture;
using osgEnvLight::EmitterPoint;

namespace
{

// Radiance x in red, y in green, x y in blue; x and y at the middles of pixels, from 0 to 1.
osg::ref_ptr<osg::Image> makeRamp(int width, int height, GLenum format = GL_RGB)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, format, GL_FLOAT);
    for (int t = 0; t < height; ++t)
        for (int s = 0; s < width; ++s) {
            const float x = (float(s) + 0.5f) / float(width), y = (float(t) + 0.5f) / float(height);
            image->setColor(osg::Vec4(x, y, x * y, 1), unsigned(s), unsigned(t));
        }
    return image;
}

osg::ref_ptr<const EmitterPicture> made(const osg::Image& image)
{
    std::string problem;
    const osg::ref_ptr<const EmitterPicture> picture = EmitterPicture::create(image, problem);
    EXPECT_EQ("", problem);
    return picture;
}

std::string problemOf(const osg::Image& image)
{
    std::string problem;
    EXPECT_EQ(nullptr, EmitterPicture::create(image, problem));
    return problem;
}

void expectNear(const osg::Vec3d& expected, const osg::Vec3d& v, double slack, const std::string& what)
{
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(expected[k], v[k], slack) << what << ", channel " << k;
}

Emitter screen(osg::Image* image, const osg::Matrixd& matrix = osg::Matrixd())
{
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setRectangle(osg::Vec3d(1, 2, 3), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 0, 1));
    light->setRadiance(osg::Vec3f(4, 4, 4));
    light->setImage(image);
    Emitter e;
    EXPECT_EQ("", osgEnvLight::placeEmitter(*light, matrix, e));
    return e;
}

}  // namespace

TEST(EmitterPicture, MeansOfPartsAreIntegralsOverThem)
{
    // Smaller than the grid, larger, and neither a multiple of the other. The steps of pixels differ from the ramp by less than
    // half of one, and in a mean the less the more of them it has.
    for (const auto& [width, height] : {std::pair(7, 5), std::pair(256, 256), std::pair(300, 1000)}) {
        const osg::ref_ptr<const EmitterPicture> picture = made(*makeRamp(width, height));
        const std::string what = std::to_string(width) + " x " + std::to_string(height);
        expectNear(osg::Vec3d(0.5, 0.5, 0.25), picture->mean(), 1e-6, what);
        for (const osg::Vec2d& c : {osg::Vec2d(0.5, 0.5), osg::Vec2d(0.3, 0.7), osg::Vec2d(0.81, 0.19)}) {
            const osg::Vec3d mean = picture->mean(c, osg::Vec2d(0.15, 0.1));
            expectNear(osg::Vec3d(c[0], c[1], c[0] * c[1]), mean, 0.25 / std::min(width, height), what);
        }
        // What reaches beyond the border is cut off: the mean is over x 0 to .1 and y .9 to 1.
        expectNear(osg::Vec3d(0.05, 0.95, 0.0475), picture->mean(osg::Vec2d(0, 1), osg::Vec2d(0.1, 0.1)),
                   0.5 / std::min(width, height), what);
    }
}

TEST(EmitterPicture, BytesAreDecodedAndTheirOrderIsKept)
{
    const unsigned char bytes[] = {255, 188, 0, 128};
    for (const int name : {GL_RGB, GL_RGBA, GL_BGR, GL_BGRA}) {
        const auto format = GLenum(name);
        osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(3, 2, 1, format, GL_UNSIGNED_BYTE);
        for (unsigned s = 0; s < 3; ++s)
            for (unsigned t = 0; t < 2; ++t) std::copy_n(bytes, image->getPixelSizeInBits() / 8, image->data(s, t));
        osg::Vec3d expected(1.0, std::pow((188 / 255.0 + 0.055) / 1.055, 2.4), 0.0);
        if (format == GL_BGR || format == GL_BGRA) std::swap(expected[0], expected[2]);
        expectNear(expected, made(*image)->mean(), 1e-9, std::to_string(format));
    }
    osg::ref_ptr<osg::Image> gray = new osg::Image;
    gray->allocateImage(1, 1, 1, GL_LUMINANCE, GL_UNSIGNED_BYTE);
    gray->data()[0] = 255;
    expectNear(osg::Vec3d(1, 1, 1), made(*gray)->mean(), 1e-6, "luminance");
    osg::ref_ptr<osg::Image> fine = new osg::Image;
    fine->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_SHORT);
    for (unsigned k = 0; k < 3; ++k) reinterpret_cast<unsigned short*>(fine->data())[k] = 32768;
    const double half = std::pow((32768 / 65535.0 + 0.055) / 1.055, 2.4);
    expectNear(osg::Vec3d(half, half, half), made(*fine)->mean(), 1e-6, "16 bits");
}

TEST(EmitterPicture, TheTopOfAnImageFromTheTopIsUp)
{
    const osg::ref_ptr<osg::Image> image = makeRamp(8, 8);
    image->setOrigin(osg::Image::TOP_LEFT);
    const osg::ref_ptr<const EmitterPicture> picture = made(*image);
    EXPECT_NEAR(0.75, picture->mean(osg::Vec2d(0.5, 0.25), osg::Vec2d(0.5, 0.25))[1], 1e-6);
}

TEST(EmitterPicture, WhatCanNotLightIsNamed)
{
    const osg::ref_ptr<osg::Image> image = makeRamp(4, 3);
    image->setColor(osg::Vec4(0, std::numeric_limits<float>::quiet_NaN(), 0, 1), 2, 1);
    EXPECT_EQ("has an image whose pixel (2, 1), from the lower left, is nan, expected 0 or more", problemOf(*image));
    image->setColor(osg::Vec4(0, 0, -1, 1), 2, 1);
    EXPECT_EQ("has an image whose pixel (2, 1), from the lower left, is -1, expected 0 or more", problemOf(*image));
    EXPECT_EQ("has an image without pixels", problemOf(*osg::ref_ptr<osg::Image>(new osg::Image)));
    const osg::ref_ptr<osg::Image> compressed = new osg::Image;
    compressed->setImage(4, 4, 1, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, GL_UNSIGNED_BYTE,
                         new unsigned char[8](), osg::Image::USE_NEW_DELETE);
    EXPECT_EQ("has a compressed image", problemOf(*compressed));
}

TEST(EmitterPicture, OfABlackChannelNothingIsSent)
{
    const osg::ref_ptr<osg::Image> image = makeHalves();
    const Emitter e = screen(image);
    EXPECT_EQ(0.0, e.radiance[1]);
    const float* pixels = reinterpret_cast<const float*>(e.picture->relative().data());
    for (unsigned i = 0; i < EmitterPicture::side * EmitterPicture::side; ++i) {
        ASSERT_EQ(0.0f, pixels[3 * i + 1]);
        ASSERT_TRUE(std::isfinite(pixels[3 * i]));
    }
}

TEST(EmitterPicture, PointsSendWhatTheLightDoesInTheColoursOfTheirPlaces)
{
    const osg::ref_ptr<osg::Image> image = makeHalves();
    const Emitter e = screen(image);
    const std::vector<EmitterPoint> points = osgEnvLight::emitterPoints({e}, 64);
    osg::Vec3d power, even;
    for (const EmitterPoint& p : points) {
        power += p.power;
        even += p.even;
        // Half of a part's width is the square root of area over points over 2: nearer to the middle it shows both colours.
        const double x = p.position[0] - e.center[0], half = 0.5 * std::sqrt(e.area / 64);
        EXPECT_TRUE(std::abs(x) <= half || p.power[x < 0.0 ? 2 : 0] == 0.0) << x;
    }
    expectNear(e.radiance * e.area, power, 1e-9, "power");
    expectNear(e.radiance * e.area, even, 1e-9, "even");
    EXPECT_NEAR(2.0 * e.area, power[0], 1e-9);
}

// v is turned over to keep the lit side, but what is shown stays where the mirror shows it.
TEST(EmitterPicture, StaysUprightInAMirror)
{
    const osg::ref_ptr<osg::Image> image = makeRamp(16, 16);  // green grows upwards
    for (const osg::Matrixd& matrix : {osg::Matrixd(), osg::Matrixd::scale(-1, 1, 1)}) {
        const Emitter e = screen(image, matrix);
        for (const EmitterPoint& p : osgEnvLight::emitterPoints({e}, 64)) {
            const double up = 0.5 + 0.5 * (p.position[2] - e.center[2]);
            EXPECT_NEAR(up, p.power[1] / (4.0 * p.area), 0.12) << up;  // points near the border stand for what is within it
        }
    }
}

TEST(EmitterPicture, IsMadeAnewWhenTheImageChangesAndNotBefore)
{
    const osg::ref_ptr<osg::Image> image = makeHalves();
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setImage(image);
    Emitter first, second, third;
    EXPECT_EQ("", osgEnvLight::placeEmitter(*light, osg::Matrixd(), first));
    EXPECT_EQ("", osgEnvLight::placeEmitter(*light, osg::Matrixd(), second));
    EXPECT_TRUE(first == second);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(255));
    image->dirty();
    EXPECT_EQ("", osgEnvLight::placeEmitter(*light, osg::Matrixd(), third));
    EXPECT_FALSE(first == third);
    EXPECT_EQ(osg::Vec3d(1, 1, 1), third.radiance);
}

TEST(EmitterPicture, AFluxIsAllThatIsSent)
{
    const osg::ref_ptr<osg::Image> image = makeHalves();
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setImage(image);
    light->setFlux(osg::Vec3f(3, 3, 3));
    Emitter e;
    EXPECT_EQ("", osgEnvLight::placeEmitter(*light, osg::Matrixd(), e));
    expectNear(osg::Vec3d(3, 0, 3), e.radiance * (e.area * osg::PI), 1e-6, "flux");  // green has nothing to be sent by
    EXPECT_NEAR(2.0 * e.radiance[0], e.tint[0], 1e-9);
    light->setShape(AreaLight::DISC);
    EXPECT_EQ("has an image but is no rectangle", osgEnvLight::placeEmitter(*light, osg::Matrixd(), e));
}

}  // namespace EmitterPicture_test
