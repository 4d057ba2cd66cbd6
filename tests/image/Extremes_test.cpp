// SPDX-License-Identifier: MIT
// Visibility where there is hardly anything to see, or too much [systems.md 4.F].
#include <SceneRenderer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Extremes_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

osg::ref_ptr<LitScene> emptyScene(osg::Image* map, int visibility)
{
    osg::ref_ptr<LitScene> lit = makeLit(map);
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->atlasLights = 64;
    lit->getSettings()->visibility = Settings::Visibility(visibility);
    return lit;
}

// What is known of who hides what: by the atlas, by the picture's depth, by both.
class VisibilityExtremes : public testing::TestWithParam<int>
{
};

std::string nameOf(const testing::TestParamInfo<int>& info)
{
    return std::array<const char*, 5>{"Auto", "Screen", "Atlas", "Both", "None"}[size_t(info.param)];
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(Every, VisibilityExtremes,
                         testing::Values(int(Settings::VISIBILITY_AUTO), int(Settings::VISIBILITY_SCREEN),
                                         int(Settings::VISIBILITY_ATLAS)),
                         nameOf);

// From within a solid body all is back faces, near and cut by the near plane.
TEST_P(VisibilityExtremes, TheCameraInsideABody)
{
    SceneRenderer renderer(64, 48);
    osg::ref_ptr<LitScene> lit = emptyScene(lopsidedMap().get(), GetParam());
    lit->addChild(makeBox(osg::Vec3d(-1, -1, -1), osg::Vec3d(1, 1, 1)));
    lit->addChild(makeBox(osg::Vec3d(0.02, 0.4, -0.5), osg::Vec3d(0.7, 0.8, 0.5)));
    for (const Settings::View view : {Settings::VISIBILITY, Settings::BEAUTY})
        for (double x : {0.0, 0.2, 0.99, 1.01}) {
            lit->getSettings()->view = view;
            renderer.lookAt(osg::Vec3d(x, 0, 0), osg::Vec3d(x - 0.3, 1, 0.1));
            const Picture p = renderer.render(lit, 2);
            EXPECT_TRUE(p.finite()) << x;
            const Statistics r = ofGeometry(p);
            EXPECT_GE(r.least, 0.0) << x;
            EXPECT_LE(r.most, view == Settings::VISIBILITY ? 1.0 + 1e-6 : 3.0) << x;
        }
}

// Bars of a pixel's width find no neighbours of their own to be averaged with.
TEST_P(VisibilityExtremes, AFenceOfOnePixel)
{
    SceneRenderer renderer(64, 48);
    osg::ref_ptr<LitScene> lit = emptyScene(constantMap(1.0).get(), GetParam());
    lit->getSettings()->view = Settings::VISIBILITY;
    const double pixel = 8.0 / 64;
    for (int i = -12; i <= 12; ++i)
        lit->addChild(makeBox(osg::Vec3d(2 * i * pixel, 0, 0), osg::Vec3d((2 * i + 1) * pixel, pixel, 2)));
    renderer.lookAt(osg::Vec3d(0, -20, 1), osg::Vec3d(0, 0, 1));
    renderer.viewer().getCamera()->setProjectionMatrixAsOrtho(-4, 4, -3, 3, 1, 40);
    const Statistics r = ofGeometry(renderer.render(lit, 2));
    EXPECT_GT(r.pixels, 300);
    // Faces towards the viewer, of which nothing is hidden.
    EXPECT_GT(r.least, 0.9);
    EXPECT_LE(r.most, 1.0 + 1e-6);
}

// All light comes from below the plane: it is dark, and nothing of it is hidden.
TEST_P(VisibilityExtremes, NoLightInFrontOfASurface)
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = emptyScene(makeMap(32, 16,
                                                    [](const osg::Vec3d& d) {
                                                        const double level = d.z() < -0.3 ? 1.0 : 0.0;
                                                        return osg::Vec3d(level, level, level);
                                                    })
                                                .get(),
                                            GetParam());
    lit->addChild(makeQuad(osg::Vec3d(-2, -2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    renderer.lookAt(osg::Vec3d(0, -1, 3), osg::Vec3d());
    const Statistics beauty = ofGeometry(renderer.render(lit, 2));
    EXPECT_GT(beauty.pixels, 900);
    EXPECT_NEAR(beauty.most, 0.0, 1e-6);
    lit->getSettings()->view = Settings::VISIBILITY;
    const Statistics visibility = ofGeometry(renderer.render(lit, 2));
    EXPECT_NEAR(visibility.least, 1.0, 1e-6);
    EXPECT_NEAR(visibility.most, 1.0, 1e-6);
}

TEST_P(VisibilityExtremes, ALineOf16384Pixels)
{
    SceneRenderer renderer(16384, 1);
    osg::ref_ptr<LitScene> lit = emptyScene(lopsidedMap().get(), GetParam());
    lit->addChild(makeBox(osg::Vec3d(-4, -4, -0.3), osg::Vec3d(4, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-0.3, -0.3, 0), osg::Vec3d(0.3, 0.3, 1.5)));
    renderer.lookAt(osg::Vec3d(0, -8, 4), osg::Vec3d());
    renderer.viewer().getCamera()->setProjectionMatrixAsOrtho(-4, 4, -0.001, 0.001, 1, 40);
    const Picture p = renderer.render(lit, 2);
    EXPECT_TRUE(p.finite());
    EXPECT_EQ(16384, ofGeometry(p).pixels);
    EXPECT_GT(ofGeometry(p).least, 0.0);
}

TEST_P(VisibilityExtremes, NothingAndOneTriangle)
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = emptyScene(constantMap(1.0).get(), GetParam());
    renderer.lookAt(osg::Vec3d(0, 0, 3), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    EXPECT_EQ(0, ofGeometry(renderer.render(lit, 2)).pixels);
    osg::ref_ptr<osg::Geometry> triangle = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (const osg::Vec3& c : {osg::Vec3(-1, -1, 0), osg::Vec3(1, -1, 0), osg::Vec3(0, 1, 0)}) corners->push_back(c);
    triangle->setVertexArray(corners);
    triangle->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    lit->addChild(triangle);
    lit->getSettings()->view = Settings::VISIBILITY;
    const Statistics r = ofGeometry(renderer.render(lit, 2));
    EXPECT_GT(r.pixels, 100);
    EXPECT_NEAR(r.least, 1.0, 1e-3);
    lit->removeChild(triangle);
    EXPECT_EQ(0, ofGeometry(renderer.render(lit, 2)).pixels);
}

// A millionth and a million of the same scene.
TEST_P(VisibilityExtremes, TheSamePictureAtEveryScale)
{
    const auto picture = [&](double scale) {
        SceneRenderer renderer(64, 48);
        osg::ref_ptr<LitScene> lit = emptyScene(lopsidedMap().get(), GetParam());
        const auto box = [&](osg::Vec3d low, osg::Vec3d high) { lit->addChild(makeBox(low * scale, high * scale)); };
        box(osg::Vec3d(-4, -4, -0.3), osg::Vec3d(4, 4, 0));
        box(osg::Vec3d(-0.3, -0.3, 0), osg::Vec3d(0.3, 0.3, 1.5));
        box(osg::Vec3d(-3, 1.5, 0), osg::Vec3d(3, 1.8, 1));
        renderer.lookAt(osg::Vec3d(2, -7, 4) * scale, osg::Vec3d());
        return renderer.render(lit, 3);
    };
    const Picture one = picture(1.0);
    EXPECT_GT(ofGeometry(one).most, 0.2);  // of an albedo of .6
    for (double scale : {1e-6, 1e-3, 1e3, 1e6}) {
        // Rounding moves edges of pixels and of texels by a bit, a few pixels in shadows' edges and outlines with them.
        EXPECT_LT(rootMeanSquare(one, picture(scale)), 0.01) << scale;
    }
}

// Points as far away as the picture has any; bodies without thickness; nothing near.
TEST(OcclusionExtremes, RadiusAndThicknessAtTheirEnds)
{
    SceneRenderer renderer(48, 48);
    osg::ref_ptr<LitScene> lit = emptyScene(constantMap(1.0).get(), Settings::VISIBILITY_SCREEN);
    Settings& s = *lit->getSettings();
    s.view = Settings::VISIBILITY;
    lit->addChild(makeBox(osg::Vec3d(-4, -4, -0.3), osg::Vec3d(4, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-3, 0.5, 0), osg::Vec3d(3, 0.8, 1)));
    renderer.lookAt(osg::Vec3d(0, -7, 4), osg::Vec3d());
    for (const Settings::Method method : {Settings::SLICE, Settings::RAY, Settings::POINT, Settings::GTAO, Settings::BENT_NORMAL})
        for (const auto& [radius, thickness] : {std::pair(0.0f, 0.1f), std::pair(1e-6f, 0.1f), std::pair(100.0f, 0.1f),
                                                std::pair(0.5f, 0.0f), std::pair(0.5f, 1.0f)}) {
            s.occlusionMethod = method;
            s.occlusionRadius = radius;
            s.occlusionThickness = thickness;
            const Picture p = renderer.render(lit, 2);
            const Statistics r = ofGeometry(p);
            EXPECT_TRUE(p.finite()) << int(method) << " " << radius << " " << thickness;
            EXPECT_GE(r.least, radius == 0.0f ? 1.0 : 0.0) << int(method) << " " << radius << " " << thickness;
            EXPECT_LE(r.most, 1.0 + 1e-6) << int(method) << " " << radius << " " << thickness;
        }
}

}  // namespace Extremes_test
