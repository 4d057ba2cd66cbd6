// SPDX-License-Identifier: MIT
// Textures whose sizes are no powers of two lie in the reference where the rasteriser puts them.
#include <metrics/Mask>

#include <osg/Geometry>
#include <osg/Texture2D>

#include <gtest/gtest.h>

#include <cmath>

#include "Traced.h"

namespace TextureSizes_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Mask;
using osgEnvLight::Settings;

namespace
{

const int size = 64;

// Waves over the whole image: coarse levels show them too.
osg::ref_ptr<osg::Image> waves(int width, int height)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double s = 2 * osg::PI * (x + 0.5) / width, t = 2 * osg::PI * (y + 0.5) / height;
            image->setColor(osg::Vec4d(0.5 + 0.3 * std::sin(s), 0.5 + 0.3 * std::cos(t), 0.5 + 0.2 * std::sin(s + t), 1),
                            unsigned(x), unsigned(y));
        }
    return image;
}

// A slanted card that repeats the texture.
osg::ref_ptr<osg::Geode> card(osg::Texture2D* texture)
{
    osg::ref_ptr<osg::Geode> quad = makeQuad(osg::Vec3d(-0.9, -0.2, -0.9), osg::Vec3d(1.8, 0.3, 0), osg::Vec3d(0, 0.2, 1.8));
    const osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array;
    for (const auto& [s, t] : {std::pair(-0.7f, -0.4f), {2.3f, -0.4f}, {2.3f, 1.6f}, {-0.7f, 1.6f}})
        st->push_back(osg::Vec2(s, t));
    quad->getDrawable(0)->asGeometry()->setTexCoordArray(0, st);
    quad->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    return quad;
}

// How far the picture lies from the traced one [pixels]: their difference is shift . gradient, by least squares over the
// mask. A filter that is wider or narrower but symmetric has no shift.
double shiftOf(const Picture& drawn, const Picture& traced, const Mask& mask)
{
    double xx = 0, xy = 0, yy = 0, dx = 0, dy = 0;
    for (int y = 1; y + 1 < size; ++y)
        for (int x = 1; x + 1 < size; ++x) {
            if (!mask.at(x - 1, y) || !mask.at(x + 1, y) || !mask.at(x, y - 1) || !mask.at(x, y + 1)) continue;
            const osg::Vec3d d = traced.color(x, y) - drawn.color(x, y);
            const osg::Vec3d gx = (traced.color(x + 1, y) - traced.color(x - 1, y)) * 0.5;
            const osg::Vec3d gy = (traced.color(x, y + 1) - traced.color(x, y - 1)) * 0.5;
            xx += gx * gx, xy += gx * gy, yy += gy * gy, dx += d * gx, dy += d * gy;
        }
    return std::hypot(dx * yy - dy * xy, dy * xx - dx * xy) / (xx * yy - xy * xy);
}

}  // namespace

class TextureSizes : public testing::TestWithParam<std::pair<int, int>>
{
};

TEST_P(TextureSizes, AreNotShifted)
{
    SceneRenderer renderer(size, size);
    const osg::Camera& camera = *renderer.viewer().getCamera();
    const FunctionEnvironment night([](const glm::dvec3&) { return 0.0; });
    const auto& [width, height] = GetParam();
    for (bool powersOfTwo : {true, false})
        for (auto filter : {osg::Texture::LINEAR_MIPMAP_LINEAR, osg::Texture::LINEAR_MIPMAP_NEAREST, osg::Texture::LINEAR}) {
            const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(waves(width, height));
            texture->setResizeNonPowerOfTwoHint(powersOfTwo);
            texture->setFilter(osg::Texture::MIN_FILTER, filter);
            texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
            texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
            const osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0));
            lit->addChild(card(texture));
            lit->getSettings()->view = Settings::ALBEDO;
            const Picture drawn = renderer.render(lit, 2);
            const Picture albedo = Traced(*lit, camera.getViewMatrix(), camera.getProjectionMatrix(), size, size)
                                       .render(night, makeOptions(ReferenceOptions::COSINE, 1, 1), {Layer::ALBEDO})
                                       .mean(Layer::ALBEDO);
            const Mask mask = Mask::geometry(albedo) & Mask::geometry(drawn);
            ASSERT_GT(mask.pixels(), size_t(size * size / 4));
            // Levels that drop the last of an odd number of texels shift the larger images by .5 to 2 pixels; a weight of 8
            // bits places a texel's border to 1/256 of the texel, which has at most 6 pixels here.
            EXPECT_LT(shiftOf(drawn, albedo, mask), 0.05) << "powers of two " << powersOfTwo << ", filter " << filter;
        }
}

INSTANTIATE_TEST_SUITE_P(All, TextureSizes,
                         testing::Values(std::pair(7, 5), std::pair(13, 11), std::pair(127, 63), std::pair(249, 95),
                                         std::pair(250, 251), std::pair(511, 383), std::pair(768, 600)),
                         [](const auto& row) {
                             return std::to_string(row.param.first) + "x" + std::to_string(row.param.second);
                         });

}  // namespace TextureSizes_test
